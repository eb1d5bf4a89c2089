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
import random
import shutil
import sys
import threading
import time

import links
from fleet import FRAGMENT, Fleet, certify, end_well, endpoint, hosts

ACTORS = ("actor-1", "actor-2")
BEFORE_S, FAULT_S, AFTER_S, RESTART_S = 10, 12, 12, 1
RECOVERY_S = 60
FAULTS = {}


class Cannot(Exception):
    """This machine cannot inject it."""


class Trial:
    """One fault and what was seen of it."""

    def __init__(self, fleet):
        self.fleet, self.injected, self.repaired, self.ended = fleet, None, None, None
        self.detected, self.recovered, self.note = None, None, ""
        self.updates_repeated = None

    def inject(self):
        time.sleep(BEFORE_S)
        self.before = self.fleet.speed(time.time() - BEFORE_S, time.time())
        self.injected = time.time()

    def gone(self, *names):
        """Waits until the learner knows that these actors are gone, and notes how long that took."""
        def all_gone():
            times = [self.fleet.learner_said(f"`{name}` is gone", self.injected) for name in names]
            return all(times) and max(times)

        self.detected = self.fleet.wait("the learner notices", all_gone, 30) - self.injected

    def unanswered(self, names=ACTORS):
        """The same, for actors whose learner is gone."""
        def all_know():
            times = [self.fleet.current[name].said("keeping fragments", self.injected) for name in names]
            return all(times) and max(times)

        self.detected = self.fleet.wait("the actors notice", all_know, 30) - self.injected

    def repair(self):
        self.repaired = time.time()

    def await_actors(self, *names, delivers=False):
        """Waits until these are back and training goes on."""
        since = self.repaired

        def all_back():
            said = self.fleet.delivers if delivers else lambda name, at: self.fleet.learner_said(f"`{name}` is there", at)
            times = [said(name, since) for name in names]
            return all(times) and max(times)

        back = self.fleet.wait("the actors are back", all_back, RECOVERY_S)
        self.fleet.grow(1, RECOVERY_S)
        self.recovered = max(back, self.grown_since(back)) - since

    def await_training(self, rounds=1):
        self.fleet.grow(rounds * 2 * FRAGMENT, RECOVERY_S)
        self.recovered = self.grown_since(self.repaired) - self.repaired

    def grown_since(self, moment):
        return min((at for at, _ in self.fleet.samples if at >= moment), default=time.time())

    def finish(self):
        time.sleep(AFTER_S)
        self.ended = time.time()
        until = self.repaired if self.repaired and self.repaired > self.injected + 1 else self.ended - AFTER_S
        self.during = self.fleet.speed(self.injected, until) / self.before
        self.after = self.fleet.speed(self.ended - AFTER_S + 2, self.ended) / self.before


def fault(title, **options):
    def keep(function):
        FAULTS[function.__name__.replace("_", "-")] = (title, function, options)
        return function

    return keep


def restart(trial, *names, binary=None):
    """What a restart policy does."""
    time.sleep(RESTART_S)
    for name in names:
        trial.fleet.start(name, binary=binary)


@fault("none")
def undisturbed(trial):
    trial.inject()
    time.sleep(4 * FAULT_S)


@fault("an actor is killed (`kill -9`), and started again 1 s later")
def actor_killed(trial):
    trial.inject()
    trial.fleet.current["actor-1"].kill()
    trial.gone("actor-1")
    trial.repair()
    restart(trial, "actor-1")
    trial.await_actors("actor-1", delivers=True)
    trial.note = "recovered: from the notice until the learner has work of the new process"


@fault("an actor is frozen for 12 s (`SIGSTOP`)")
def actor_frozen(trial):
    trial.inject()
    trial.fleet.current["actor-1"].freeze()
    trial.gone("actor-1")
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["actor-1"].thaw()
    trial.await_actors("actor-1")


