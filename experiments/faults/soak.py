#!/usr/bin/env python3
"""Trains for a long time while actors join, leave and are killed at random; checks memory, descriptors and speed.

Usage: soak.py TREADMILL FOLDER [--minutes 30] [--actors 3] [--seed 1]

The number of actors is constant: every few seconds one leaves, is killed, or freezes beyond its lease and is killed, and a new
one replaces it. Prints a table: memory growth of learner and router after a warm-up of a fifth of the time, their descriptors, and
the speed of the last third against the first. Exits with 1 if a value is out of bounds or a fragment is unaccounted for. Needs
root and iproute2, no Python packages.
"""

import argparse
import contextlib
import os
import pathlib
import random
import sys
import time

from experiments.faults.fleet import FRAGMENT, Fleet, certify, clean_up_on_signal, hosts

SAMPLE_S = 2
EVENT_S = (4, 12)
GROWTH_MAX_MB_PER_MINUTE, SLOWDOWN_MAX = 1.0, 0.05
PARTS = ("learner", "router")


def memory_mb(process):
    for line in pathlib.Path(f"/proc/{process.child.pid}/status").read_text(encoding="ascii").splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    return float("nan")


def descriptors(process):
    return len(os.listdir(f"/proc/{process.child.pid}/fd"))


def slope(points):
    """Returns the least-squares slope."""
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    return sum((x - mean_x) * (y - mean_y) for x, y in points) / spread


class Soak:
    def __init__(self, fleet, actors, seed):
        self.fleet, self.random, self.count = fleet, random.Random(seed), 0
        self.events = {"joined": 0, "left": 0, "killed": 0, "frozen": 0}
        fleet.start("learner")
        fleet.start("router")
        self.actors = [self.join() for _ in range(actors)]
        fleet.grow(4 * FRAGMENT)

    def join(self):
        self.count += 1
        self.events["joined"] += 1
        return self.fleet.start(f"actor-{self.count}", host=("actor1", "actor2", "observer")[self.count % 3])

    def replace_actor(self):
        """Removes a random actor in a random way and starts another one."""
        victim = self.actors.pop(self.random.randrange(len(self.actors)))
        what = self.random.choice(("left", "killed", "killed", "frozen"))
        self.events[what] += 1
        if what == "left":
            if not victim.stop():
                raise RuntimeError(f"{victim.name} did not stop after SIGTERM; see {victim.err}")
        else:
            if what == "frozen":
                victim.freeze()
                time.sleep(6)
            victim.kill()
        del self.fleet.current[victim.name]
        self.actors.append(self.join())

    def run(self, minutes):
        """Returns the start time and samples: seconds, memory and descriptors of each part, environment steps."""
        begun = time.time()
        samples, event_due = [], begun
        while (now := time.time()) < begun + 60 * minutes:
            row = [now - begun]
            for part in PARTS:
                process = self.fleet.current[part]
                row += [memory_mb(process), descriptors(process)]
            samples.append((*row, self.fleet.steps()))
            if now >= event_due:
                self.replace_actor()
                event_due = time.time() + self.random.uniform(*EVENT_S)
            time.sleep(SAMPLE_S)
        return begun, samples


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("folder", type=pathlib.Path, help="where the run goes; must not exist")
    parser.add_argument("--minutes", type=float, default=30)
    parser.add_argument("--actors", type=int, default=3)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    clean_up_on_signal()
    binary, folder, prefix = arguments.treadmill.resolve(), arguments.folder.resolve(), f"tms{os.getpid()}"
    folder.mkdir(parents=True)
    certificates = certify(binary, folder / "certs")
    with contextlib.ExitStack() as stack:
        hosts("up", prefix)
        stack.callback(hosts, "down", prefix)
        fleet = Fleet(binary, folder / "fleet", prefix, certificates)
        stack.callback(lambda: [process.kill() for process in fleet.processes if process.is_running()])
        soak = Soak(fleet, arguments.actors, arguments.seed)
        begun, samples = soak.run(arguments.minutes)
        ended = time.time()
        stuck = fleet.stop()
        account = fleet.account()
    header = "seconds," + ",".join(f"{part}_mb,{part}_descriptors" for part in PARTS) + ",env_steps\n"
    lines = (",".join(f"{value:.2f}" for value in row) + "\n" for row in samples)
    (folder / "samples.csv").write_text(header + "".join(lines), encoding="ascii")
    sys.exit(report(fleet, soak, account, stuck, begun, ended, samples))


def report(fleet, soak, account, stuck, begun, ended, samples):
    """Prints the table. Returns 1 if a value is out of bounds."""
    warm = [row for row in samples if row[0] >= samples[-1][0] / 5]
    rows, wrong = [("minutes", f"{(ended - begun) / 60:.1f}", "")], []
    rows += [(f"actors {what}", str(count), "") for what, count in soak.events.items()]
    for number, part in enumerate(PARTS):
        memory, files = 1 + 2 * number, 2 + 2 * number
        growth = slope([(row[0] / 60, row[memory]) for row in warm])
        rows.append((f"{part}: memory at the end", f"{warm[-1][memory]:.1f} MB", ""))
        rows.append((f"{part}: growth after warm-up", f"{growth:+.2f} MB/min", f"below {GROWTH_MAX_MB_PER_MINUTE:g}"))
        # Actors join and leave all the time, so compare minima.
        half = len(warm) // 2
        first, last = (min(row[files] for row in part_of) for part_of in (warm[:half], warm[half:]))
        rows.append((f"{part}: descriptors, first and second half", f"{first}, {last}", "no more"))
        if growth >= GROWTH_MAX_MB_PER_MINUTE:
            wrong.append(f"the {part}'s memory grows")
        if last > first:
            wrong.append(f"the {part}'s descriptors grow")
    third = (ended - begun) / 3
    early, late = fleet.speed(begun, begun + third), fleet.speed(ended - third, ended)
    rows.append(("env steps/s in the first and the last third", f"{early:.0f}, {late:.0f}", f"within {SLOWDOWN_MAX:.0%}"))
    if late < (1 - SLOWDOWN_MAX) * early:
        wrong.append(f"training slowed down by {1 - late / early:.1%}")
    for what in ("lost", "twice"):
        rows.append((f"fragments {what}", str(account[what]), "0"))
        wrong += [f"fragments {what}"] * bool(account[what])
    rows.append(("fragments dropped by rule", str(account["dropped"]), ""))
    rows.append(("fragments lost with killed actors", str(account["lost_with_process"]), ""))
    print("| what | measured | bound |\n|---|---|---|")
    for row in rows:
        print("| " + " | ".join(row) + " |")
    wrong += account["mistakes"] + [f"{name} did not stop after SIGTERM" for name in stuck]
    for text in wrong:
        print(text, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    main()
