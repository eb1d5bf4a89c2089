"""Runs a fleet over several hosts, for the fault suite and the soak test.

Hosts are network namespaces (hosts.sh). Each process runs the real binary over TLS and writes its output to files. Needs root.
"""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
ADDRESSES = {"learner": "10.77.0.1", "router": "10.77.0.2"}
PORT = 7447
FRAGMENT_STEPS, ENVS = 64, 16
FRAGMENT = FRAGMENT_STEPS * ENVS
# Rounds take a fraction of a second, so that times are precise. Networks are those of the preset `walk`.
SETTINGS = {
    "rollout.fragment_steps": FRAGMENT_STEPS,
    "ppo.batch": 2 * FRAGMENT,
    "ppo.minibatch": 512,
    "eval.every_steps": 0,
    "learner.table_every_updates": 1_000_000,
    "bus.stats_every_ms": 1000,
}
ENDLESS = 1_000_000_000
SAMPLE_S = 0.05
STAMP = re.compile(r"^(\d{4}-\d\d-\d\dT[\d:.]+)Z\s+(\w+) (.*)$")


def endpoint(host):
    return f"tls/{ADDRESSES[host]}:{PORT}"


class Process:
    """One start of one process of the fleet."""

    def __init__(self, name, host, child, out, err):
        self.name, self.host, self.child, self.out, self.err = name, host, child, out, err
        self.begun, self.frozen = time.time(), False

    def kill(self):
        self.child.kill()
        self.child.wait()

    def freeze(self):
        self.child.send_signal(signal.SIGSTOP)
        self.frozen = True

    def thaw(self):
        self.child.send_signal(signal.SIGCONT)
        self.frozen = False

    def stop(self, timeout_s=20):
        """Sends SIGTERM. Returns False, and kills the process, if it has not ended after the timeout."""
        if self.child.poll() is not None:
            return True
        self.thaw()
        self.child.terminate()
        try:
            self.child.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self.kill()
            return False
        return True

    def is_running(self):
        return self.child.poll() is None

    def logged(self, text, since=0.0):
        """Returns the time, by the process's clock, of the first log line with `text` after `since`, or None."""
        for line in self.err.read_text(encoding="utf-8", errors="replace").splitlines():
            found = STAMP.match(line)
            if found and text in found[3] and (at := seconds(found[1])) >= since:
                return at
        return None

    def last_json(self):
        for line in reversed(self.out.read_text(encoding="utf-8", errors="replace").splitlines()):
            if line.startswith("{"):
                return json.loads(line)
        return None


def seconds(stamp):
    whole, _, fraction = stamp.partition(".")
    return time.mktime(time.strptime(whole + "UTC", "%Y-%m-%dT%H:%M:%S%Z")) - time.timezone + float("0." + (fraction or "0"))


