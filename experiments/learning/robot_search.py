#!/usr/bin/env python3
"""Searches for settings with which a robot obeys sooner: trains each candidate on several seeds and tabulates the results.

Usage: robot_search.py target/release/treadmill PRESET MODEL FOLDER [--only NAME ...] [--seeds 1 2 3] [--steps 1500000]
                       [--csv FILE.csv]

Trains the runs that FOLDER lacks, and tabulates all. Every 100 000 steps, a run is evaluated on ten deterministic episodes. As
with search.py, two parallel runs share two cores: compare steps, not times.
"""

import argparse
import json
import pathlib
import statistics

from experiments import report
from experiments.learning.search import folder_of, median, million, train_candidates

# Discount and trace of the candidates that change something else.
OTHERS = ["ppo.gamma=0.97", "ppo.gae_lambda=0.95"]
# Changes of each candidate.
CANDIDATES = {
    "γ 0.99, λ 0.95": ["ppo.gamma=0.99", "ppo.gae_lambda=0.95"],
    "γ 0.98, λ 0.95": ["ppo.gae_lambda=0.95"],
    "γ 0.97, λ 0.95": ["ppo.gamma=0.97", "ppo.gae_lambda=0.95"],
    "γ 0.95, λ 0.95": ["ppo.gamma=0.95", "ppo.gae_lambda=0.95"],
    "γ 0.99, λ 0.9": ["ppo.gamma=0.99"],
    "γ 0.99, λ 0.98": ["ppo.gamma=0.99", "ppo.gae_lambda=0.98"],
    "γ 0.98, λ 0.9, the presets now": [],
    "γ 0.97, λ 0.9": ["ppo.gamma=0.97"],
    "γ 0.97, λ 0.9, first log std −1.3": ["ppo.gamma=0.97", "policy.init_log_std=-1.3"],
    "γ 0.97, λ 0.9, first log std −1.3, 3 passes": ["ppo.gamma=0.97", "policy.init_log_std=-1.3", "ppo.epochs=3"],
    "γ 0.97, λ 0.95, first log std −1.3": [*OTHERS, "policy.init_log_std=-1.3"],
    "γ 0.97, λ 0.95, first log std −2.3": [*OTHERS, "policy.init_log_std=-2.3"],
    "γ 0.97, λ 0.95, learning rate 1e-3, at most 2e-3": [*OTHERS, "ppo.learning_rate=1e-3", "ppo.learning_rate_max=2e-3"],
    "γ 0.97, λ 0.95, target KL 0.02": [*OTHERS, "ppo.target_kl=0.02"],
    "γ 0.97, λ 0.95, 3 passes": [*OTHERS, "ppo.epochs=3"],
    "γ 0.97, λ 0.95, minibatch 256": [*OTHERS, "ppo.minibatch=256"],
}
# Return that a run is to reach.
GOAL = 2400
# What the last evaluations are judged by.
LATE = ("mean_reward", "velocity_error", "yaw_rate_error", "fall_fraction")


def measure(folder):
    """Returns when a run reached the goal, and the means of its last three evaluations."""
    evaluations = {}
    for values in report.by_step(folder).values():
        if "eval/velocity_error" in values:
            evaluations[values["eval/total_timesteps"]] = values
    last = [evaluations[step] for step in sorted(evaluations)[-3:]]
    late = {tag: statistics.mean(values[f"eval/{tag}"] for values in last) for tag in LATE}
    reached = (step for step in sorted(evaluations) if evaluations[step]["eval/mean_reward"] >= GOAL)
    return {"reached": next(reached, None), **late}


def table(folder, what):
    """Formats a row per trained candidate of `what`."""
    notes = [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("*.json")]
    rows = []
    for name in CANDIDATES:
        seeds = sorted(note["seed"] for note in notes if note["name"] == name)
        found = [measure(folder_of(folder, name, seed)) for seed in seeds]
        if not found:
            continue
        steps = [one["reached"] for one in found]
        reward, velocity, yaw, falls = (statistics.median(one[tag] for one in found) for tag in LATE)
        late = [f"{reward:.0f}", f"{velocity:.3f} m/s", f"{yaw:.3f} rad/s", f"{100 * falls:.0f} %"]
        rows.append([name, ", ".join(map(str, seeds)), million(median(steps)), ", ".join(map(million, steps)), *late])
    header = [f"settings of {what}", "seeds", f"return of {GOAL} after", "each seed", "return at the end", "velocity error"]
    return report.table([*header, "yaw rate error", "falls"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path)
    parser.add_argument("preset")
    parser.add_argument("model", type=pathlib.Path, help="the robot's MJCF file")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=CANDIDATES, default=list(CANDIDATES), metavar="NAME")
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=1_500_000)
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    flags = ["--preset", arguments.preset, "--model", str(arguments.model), "--steps", str(arguments.steps)]
    flags += ["--set", "eval.every_steps=100000"]
    train_candidates(arguments.treadmill, arguments.folder, CANDIDATES, arguments.only, arguments.seeds, flags, 2)
    text = table(arguments.folder, f"`{arguments.preset}`, {million(arguments.steps)} steps")
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
