#!/usr/bin/env python3
"""Trains with few and with many environments and compares the environment steps until the humanoid walks 10 m.

Usage: environments.py target/release/treadmill FOLDER [--envs 64 512 4096] [--seeds 1 2 3] [--steps 8000000] [--jobs 2]
                       [--set KEY=VALUE ...] [--label NAME]
       environments.py FOLDER --csv FILE.csv

The first form trains the runs that FOLDER lacks, under the automatic rules for horizons, batches and minibatches; `--set` changes
settings of a variant that `--label` names. The second form tabulates all runs. Every run has one actor process and one update
thread, so that parallel runs do not disturb each other. Compare steps, not times. Needs no Python packages.
"""

import argparse
import json
import pathlib
import statistics

from experiments import report
from experiments.learning import search

# Environment steps after which the distance is tabulated.
CHECKPOINTS = (4_000_000, 8_000_000)


def folder_of(root, label, envs, seed):
    """Returns the run's folder, whose name must be valid in bus keys."""
    return root / f"{label}-{envs}-{seed}"


def train(binary, root, label, envs, seed, steps, changes):
    """Trains one run unless it is complete."""
    flags = ["--preset", "own-task", "--seed", str(seed), "--steps", str(steps), "--envs", str(envs)]
    note = {"label": label, "envs": envs, "seed": seed, "steps": steps, "changes": changes}
    search.train(binary, folder_of(root, label, envs, seed), flags, changes, note)


def distance_at(folder, steps):
    """Returns the mean distance of the evaluations in the last 400 000 steps before `steps`, or `None` without any."""
    evaluated = {}
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            if metric["tag"] in ("eval/distance_mean_m", "eval/total_timesteps"):
                evaluated.setdefault(metric["step"], {})[metric["tag"]] = metric["value"]
    late = [
        values["eval/distance_mean_m"]
        for values in evaluated.values()
        if steps - 400_000 < values.get("eval/total_timesteps", 0) <= steps + 200_000
    ]
    return statistics.mean(late) if late else None


def last_of(folder, tag):
    """Returns the last value of a tag."""
    value = None
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            value = metric["value"] if metric["tag"] == tag else value
    return value


def metres(distance_m):
    return "–" if distance_m is None else f"{distance_m:.1f}"


def table(root):
    """Formats a row per variant and number of environments."""
    notes = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(root.glob("*.json"))]
    kinds = sorted({(note["label"], note["envs"]) for note in notes}, key=lambda kind: (kind[0] != "automatic", *kind))
    rows = []
    for label, envs in kinds:
        of_kind = [note for note in notes if (note["label"], note["envs"]) == (label, envs)]
        folders = [folder_of(root, label, envs, note["seed"]) for note in of_kind]
        found = [search.measure(folder) for folder in folders]
        ends = [", ".join(metres(distance_at(folder, steps)) for folder in folders) for steps in CHECKPOINTS]
        changes = "<br>".join(f"`{change}`" for change in of_kind[0]["changes"]) or "–"
        batch = statistics.median(last_of(folder, "train/batch") for folder in folders)
        reached = [one["to_10_m"] for one in found]
        each = ", ".join(search.million(steps) for steps in reached)
        seeds = ", ".join(str(note["seed"]) for note in of_kind)
        rows.append([str(envs), changes, f"{batch:.0f}", seeds, search.million(search.median(reached)), each, *ends])
    header = ["environments", "`--set`", "batch", "seeds", "10 m after", "each seed", "4 M steps: m", "8 M steps: m"]
    return report.table(header, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=pathlib.Path, metavar="PATH", help="the binary, if any, and the folder")
    parser.add_argument("--envs", nargs="+", type=int, default=[64, 512, 4096])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=8_000_000)
    parser.add_argument("--jobs", type=int, default=2, help="parallel runs")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", dest="changes")
    parser.add_argument("--label", default="automatic", help="name of the variant")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    *binary, root = arguments.paths
    if binary:
        root.mkdir(parents=True, exist_ok=True)
        runs = [(envs, seed) for envs in arguments.envs for seed in arguments.seeds]
        train_one = lambda envs, seed: train(binary[0], root, arguments.label, envs, seed, arguments.steps, arguments.changes)
        search.run_all(train_one, runs, arguments.jobs)
    text = table(root)
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
