#!/usr/bin/env python3
"""Searches for settings that learn to walk sooner: trains each candidate on several seeds and tabulates the results.

Usage: search.py target/release/treadmill FOLDER [--only NAME ...] [--seeds 1 2 3] [--steps 4000000] [--jobs 2]
       search.py FOLDER --csv FILE.csv

The first form trains the runs that FOLDER lacks; the second tabulates all its runs. Every 200 000 steps, a run is evaluated on ten
deterministic episodes of at most 15 s. Each run has one actor process and one update thread, so two parallel runs use two cores.
Compare steps, not times, with a run that has the machine to itself. Needs no Python packages.
"""

import argparse
import concurrent.futures
import json
import pathlib
import shutil
import statistics
import subprocess
import sys

from experiments import report

# Changes of each candidate.
CANDIDATES = {
    "default": [],
    "target KL 0.02": ["ppo.target_kl=0.02"],
    "target KL 0.02, learning rate 1e-3": ["ppo.target_kl=0.02", "ppo.learning_rate=1e-3", "ppo.learning_rate_max=2e-3"],
    "target KL 0.02, first log std −1": ["ppo.target_kl=0.02", "policy.init_log_std=-1"],
    "target KL 0.02, network 512–256": ["ppo.target_kl=0.02", "policy.hidden=[512, 256]"],
    "γ 0.98": ["ppo.gamma=0.98"],
    "λ 0.9": ["ppo.gae_lambda=0.9"],
    "γ 0.98, λ 0.9": ["ppo.gamma=0.98", "ppo.gae_lambda=0.9"],
    "γ 0.985, λ 0.9": ["ppo.gamma=0.985", "ppo.gae_lambda=0.9"],
    "γ 0.985, λ 0.9, the batch grows, as in `walk`": ["ppo.gamma=0.985", "ppo.gae_lambda=0.9", "ppo.batch_growth_steps=1000000"],
    "γ 0.985, λ 0.9, target KL 0.02": ["ppo.gamma=0.985", "ppo.gae_lambda=0.9", "ppo.target_kl=0.02"],
    "γ 0.98, λ 0.9, the batch grows": ["ppo.gamma=0.98", "ppo.gae_lambda=0.9", "ppo.batch_growth_steps=1000000"],
    "3 passes": ["ppo.target_kl=0.03", "ppo.epochs=3"],
    "minibatch 256, 3 passes": ["ppo.target_kl=0.03", "ppo.epochs=3", "ppo.minibatch=256"],
    "batch 4096, 3 passes": ["ppo.target_kl=0.03", "ppo.epochs=3", "ppo.batch=4096"],
    "batch 4096, minibatch 256, 2 passes": ["ppo.target_kl=0.048", "ppo.epochs=2", "ppo.batch=4096", "ppo.minibatch=256"],
    "dense networks": ["ppo.target_kl=0.03", "ppo.epochs=3", "ppo.batch=4096", "ppo.symmetry=off"],
}


def folder_of(root, name, seed):
    """Returns the run's folder, whose name must be valid in bus keys."""
    plain = name.replace("γ", "gamma").replace("λ", "lambda").replace("×", "x").replace("–", "-").replace("−", "minus-")
    plain = plain.replace(",", "").replace(".", "-").replace(" ", "-")
    return root / f"{plain}-{seed}"


def note_of(folder):
    """Returns the file that marks a run as complete."""
    return folder.parent / f"{folder.name}.json"


def train(binary, folder, flags, changes, note):
    """Trains a run with one actor process and one update thread, unless its note says that it is complete. Restarts one that
    is not."""
    done = note_of(folder)
    if done.exists():
        return
    if folder.exists():
        shutil.rmtree(folder)
    command = [str(binary), "train", "--run-dir", str(folder), "--no-progress", "--json", *flags]
    for change in ["rollout.actors=1", "learner.threads=1", *changes]:
        command += ["--set", change]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)} failed: {run.stderr.strip()}")
    if json.loads(run.stdout.splitlines()[-1])["stopped"]:
        sys.exit(f"{folder} was stopped before its last step")
    done.write_text(json.dumps(note) + "\n", encoding="utf-8")
    print(f"{folder.name} is trained", file=sys.stderr)


