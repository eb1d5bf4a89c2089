"""Fleet of the chaos run: two learners, an S3 server, routers and actors, restarted by a supervisor.

Hosts are network namespaces (hosts.sh), learners and the server write to small file systems, and each process has a control
group of its own, which paces actors and measures processor time. Needs root.
"""

import contextlib
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time

from experiments.faults import links
from experiments.faults.fleet import PORT, Fleet, Process

ACTOR_HOSTS, ACTORS = 5, 16
HOSTS = {"leader": "10.77.0.1", "standby": "10.77.0.2", "store": "10.77.0.3"}
HOSTS |= {f"host{number}": f"10.77.0.{10 + number}" for number in range(1, ACTOR_HOSTS + 1)}
LEARNERS = ("leader", "standby")
ROUTERS = tuple(f"router-{number}" for number in range(1, ACTOR_HOSTS + 1))
ACTOR_NAMES = tuple(f"actor-{number}" for number in range(1, ACTORS + 1))
NAMES = ("store", *LEARNERS, *ROUTERS, *ACTOR_NAMES)
RUN, S3_PORT, RESTART_S = "walk", 18333, 1
FRAGMENT_STEPS, ENVS = 64, 4
FRAGMENT = FRAGMENT_STEPS * ENVS
SETTINGS = {
    "rollout.fragment_steps": FRAGMENT_STEPS,
    "policy.hidden": [64, 64],
    "ppo.batch": ACTORS * FRAGMENT // 2,
    "ppo.minibatch": 256,
    # A policy that stays as it began: a body that learns to walk costs more and more to simulate, which no two fleets do alike.
    "ppo.learning_rate": 1e-9,
    "ppo.learning_rate_min": 1e-9,
    "ppo.learning_rate_max": 1e-9,
    "eval.every_steps": 0,
    "learner.table_every_updates": 1_000_000,
    "learner.threads": 1,
    "bus.stats_every_ms": 500,
    "bus.receipt_timeout_ms": 5000,
}
KEYS = {"AWS_ACCESS_KEY_ID": "treadmill", "AWS_SECRET_ACCESS_KEY": "treadmill-secret"}
KEYS |= {"AWS_ENDPOINT": f"http://{HOSTS['store']}:{S3_PORT}", "AWS_ALLOW_HTTP": "true", "AWS_REGION": "us-east-1"}
DISK_MB = {"leader": 256, "standby": 256, "store": 4096}
LOG_BYTES_MAX, EVENTS_MAX = 1 << 20, 10_000
# Lines of learners that the result needs, by a part of them.
NOTED = (
    "taking over", "resuming at", "another learner leads", "the store fails", "written: training continues",
    "the disk is full", "panicked", "error: ", "leads in epoch", "has ended",
)  # fmt: skip


def host_of(name):
    """Returns the host of a process."""
    kind, _, number = name.partition("-")
    return f"host{(int(number) - 1) % ACTOR_HOSTS + 1}" if number else name


def endpoint(host):
    return f"tls/{HOSTS[host]}:{PORT}"