@fault("the learner is killed, and resumed 1 s later")
def learner_killed(trial):
    trial.inject()
    kill_learner(trial)
    trial.unanswered()
    trial.fleet.start("learner")
    await_listening(trial)
    trial.await_training()
    count_repeated(trial)


@fault("the learner is frozen for 12 s")
def learner_frozen(trial):
    trial.inject()
    trial.fleet.current["learner"].freeze()
    trial.unanswered()
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["learner"].thaw()
    trial.await_training()


@fault("the router is killed, and started again 1 s later")
def router_killed(trial):
    trial.inject()
    trial.fleet.current["router"].kill()
    trial.gone(*ACTORS)
    restart(trial, "router")
    trial.repair()
    trial.await_actors(*ACTORS)


@fault("the router is frozen for 12 s")
def router_frozen(trial):
    trial.inject()
    trial.fleet.current["router"].freeze()
    trial.gone(*ACTORS)
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.fleet.current["router"].thaw()
    trial.await_actors(*ACTORS)


@fault("the router is killed for good; actors know the learner's endpoint, too", via=["router", "learner"])
def router_gone(trial):
    trial.inject()
    trial.fleet.current.pop("router").kill()
    trial.repaired = trial.injected
    # They may be back before the learner has looked.
    trial.await_training(2)


@fault("all actors are killed, and started again 1 s later")
def all_actors_killed(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].kill()
    trial.gone(*ACTORS)
    trial.repair()
    restart(trial, *ACTORS)
    trial.await_actors(*ACTORS, delivers=True)


@fault("all actors are frozen for 12 s")
def all_actors_frozen(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].freeze()
    trial.gone(*ACTORS)
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    for name in ACTORS:
        trial.fleet.current[name].thaw()
    trial.await_actors(*ACTORS)


@fault("an actor's host is cut off for 12 s")
def actor_cut(trial):
    cut(trial, ["INPUT", "OUTPUT"])


@fault("one-way loss: nothing reaches an actor's host for 12 s")
def actor_deaf(trial):
    cut(trial, ["INPUT"])


@fault("one-way loss: nothing leaves an actor's host for 12 s")
def actor_mute(trial):
    cut(trial, ["OUTPUT"])


@fault("the learner's host is cut off for 12 s")
def learner_cut(trial):
    trial.inject()
    with links.dropped(trial.fleet.prefix, "learner", ["INPUT", "OUTPUT"]):
        trial.gone(*ACTORS)
        wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.await_actors(*ACTORS)


@fault("5 % of packets are lost on every host for 20 s (iptables `statistic`)")
def packets_lost(trial):
    trial.inject()
    with contextlib.ExitStack() as stack:
        for host in ("learner", "router", "actor1", "actor2"):
            stack.enter_context(links.dropped(trial.fleet.prefix, host, ["INPUT"], probability=0.05))
        wait_until(trial.injected + 20)
    trial.repair()
    trial.await_training()


@fault("200 ms delay each way for 20 s (a relay before each actor)", relay=True)
def delayed(trial):
    trial.inject()
    links.set_delay(trial.fleet.folder, 0.2)
    wait_until(trial.injected + 20)
    trial.repair()
    links.set_delay(trial.fleet.folder, 0)
    trial.await_training()


@fault("1 MB/s on the links of router and actors for 20 s (`tc` TBF)")
def narrow(trial):
    trial.inject()
    with contextlib.ExitStack() as stack:
        for host in ("router", "actor1", "actor2"):
            stack.enter_context(links.narrowed(trial.fleet.prefix, host, "8mbit"))
        wait_until(trial.injected + 20)
    trial.repair()
    trial.await_training()


@fault("the learner's disk is full for 12 s", disk_mb=40)
def disk_full(trial):
    trial.inject()
    filler = links.fill(trial.fleet.run.parent)
    until = trial.fleet.current["learner"]
    trial.detected = trial.fleet.wait("it says so", lambda: until.said("waits until there is room", trial.injected), 30)
    trial.detected -= trial.injected
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    filler.unlink()
    trial.await_training()


