#!/usr/bin/env python3
"""Measures the bus over each transport and writes the table.

    cargo build --release && cargo build --release -p treadmill-bench
    python3 -m experiments.scale.measure target/release/treadmill --csv FILE.csv

Transports take turns within a round, and `treadmill-bench bus` measures raw TCP before and after each number of actors, so that
other load affects all alike. The table shows the median over rounds, with minimum and maximum.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess

from experiments import report

TRANSPORTS = {"TCP": [], "mutual TLS": ["--tls"], "shared memory": ["--shared-memory"]}
# Field, heading, decimals.
COLUMNS = [
    ("accepted_mb_per_s", "accepted, MB/s", 0),
    ("ratio_to_raw_tcp", "÷ raw TCP", 2),
    ("cpu_ratio_to_raw_tcp", "CPU-s/GB: raw TCP ÷ this", 2),
    ("learner_cpu_s_per_gb", "learner, CPU-s/GB", 2),
    ("actors_cpu_s_per_gb", "actors, CPU-s/GB", 2),
    ("receipt_p50_ms", "receipt p50, ms", 1),
    ("receipt_p99_ms", "p99, ms", 1),
    ("first_of_all_s", "first fragment of every actor accepted, s", 1),
    ("policy_p50_ms", "policy at all actors p50, ms", 1),
    ("policy_p99_ms", "p99, ms", 1),
    ("learner_resident_max_mb", "learner's peak memory, MB", 0),
    ("learner_shared_mb", "shared part, MB", 0),
]


def measure(binary, transport, arguments):
    command = [pathlib.Path(binary).with_name("treadmill-bench"), "bus", "--json", *TRANSPORTS[transport]]
    command += ["--actors", arguments.actors, "--seconds", str(arguments.seconds)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout.strip().splitlines()[-1])


def cell(values, digits):
    middle = statistics.median(values)
    if len(values) == 1:
        return f"{middle:.{digits}f}"
    return f"{middle:.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def table(results, actors):
    lines = ["| transport | actors | " + " | ".join(heading for _, heading, _ in COLUMNS) + " |"]
    lines.append("| --- " * (len(COLUMNS) + 2) + "|")
    for transport, rounds in results.items():
        for index, count in enumerate(actors):
            cells = [cell([one["steps"][index][field] for one in rounds], digits) for field, _, digits in COLUMNS]
            lines.append(f"| {transport} | {count} | " + " | ".join(cells) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", help="the built binary")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--actors", default="1,10,50,100,200")
    parser.add_argument("--seconds", type=float, default=5.0)
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    load_before, results = os.getloadavg()[0], {transport: [] for transport in TRANSPORTS}
    for number in range(arguments.rounds):
        for transport in TRANSPORTS:
            results[transport].append(measure(arguments.binary, transport, arguments))
            last = results[transport][-1]
            print(f"round {number + 1}, {transport}: {last['accepted_mb_per_s']} MB/s, {last['ratio_to_raw_tcp']} of raw TCP")
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    one = results["TCP"][0]
    every = [step for rounds in results.values() for result in rounds for step in result["steps"]]
    raw = cell([step["raw_tcp_mb_per_s"] for step in every], 0)
    raw_cpu = cell([step["raw_tcp_cpu_s_per_gb"] for step in every], 2)
    resent, dropped = (int(sum(step[name] for step in every)) for name in ("resent", "dropped"))
    text = [
        f"Treadmill {commit}; {one['cpu']}, {one['cores']} cores; load of the machine before: {load_before:.1f}. "
        f"{arguments.rounds} rounds of {arguments.seconds:g} s; fragments of {one['fragment_bytes']} bytes, policies of "
        f"{one['policy_bytes']} bytes. Raw TCP: {raw} MB/s, {raw_cpu} CPU-s/GB. Sent again: {resent}; "
        f"dropped: {dropped}.",
        "",
        *table(results, arguments.actors.split(",")),
    ]
    if arguments.csv:
        report.write_csv(arguments.csv, "\n".join(text), report.commit(), report.cpu_model())
    print("\n".join(text))


if __name__ == "__main__":
    main()
