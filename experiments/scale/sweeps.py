"""Measures sweeps and pools of actors on this machine, and appends rows to a table.

Usage: python3 -m experiments.scale.sweeps seeds FOLDER [--turns 3] [--steps 1000000]       one command against three
       python3 -m experiments.scale.sweeps pool FOLDER [--turns 5] [--steps 1000000]        a pool against actors of one run
       python3 -m experiments.scale.sweeps killed FOLDER [--steps 65536]                    a tenth of all processes killed
       python3 -m experiments.scale.sweeps search FOLDER --model g1.xml [--turns 3] [--steps 750000]  Hyperband against random
       all with [--csv sweeps.csv]

`seeds` and `pool` need the machine to themselves. `killed` compares sweeps of twelve trials of `smoke`, of which one is
undisturbed: the goals and the exported policies must be equal. A process is killed with SIGKILL after each tenth one that starts,
at random among those that are alive, the sweep itself included, which then goes on with --resume. In `search`, random settings
train for as many steps in sum as 27 settings that Hyperband prunes, and the best trial of each is evaluated on 100 episodes.

TREADMILL         the program; by default target/release/treadmill
TREADMILL_PYTHON  Python with Optuna, for `search`
"""

import argparse
import csv
import json
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import time

from experiments import report

SOURCES = ("actor", "common", "learner", "src", "python")
COLUMNS = ["what", "turn", "value", "compared with", "unit", "ratio"]
TRIALS = 27
KEYS = """
[keys]
ppo.learning_rate = { log_uniform = [1e-4, 1e-3] }
ppo.entropy_coefficient = { log_uniform = [1e-5, 1e-2] }
policy.init_log_std = { uniform = [-1.5, 0.0] }
"""
GOAL = 'goal = "highest rollout/ep_rew_mean"\n'


def program():
    return os.environ.get("TREADMILL", "target/release/treadmill")


def run(*arguments):
    """Runs the program and returns what it printed."""
    done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"treadmill {' '.join(map(str, arguments))} failed: {done.stderr.strip()}")
    return done.stdout


def seconds(*arguments):
    began = time.monotonic()
    run(*arguments)
    return time.monotonic() - began


def seeds(args, add):
    """Three seeds of `walk` by one command, and by three commands one after the other."""
    for turn in range(1, args.turns + 1):
        common = ["--preset", "walk", "--steps", args.steps]
        folder = args.folder / f"seeds-{turn}"
        swept = seconds("sweep", "--seeds", 3, *common, "--seed", 10 * turn, "--run-dir", folder / "sweep")
        alone = sum(
            seconds("train", *common, "--seed", 10 * turn + seed, "--run-dir", folder / str(seed), "--no-progress") for seed in range(3)
        )
        add("three seeds of `walk` by `sweep`; by hand", turn, f"{swept:.1f}", f"{alone:.1f}", "s", f"{swept / alone:.3f}")


def trained_steps_per_s(folder):
    """Returns the steps per second of a run between its first and its last update."""
    lines = (folder / "metrics.jsonl").read_text(encoding="utf-8").splitlines()
    points = [point for point in map(json.loads, lines) if point["tag"] == "time/total_timesteps"]
    return (points[-1]["step"] - points[0]["step"]) / (points[-1]["time_unix_s"] - points[0]["time_unix_s"])


