"""Measures how long a robot trains until it obeys velocity commands: the rows of time_to_obey.csv.

Usage: python3 -m experiments.robots.obeys PRESET MODEL STEPS FOLDER [--seeds 1 2 3] [--errors 0.15 0.2] [--falls 5] [--first 1]
                [--all] [--set KEY=VALUE ...] [--csv time_to_obey.csv]

A robot obeys at the first checkpoint that, played without exploration for 100 episodes of 20 s with drawn commands and with the
pushes of the training, misses the commanded velocity by at most the first error (m/s) and the yaw rate by at most the second
(rad/s), and falls in at most so many of the episodes, here and in MuJoCo. Its time counts from the start of `train`, with all that
`train` does, evaluations included. Each seed trains to STEPS alone; checkpoints are measured afterwards. A run that FOLDER holds is
only measured; the seconds of one that was resumed count from there. `--csv` appends the rows to a table, with this repository's commit.

TREADMILL  the program; by default target/release/treadmill
PYTHON     Python with mujoco and onnxruntime, and python/ of this repository on its path; by default this one
"""

import argparse
import bisect
import json
import os
import pathlib
import subprocess
import sys

from experiments import report

EPISODES = 100
# Pushes as in training, everything else exact.
PUSHES = ["--set", "randomisation.push_mps=[0.0,0.5]", "--set", "randomisation.push_interval_s=[5.0,10.0]"]
SOURCES = ("actor", "common", "learner", "src")
MEASURED = ["velocity error", "yaw rate error", "falls"]
COLUMNS = ["preset", f"goal, of {EPISODES} episodes", "seed", "steps", "seconds from the start of `train`", "obeys", *MEASURED]
COLUMNS += [f"in MuJoCo: {MEASURED[0]}", *MEASURED[1:]]
CHECKPOINTS = ["--set", "learner.checkpoint_every_updates=100", "--set", "learner.keep_checkpoints=1000"]


def last_line(command):
    """Runs a command and returns the JSON of its last line."""
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed: {run.stderr.strip()}")
    return json.loads(run.stdout.splitlines()[-1])


def train(program, args, seed, folder):
    """Trains a run unless it exists, and notes when it began."""
    if folder.exists():
        return
    changes = [flag for change in args.set for flag in ("--set", change)]
    fixed = ["--preset", args.preset, "--model", args.model, "--steps", str(args.steps), "--seed", str(seed)]
    last_line([program, "train", *fixed, "--run-dir", folder, "--json", "--no-progress", *CHECKPOINTS, *changes])


def began_unix_s(folder):
    """Returns when `train` made the run's folder."""
    return min(file.stat().st_mtime for file in (folder / "config.toml", folder / "model.xml"))


def measured(found):
    """Returns what a simulator's summary says of velocity (m/s), yaw rate (rad/s) and falls."""
    return {"velocity_mps": found["velocity_error_mps"], "yaw_radps": found["yaw_rate_error_radps"], "falls": found["falls"]}


def steps_at(folder):
    """Returns a function from updates of a run to its environment steps, to the next logged update."""
    metrics = map(json.loads, (folder / "metrics.jsonl").read_text(encoding="utf-8").splitlines())
    logged = sorted((metric["value"], metric["step"]) for metric in metrics if metric["tag"] == "time/iterations")
    return lambda update: logged[min(bisect.bisect_left(logged, (update,)), len(logged) - 1)][1]


def here(program, folder, update):
    """Measures a checkpoint in Treadmill."""
    command = [program, "eval", folder, "--checkpoint", update, "--episodes", str(EPISODES), *PUSHES, "--json"]
    return measured(last_line(command))


def in_mujoco(program, args, folder, update):
    """Measures a checkpoint in MuJoCo."""
    policy = folder / f"policy-{update}.onnx"
    last_line([program, "export", folder, "--checkpoint", update, "--onnx", policy, "--json"])
    python = os.environ.get("PYTHON", sys.executable)
    command = [python, "-m", "treadmill_transfer", policy, "--model", args.model, "--episodes", str(EPISODES), "--json"]
    return measured(last_line(command))


def obeys(args, found):
    return found["velocity_mps"] <= args.errors[0] and found["yaw_radps"] <= args.errors[1] and found["falls"] <= args.falls


def measure(program, args, seed, folder):
    """Yields the measurements of each checkpoint until one obeys in both simulators."""
    began = began_unix_s(folder)
    numbered = [file for file in sorted((folder / "checkpoints").glob("0*.bundle")) if int(file.stem) >= args.first]
    steps = steps_at(folder)
    for checkpoint in [*numbered, folder / "checkpoints/latest.bundle"]:
        update = checkpoint.stem.lstrip("0")
        row = {"preset": args.preset, "seed": seed, "checkpoint": update, "seconds": checkpoint.stat().st_mtime - began}
        row["steps"] = steps(float("inf") if update == "latest" else int(update))
        row["here"] = here(program, folder, update)
        if obeys(args, row["here"]) or args.all:
            row["mujoco"] = in_mujoco(program, args, folder, update)
        row["obeys"] = "mujoco" in row and obeys(args, row["here"]) and obeys(args, row["mujoco"])
        yield row


def cells(args, row):
    """Returns the cells of a row of time_to_obey.csv."""
    goal = f"{args.errors[0]:g} m/s, {args.errors[1]:g} rad/s, {args.falls} falls"
    measured = [row["here"], row.get("mujoco")]
    found = [(f"{one['velocity_mps']:.3f} m/s", f"{one['yaw_radps']:.3f} rad/s", one["falls"]) if one else "–––" for one in measured]
    obeys = "yes" if row["obeys"] else "no"
    changes = [f"`{args.preset}`", *args.set]
    return [", ".join(changes), goal, row["seed"], f"{row['steps'] / 1e6:.2f} M", round(row["seconds"]), obeys, *found[0], *found[1]]


def arguments(doc, first):
    """Returns a parser of what each measurement takes, after its first argument."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(first)
    parser.add_argument("model")
    parser.add_argument("steps", type=int)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--falls", type=int, default=5)
    parser.add_argument("--first", type=int, default=1, help="update of the first checkpoint to measure")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--all", action="store_true", help="measure every checkpoint, each in both simulators")
    return parser


def each_seed(args, columns, reached, train, measure, cells):
    """Trains and measures each seed, until a row has what `reached` names."""
    program = os.environ.get("TREADMILL", "target/release/treadmill")
    for seed in args.seeds:
        folder = args.folder / f"{args.preset}-{seed}"
        train(program, args, seed, folder)
        for row in measure(program, args, seed, folder):
            print(json.dumps(row), flush=True)
            if args.csv:
                report.append_row(args.csv, columns, cells(args, row), SOURCES)
            if row[reached] and not args.all:
                break


def main():
    parser = arguments(__doc__, "preset")
    parser.add_argument("--errors", type=float, nargs=2, default=[0.15, 0.2])
    each_seed(parser.parse_args(), COLUMNS, "obeys", train, measure, cells)


if __name__ == "__main__":
    main()