class Fleet:
    """A learner, a router and actors, each on its own host."""

    def __init__(self, binary, folder, prefix, certificates, settings=None, run=None):
        self.binary, self.folder, self.prefix, self.certificates = binary, folder, prefix, certificates
        self.settings = SETTINGS | (settings or {})
        self.run = run or folder / "run"
        self.processes, self.current = [], {}
        self.samples, self.is_over = [], threading.Event()
        folder.mkdir(parents=True)
        self.sampler = threading.Thread(target=self.sample, daemon=True)
        self.sampler.start()

    def start(self, name, wrapper=(), via=None, binary=None, host=None):
        """Starts a process. An actor connects to the router, or to the endpoints in `via`."""
        tls = ["--tls", str(self.certificates)]
        if name == "learner":
            arguments = ["learner", "--listen", endpoint("learner"), "--json", "--no-progress"]
            if (self.run / "checkpoints" / "latest.bundle").exists():
                arguments += ["--resume", str(self.run)]
            else:
                arguments += ["--preset", "walk", "--run", "walk", "--run-dir", str(self.run), "--steps", str(ENDLESS)]
                for key, value in self.settings.items():
                    arguments += ["--set", f"{key}={json.dumps(value)}"]
        elif name == "router":
            arguments = ["router", "--listen", endpoint("router"), "--connect", endpoint("learner")]
        else:
            arguments = ["actor", "--name", name, "--envs", str(ENVS)]
            for where in via or [endpoint("router")]:
                arguments += ["--connect", where]
            if binary is None:
                arguments.append("--json")
        command = [str(binary or self.binary), *arguments, *tls]
        host = host or name.replace("-", "")
        number = sum(process.name == name for process in self.processes)
        out, err = (self.folder / f"{name}-{number}.{kind}" for kind in ("out", "err"))
        environment = os.environ | {"TREADMILL_LOG": "info,treadmill_actor=debug,zenoh=off"}
        with out.open("wb") as out_file, err.open("wb") as err_file:
            child = subprocess.Popen(
                ["ip", "netns", "exec", f"{self.prefix}-{host}", *wrapper, *command],
                stdout=out_file, stderr=err_file, stdin=subprocess.DEVNULL, env=environment,
            )  # fmt: skip
        process = Process(name, host, child, out, err)
        self.processes.append(process)
        self.current[name] = process
        return process

    def stop(self):
        """Stops the learner first, then actors, then the router, so that all counts are final. Returns who did not stop."""
        in_order = sorted(self.current.values(), key=lambda process: (process.name != "learner", process.name == "router"))
        stuck = [process.name for process in in_order if not process.stop()]
        self.is_over.set()
        self.sampler.join()
        return stuck

    def sample(self):
        while not self.is_over.wait(SAMPLE_S):
            if (newest := self.newest()) and (not self.samples or self.samples[-1][1] != newest):
                self.samples.append((time.time(), newest))

    def newest(self):
        """Returns environment steps and updates so far, from the end of metrics.jsonl."""
        try:
            with (self.run / "metrics.jsonl").open("rb") as file:
                size = file.seek(0, os.SEEK_END)
                file.seek(max(0, size - 32_768))
                tail = file.read().decode("utf-8", errors="replace")
        except OSError:
            return None
        updates = re.findall(r'"tag":"time/iterations","step":(\d+),"value":(\d+)', tail)
        return tuple(map(int, updates[-1])) if updates else None

    def steps(self):
        return self.samples[-1][1][0] if self.samples else 0

    def wait(self, what, poll, timeout_s=60):
        until = time.time() + timeout_s
        while time.time() < until:
            if found := poll():
                return found
            time.sleep(0.02)
        raise RuntimeError(f"not within {timeout_s} s: {what}; see {self.folder}")

    def grow(self, steps, timeout_s=60):
        """Waits until the learner has trained on `steps` more steps. Returns the time."""
        wanted = self.steps() + steps
        self.wait(f"{steps} more steps", lambda: self.steps() >= wanted, timeout_s)
        return time.time()

    def speed(self, since, until):
        """Returns steps per second between two times."""
        def at(moment):
            before = [newest[0] for when, newest in self.samples if when <= moment]
            return before[-1] if before else 0

        return (at(until) - at(since)) / (until - since)

    def learner_logged(self, text, since):
        times = [at for process in self.processes if process.name == "learner" and (at := process.logged(text, since))]
        return min(times, default=None)

    def delivers(self, name, since=0.0):
        return self.learner_logged(f"first fragment of an actor process actor={name} ", since)

    def spans(self):
        """Yields for each incarnation of an actor: name, incarnation, final JSON, and the last fragment that it produced."""
        for process in self.processes:
            if not process.name.startswith("actor"):
                continue
            text = process.err.read_text(encoding="utf-8", errors="replace")
            last = process.last_json()
            # One process may have stayed in several runs, of which each has numbers of its own.
            for part in text.split("new incarnation incarnation=")[1:]:
                incarnation = re.match(r"\d+", part)[0]
                produced = [int(number) for number in re.findall(r"fragment produced sequence=(\d+)", part)]
                own = last if last and last["incarnation"] == incarnation else None
                yield process.name, incarnation, own, max(produced, default=0)

    def account(self):
        """Compares the actors' counts with the learner's accounts.jsonl."""
        lines = (self.run / "accounts.jsonl").read_text(encoding="utf-8").splitlines()
        theirs = {line["incarnation"]: line for line in map(json.loads, lines)}
        learner = self.current["learner"].last_json() or {}
        found = {"lost_with_process": 0, "lost": 0, "twice": 0, "dropped": 0, "sent_again": 0, "mistakes": []}
        known = set()
        for name, incarnation, own, produced in self.spans():
            known.add(incarnation)
            line = theirs.get(incarnation)
            if line is None:
                line = dict.fromkeys(("through", "newest", "missing", "accepted", "too_old", "vanished", "unseen"), 0)
            dropped = line["too_old"] + line["vanished"] + line["unseen"]
            if own is None:
                # A killed actor loses what the learner never received.
                found["lost_with_process"] += max(0, produced - line["accepted"] - dropped)
                found["twice"] += max(0, line["accepted"] + dropped - produced)
                continue
            found["sent_again"] += own["resent"]
            found["dropped"] += own["dropped_by_rule"]
            if own["produced"] != own["accepted"] + own["dropped_by_rule"] + own["in_flight"]:
                found["mistakes"].append(f"{name}: {own}")
            # The learner must have settled every fragment that the actor forgot, and the actor must know of each drop. Only the
            # actor knows of drops that a learner made after its last checkpoint.
            unsaved = max(0, own["dropped_by_rule"] - dropped)
            found["lost"] += max(0, own["settled_through"] - line["through"] - unsaved)
            found["lost"] += max(0, dropped - own["dropped_by_rule"] - own["in_flight"])
            found["lost"] += max(0, own["accepted"] - own["awaiting_durability"] - line["accepted"])
            found["twice"] += max(0, line["accepted"] - own["accepted"] - own["in_flight"])
        found["mistakes"] += [f"no actor has the incarnation of {line}" for key, line in theirs.items() if key not in known]
        trained = sum(line["env_steps"] for line in theirs.values())
        found["env_steps"], found["trained"] = learner.get("env_steps"), trained
        if learner.get("env_steps") != trained:
            found["mistakes"].append(f"the learner reports {learner.get('env_steps')} env steps, accounts.jsonl {trained}")
        return found


def clean_up_on_signal():
    """Turns SIGTERM into an exit that ends processes and removes hosts."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))


def hosts(command, prefix):
    subprocess.run([str(HERE / "hosts.sh"), command, prefix], check=True)


def certify(binary, folder, addresses=tuple(ADDRESSES.values())):
    names = [part for host in (*addresses, "127.0.0.1") for part in ("--host", host)]
    subprocess.run([str(binary), "certs", str(folder), *names], check=True, stdout=subprocess.DEVNULL)
    return folder.resolve()