def fleet(folder, steps, port, actor_flags):
    """Trains `walk` behind a router with two actor processes; returns steps per second."""
    endpoint = f"tcp/127.0.0.1:{port}"
    router = subprocess.Popen([program(), "router", "--listen", endpoint], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    actor = [program(), "actor", "--connect", endpoint, "--envs", "64", *actor_flags]
    actors = [subprocess.Popen(actor, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for _ in range(2)]
    try:
        run("learner", "--preset", "walk", "--steps", steps, "--run-dir", folder, "--connect", endpoint, "--no-progress", "--no-page")
    finally:
        for process in [*actors, router]:
            process.kill()
            process.wait()
    return trained_steps_per_s(folder)


def pool(args, add):
    """Two actors of one run, and two of a pool with this one run."""
    for turn in range(1, args.turns + 1):
        own, pooled = (
            fleet(args.folder / f"{name}-{turn}", args.steps, 7500 + turn, flags)
            for name, flags in (("own", ["--run", f"own-{turn}"]), ("pool", ["--pool"]))
        )
        add("`walk` with a pool of two actors; with two of its own", turn, f"{pooled:.0f}", f"{own:.0f}", "steps/s", f"{pooled / own:.3f}")


def family(root):
    """Returns the process `root` and its descendants that are alive."""
    parents = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            state, parent = stat.read_text(encoding="utf-8").rsplit(")", 1)[1].split()[:2]
        except OSError:
            continue
        if state != "Z":
            parents[int(stat.parent.name)] = int(parent)
    found = {root} & parents.keys()
    while more := {pid for pid, parent in parents.items() if parent in found} - found:
        found |= more
    return found


def results(folder):
    """Returns seed, exit, goal and exported policy of each trial."""
    with (folder / "sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = {}
    for row in rows:
        del row["wall_s"]
        policy = folder / f"{row['trial']}.safetensors"
        run("export", folder / f"trial-{row['trial']}", "--checkpoint", "latest", "--safetensors", policy)
        found[row["trial"]] = (row, policy.read_bytes())
    return found


def sweep_with_kills(folder, arguments, draw):
    """Runs a sweep to its end, and kills processes of it; returns the numbers of those started and killed."""
    seen, killed, log = set(), 0, (folder.parent / f"{folder.name}.log").open("w", encoding="utf-8")
    command = arguments
    while True:
        process = subprocess.Popen([program(), *map(str, command)], stdout=log, stderr=log)
        while process.poll() is None:
            alive = family(process.pid)
            seen |= alive
            if draw and alive and len(seen) >= 10 * (killed + 1):
                victim = draw.choice(sorted(alive))
                try:
                    os.kill(victim, signal.SIGKILL)
                    killed += 1
                except ProcessLookupError:
                    pass
            time.sleep(0.05)
        if process.returncode >= 0:
            return len(seen), killed, process.returncode
        # Trials end with their sweep.
        while family(process.pid):
            time.sleep(0.1)
        command = ["sweep", "--resume", folder]


def killed(args, add):
    """Twelve deterministic trials, undisturbed and with kills."""
    flags = ["sweep", "--seeds", 12, "--preset", "smoke", "--steps", args.steps, "--deterministic", "--run-dir"]
    quiet, disturbed = args.folder / "quiet", args.folder / "disturbed"
    sweep_with_kills(quiet, [*flags, quiet], None)
    started, kills, status = sweep_with_kills(disturbed, [*flags, disturbed], random.Random(1))
    wanted, got = results(quiet), results(disturbed)
    same = sum(got.get(trial) == result for trial, result in wanted.items())
    what = f"trials of 12 with the undisturbed result; {kills} of {started} processes killed, exit {status}"
    add(what, 1, same, len(wanted), "trials", f"{same / len(wanted):.2f}")


def best_return(folder):
    """Returns a sweep's steps in sum, and the return in 100 episodes of the trial whose training reached most."""
    with (folder / "sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    total = sum(int(row["env_steps"]) for row in rows if row["env_steps"])
    best = max((row for row in rows if row["state"] == "complete"), key=lambda row: float(row["goal"]))
    lines = run("eval", folder / f"trial-{best['trial']}", "--episodes", 100, "--json").splitlines()
    return total, json.loads(lines[-1])["return_mean"]


def search(args, add):
    """Searches settings of `g1` with Hyperband, and at random with as many steps."""
    for turn in range(1, args.turns + 1):
        common = ["--preset", "g1", "--model", args.model, "--steps", args.steps, "--seed", 100 * turn]
        file = args.folder / f"search-{turn}.toml"
        found = []
        for name, strategy in (("hyperband", 'strategy = "tpe"\npruner = "hyperband"\n'), ("random", 'strategy = "random"\n')):
            trials = TRIALS if not found else max(1, round(found[0][0] / args.steps))
            folder = args.folder / f"{name}-{turn}"
            file.write_text(f"{strategy}trials = {trials}\n{GOAL}{KEYS}", encoding="utf-8")
            if not folder.exists():
                run("sweep", file, *common, "--run-dir", folder)
            found.append(best_return(folder))
        (steps, hyperband), (random_steps, drawn) = found
        what = f"best of {TRIALS} settings of `g1` by TPE and Hyperband, {steps / 1e6:.1f} M steps in sum; at random, {random_steps / 1e6:.1f} M"
        add(what, turn, f"{hyperband:.0f}", f"{drawn:.0f}", "return", f"{hyperband / drawn:.3f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    measures = {"seeds": (seeds, 3, 1_000_000), "pool": (pool, 5, 1_000_000), "killed": (killed, 1, 65_536), "search": (search, 3, 750_000)}
    parser.add_argument("what", choices=measures)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--turns", type=int)
    parser.add_argument("--steps", type=int)
    parser.add_argument("--model")
    parser.add_argument("--csv", type=pathlib.Path)
    args = parser.parse_args()
    measure, turns, steps = measures[args.what]
    args.turns, args.steps = args.turns or turns, args.steps or steps
    args.folder.mkdir(parents=True, exist_ok=True)
    ratios = []

    def add(*cells):
        print(*cells, sep=" | ", flush=True)
        ratios.append(float(cells[-1]))
        if args.csv:
            report.append_row(args.csv, COLUMNS, cells, SOURCES)

    measure(args, add)
    print(f"median ratio {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
