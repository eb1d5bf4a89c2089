"""Trains a robot from its maker's file, without card or preset, and measures its policy here and in MuJoCo: the rows of any_robot.csv.

Usage: python3 -m experiments.robots.any_robot NAME MODEL STEPS FOLDER [--seeds 1 2 3] [--set KEY=VALUE ...]
                [--package NAME=FOLDER ...]

Episodes of 20 s have drawn commands and the pushes of the training, everything else exact. The error of the velocity is also
given by √(g × leg length), so that robots of different sizes compare. MuJoCo plays the ONNX file on the same MJCF; for a URDF on the
`model.xml` of the run, since its own reader of URDF leaves the root without a joint. A run that FOLDER holds is only measured.

TREADMILL  the program; by default target/release/treadmill
PYTHON     Python with mujoco and onnxruntime, and python/ of this repository on its path; by default this one
"""

import argparse
import csv
import json
import os
import pathlib
import sys
import tomllib

from experiments.robots.obeys import last_line

EPISODES = "100"
GRAVITY_MPS2 = 9.81
COLUMNS = ["robot", "seed", "steps", "seconds", "leg length (m)", "simulator", "velocity error (m/s)", "÷ √(g L)",
           "yaw rate error (rad/s)", "falls of 100"]  # fmt: skip


def row(args, seed, trained, leg_length_m, simulator, found):
    """Returns a row of the table from a simulator's summary."""
    errors = [found["velocity_error_mps"], found["velocity_error_mps"], found["yaw_rate_error_radps"]]
    units = [1.0, (GRAVITY_MPS2 * leg_length_m) ** 0.5, 1.0]
    # A policy that always falls at once has no errors.
    numbers = ["–" if error is None else f"{error / unit:.3f}" for error, unit in zip(errors, units)] + [found["falls"]]
    return [args.name, seed, trained["env_steps"], f"{trained['wall_s']:.0f}", f"{leg_length_m:.3f}", simulator, *numbers]


def measure(program, args, seed, folder):
    """Trains a run unless it exists, and yields its rows."""
    flags = [flag for change in args.set for flag in ("--set", change)]
    flags += [flag for package in args.package for flag in ("--package", package)]
    summary = folder.with_suffix(".json")
    if not folder.exists():
        fixed = ["--task", "velocity", "--model", args.model, "--steps", args.steps, "--seed", str(seed)]
        trained = last_line([program, "train", *fixed, "--run-dir", folder, "--json", "--no-progress", *flags])
        summary.write_text(json.dumps(trained))
    trained = json.loads(summary.read_text())
    pushes = tomllib.loads((folder / "config.toml").read_text())["randomisation"]
    pushed = [flag for key in ("push_mps", "push_interval_s") for flag in ("--set", f"randomisation.{key}={pushes[key]}")]
    here = last_line([program, "eval", folder, "--checkpoint", "latest", "--episodes", EPISODES, *pushed, "--json"])
    leg_length_m = last_line([program, "robot", folder / "model.xml", "--json"])["leg_length_m"]
    yield row(args, seed, trained, leg_length_m, "Treadmill", here)
    policy = folder / "policy.onnx"
    last_line([program, "export", folder, "--checkpoint", "latest", "--onnx", policy, "--json"])
    model = folder / "model.xml" if args.model.endswith(".urdf") else args.model
    python = [os.environ.get("PYTHON", sys.executable), "-m", "treadmill_transfer", policy, "--model", model]
    yield row(args, seed, trained, leg_length_m, "MuJoCo", last_line([*python, "--episodes", EPISODES, "--json"]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name")
    parser.add_argument("model")
    parser.add_argument("steps")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--package", action="append", default=[])
    parser.add_argument("--header", action="store_true", help="print the names of the columns first")
    args = parser.parse_args()
    table = csv.writer(sys.stdout, lineterminator="\n")
    if args.header:
        table.writerow(COLUMNS)
    program = os.environ.get("TREADMILL", "target/release/treadmill")
    args.folder.mkdir(parents=True, exist_ok=True)
    for seed in args.seeds:
        for found in measure(program, args, seed, args.folder / f"{args.name}-{seed}"):
            table.writerow(found)
            sys.stdout.flush()


if __name__ == "__main__":
    main()