class Groups:
    """Control groups of the fleet, of version 1 or 2, one for each process."""

    def __init__(self, prefix):
        root = pathlib.Path("/sys/fs/cgroup")
        self.is_v2 = (root / "cgroup.controllers").exists()
        roots = [root] if self.is_v2 else [root / controller for controller in ("cpu", "cpuacct", "memory")]
        self.tops = [at / prefix for at in roots]
        for at, top in zip(roots, self.tops, strict=True):
            if self.is_v2:
                (at / "cgroup.subtree_control").write_text("+cpu +memory", encoding="ascii")
            top.mkdir()
            if self.is_v2:
                (top / "cgroup.subtree_control").write_text("+cpu +memory", encoding="ascii")

    def wrapper(self, name, share):
        """Returns a command prefix that puts a process into its group; `share` limits it to that part of one core."""
        for top in self.tops:
            (top / name).mkdir(exist_ok=True)
        if share and self.is_v2:
            (self.tops[0] / name / "cpu.max").write_text(f"{int(share * 250_000)} 250000", encoding="ascii")
        elif share:
            (self.tops[0] / name / "cpu.cfs_period_us").write_text("250000", encoding="ascii")
            (self.tops[0] / name / "cpu.cfs_quota_us").write_text(str(int(share * 250_000)), encoding="ascii")
        files = [str(top / name / "cgroup.procs") for top in self.tops]
        joined = "".join(f"echo $$ > {file}; " for file in files)
        return ["sh", "-c", joined + 'exec "$@"', "sh"]

    def cpu_s(self):
        """Returns the processor time of all processes so far."""
        if self.is_v2:
            return int((self.tops[0] / "cpu.stat").read_text(encoding="ascii").split()[1]) / 1e6
        return int((self.tops[1] / "cpuacct.usage").read_text(encoding="ascii")) / 1e9

    def limit_memory(self, name, room_bytes):
        """Limits a process to what it uses now and `room_bytes`; None removes the limit."""
        limit, used = ("memory.max", "memory.current") if self.is_v2 else ("memory.limit_in_bytes", "memory.usage_in_bytes")
        folder = self.tops[-1] / name
        text = "max" if self.is_v2 else "-1"
        if room_bytes is not None:
            text = str(int((folder / used).read_text(encoding="ascii")) + room_bytes)
        (folder / limit).write_text(text, encoding="ascii")

    def remove(self):
        for top in self.tops:
            for folder in [*top.iterdir(), top]:
                if folder.is_dir():
                    with contextlib.suppress(OSError):
                        folder.rmdir()


@contextlib.contextmanager
def disks(folder):
    """Mounts the file systems of learners and server. Keeps a copy of the learners' files."""
    with contextlib.ExitStack() as stack:
        for name, megabytes in DISK_MB.items():
            disk = folder / "disks" / name
            disk.mkdir(parents=True)
            subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", str(disk)], check=True)
            stack.callback(subprocess.run, ["umount", "--lazy", str(disk)], check=False)
            if name in LEARNERS:
                stack.callback(shutil.copytree, disk, folder / "runs" / name, dirs_exist_ok=True)
        yield


