"""Compares the speed of Treadmill's learning with PyTorch and Stable-Baselines3, in turn on the same cores.

Needs: pip install torch stable-baselines3 "gymnasium[mujoco]" numpy
       cargo build --release

Usage: speed.py target/release/treadmill [--rounds 5] [--without-training] [--json OUT.json] [--csv FILE.csv]

Each round runs both sides of every comparison; odd rounds reverse the order, and a ratio belongs to one round. Update and
inference use one core and thread; the two-thread update and training use two cores. torch_ppo.py has PyTorch's side.
Stable-Baselines3 runs with one thread and with one per core, and the faster one counts. Five rounds take about a quarter of an
hour. Run it on an idle machine.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
import torch

from experiments import report
from experiments.fidelity import speed_peers
from experiments.learning import torch_ppo

SMALL, LARGE = (45, 256, 128), (348, 512, 256)
MINIBATCH, ROWS = 2048, 64
HAND_MADE = torch_ppo.HandMadeElu
PACKAGES = ("torch", "stable-baselines3", "gymnasium", "mujoco", "numpy")
SOURCES = ("src", "common", "learner", "actor", "Cargo.lock")

COMPARISONS = {
    "update": ("Update, 45–256–128, samples/s", "PyTorch, one thread each", "at least 1.2"),
    "update_hand_made": ("Update, 45–256–128, samples/s", "PyTorch with a hand-made ELU", "–"),
    "update_large": ("Update, 348–512–256, samples/s", "PyTorch, one thread each", "at least 1.0"),
    "two_threads": ("Update on two threads, 45–256–128, samples/s", "Treadmill on one thread", "at least 1.6"),
    "inference": ("Actions for 64 observations, 45–256–128, µs", "PyTorch, one thread each", "at most 0.7"),
    "inference_hand_made": ("Actions for 64 observations, 45–256–128, µs", "PyTorch with a hand-made ELU", "–"),
    "training": ("Training on two cores, environment steps/s", "Stable-Baselines3's PPO", "at least 18"),
}


def treadmill(binary, cores, *arguments):
    """Returns the output of `treadmill bench`, pinned to these cores."""
    command = [str(binary), "bench", *map(str, arguments), "--json"]
    run = subprocess.run(command, capture_output=True, text=True, preexec_fn=lambda: os.sched_setaffinity(0, cores))
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)} failed: {run.stderr.strip()}")
    return json.loads(run.stdout.strip().splitlines()[-1])


def pinned(cores, threads, measure):
    """Runs `measure` pinned to these cores, with this many PyTorch threads."""
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, cores)
    torch.set_num_threads(threads)
    try:
        return measure()
    finally:
        os.sched_setaffinity(0, before)


def update(arguments, cores, widths, threads=1):
    """Returns Treadmill's samples per second."""
    options = ["--network", "-".join(map(str, widths)), "--threads", threads, "--updates", arguments.updates]
    return treadmill(arguments.treadmill, cores, "update", "--minibatch", MINIBATCH, *options)["samples_per_s"]


def sides(arguments, one, two):
    """Returns the two measurements of each comparison, Treadmill's first."""

    def torch_update(widths, **options):
        return pinned(one, 1, lambda: torch_ppo.samples_per_s(widths, MINIBATCH, arguments.updates, **options))

    def torch_inference(**options):
        return pinned(one, 1, lambda: torch_ppo.call_us(SMALL, ROWS, arguments.calls, **options))

    def other_training():
        return pinned(two, len(two), lambda: speed_peers.stable_baselines(arguments.sb3_steps, len(two)))

    def inference():
        return treadmill(arguments.treadmill, one, "policy", "--rows", ROWS, "--calls", arguments.calls)["call_us"]

    def training():
        return treadmill(arguments.treadmill, two, "train", "--steps", arguments.train_steps)["env_steps_per_s"]

    found = {
        "update": (lambda: update(arguments, one, SMALL), lambda: torch_update(SMALL)),
        "update_hand_made": (lambda: update(arguments, one, SMALL), lambda: torch_update(SMALL, elu=HAND_MADE)),
        "update_large": (lambda: update(arguments, one, LARGE), lambda: torch_update(LARGE)),
        "two_threads": (lambda: update(arguments, two, SMALL, threads=2), lambda: update(arguments, one, SMALL)),
        "inference": (inference, torch_inference),
        "inference_hand_made": (inference, lambda: torch_inference(elu=HAND_MADE)),
        "training": (training, other_training),
    }
    if arguments.without_training:
        del found["training"]
    if len(two) < 2:
        print("only one core: skipping the update on two threads", file=sys.stderr)
        del found["two_threads"]
    return found


def one_round(measures, number):
    """Measures both sides of each comparison."""
    found = {}
    for name, both in measures.items():
        order = (0, 1) if number % 2 == 0 else (1, 0)
        values = {side: both[side]() for side in order}
        found[name] = [values[0], values[1]]
        print(f"round {number + 1}, {name}: {values[0]:.1f} against {values[1]:.1f}", file=sys.stderr)
    return found


def table(rounds):
    """Formats medians of both sides, and median and range of their ratio within rounds."""

    def rounded(value):
        return f"{value:.0f}" if value >= 1000 else f"{value:.3g}"

    rows = []
    for name in rounds[0]:
        ours, theirs = zip(*(found[name] for found in rounds))
        ratios = [mine / other for mine, other in zip(ours, theirs)]
        what, against, wanted = COMPARISONS[name]
        spread = f"{min(ratios):.2f} to {max(ratios):.2f}"
        medians = [rounded(statistics.median(values)) for values in (ours, theirs)]
        rows.append([what, medians[0], f"{against}: {medians[1]}", f"{statistics.median(ratios):.2f}", spread, wanted])
    header = ["", "Treadmill", "compared with", "ratio", "range", "target"]
    return report.table(header, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--updates", type=int, default=5, help="updates per candidate and round")
    parser.add_argument("--calls", type=int, default=10_000, help="calls of the policy per candidate and round")
    parser.add_argument("--train-steps", type=int, default=500_000, help="of Treadmill, per round")
    parser.add_argument("--sb3-steps", type=int, default=20_480, help="of Stable-Baselines3, per round")
    parser.add_argument("--without-training", action="store_true", help="measure only update and inference")
    parser.add_argument("--cores", help="two cores to use, for example 0,1; default: the first allowed ones")
    parser.add_argument("--json", type=pathlib.Path, help="file for all numbers")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    allowed = sorted(os.sched_getaffinity(0))
    cores = [int(core) for core in arguments.cores.split(",")] if arguments.cores else allowed
    load = os.getloadavg()[0]
    measures = sides(arguments, set(cores[:1]), set(cores[:2]))
    rounds = [one_round(measures, number) for number in range(arguments.rounds)]
    made = report.circumstances(PACKAGES, SOURCES)
    lead = f"{report.made_by(made, PACKAGES)} {len(rounds)} rounds; load of the machine before: {load:.1f}."
    text = f"{lead}\n\n{table(rounds)}"
    print(text)
    if arguments.json:
        report.write_json(arguments.json, {"made": made, "load": load, "rounds": rounds})
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