def train_candidates(binary, root, candidates, names, seeds, flags, jobs):
    """Trains each named candidate with each seed, `jobs` at once."""

    def train_one(seed, name):
        seeded = ["--seed", str(seed), *flags]
        train(binary, folder_of(root, name, seed), seeded, candidates[name], {"name": name, "seed": seed})

    root.mkdir(parents=True, exist_ok=True)
    run_all(train_one, [(seed, name) for seed in seeds for name in names], jobs)


def run_all(train_one, runs, jobs):
    """Calls `train_one` with each of `runs`, in `jobs` threads."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for job in [pool.submit(train_one, *run) for run in runs]:
            job.result()


def measure(folder):
    """Returns the results of a run's evaluations."""
    by_step = report.by_step(folder)
    evaluations = {}
    for values in by_step.values():
        if "eval/distance_mean_m" in values:
            evaluations[values["eval/total_timesteps"]] = values
    last = [evaluations[step] for step in sorted(evaluations)[-3:]]

    def reached(distance_m):
        return next((step for step in sorted(evaluations) if evaluations[step]["eval/distance_mean_m"] >= distance_m), None)

    def late(tag):
        return statistics.mean(values[tag] for values in last)

    return {
        "to_5_m": reached(5),
        "to_10_m": reached(10),
        "to_20_m": reached(20),
        "distance_m": late("eval/distance_mean_m"),
        "return": late("eval/mean_reward"),
        "falls": late("eval/fall_fraction"),
        "training_return": by_step[max(by_step)]["rollout/ep_rew_mean"],
    }


def million(steps):
    return "–" if steps is None else f"{steps / 1e6:.1f} M"


def median(values):
    """Returns the upper median; None (never reached) counts as the largest."""
    ordered = sorted(values, key=lambda value: float("inf") if value is None else value)
    return ordered[len(ordered) // 2]


def table(root):
    """Formats a row per trained candidate: medians, and each seed's final distance."""
    rows = []
    for name, changes in CANDIDATES.items():
        notes = [json.loads(path.read_text(encoding="utf-8")) for path in root.glob("*.json")]
        trained = sorted(note["seed"] for note in notes if note["name"] == name)
        found = [measure(folder_of(root, name, seed)) for seed in trained]
        if not found:
            continue
        seeds = ", ".join(map(str, trained))
        steps = [million(median([one[f"to_{metres}_m"] for one in found])) for metres in (5, 10, 20)]
        ends = ", ".join(f"{one['distance_m']:.1f}" for one in found)
        middle = f"{statistics.median(one['distance_m'] for one in found):.1f} m"
        falls = f"{100 * statistics.mean(one['falls'] for one in found):.0f} %"
        training = f"{statistics.median(one['training_return'] for one in found):.0f}"
        settings = "<br>".join(f"`{change}`" for change in changes) or "–"
        rows.append([name, settings, seeds, *steps, middle, ends, falls, training])
    header = ["", "`--set`", "seeds", "5 m after", "10 m after", "20 m after", "distance at the end", "each seed's (m)"]
    return report.table([*header, "falls", "return in training"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=pathlib.Path, metavar="PATH", help="the binary, if any, and the folder")
    parser.add_argument("--only", nargs="+", choices=CANDIDATES, default=list(CANDIDATES), metavar="NAME")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=4_000_000)
    parser.add_argument("--jobs", type=int, default=2, help="parallel runs")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    *binary, root = arguments.paths
    if binary:
        # The preset without keys of its own.
        flags = ["--preset", "own-task", "--steps", str(arguments.steps)]
        train_candidates(binary[0], root, CANDIDATES, arguments.only, arguments.seeds, flags, arguments.jobs)
    text = table(root)
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
