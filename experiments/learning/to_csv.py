#!/usr/bin/env python3
"""Converts a run's metrics.jsonl to a CSV table on standard output."""

import argparse
import csv
import json
import sys

TAGS = [
    "rollout/ep_rew_mean",
    "rollout/ep_len_mean",
    "rollout/distance_mean_m",
    "rollout/velocity_mean_mps",
    "rollout/fall_fraction",
    "eval/mean_reward",
    "eval/mean_ep_length",
    "eval/distance_mean_m",
    "eval/velocity_mean_mps",
    "eval/fall_fraction",
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
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("metrics", help="RUN/metrics.jsonl")
    parser.add_argument("every", nargs="?", type=int, default=1, help="write every N-th update, and those with an evaluation")
    arguments = parser.parse_args()
    rows = {}
    with open(arguments.metrics, encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            rows.setdefault(metric["step"], {})[metric["tag"]] = metric["value"]
    writer = csv.writer(sys.stdout, lineterminator="\n")
    writer.writerow(["env_steps", *TAGS])
    for index, step in enumerate(sorted(rows), 1):
        if index % arguments.every and "eval/mean_reward" not in rows[step]:
            continue
        writer.writerow([step, *(f"{rows[step][tag]:.6g}" if tag in rows[step] else "" for tag in TAGS)])


if __name__ == "__main__":
    main()
