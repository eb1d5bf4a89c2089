"""Trains the same presets and seeds with several builds in turn, and tabulates their evaluations: the rows of curves.csv.

Usage: python3 -m experiments.learning.curves FOLDER --build COMMIT=PROGRAM [--build ...] --preset PRESET STEPS [MODEL] [--preset ...] [--seeds 1 2 3]
                 --csv FILE.csv

Each run has the machine to itself, and its time counts from the start of `train`. A complete run that FOLDER holds is only
tabulated.
`python3 -m experiments.pictures` draws the table. Needs no Python packages.
"""

import argparse
import csv
import json
import pathlib
import subprocess
import sys

from experiments import report

TAGS = {"return": "eval/mean_reward", "distance (m)": "eval/distance_mean_m", "falls": "eval/fall_fraction"}


def train(program, folder, seed, preset, steps, model=None):
    """Trains a run unless it exists."""
    if folder.exists():
        last = json.loads((folder / "metrics.jsonl").read_text(encoding="utf-8").splitlines()[-1])["step"]
        if last < int(steps):
            sys.exit(f"{folder} ended after {last} of {steps} steps; remove it")
        return
    command = [program, "train", "--preset", preset, "--steps", steps, "--seed", str(seed), "--run-dir", folder]
    run = subprocess.run([*command, *(["--model", model] if model else []), "--json", "--no-progress"], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{folder}: {run.stderr.strip()}")


def evaluations(folder):
    """Yields environment steps, seconds since the start of `train`, and the values of each evaluation of a run."""
    began = min(file.stat().st_mtime for name in ("config.toml", "model.xml") if (file := folder / name).exists())
    found = {}
    for line in (folder / "metrics.jsonl").read_text(encoding="utf-8").splitlines():
        metric = json.loads(line)
        if metric["tag"] in TAGS.values():
            values = found.setdefault(metric["step"], {"seconds": metric["time_unix_s"] - began})
            values[metric["tag"]] = metric["value"]
    for step, values in sorted(found.items()):
        if len(values) > len(TAGS):
            yield step, values["seconds"], [values[tag] for tag in TAGS.values()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--build", action="append", required=True)
    parser.add_argument("--preset", action="append", nargs="+", required=True)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--csv", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    rows = []
    for preset in arguments.preset:
        for seed in arguments.seeds:
            for build in arguments.build:
                commit, program = build.split("=", 1)
                folder = arguments.folder / commit / f"{preset[0]}-{seed}"
                train(program, folder, seed, *preset)
                for step, seconds, values in evaluations(folder):
                    rows.append([preset[0], commit, seed, step, f"{seconds:.1f}", *(f"{value:.4g}" for value in values)])
    with arguments.csv.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["preset", "commit", "seed", "env steps", "seconds", *TAGS, "machine"])
        writer.writerows([*row, report.cpu_model()] for row in rows)


if __name__ == "__main__":
    main()
