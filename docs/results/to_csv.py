#!/usr/bin/env python3
"""Turns a run's metrics.jsonl into a CSV table: one row per update, one column per tag.

Usage: to_csv.py RUN/metrics.jsonl > table.csv
"""

import csv
import json
import sys

TAGS = [
    "rollout/ep_rew_mean",
    "rollout/ep_len_mean",
    "rollout/distance_mean_m",
    "rollout/velocity_mean_mps",
    "rollout/fall_fraction",
    "time/fps",
    "time/time_elapsed",
    "train/approx_kl",
    "train/clip_fraction",
    "train/entropy_loss",
    "train/explained_variance",
    "train/learning_rate",
    "train/std",
    "train/value_loss",
    "bus/policy_lag_mean",
    "actors/alive",
    "actors/memory_max_mb",
    "learner/memory_mb",
]


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    rows = {}
    with open(sys.argv[1], encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            rows.setdefault(metric["step"], {})[metric["tag"]] = metric["value"]
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["env_steps", *TAGS])
    for step in sorted(rows):
        writer.writerow([step, *(f"{rows[step][tag]:.6g}" if tag in rows[step] else "" for tag in TAGS)])


if __name__ == "__main__":
    main()
