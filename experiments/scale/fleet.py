#!/usr/bin/env python3
"""Measures a learner with real updates among played actors and writes the table.

    cargo build --release && cargo build --release -p treadmill-bench
    python3 -m experiments.scale.fleet target/release/treadmill --logs /tmp/fleet --csv FILE.csv

Each row is a scenario of `treadmill-bench fleet`, or five real actors. `--only NAME` runs the scenarios whose name begins with
NAME and keeps the other rows of the last run, which are in the folder of --logs. `--quick` measures fewer numbers of actors.
"""

import argparse
import json
import os
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import time

from experiments import report

MODES = ["sync", "async"]
# The update has one core, and the played actors the other one.
ONE_THREAD = ["--set", "learner.threads=1"]
REAL_ACTORS = 5


USED = ("used_share", 0.97, 0.995)


class Scenario:
    """Row of the table: flags of `treadmill-bench fleet`, and figures with their least and aimed values."""

    def __init__(self, name, mode, title, args, targets):
        self.name, self.mode, self.title, self.args = name, mode, title, args
        self.targets = targets


def scenarios(quick):
    rows = []
    for mode in MODES:
        for actors in [1, 3, 8] if quick else [1, 2, 3, 5, 8, 16, 64]:
            title = f"{actors} equal actors, load 0.8"
            rows.append(Scenario(f"used-{mode}-{actors}", mode, title, fleet(mode, actors), [USED]))
        title = "8 actors, one at half and one at a tenth of the rate, load 0.8"
        slow = [*fleet(mode, 8), "--slow", "0.5", "--slow", "0.1"]
        rows.append(Scenario(f"slow-{mode}", mode, title, slow, [("trained_per_rate", 0.95, 0.98)]))
        title = "8 actors of load 0.1 each, ÷ one of them alone"
        rows.append(Scenario(f"eight-{mode}", mode, title, [], [("times_one", 7, 7.7)]))
        targets = [("trained_per_update", 0.9, 0.97), ("used_share", 0.97, 0.99)]
        rows.append(Scenario(f"over-{mode}", mode, "8 actors, load 3", [*fleet(mode, 8, 3), *ONE_THREAD], targets))
        title = "1000 actors of one environment behind 10 routers"
        thousand = ["--mode", mode, "--actors", "1000", "--routers", "10", "--envs", "1", "--rate", "4"]
        thousand += ["--set", "rollout.fragment_steps=8", *ONE_THREAD]
        targets = [("learner_resident_max_mb", 1500, 600), ("serial_ms", 50, 15), ("learner_sent_mb_per_version", 10, 2)]
        rows.append(Scenario(f"thousand-{mode}", mode, title, thousand, targets))
    for transport, flags in [("TCP", []), ("mutual TLS", ["--tls"])]:
        for routers in [0, 2]:
            path = f"{routers} routers" if routers else "direct"
            name = f"link-{'tls' if flags else 'tcp'}-{routers}"
            args = [*fleet("sync", 5), *flags, "--routers", str(routers)]
            rows.append(Scenario(name, "sync", f"5 actors, {transport}, {path}", args, [USED]))
    for mode in MODES:
        title = f"{REAL_ACTORS} real actors of 32 environments on this machine"
        rows.append(Scenario(f"real-{mode}", mode, title, None, [USED]))
    return rows


def fleet(mode, actors, load=0.8):
    return ["--mode", mode, "--actors", str(actors), "--load", str(load)]


def bench(binary, folder, args, seconds):
    """Runs `treadmill-bench fleet`; its folder keeps run, log and result."""
    folder.mkdir(parents=True)
    command = [pathlib.Path(binary).with_name("treadmill-bench"), "fleet", "--json", "--keep", str(folder), "--seconds", str(seconds), *args]
    done = subprocess.run(command, capture_output=True, text=True)
    (folder / "stderr.log").write_text(done.stderr)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}: {done.stderr.strip()}")
    result = json.loads(done.stdout.strip().splitlines()[-1])
    (folder / "result.json").write_text(json.dumps(result, indent=1))
    return result


