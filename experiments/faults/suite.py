#!/usr/bin/env python3
"""Injects one fault after another into a fleet that trains, and measures what it costs.

Usage: suite.py TREADMILL FOLDER [--only NAME...] [--older TREADMILL] [--mode sync|async] [--table FILE]

Hosts are network namespaces joined by a bridge (hosts.sh), links are mutually authenticated TLS, and actors reach the learner
through a router. Each fault has a run of its own: it trains, is disturbed, recovers without anybody's help but that processes
which ended are started again, and is stopped; then what the actors produced is compared with what the learner did with it.
Prints a row for each. With --table, those of all faults that FOLDER has results of are put into FILE between its two markers, so
that --only may repeat some. Exits with 1 where anything was lost silently, trained on twice, or did not recover. Needs root,
iproute2, iptables, and for clock jumps Debian's `faketime`. Needs Python alone.
"""

import argparse
import contextlib
import json
import os
import pathlib
import shutil
import sys

import links
import table
from fleet import FRAGMENT, Fleet, certify, end_well, endpoint, hosts
from injections import FAULTS
from trial import ACTORS, Cannot, Trial


def run_one(arguments, name, certificates):
    title, function, options = FAULTS[name]
    folder = arguments.folder / name
    shutil.rmtree(folder, ignore_errors=True)
    if options.get("older") and not arguments.older:
        raise Cannot("--older names no binary")
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
        trial = Trial(fleet)
        function(trial)
        trial.finish()
        ended = {process.name for process in fleet.current.values() if not process.is_running()}
        stuck = fleet.stop()
        account = fleet.account()
        account["mistakes"] += [f"{name} ended by itself" for name in ended]
        account["mistakes"] += [f"{name} did not stop when it was asked to" for name in stuck]
        panics = [process.err for process in fleet.processes if "panicked" in process.err.read_text(errors="replace")]
        account["mistakes"] += [f"a panic in {path}" for path in panics]
        if options.get("older"):
            # Actors of before say nothing at their end; what they did not settle is all that can be missing.
            account["mistakes"] = [text for text in account["mistakes"] if "no actor sent" not in text]
        row = {"name": name, "title": title, "account": account, "note": trial.note, "curve": table.curve(fleet)}
        keys = ("detected", "recovered", "before", "during", "after", "updates_repeated")
        row |= {key: getattr(trial, key) for key in keys}
        return row


def begin(fleet, wrapped, actor_options):
    for name in ("learner", "router", *ACTORS):
        options = actor_options if name in ACTORS else {}
        fleet.start(name, wrapper=wrapped.get(name, ()), **options)
    patience = "both actors are there"
    fleet.wait(patience, lambda: all(fleet.learner_said(f"actor joined actor={name}", 0.0) for name in ACTORS))
    fleet.grow(6 * FRAGMENT)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("folder", type=pathlib.Path, help="where the runs go")
    parser.add_argument("--only", nargs="+", choices=sorted(FAULTS), default=list(FAULTS))
    parser.add_argument("--older", type=lambda path: pathlib.Path(path).resolve(), help="binary of the version before")
    parser.add_argument("--mode", choices=("sync", "async"), default="sync", help="of the learner")
    parser.add_argument("--table", type=pathlib.Path, help="page that the table is put into")
    arguments = parser.parse_args()
    end_well()
    arguments.treadmill, arguments.folder = arguments.treadmill.resolve(), arguments.folder.resolve()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    certificates = certify(arguments.treadmill, arguments.folder / "certs")
    failed = False
    for name in arguments.only:
        try:
            row = run_one(arguments, name, certificates)
        except Cannot as why:
            print(f"{name}: CANNOT BE INJECTED HERE: {why}", file=sys.stderr, flush=True)
            continue
        except Exception as why:  # noqa: BLE001: the other faults are still worth their time.
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
    if arguments.table:
        table.put(arguments.table, table.HEAD + "".join(row + "\n" for row in table.results(arguments.folder).values()))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
