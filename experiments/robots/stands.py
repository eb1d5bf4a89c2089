"""Measures how still robots stand: the rows of stands.csv.

Usage: python3 -m experiments.robots.stands PRESET MODEL RUN [RUN ...] [--csv stands.csv]

Each run's newest checkpoint has to stand for 100 episodes of 20 s, without pushes and from starts as in training, here and in
MuJoCo. From 2 s on: the largest distance of the base from where it then stood, the root mean square of the hinges' rates, and how
often a foot is lifted. Beside it stand the errors and falls of 100 episodes with drawn commands and the pushes of PRESET: g1, g1-29,
h1 or t1.

TREADMILL  the program; by default target/release/treadmill
PYTHON     Python with mujoco and onnxruntime, and python/ of this repository on its path; by default this one
"""

import argparse
import os
import pathlib
import sys
import tempfile

from experiments import report
from experiments.robots.obeys import EPISODES, PUSHES, SOURCES, last_line

STANDING = ["drift (m)", "hinges (rad/s)", "lifts of a foot (1/s)", "falls"]
COLUMNS = ["preset", "seed", "steps", "simulator", *[f"standing: {what}" for what in STANDING]]
COLUMNS += ["commands: velocity error (m/s)", "yaw rate error (rad/s)", "falls with pushes"]


def cells(standing, commanded):
    """Returns the measured cells of a row from the summaries of both."""
    still = [standing["standing_drift_m"], standing["standing_hinge_radps"], standing["standing_lifts_per_s"]]
    errors = [commanded["velocity_error_mps"], commanded["yaw_rate_error_radps"]]
    # A policy that always falls at once has no errors.
    still, errors = ([f"{number:.3f}" if number is not None else "–" for number in numbers] for numbers in (still, errors))
    return [*still, standing["falls"], *errors, commanded["falls"]]


def rows(program, args, run, folder):
    """Yields the rows of a run."""
    schedule = folder / "stand.csv"
    schedule.write_text("0,0,0,0\n")
    evaluate = [program, "eval", run, "--checkpoint", "latest", "--episodes", str(EPISODES), "--json"]
    found = last_line([*evaluate, "--commands", schedule])
    begun = [f"`{args.preset}`", run.name.rsplit("-", 1)[-1]]
    begun.append(f"{found['checkpoint_env_steps'] / 1e6:.2f} M")
    yield [*begun, "Treadmill", *cells(found, last_line([*evaluate, *PUSHES]))]
    policy = folder / "policy.onnx"
    last_line([program, "export", run, "--checkpoint", "latest", "--onnx", policy, "--json"])
    python = [os.environ.get("PYTHON", sys.executable), "-m", "treadmill_transfer", policy, "--model", args.model, "--json"]
    play = [*python, "--episodes", str(EPISODES)]
    yield [*begun, "MuJoCo", *cells(last_line([*play, "--commands", schedule, "--no-pushes"]), last_line(play))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("preset")
    parser.add_argument("model")
    parser.add_argument("runs", metavar="RUN", type=pathlib.Path, nargs="+", help="folder that ends in -SEED")
    parser.add_argument("--csv", type=pathlib.Path)
    args = parser.parse_args()
    program = os.environ.get("TREADMILL", "target/release/treadmill")
    for run in args.runs:
        with tempfile.TemporaryDirectory() as folder:
            for row in rows(program, args, run, pathlib.Path(folder)):
                print(row, flush=True)
                if args.csv:
                    report.append_row(args.csv, COLUMNS, row, SOURCES)


if __name__ == "__main__":
    main()