def measure(binary, folder, scenario, seconds):
    mode = scenario.mode
    if scenario.args is None:
        return real(binary, folder, mode, 2 * seconds)
    if scenario.targets[0][0] != "times_one":
        return bench(binary, folder, scenario.args, seconds)
    alone = bench(binary, folder / "alone", ["--mode", mode, "--actors", "1", "--load", "0.1"], seconds)
    args = ["--mode", mode, "--actors", "8", "--rate", str(alone["rate_max"])]
    result = bench(binary, folder / "eight", args, seconds)
    result["times_one"] = result["trained_steps_per_s"] / alone["trained_steps_per_s"]
    return result


def real(binary, folder, mode, seconds):
    """Trains with real actors. Their own counts come from the last line of their logs."""
    folder.mkdir(parents=True)
    run = folder / "real"
    environment = dict(os.environ, TREADMILL_LOG="info,zenoh=off")
    learner_log = open(folder / "learner.log", "w")
    command = [binary, "learner", "--run-dir", str(run), "--run", "real", "--steps", "1000000000000", "--no-progress",
               "--listen", "tcp/127.0.0.1:0", "--set", f"learner.mode={mode}"]
    learner = subprocess.Popen(command, stdout=learner_log, stderr=learner_log)
    actors, logs = [], []
    try:
        endpoint = run / "endpoint.txt"
        while not (endpoint.exists() and endpoint.read_text().endswith("\n")):
            if learner.poll() is not None:
                sys.exit(f"the learner ended; see {folder / 'learner.log'}")
            time.sleep(0.1)
        for number in range(REAL_ACTORS):
            logs.append(folder / f"actor-{number}.log")
            command = [binary, "actor", "--connect", endpoint.read_text().strip(), "--run", "real", "--envs", "32"]
            output = open(logs[-1], "w")
            actors.append(subprocess.Popen(command, stdout=output, stderr=output, env=environment))
        time.sleep(seconds)
    finally:
        for process in [*actors, learner]:
            process.send_signal(signal.SIGTERM)
            process.wait(timeout=60)
    return real_result(run, logs, mode)


def real_result(run, logs, mode):
    metrics = [json.loads(line) for line in (run / "metrics.jsonl").read_text().splitlines()]
    series = {}
    for metric in metrics:
        series.setdefault(metric["tag"], []).append(metric["value"])
    trained, dropped, counts = max(series["time/total_timesteps"]), 0.0, []
    for log in logs:
        last = [line for line in log.read_text().splitlines() if "left the run" in line][-1]
        count = {name: int(value) for name, value in re.findall(r"(\w+): (\d+)", last)}
        counts.append(count)
        dropped += count["env_steps"] * count["dropped_by_rule"] / max(count["produced"], 1)
    steps, elapsed = series["time/total_timesteps"], series["time/time_elapsed"]
    total = lambda name: sum(count[name] for count in counts)
    return {
        "mode": mode, "actors": REAL_ACTORS, "settings": "", "used_share": trained / (trained + dropped),
        "learner_used_share": series.get("rollout/used_share", [None])[-1],
        "trained_steps_per_s": (steps[-1] - steps[0]) / (elapsed[-1] - elapsed[0]),
        "policy_lag_mean": statistics.fmean(series["bus/policy_lag_mean"]), "policy_lag_max": max(series["bus/policy_lag_max"]),
        "learner_resident_max_mb": max(series["learner/memory_mb"]),
        "nothing_lost": total("produced") == total("accepted") + total("dropped_by_rule") + total("in_flight"),
    }


# Field, heading, decimals.
COLUMNS = [
    ("used_share", "used share", 3),
    ("learner_used_share", "by the learner", 3),
    ("trained_steps_per_s", "trained steps/s", 0),
    ("trained_per_rate", "÷ rates", 3),
    ("trained_per_update", "÷ update's speed", 3),
    ("idle_share", "actors idle", 3),
    ("policy_lag_mean", "lag mean", 2),
    ("policy_lag_max", "lag max", 0),
    ("receipt_p50_ms", "receipt p50, ms", 0),
    ("receipt_p99_ms", "p99, ms", 0),
    ("policy_fetch_p50_ms", "policy p50, ms", 0),
    ("policy_fetch_p99_ms", "p99, ms", 0),
    ("joined_s", "joined, s", 1),
    ("learner_sent_mb_per_version", "learner sends per version, MB", 2),
    ("publish_ms", "publish, ms", 1),
    ("serial_ms", "serial, ms", 1),
    ("learner_resident_max_mb", "learner's peak memory, MB", 0),
    ("learner_cpu_s", "CPU-s: learner", 1),
    ("played_cpu_s", "played actors", 1),
    ("routers_cpu_s", "routers", 1),
]
SMALLER_IS_BETTER = ("learner_resident_max_mb", "serial_ms", "learner_sent_mb_per_version")


