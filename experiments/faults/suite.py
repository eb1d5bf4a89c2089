#!/usr/bin/env python3
"""Injects one fault after another into a training fleet and measures the cost.

Usage: suite.py TREADMILL FOLDER [--only NAME...] [--older TREADMILL] [--mode sync|async] [--csv FILE]

Hosts are network namespaces on a bridge (hosts.sh), links use mutual TLS, and actors connect through a router. Each fault has its
own run: the fleet trains, is disturbed, recovers with no help except restarts of ended processes, and stops. Then the script
compares the actors' counts with the learner's. Prints a row per fault. --csv writes the rows of all results in FOLDER; with
--only, some faults can be repeated. Exits with 1 if a fragment was lost silently or trained on twice, or
if the fleet did not recover. Needs root, iproute2, iptables and, for clock jumps, Debian's `faketime`; no Python packages.
"""

import argparse
import contextlib
import json
import os
import pathlib
import shutil
import sys

from experiments import report
from experiments.faults import links, table
from experiments.faults.experiment import ACTORS, Experiment, NotPossible
from experiments.faults.fleet import FRAGMENT, Fleet, certify, clean_up_on_signal, endpoint, hosts
from experiments.faults.injections import FAULTS


def run_one(arguments, name, certificates):
    title, function, options = FAULTS[name]
    folder = arguments.folder / name
    shutil.rmtree(folder, ignore_errors=True)
    if options.get("older") and not arguments.older:
        raise NotPossible("it needs --older BINARY")
    with contextlib.ExitStack() as stack:
        prefix = f"tm{os.getpid()}"
        hosts("up", prefix)
        stack.callback(hosts, "down", prefix)
        run = None
        fleet = Fleet(arguments.treadmill, folder, prefix, certificates, {"learner.mode": arguments.mode})
        if megabytes := options.get("disk_mb"):
            run = stack.enter_context(links.small_disk(folder / "disk", megabytes)) / "run"
            fleet.run = run
        stack.callback(lambda: [process.kill() for process in fleet.processes if process.is_running()])
        actor_options = {}
        if options.get("relay"):
            actor_options["via"] = [stack.enter_context(links.relays(fleet))]
        if via := options.get("via"):
            actor_options["via"] = [endpoint(host) for host in via]
        if options.get("older"):
            actor_options["binary"] = arguments.older
        wrapped = {options["clock"]: links.faked_clock(folder)} if "clock" in options else {}
        begin(fleet, wrapped, actor_options)
        experiment = Experiment(fleet)
        function(experiment)
        experiment.finish()
        ended = {process.name for process in fleet.current.values() if not process.is_running()}
        stuck = fleet.stop()
        account = fleet.account()
        account["mistakes"] += [f"{name} ended unexpectedly" for name in ended]
        account["mistakes"] += [f"{name} did not stop after SIGTERM" for name in stuck]
        panics = [process.err for process in fleet.processes if "panicked" in process.err.read_text(errors="replace")]
        account["mistakes"] += [f"a panic in {path}" for path in panics]
        row = {"name": name, "title": title, "account": account, "note": experiment.note, "curve": table.curve(fleet)}
        keys = ("detected", "recovered", "before", "during", "after", "updates_repeated")
        row |= {key: getattr(experiment, key) for key in keys}
        return row


def begin(fleet, wrapped, actor_options):
    for name in ("learner", "router", *ACTORS):
        options = actor_options if name in ACTORS else {}
        fleet.start(name, wrapper=wrapped.get(name, ()), **options)
    fleet.wait("both actors joined", lambda: all(fleet.learner_logged(f"actor joined actor={name}", 0.0) for name in ACTORS))
    fleet.grow(6 * FRAGMENT)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("folder", type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--only", nargs="+", choices=sorted(FAULTS), default=list(FAULTS))
    parser.add_argument("--older", type=lambda path: pathlib.Path(path).resolve(), help="binary of the previous version")
    parser.add_argument("--mode", choices=("sync", "async"), default="sync", help="mode of the learner")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the rows of all results in FOLDER")
    arguments = parser.parse_args()
    clean_up_on_signal()
    arguments.treadmill, arguments.folder = arguments.treadmill.resolve(), arguments.folder.resolve()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    certificates = certify(arguments.treadmill, arguments.folder / "certs")
    failed = False
    for name in arguments.only:
        try:
            row = run_one(arguments, name, certificates)
        except NotPossible as why:
            print(f"{name}: SKIPPED: {why}", file=sys.stderr, flush=True)
            continue
        except Exception as why:  # noqa: BLE001: the other faults still run
            print(f"{name}: FAILED: {why!r}", file=sys.stderr, flush=True)
            failed = True
            continue
        (arguments.folder / f"{name}.json").write_text(json.dumps(row), encoding="utf-8")
        print(table.results(arguments.folder)[name], flush=True)
        account = row["account"]
        wrong = account["mistakes"] + [f"{account[what]} fragments {what}" for what in ("lost", "twice") if account[what]]
        failed = failed or bool(wrong)
        for text in wrong:
            print(f"{name}: {text}", file=sys.stderr, flush=True)
    if arguments.csv:
        text = table.HEAD + "".join(row + "\n" for row in table.results(arguments.folder).values())
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
