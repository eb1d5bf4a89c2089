"""Measures gradient steps and trainings on a GPU, beside the same machine's cores and PyTorch. Prints a table, leaves a CSV file.

It builds nothing, and ends after about as many seconds as given. PyTorch is measured if it is installed.

Usage: python3 -m experiments.accelerator.measure target/release/treadmill gpu.csv [--g1 g1.xml] [--seconds 420]
"""

import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

NETWORKS = ["45-256-128", "103-256-128", "348-512-256"]
MINIBATCHES = [512, 2048, 16384]
THREADS = [1, 8, 16]
COLUMNS = ["what", "network", "minibatch", "device", "value", "unit"]


def result(command, seconds=120):
    """Runs a command. Returns the JSON object of its last line, or None if it fails or takes too long."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=True)
        return json.loads(done.stdout.strip().splitlines()[-1])
    except (subprocess.SubprocessError, ValueError, IndexError) as why:
        detail = (getattr(why, "stderr", "") or str(why)).strip().splitlines()[-1:]
        print(f"# {' '.join(map(str, command))}: {detail}", file=sys.stderr)
        return None


def updates(treadmill, symmetry):
    """Yields a row for each network, minibatch and device."""
    cores = os.cpu_count()
    devices = [("cuda", 1)] + [("cpu", threads) for threads in THREADS if threads <= cores]
    for network in NETWORKS:
        for minibatch in MINIBATCHES:
            base = [treadmill, "bench", "update", "--json", "--network", network, "--minibatch", str(minibatch)]
            for device, threads in devices:
                # Few updates on slow devices.
                count = "30" if device == "cuda" else "3"
                command = [*base, "--symmetry", symmetry, "--device", device, "--threads", str(threads), "--updates", count]
                if found := result(command):
                    name = device if device == "cuda" else f"{threads} threads"
                    yield [f"update, {symmetry}", network, minibatch, name, found["samples_per_s"], "samples/s"]
            if symmetry != "off":
                continue
            torch = [sys.executable, "-m", "experiments.accelerator.torch_update", network, str(minibatch)]
            for mode in ("eager", "graph"):
                if found := result([*torch, mode]):
                    yield ["update, off", network, minibatch, f"PyTorch {found['torch']}, {mode}", found["samples_per_s"], "samples/s"]


def trainings(treadmill, folder, g1):
    """Yields a row for each preset and device: trained steps per second, and when 10 m were covered."""
    for preset, more in [("walk", []), *([("g1-29", ["--model", g1])] if g1 else [])]:
        for device in ("cuda", "cpu"):
            run = pathlib.Path(folder) / f"{preset}-{device}"
            command = [treadmill, "train", "--preset", preset, "--steps", "3000000", "--device", device, "--seed", "101", *more]
            begun = time.monotonic()
            if found := result([*command, "--run-dir", str(run), "--no-progress", "--no-page", "--json"]):
                seconds = time.monotonic() - begun
                yield [f"train {preset}", "", "", device, round(found["env_steps"] / seconds), "steps/s"]
                if not more:
                    yield [f"train {preset}", "", "", device, first_10_m(run / "metrics.jsonl"), "s to 10 m"]


def first_10_m(metrics):
    """Returns the seconds after which training covered 10 m, or None."""
    lines = [json.loads(line) for line in metrics.read_text().splitlines()]
    times = [line for line in lines if line.get("tag") == "rollout/distance_mean_m" and line["value"] >= 10]
    return round(times[0]["time_unix_s"] - lines[0]["time_unix_s"], 1) if times else None


def main():
    """Measures until the time is over."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("treadmill")
    parser.add_argument("csv")
    parser.add_argument("--g1", help="model of a G1 with 29 hinges, to train it, too")
    parser.add_argument("--seconds", type=float, default=420)
    args = parser.parse_args()
    end = time.monotonic() + args.seconds
    print(subprocess.run([args.treadmill, "check"], capture_output=True, text=True, check=False).stdout)
    with tempfile.TemporaryDirectory() as folder, open(args.csv, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        for rows in (updates(args.treadmill, "equivariant"), trainings(args.treadmill, folder, args.g1), updates(args.treadmill, "off")):
            for row in rows:
                writer.writerow(row)
                file.flush()
                print(*row, sep="\t", flush=True)
                if time.monotonic() > end:
                    print(f"# stopped after {args.seconds:.0f} s", file=sys.stderr)
                    return


if __name__ == "__main__":
    main()