def cell(values, digits):
    values = [float(value) for value in values if value is not None]
    if not values:
        return "–"
    middle = f"{statistics.median(values):.{digits}f}"
    return middle if len(values) == 1 else f"{middle} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def reached(target, rounds):
    """Returns a figure with its limits, and whether its worst round reaches them."""
    figure, least, aim = target
    values = [float(one[figure]) for one in rounds if one.get(figure) is not None]
    if not values:
        return f"{figure}: not measured"
    smaller = figure in SMALLER_IS_BETTER
    worst = max(values) if smaller else min(values)
    holds = lambda limit: worst <= limit if smaller else worst >= limit
    word = "better than the aim" if holds(aim) else "reached" if holds(least) else "**not reached**"
    return f"{figure} {cell(values, 3)}; {'at most' if smaller else 'at least'} {least}, aim {aim}: {word}"


def table(rows, results):
    headings = ["scenario", "mode", "targets", "lost", *(heading for _, heading, _ in COLUMNS)]
    lines = ["| " + " | ".join(headings) + " |", "| --- " * len(headings) + "|"]
    for scenario in rows:
        rounds = results.get(scenario.name)
        if not rounds:
            continue
        title = scenario.title + (f", `{rounds[0]['settings']}`" if rounds[0].get("settings") else "")
        lost = "no" if all(one["nothing_lost"] for one in rounds) else "**yes**"
        cells = [title, scenario.mode, "<br>".join(reached(target, rounds) for target in scenario.targets), lost]
        cells += [cell([one.get(field) for one in rounds], digits) for field, _, digits in COLUMNS]
        lines.append("| " + " | ".join(cells) + " |")
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", help="the built binary")
    parser.add_argument("--logs", type=pathlib.Path, required=True, help="folder of runs, logs and results")
    parser.add_argument("--only", metavar="NAME", action="append", help="beginning of a scenario's name; may be repeated")
    parser.add_argument("--list", action="store_true", help="print the names of the scenarios")
    parser.add_argument("--quick", action="store_true", help="measure fewer numbers of actors")
    parser.add_argument("--seconds", type=float, default=30, help="length of each measurement; real actors take twice as long")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    binary = str(pathlib.Path(arguments.binary).resolve())
    rows = scenarios(arguments.quick)
    if arguments.list:
        return print("\n".join(row.name for row in rows))
    kept = arguments.logs / "results.json"
    results = json.loads(kept.read_text()) if kept.exists() else {}
    load_before = os.getloadavg()[0]
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], capture_output=True, text=True).stdout.strip()
    for row in rows:
        if arguments.only and not any(row.name.startswith(name) for name in arguments.only):
            continue
        results[row.name] = []
        for number in range(arguments.rounds):
            folder = arguments.logs / f"{row.name}-{int(time.time())}"
            results[row.name].append(measure(binary, folder, row, arguments.seconds) | {"commit": commit})
            figures = ", ".join(f"{figure} {results[row.name][-1].get(figure)}" for figure, _, _ in row.targets)
            print(f"{row.name}, round {number + 1}: {figures}", flush=True)
        kept.write_text(json.dumps(results))
    # Rows may be of earlier calls.
    commits = dict.fromkeys(one.get("commit", "unknown") for rounds in results.values() for one in rounds)
    machine = next((one for rounds in results.values() for one in rounds if "cpu" in one), {})
    text = [f"Treadmill {', '.join(commits)}; {machine.get('cpu', '?')}, {machine.get('cores', '?')} cores; load of the machine before: "
            f"{load_before:.1f}. {arguments.rounds} rounds.", "", *table(rows, results)]
    if arguments.csv:
        report.write_csv(arguments.csv, "\n".join(text), report.commit(), report.cpu_model())
    print("\n".join(text))


if __name__ == "__main__":
    main()
