#!/usr/bin/env python3
"""Trains on all cores of one machine in several ways, one after the other, and prints speed and time until the humanoid walks 10 m.

Usage: cores.py target/release/treadmill FOLDER [--seeds 1 2 3] [--steps 4000000] [--way "--actors 8 --set learner.threads=4"] ...

Each `--way` holds flags of `treadmill train`; without any, its defaults are measured. Needs no Python packages.
"""

import argparse
import json
import pathlib
import shlex
import statistics
import subprocess
import time

from experiments import report


def train(binary, folder, seed, steps, way):
    """Trains one run. Returns its speed, and steps and seconds from the program's start until an evaluation reached 10 m."""
    begun = time.time()
    command = [binary, "train", "--seed", str(seed), "--steps", str(steps), "--run-dir", str(folder), "--json", "--no-progress"]
    subprocess.run([*command, *shlex.split(way)], check=True, stdout=subprocess.DEVNULL)
    wall_s = time.time() - begun
    updates, evaluations = {}, {}
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            by_step = evaluations if metric["tag"].startswith("eval/") else updates
            by_step.setdefault(metric["step"], {"at_s": metric["time_unix_s"] - begun})[metric["tag"]] = metric["value"]
    last = updates[max(updates)]
    walks = [found for _, found in sorted(evaluations.items()) if found["eval/distance_mean_m"] >= 10]
    # Without the first fifth, in which all processes start.
    early = min(updates, key=lambda step: abs(step - 0.2 * steps))
    return {
        "way": way, "seed": seed, "wall_s": wall_s,
        "steps_per_s": (max(updates) - early) / (last["at_s"] - updates[early]["at_s"]),
        "to_10_m_s": walks[0]["at_s"] if walks else None,
        "to_10_m_steps": walks[0]["eval/total_timesteps"] if walks else None,
        "distance_m": evaluations[max(evaluations)]["eval/distance_mean_m"] if evaluations else None,
        "wait_share": statistics.median(found.get("learner/wait_share", 0) for found in updates.values()),
        "update_s": statistics.median(found["time/update_s"] for found in updates.values()),
        "used_share": last.get("rollout/used_share"),
    }  # fmt: skip


def shown(number, digits=0, scale=1.0):
    return "–" if number is None else f"{number * scale:,.{digits}f}"


def main():
    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("binary", type=pathlib.Path)
    flags.add_argument("folder", type=pathlib.Path)
    flags.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    flags.add_argument("--steps", type=int, default=4_000_000)
    flags.add_argument("--way", action="append", help="flags of `treadmill train`; repeatable")
    args = flags.parse_args()
    print(f"{report.cpu_model()}; {args.steps:,} steps\n")
    columns = ["flags of `train`", "seed", "steps/s", "learner waits", "update, ms", "10 m after, M steps", "10 m after, s",
               "last distance, m", "wall, s"]  # fmt: skip
    print("| " + " | ".join(columns) + " |\n" + "| --- " * len(columns) + "|")
    args.folder.mkdir(parents=True, exist_ok=True)
    for number, way in enumerate(args.way or [""]):
        for seed in args.seeds:
            found = train(args.binary.resolve(), args.folder / f"way-{number}-{seed}", seed, args.steps, way)
            with open(args.folder / "cores.jsonl", "a", encoding="utf-8") as results:
                results.write(json.dumps(found) + "\n")
            cells = [f"`{way}`" if way else "–", str(seed), shown(found["steps_per_s"]), shown(found["wait_share"], 2),
                     shown(found["update_s"], 0, 1e3), shown(found["to_10_m_steps"], 1, 1e-6), shown(found["to_10_m_s"]),
                     shown(found["distance_m"], 1), shown(found["wall_s"])]  # fmt: skip
            print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
