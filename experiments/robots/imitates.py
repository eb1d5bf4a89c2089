"""Measures how long a robot trains until it imitates a motion: the rows of time_to_imitate.csv.

MOTION is a file or a folder; several have commas between them.

Usage: python3 -m experiments.robots.imitates MOTION MODEL STEPS FOLDER [--preset g1-motion] [--seeds 1 2 3] [--bodies 0.06]
                [--falls 5] [--first 1] [--all] [--set KEY=VALUE ...] [--csv time_to_imitate.csv]

A robot imitates a motion at the first checkpoint that, played without exploration for 100 episodes from the first frame, with the
offsets of the training at the start and without pushes, leaves the motion before its end in at most so many episodes, and whose
links are within so many metres of it in the mean, moved so that the anchors lie above each other. The same is measured in MuJoCo by
the exported ONNX alone, and does not decide. Its time counts from the start of `train`, with all that `train` does, evaluations
included. Each seed trains to STEPS alone; checkpoints are measured afterwards. A run that FOLDER holds is only
measured; the seconds of one that was resumed count from there.

TREADMILL  the program; by default target/release/treadmill
PYTHON     Python with mujoco and onnxruntime, and python/ of this repository on its path; by default this one
"""

import os
import pathlib
import sys

from experiments.robots.obeys import CHECKPOINTS, EPISODES, arguments, began_unix_s, each_seed, last_line, steps_at

MEASURED = ["finished", "share done", "error of links", "angle of links"]
COLUMNS = ["preset", "motion", "seed", "steps", "seconds from the start of `train`", "imitates", *MEASURED]
COLUMNS += [f"in MuJoCo: {MEASURED[0]}", *MEASURED[1:]]


def train(program, args, seed, folder):
    """Trains a run unless it exists."""
    if folder.exists():
        return
    changes = [flag for change in args.set for flag in ("--set", change)]
    fixed = ["--preset", args.preset, "--model", args.model, "--steps", str(args.steps), "--seed", str(seed)]
    motion = ["--motion", *args.motion.split(",")]
    last_line([program, "train", *fixed, *motion, "--run-dir", folder, "--json", "--no-progress", *CHECKPOINTS, *changes])


def measured(found):
    """Returns what a simulator's summary says of falls, share, error (m) and angle (rad)."""
    return {"falls": found["falls"], "done": found["done_share"], "bodies_m": found["body_error_m"], "bodies_rad": found["body_error_rad"]}


def in_mujoco(program, args, folder, update):
    """Measures a checkpoint in MuJoCo."""
    policy = folder / f"policy-{update}.onnx"
    last_line([program, "export", folder, "--checkpoint", update, "--onnx", policy, "--json"])
    python = os.environ.get("PYTHON", sys.executable)
    command = [python, "-m", "treadmill_transfer", policy, "--model", args.model, "--episodes", str(EPISODES), "--no-pushes", "--json"]
    return measured(last_line(command))


def measure(program, args, seed, folder):
    """Yields the measurements of each checkpoint until one imitates the motion."""
    began = began_unix_s(folder)
    numbered = [file for file in sorted((folder / "checkpoints").glob("0*.bundle")) if int(file.stem) >= args.first]
    steps = steps_at(folder)
    for checkpoint in [*numbered, folder / "checkpoints/latest.bundle"]:
        update = checkpoint.stem.lstrip("0")
        row = {"seed": seed, "checkpoint": update, "seconds": checkpoint.stat().st_mtime - began}
        row["steps"] = steps(float("inf") if update == "latest" else int(update))
        row["here"] = measured(last_line([program, "eval", folder, "--checkpoint", update, "--episodes", str(EPISODES), "--json"]))
        row["imitates"] = row["here"]["falls"] <= args.falls and row["here"]["bodies_m"] <= args.bodies
        if row["imitates"] or args.all or update == "latest":
            row["mujoco"] = in_mujoco(program, args, folder, update)
        yield row


def cells(args, row):
    """Returns the cells of a row of time_to_imitate.csv."""

    def shown(one):
        if one is None:
            return "––––"
        share, degrees = f"{100.0 * one['done']:.0f} %", f"{57.29578 * one['bodies_rad']:.1f}°"
        return [f"{EPISODES - one['falls']} of {EPISODES}", share, f"{100.0 * one['bodies_m']:.1f} cm", degrees]

    changes = [f"`{args.preset}`", *args.set]
    names = ", ".join(pathlib.Path(name).stem for name in args.motion.split(","))
    seconds, steps = round(row["seconds"]), f"{row['steps'] / 1e6:.2f} M"
    found = [*shown(row["here"]), *shown(row.get("mujoco"))]
    return [", ".join(changes), names, row["seed"], steps, seconds, "yes" if row["imitates"] else "no", *found]


def main():
    parser = arguments(__doc__, "motion")
    parser.add_argument("--preset", default="g1-motion")
    parser.add_argument("--bodies", type=float, default=0.06, help="greatest mean error of the links (m)")
    each_seed(parser.parse_args(), COLUMNS, "imitates", train, measure, cells)


if __name__ == "__main__":
    main()
