#!/usr/bin/env python3
"""Tabulates the evaluations of several runs: the rows of curves.csv, which experiments/pictures.py draws.

Usage: curves.py OUT.csv BUILD=RUN ...

BUILD names the build that trained RUN, a run folder. Seconds count from the start of `train`.
"""

import csv
import json
import pathlib
import sys
import tomllib

TAG = "eval/distance_mean_m"


def rows(build, run):
    """Yields a row for each evaluation of a run."""
    config = tomllib.loads((run / "config.toml").read_text(encoding="utf-8"))
    began_unix_s = (run / "config.toml").stat().st_mtime
    for line in (run / "metrics.jsonl").read_text(encoding="utf-8").splitlines():
        point = json.loads(line)
        if point["tag"] == TAG:
            yield [build, config["run"]["seed"], point["step"], round(point["time_unix_s"] - began_unix_s, 1), round(point["value"], 2)]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    with pathlib.Path(sys.argv[1]).open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["build", "seed", "steps", "seconds", "distance in 15 s, m"])
        for pair in sys.argv[2:]:
            build, run = pair.split("=", 1)
            table.writerows(rows(build, pathlib.Path(run)))


if __name__ == "__main__":
    main()