@fault("the same, and the learner is killed meanwhile and started every 2 s until it stays", disk_mb=40)
def disk_full_killed(trial):
    trial.inject()
    filler = links.fill(trial.fleet.run.parent)
    kill_learner(trial)
    trial.unanswered()
    ends = 0
    while time.time() < trial.injected + FAULT_S + 4:
        learner = trial.fleet.start("learner")
        time.sleep(2)
        if learner.is_running():
            break
        ends += 1
    wait_until(trial.injected + FAULT_S)
    trial.repair()
    filler.unlink()
    while not trial.fleet.current["learner"].is_running():
        restart(trial, "learner")
        time.sleep(1)
    trial.await_training()
    count_repeated(trial)
    trial.note = f"{ends} starts ended with an error that names the full disk"


@fault("an actor at a tenth of its speed for 20 s (stopped for 90 of every 100 ms)")
def actor_slow(trial):
    trial.inject()
    actor, over = trial.fleet.current["actor-1"], threading.Event()

    def slow():
        while not over.is_set():
            actor.freeze()
            over.wait(0.09)
            actor.thaw()
            over.wait(0.01)
        actor.thaw()

    slowing = threading.Thread(target=slow)
    slowing.start()
    wait_until(trial.injected + 20)
    over.set()
    slowing.join()
    trial.repair()
    trial.await_training()


@fault("the learner's clock jumps an hour ahead, then two back (libfaketime)", clock="learner")
def learner_clock(trial):
    clock(trial)


@fault("an actor's clock jumps an hour ahead, then two back (libfaketime)", clock="actor-1")
def actor_clock(trial):
    clock(trial)


@fault("everything is killed, and started in some order; the worst of four orders")
def restart_of_everything(trial):
    trial.inject()
    fleet, slowest = trial.fleet, 0.0
    order = ["learner", "router", *ACTORS]
    for number in range(4):
        random.Random(number).shuffle(order)
        for name in order:
            fleet.current[name].kill()
        for name in order:
            fleet.start(name)
            time.sleep(0.5)
        trial.repair()
        trial.await_actors(*ACTORS, delivers=True)
        slowest = max(slowest, trial.recovered)
        fleet.grow(4 * FRAGMENT)
    trial.recovered = slowest


@fault("a rolling upgrade: actors one version older, replaced one after the other", older=True)
def rolling_upgrade(trial):
    trial.inject()
    for name in ACTORS:
        trial.fleet.current[name].stop()
        trial.repair()
        trial.fleet.start(name)
        trial.await_actors(name, delivers=True)


def wait_until(moment):
    time.sleep(max(0.0, moment - time.time()))


def cut(trial, chains):
    trial.inject()
    with links.dropped(trial.fleet.prefix, "actor1", chains):
        trial.gone("actor-1")
        wait_until(trial.injected + FAULT_S)
    trial.repair()
    trial.await_actors("actor-1")


def kill_learner(trial):
    trial.updates_before = trial.fleet.newest()[1]
    trial.fleet.current["learner"].kill()
    trial.updates_before = max(trial.updates_before, trial.fleet.newest()[1])


def count_repeated(trial):
    first = trial.fleet.wait("an update", lambda: (newest := trial.fleet.newest()) and newest[1] > 0 and newest[1])
    trial.updates_repeated = max(0, trial.updates_before - first + 1) if first <= trial.updates_before else 0


def await_listening(trial):
    out = trial.fleet.current["learner"].out
    trial.fleet.wait("the learner listens", lambda: "listening" in out.read_text(encoding="utf-8", errors="replace"))
    trial.repair()