class ChaosFleet(Fleet):
    """The fleet, and the supervisor that restarts what ended."""

    def __init__(self, binary, folder, prefix, certificates, share):
        self.groups, self.share, self.host_down = Groups(prefix), share, {}
        self.due, self.ends, self.events, self.read_to = {}, [], [], {}
        self.binaries, self.binary_after = dict.fromkeys(NAMES, binary), None
        self.manifests, self.manifests_read, self.lock, self.helpers = [], 0, threading.Lock(), []
        super().__init__(binary, folder, prefix, certificates)
        for host in HOSTS:
            (folder / host).mkdir()
            links.set_clock(folder / host, "+0")
            shutil.copytree(certificates, folder / host / "certs")

    def command(self, name):
        """Returns the command line of a process, the same at each start."""
        host = host_of(name)
        tls = ["--tls", str(self.folder / host / "certs")]
        if name == "store":
            return self.store_command()
        if name in LEARNERS:
            run = ["--store", f"s3://treadmill/{RUN}", "--run-dir", str(self.disk(name) / "run"), "--json", "--no-progress"]
            # Only one dials the other: with two links between them, a silence may leave one half open (zenoh#2806).
            links_to = ["--listen", endpoint(name)] + (["--connect", endpoint("leader")] if name == "standby" else [])
            if name == "standby":
                return [self.binaries[name], "learner", "--standby", *run, *links_to, *tls]
            new = ["--resume-or-start", "--preset", "walk", "--run", RUN, "--steps", "1000000000"]
            for key, value in SETTINGS.items():
                new += ["--set", f"{key}={json.dumps(value)}"]
            return [self.binaries[name], "learner", *run, *links_to, *tls, *new]
        if name in ROUTERS:
            dialled = [part for learner in LEARNERS for part in ("--connect", endpoint(learner))]
            return [self.binaries[name], "router", "--listen", endpoint(host), *dialled, *tls]
        # After its own host's router, an actor may use the next host's.
        following = f"host{int(host[4:]) % ACTOR_HOSTS + 1}"
        dialled = [part for at in (host, following) for part in ("--connect", endpoint(at))]
        return [self.binaries[name], "actor", "--name", name, "--envs", str(ENVS), "--threads", "1", *dialled, "--json", *tls]

    def store_command(self):
        """Returns the command line of SeaweedFS. It puts sockets into /tmp with names by port, so its disk is also its /tmp."""
        beside = pathlib.Path(sys.executable).with_name("weed")
        program = beside if beside.exists() else "weed"
        # With free space to keep, it looks once a minute whether there is some again.
        limits = ["-master.volumeSizeLimitMB=64", "-volume.max=60", "-volume.minFreeSpace=0", "-master.telemetry=false"]
        return [
            "unshare", "--mount", "sh", "-c", 'mount --bind "$1" /tmp && shift && exec "$@"', "sh", self.disk("store"),
            program, "server", "-s3", "-dir=/tmp", f"-ip={HOSTS['store']}", "-ip.bind=0.0.0.0", f"-s3.port={S3_PORT}",
            "-s3.config=/tmp/s3.json", *limits,
        ]  # fmt: skip

    def disk(self, host):
        return self.folder.parent / "disks" / host

    def start(self, name, **_):
        """Starts a process in its control group, with the clock of its host."""
        number = sum(process.name == name for process in self.processes)
        out, err = (self.folder / f"{name}-{number}.{kind}" for kind in ("out", "err"))
        environment = os.environ | {"TREADMILL_LOG": "info,treadmill_actor=debug,zenoh=off,zenoh::net=error"}
        environment |= KEYS if name in LEARNERS else {}
        clock = () if name == "store" else links.faked_clock(self.folder / host_of(name), is_new=False)
        wrapper = self.groups.wrapper(name, self.share if name in ACTOR_NAMES else None)
        self.groups.limit_memory(name, None)
        # Unlike `ip netns exec`, this gives no mounts of its own to a process, so that a disk is writable again for all.
        on_host = ["nsenter", f"--net=/run/netns/{self.prefix}-{host_of(name)}"]
        command = [*wrapper, *on_host, *clock, *map(str, self.command(name))]
        with out.open("wb") as out_file, err.open("wb") as err_file:
            # Ctrl-C ends the script in order, not these.
            child = subprocess.Popen(
                command, stdout=out_file, stderr=err_file, stdin=subprocess.DEVNULL, env=environment, start_new_session=True
            )  # fmt: skip
        process = Process(name, host_of(name), child, out, err)
        process.is_ending = False
        self.processes.append(process)
        self.current[name] = process
        self.due.pop(name, None)
        return process

    def begin(self):
        """Starts everything, in the order in which an operator would."""
        identities = [
            {
                "name": "treadmill",
                "credentials": [{"accessKey": KEYS["AWS_ACCESS_KEY_ID"], "secretKey": KEYS["AWS_SECRET_ACCESS_KEY"]}],
                "actions": ["Admin", "Read", "Write", "List", "Tagging"],
            },
            {"name": "anonymous", "actions": ["Read"]},
        ]
        (self.disk("store") / "s3.json").write_text(json.dumps({"identities": identities}), encoding="utf-8")
        self.start("store")
        self.probe("store", "manifest", f"http://{HOSTS['store']}:{S3_PORT}/treadmill/{RUN}/manifest.json", "manifests.jsonl")
        self.wait("the store answers", lambda: self.newest() or self.manifests, 60)
        for name in NAMES[1:]:
            self.start(name)
        self.wait("training", lambda: self.supervise() or (self.newest() or (0, 0))[1] > 2, 120)
        for number in range(1, ACTOR_HOSTS + 1):
            host = f"host{number}"
            actors = ",".join(name for name in ACTOR_NAMES if host_of(name) == host)
            self.probe(host, "bus", endpoint(host), str(self.certificates), actors, f"bus-{number}.jsonl")

    def probe(self, host, kind, *arguments):
        """Starts a helper on a host, without a control group."""
        *arguments, file = arguments
        command = ["ip", "netns", "exec", f"{self.prefix}-{host}", sys.executable]
        command += ["-m", "experiments.faults.chaos_probes", kind]
        environment = os.environ | {"ZENOH_RUNTIME": "(rx:(handover:tx))"}
        with (self.folder / f"probe-{file}.err").open("ab") as err:
            complete = [*command, *arguments, str(self.folder / file)]
            child = subprocess.Popen(complete, env=environment, stderr=err, start_new_session=True)
        self.helpers.append(child)
        return child

    def kill(self, name):
        """Kills a process; its supervisor starts it again."""
        process = self.current[name]
        process.is_ending = True
        process.kill()

    def supervise(self):
        """Notes ends, starts what has been down for a second, and reads new lines of learners."""
        now = time.time()
        for name, process in list(self.current.items()):
            if process.is_running():
                continue
            if name not in self.due:
                self.due[name] = now + RESTART_S
                self.ends.append({"at": now, "name": name, "code": process.child.returncode, "by_fault": process.is_ending})
            if now >= max(self.due[name], self.host_down.get(host_of(name), 0)):
                self.start(name)
        for name in LEARNERS:
            for kind in ("out", "err"):
                self.read_new(name, getattr(self.current[name], kind))

    def read_new(self, name, file):
        with file.open("rb") as opened:
            opened.seek(self.read_to.get(file, 0))
            text = opened.read(LOG_BYTES_MAX)
        complete = text[: text.rfind(b"\n") + 1]
        self.read_to[file] = self.read_to.get(file, 0) + len(complete)
        for line in complete.decode("utf-8", errors="replace").splitlines():
            if any(part in line for part in NOTED) and len(self.events) < EVENTS_MAX:
                self.events.append({"at": time.time(), "name": name, "pid": self.current[name].child.pid, "line": line})

    def newest(self):
        """Returns environment steps and updates of the newest manifest."""
        with self.lock:
            return self.read_manifests()

    def read_manifests(self):
        file = self.folder / "manifests.jsonl"
        if not file.exists():
            return None
        with file.open("rb") as opened:
            opened.seek(self.manifests_read)
            text = opened.read()
        complete = text[: text.rfind(b"\n") + 1]
        self.manifests_read += len(complete)
        self.manifests += [json.loads(line) for line in complete.splitlines()]
        found = [one for one in self.manifests[-1:] if one.get("updates")]
        return (found[0]["env_steps"], found[0]["updates"]) if found else None

    def leader(self):
        """Returns the name of the learner that leads, by the newest manifest; that of the first leader if it is gone."""
        pid = self.manifests[-1].get("pid") if self.manifests else None
        for name in LEARNERS:
            if any(process.name == name and process.child.pid == pid for process in self.processes):
                return name
        return LEARNERS[0]

    def end(self):
        """Stops followers, the leader, actors and routers, so that all counts are final. Returns who did not stop."""
        leader = self.leader()
        order = [name for name in LEARNERS if name != leader] + [leader, *ACTOR_NAMES, *ROUTERS]
        self.current["learner"], self.run = self.current[leader], self.disk(leader) / "run"
        stuck = [name for name in order if not self.current[name].stop()]
        self.is_over.set()
        self.sampler.join()
        return stuck

    def destroy(self):
        """Kills everything that still runs."""
        self.is_over.set()
        for child in self.helpers:
            # Observers end in order, so that they leave nothing behind.
            child.terminate()
        for child in self.helpers + [process.child for process in self.processes]:
            with contextlib.suppress(subprocess.TimeoutExpired):
                child.wait(2 if child in self.helpers else 0)
            if child.poll() is None:
                child.kill()
                child.wait()
        self.groups.remove()
        for process in self.processes:
            # libfaketime leaves these behind if its process is killed.
            for name in ("sem.faketime_sem", "faketime_shm"):
                pathlib.Path(f"/dev/shm/{name}_{process.child.pid}").unlink(missing_ok=True)
