"""Measures what a flood of messages costs: a learner and an actor share one core, a hostile client has the other one.

Needs: cargo build --release --bins --examples; Linux, two cores.

Usage: measure.py [--target target/release] [--pairs 3] [--window-s 8] [--kinds empty,names,...] [--plain] [--million]

For each kind of flood, windows without and with the flood alternate; results are medians over pairs of neighbouring windows.
Two numbers state the cost:
- bus: CPU time of the learner's threads that do not train, as a share of one core. Its growth is what the actors lose.
- cost by steps: CPU time of learner and actor beyond what the trained steps cost without the flood. It includes the training
  thread and all disturbances, so it is noisier.
Links use mutual TLS, and the hostile client has an actor's certificate, unless --plain is given. --million sends a million tiny
messages of three kinds and measures the learner's memory.
"""

import argparse
import bisect
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

KINDS = ("empty", "names", "noise", "impostor", "replay", "stats", "evaluations", "forbidden", "idle")
FLEET_CORE, HOSTILE_CORE = "0", "1"


def start_on_core(core, command, **options):
    return subprocess.Popen(["taskset", "-c", core, *map(str, command)], **options)


class Fleet:
    """A learner and an actor on one core."""

    def __init__(self, target, folder, plain):
        self.target, self.folder, self.run = target, folder, folder / "run"
        tls = [] if plain else ["--tls", folder / "certs"]
        if not plain:
            subprocess.run([target / "treadmill", "certs", folder / "certs"], check=True, stdout=subprocess.DEVNULL)
        listen = f"{'tcp' if plain else 'tls'}/127.0.0.1:0"
        self.certificates = [] if plain else [folder / "certs"]
        self.log = open(folder / "learner.log", "w")
        settings = ["rollout.fragment_steps=32", "ppo.batch=1024", "ppo.minibatch=512"]
        settings += ["eval.every_steps=100000", "learner.threads=1"]
        self.learner = start_on_core(
            FLEET_CORE,
            [target / "treadmill", "learner", "--run-dir", self.run, "--steps", 10**12, "--listen", listen, *tls]
            + [part for setting in settings for part in ("--set", setting)],
            stdout=self.log,
            stderr=self.log,
        )
        endpoint = self.run / "endpoint.txt"
        while not (endpoint.exists() and endpoint.read_text().endswith("\n")):
            time.sleep(0.05)
        self.endpoint = endpoint.read_text().strip()
        self.actor = start_on_core(
            FLEET_CORE,
            [target / "treadmill", "actor", "--connect", self.endpoint, "--envs", 32, "--name", "good", *tls],
            stdout=self.log,
            stderr=self.log,
        )

    def attack(self, kind, seconds, count=2**63):
        return start_on_core(
            HOSTILE_CORE,
            [self.target / "examples/hostile_client", self.endpoint, "run", kind, seconds, count, *self.certificates],
            stdout=subprocess.PIPE,
            text=True,
        )

    def updates(self):
        """Returns (time, steps) of each update."""
        found = []
        with open(self.run / "metrics.jsonl") as lines:
            for line in lines:
                if '"time/total_timesteps"' in line and line.endswith("\n"):
                    metric = json.loads(line)
                    found.append((metric["time_unix_s"], metric["value"]))
        return found

    def value(self, tag):
        found = None
        with open(self.run / "metrics.jsonl") as lines:
            for line in lines:
                if f'"{tag}"' in line and line.endswith("\n"):
                    found = json.loads(line)["value"]
        return found

    def bus_s(self):
        """Returns CPU time of the learner's threads that do not train."""
        total = 0
        for thread in pathlib.Path(f"/proc/{self.learner.pid}/task").iterdir():
            try:
                trains = (thread / "comm").read_text().startswith(("training", "update", "treadmill"))
                total += 0 if trains else int((thread / "schedstat").read_text().split()[0])
            except OSError:
                pass  # a thread that has ended
        return total / 1e9

    def cpu_s(self):
        total = 0
        for process in (self.learner, self.actor):
            fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
            total += int(fields[11]) + int(fields[12])
        return total / os.sysconf("SC_CLK_TCK")

    def window(self, seconds):
        """Returns steps, CPU time and wall time between the first and last update; the bus's share of a core; peak memory."""
        samples, memory, begun, bus_s = [], 0.0, time.time(), self.bus_s()
        while time.time() < begun + seconds:
            samples.append((time.time(), self.cpu_s()))
            memory = max(memory, self.memory_mb())
            time.sleep(0.02)
        bus = (self.bus_s() - bus_s) / (time.time() - begun)
        within = [update for update in self.updates() if samples[0][0] <= update[0] <= samples[-1][0]]
        if len(within) < 2:
            sys.exit(f"only {len(within)} updates in a window; use a longer --window-s")
        cpu_at = lambda when: samples[bisect.bisect_left(samples, (when, 0.0))][1]
        (first, steps_before), (last, steps_after) = within[0], within[-1]
        steps = steps_after - steps_before
        return steps, cpu_at(last) - cpu_at(first), last - first, bus, memory

    def memory_mb(self):
        pages = int(pathlib.Path(f"/proc/{self.learner.pid}/statm").read_text().split()[1])
        return pages * os.sysconf("SC_PAGE_SIZE") / 1e6

    def end(self):
        for process in (self.actor, self.learner):
            process.terminate()
        for process in (self.actor, self.learner):
            process.wait(30)
        return self.learner.returncode


