"""Compares Treadmill's speed with its peers' in one run and writes the speed table.

Needs: cargo build --release && cargo build --release -p treadmill-humanoid --example open_loop
The script installs the peers into a virtual environment of its own, target/peers: MuJoCo, Gymnasium, EnvPool, and with
`--training` PyTorch and Stable-Baselines3.

Usage: speed.py target/release/treadmill [--pairs 10] [--training] [--json OUT.json]
                                         [--csv FILE.csv]

Each pair runs Treadmill and its peer in turn on the same cores; every second pair reverses the order. A row is the median of
the pairs' ratios, with their quartiles. All rows take turns, so that changes of the machine's speed affect all. Actions are
random; a step is one control step of 15 ms. Run it on an idle machine.
"""

import argparse
import os
import pathlib
import statistics
import sys

from experiments import peers

HERE = pathlib.Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]


def measure(rows, pairs):
    """Returns for each row the speeds [pair, (Treadmill's, the peer's)]. Leaves out rows that cannot be measured."""
    found = {row.key: [] for row in rows}
    for number in range(pairs):
        for row in rows:
            sides = (row.ours, row.peer) if number % 2 == 0 else (row.peer, row.ours)
            values = [side() for side in sides]
            found[row.key].append(values if number % 2 == 0 else values[::-1])
            ours, peer = found[row.key][-1]
            print(f"pair {number + 1}, {row.key}: {ours:.0f} ÷ {peer:.0f} = {ours / peer:.3g}", file=sys.stderr)
    return found


def quartiles(values):
    """Returns lower quartile, median and upper quartile."""
    return statistics.quantiles(values, n=4, method="inclusive") if len(values) > 1 else values * 3


def table(rows, found, report):
    """Formats median speeds, and median and quartiles of their ratio."""
    lines = []
    for row in rows:
        ours, peer = zip(*found[row.key])
        low, middle, high = (f"{ratio:.3g}" for ratio in quartiles([a / b for a, b in found[row.key]]))
        speeds = [f"{statistics.median(side):.0f}" for side in (ours, peer)]
        lines.append([row.what, speeds[0], row.against, speeds[1], f"**{middle}**", f"{low} to {high}", row.cores])
    header = ["Treadmill", "steps/s", "compared with", "steps/s", "ratio", "quartiles", "cores"]
    return report.table(header, lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    release = REPOSITORY / "target/release"
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("--pairs", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=2.0, help="per peer and pair")
    parser.add_argument("--steps", type=int, default=100_000, help="of Treadmill, per row and pair")
    parser.add_argument("--rows", help="keys of the rows to measure, separated by commas; default: all")
    parser.add_argument("--open-loop", type=pathlib.Path, default=release / "examples/open_loop", help="for state errors")
    robot = REPOSITORY / "actor/humanoid/assets/g1-like-servos.xml"
    parser.add_argument("--robot", type=pathlib.Path, default=robot, help="MJCF file of a servo robot on a height field")
    parser.add_argument("--robot-healthy", default="0.5,1.1", help="heights of its root (m) outside which it is reset")
    parser.add_argument("--robot-substeps", type=int, default=5, help="its physics steps per control step, on both sides")
    parser.add_argument("--training", action="store_true", help="also train: trained steps/s, and wall time to 10 m")
    parser.add_argument("--runs", type=pathlib.Path, nargs="*", default=[], help="run folders, for wall time to 10 m, in place of new trainings")
    parser.add_argument("--cores", help="two cores to use, for example 0,1; default: the first allowed ones")
    parser.add_argument("--peers", type=pathlib.Path, default=peers.FOLDER, help="virtual environment of the peers")
    parser.add_argument("--json", type=pathlib.Path, help="file for all numbers")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    if not arguments.treadmill.exists():
        sys.exit(f"{arguments.treadmill} does not exist; run: cargo build --release")
    peers.enter(arguments.peers, arguments.training)

    # These modules need the peers.
    from experiments import report
    from experiments.fidelity import speed_rows

    allowed = sorted(os.sched_getaffinity(0))
    cores = [int(core) for core in arguments.cores.split(",")] if arguments.cores else allowed[:2]
    load = os.getloadavg()[0]
    context = speed_rows.Context(arguments, cores)
    rows = speed_rows.rows(context)
    if arguments.rows:
        rows = [row for row in rows if row.key in arguments.rows.split(",")]
    found = measure(rows, arguments.pairs)
    errors = speed_rows.state_errors(context)
    walks = speed_rows.times_to_10_m(context)

    packages = ("mujoco", "gymnasium", "envpool", "numpy") + (("stable-baselines3", "torch") if arguments.training else ())
    made = report.circumstances(packages)
    lead = f"{report.made_by(made, packages)} {arguments.pairs} pairs per row; load of the machine before: {load:.1f}."
    text = "\n".join([f"{lead}\n", table(rows, found, report), *speed_rows.notes(context, errors, walks)])
    print(text)
    if arguments.json:
        keys = {"made": made, "load": load, "pairs": found, "state_errors_rad": errors, "seconds_to_10_m": walks}
        report.write_json(arguments.json, keys)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