def clock(trial):
    trial.inject()
    for offset in ("+3600", "-3600"):
        links.set_clock(trial.fleet.folder, offset)
        time.sleep(FAULT_S)
    # A link that is made while clocks differ needs certificates that are valid on both.
    trial.repair()
    trial.fleet.current["router"].kill()
    trial.fleet.start("router")
    trial.await_training(2)
    trial.note = "at the end the router is killed, so that links are made anew while clocks differ"


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
            account["mistakes"] = [text for text in account["mistakes"] if "nobody sent" not in text]
        row = {"name": name, "title": title, "account": account, "note": trial.note, "curve": curve(fleet)}
        keys = ("detected", "recovered", "before", "during", "after", "updates_repeated")
        row |= {key: getattr(trial, key) for key in keys}
        return row


def begin(fleet, wrapped, actor_options):
    for name in ("learner", "router", *ACTORS):
        options = actor_options if name in ACTORS else {}
        fleet.start(name, wrapper=wrapped.get(name, ()), **options)
    patience = "both actors are there"
    fleet.wait(patience, lambda: all(fleet.learner_said(f"`{name}` is there", 0.0) for name in ACTORS))
    fleet.grow(6 * FRAGMENT)


def curve(fleet):
    """Mean return in training by environment steps."""
    points = []
    with (fleet.run / "metrics.jsonl").open(encoding="utf-8") as lines:
        for line in lines:
            if '"rollout/ep_rew_mean"' in line:
                metric = json.loads(line)
                points.append((metric["step"], metric["value"]))
    return points


def at_steps(points, steps):
    return next((value for step, value in reversed(points) if step <= steps), None)


def as_row(row, baseline):
    def time_of(value):
        return "–" if value is None else f"{value:.1f} s"

    account = row["account"]
    lost = account["lost"] + account["lost_with_process"]
    returned = ""
    if baseline and row["curve"]:
        steps = min(row["curve"][-1][0], baseline[-1][0])
        returned = f"{at_steps(row['curve'], steps):.0f} / {at_steps(baseline, steps):.0f}"
    repeated = "" if row["updates_repeated"] is None else f"; updates repeated: {row['updates_repeated']}"
    cells = [
        row["title"], time_of(row["detected"]), time_of(row["recovered"]), str(lost * FRAGMENT),
        str(account["twice"] * FRAGMENT) + repeated, f"{account['dropped']} / {account['sent_again']}",
        f"{100 * row['during']:.0f} % / {100 * row['after']:.0f} %", returned,
    ]  # fmt: skip
    return "| " + " | ".join(cells) + " |"


def results(folder):
    """A row of the table for every fault that there are results of."""
    files = {name: folder / f"{name}.json" for name in FAULTS}
    rows = {name: json.loads(file.read_text(encoding="utf-8")) for name, file in files.items() if file.exists()}
    baseline = rows["undisturbed"]["curve"] if "undisturbed" in rows else None
    return {name: as_row(row, baseline) for name, row in rows.items()}


HEAD = """\
| fault | detected after | recovered after | env steps lost | trained twice | fragments dropped by rule / sent again | steps/s \
during / after, of before | return / undisturbed |
|---|---|---|---|---|---|---|---|
"""


def put(file, text):
    """Between the markers of a page."""
    page = file.read_text(encoding="utf-8")
    head, _, rest = page.partition("<!-- table -->")
    _, _, tail = rest.partition("<!-- end of table -->")
    file.write_text(f"{head}<!-- table -->\n{text}<!-- end of table -->{tail}", encoding="utf-8")


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
        print(results(arguments.folder)[name], flush=True)
        account = row["account"]
        wrong = account["mistakes"] + [f"{account[what]} fragments {what}" for what in ("lost", "twice") if account[what]]
        failed = failed or bool(wrong)
        for text in wrong:
            print(f"{name}: {text}", file=sys.stderr, flush=True)
    if arguments.table:
        put(arguments.table, HEAD + "".join(row + "\n" for row in results(arguments.folder).values()))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