def pairs(fleet, kind, count, window_s):
    """Returns one dictionary per pair of windows."""
    found = []
    for _ in range(count):
        quiet_steps, quiet_cpu_s, quiet_s, quiet_bus, _ = fleet.window(window_s)
        hostile = fleet.attack(kind, window_s + 60)
        # Time to join.
        time.sleep(1)
        steps, cpu_s, seconds, bus, memory = fleet.window(window_s)
        hostile.kill()
        hostile.wait()
        found.append(
            {
                "quiet_bus": quiet_bus,
                "bus": bus,
                "cost": (cpu_s - steps * quiet_cpu_s / quiet_steps) / seconds,
                "quiet_per_s": quiet_steps / quiet_s,
                "flooded_per_s": steps / seconds,
                "memory_mb": memory,
            }
        )
        # Time for the learner to process queued messages.
        time.sleep(2)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--target", type=pathlib.Path, default=pathlib.Path("target/release"), help="folder of the binaries")
    parser.add_argument("--pairs", type=int, default=3, help="pairs of windows per kind")
    parser.add_argument("--window-s", type=float, default=8, help="length of a window")
    parser.add_argument("--kinds", default=",".join(KINDS), help="kinds of floods, separated by commas")
    parser.add_argument("--plain", action="store_true", help="plain tcp instead of mutual TLS")
    parser.add_argument("--million", action="store_true", help="send a million messages and measure memory")
    options = parser.parse_args()
    target = options.target.resolve()
    with tempfile.TemporaryDirectory() as folder:
        fleet = Fleet(target, pathlib.Path(folder), options.plain)
        try:
            while len(fleet.updates() if (fleet.run / "metrics.jsonl").exists() else []) < 5:
                time.sleep(0.2)
            first = fleet.memory_mb()
            if options.million:
                print("| flood | messages | seconds | learner before, MB | peak, MB | after, MB |\n|---|---|---|---|---|---|")
                for kind in ("empty", "names", "stats"):
                    before, peak = fleet.memory_mb(), 0.0
                    hostile = fleet.attack(kind, 600, 10**6)
                    while hostile.poll() is None:
                        peak = max(peak, fleet.memory_mb())
                        time.sleep(0.1)
                    result = json.loads(hostile.communicate()[0])
                    time.sleep(3)
                    print(
                        f"| {kind} | {result['sent']} | {result['wall_s']:.0f} | {before:.0f} | {peak:.0f} | "
                        f"{fleet.memory_mb():.0f} |",
                        flush=True,
                    )
            else:
                print("| flood | bus, share of a core, without → with | cost by steps (range) "
                      "| steps/s, without → with | learner's memory, MB |")
                print("|---|---|---|---|---|", flush=True)
                for kind in options.kinds.split(","):
                    found = pairs(fleet, kind, options.pairs, options.window_s)
                    middle = {name: statistics.median(pair[name] for pair in found) for name in found[0]}
                    costs = [pair["cost"] for pair in found]
                    print(
                        f"| {kind} | {middle['quiet_bus']:.1%} → {middle['bus']:.1%} "
                        f"| {middle['cost']:.0%} ({min(costs):.0%} to {max(costs):.0%}) "
                        f"| {middle['quiet_per_s']:.0f} → {middle['flooded_per_s']:.0f} | {middle['memory_mb']:.0f} |",
                        flush=True,
                    )
            print(f"memory at the start {first:.0f} MB; quarantined {fleet.value('actors/quarantined'):.0f}, "
                  f"malformed {fleet.value('bus/fragments_malformed'):.0f}, "
                  f"rejected unread {fleet.value('bus/fragments_turned_away'):.0f}", file=sys.stderr)
        finally:
            code = fleet.end()
        print(f"the learner exited with {code}; its log has {len(open(fleet.folder / 'learner.log').readlines())} lines",
              file=sys.stderr)


if __name__ == "__main__":
    main()
