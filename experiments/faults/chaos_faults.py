"""Fault kinds of the chaos run: each is a context manager that disturbs the fleet until it ends.

A fault yields once. `seen` is its record: it notes there whether it took effect.
"""

import contextlib
import errno
import os
import pathlib
import subprocess
import sys
import time

from experiments.faults import links
from experiments.faults.chaos_fleet import ACTOR_HOSTS, ACTOR_NAMES, DISK_MB, HOSTS, LEARNERS, NAMES, ROUTERS, host_of

ACTOR_SIDE = tuple(f"host{number}" for number in range(1, ACTOR_HOSTS + 1))
CERTIFICATE_S, DAY_S = 10, 86_400
HOG_ROOM, HOG_BYTES = 4 << 20, 256 << 20
# Kinds that end the process which they hit.
ENDS_PROCESSES = ("kill", "host-down", "certificate", "memory", "disk-readonly", "upgrade")
# Function, how it is drawn (targets, shortest and longest duration, parameters) and weight of each kind, by name.
KINDS = {}


def kind(weight, targets, duration, **parameters):
    def keep(function):
        manager = contextlib.contextmanager(function)
        KINDS[function.__name__.replace("_", "-")] = (manager, weight, targets, duration, parameters)
        return function

    return keep


# Targets, weighted by repetition. `leader` and `follower` are found when the fault begins.
PROCESSES = ("leader",) * 8 + ("follower",) * 3 + ("store",) * 2 + ROUTERS + ACTOR_NAMES[:8]
MACHINES = ("leader",) * 3 + ("follower", "store", *ACTOR_SIDE)
LEARNING = ("leader", "leader", "follower")
BRIDGED = ("leader",) * 3 + ("follower", *ACTOR_SIDE)


def draw(random, at, keep_processes=False):
    """Returns a random fault at a time; with `keep_processes` one that ends none. An upgrade has an entry for each process."""
    names = [name for name in KINDS if not (keep_processes and name in ENDS_PROCESSES)]
    name = random.choices(names, [KINDS[name][1] for name in names])[0]
    _, _, targets, (shortest, longest), parameters = KINDS[name]
    entry = {"at": round(at, 2), "kind": name, "target": random.choice(targets)}
    entry["duration"] = round(random.uniform(shortest, longest), 2)
    entry["parameters"] = {key: random.choice(values) for key, values in parameters.items()}
    if name != "upgrade":
        return [entry]
    # The server is not ours: stopping it in order takes it many seconds.
    order = random.sample(NAMES[1:], len(NAMES) - 1)
    return [entry | {"at": round(at + 2 * number, 2), "target": target} for number, target in enumerate(order)]


def resolve(fleet, target):
    """Returns the process that a target means now."""
    leader = fleet.leader()
    follower = LEARNERS[leader == LEARNERS[0]]
    return {"leader": leader, "follower": follower}.get(target, target)


@kind(12, PROCESSES, (2, 2))
def kill(fleet, target, seen):
    fleet.kill(target)
    seen["seen"] = True
    yield


@kind(3, MACHINES, (3, 12))
def host_down(fleet, target, seen):
    """All processes of a host die, and start again when the host is back."""
    fleet.host_down[target] = float("inf")
    names = [name for name in NAMES if host_of(name) == target]
    for name in names:
        fleet.kill(name)
    seen["seen"] = True
    yield
    fleet.host_down[target] = time.time()


@kind(8, PROCESSES, (2, 14))
def freeze(fleet, target, seen):
    process = fleet.current[target]
    process.freeze()
    yield
    if process.is_running():
        state = pathlib.Path(f"/proc/{process.child.pid}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0]
        seen["seen"] = state == "T"
        process.thaw()
    else:
        seen["seen"] = process.is_ending


@contextlib.contextmanager
def rules(fleet, host, seen, wanted):
    """Adds rules to a host's firewall, for its link to other hosts. They took effect if they matched a packet."""
    tag = f"fault-{seen['number']}"
    complete = [[chain, "-i" if chain == "INPUT" else "-o", "eth0", *rest] for chain, *rest in wanted]
    tagged = [[*rule[:3], "-m", "comment", "--comment", tag, *rule[3:]] for rule in complete]
    for rule in tagged:
        links.on(fleet.prefix, host, "iptables", "-w", "-A", *rule)
    try:
        yield
    finally:
        command = ["ip", "netns", "exec", f"{fleet.prefix}-{host}", "iptables", "-w", "-nvxL"]
        listing = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout
        packets = sum(int(line.split()[0]) for line in listing.splitlines() if f"/* {tag} */" in line)
        seen["packets"] = seen.get("packets", 0) + packets
        seen["seen"] = seen["packets"] > 0
        for rule in tagged:
            links.on(fleet.prefix, host, "iptables", "-w", "-D", *rule)


def drops(direction, peers=None):
    """Returns rules that drop packets from, to, or from and to other hosts; by default all."""
    found = []
    for peer in peers or [None]:
        if direction in ("in", "both"):
            found.append(["INPUT", *(["-s", HOSTS[peer]] if peer else []), "-j", "DROP"])
        if direction in ("out", "both"):
            found.append(["OUTPUT", *(["-d", HOSTS[peer]] if peer else []), "-j", "DROP"])
    return found


@kind(8, BRIDGED, (3, 15), direction=("both", "in", "out"))
def cut(fleet, target, seen, direction):
    """A host is cut off, in one direction or both."""
    with rules(fleet, target, seen, drops(direction)):
        yield


@kind(6, ("leader",), (6, 15), direction=("both", "in", "out"), store=(True, False))
def cut_from_actors(fleet, target, seen, direction, store):
    """The learner is cut off from actors and the other learner; without `store`, from the store, too."""
    peers = [host for host in HOSTS if host not in (target, "store")] + ([] if store else ["store"])
    with rules(fleet, target, seen, drops(direction, peers)):
        yield


@kind(3, ("leader",), (4, 12), peer=(*ACTOR_SIDE, "follower", "store"), direction=("both", "in", "out"))
def cut_pair(fleet, target, seen, peer, direction):
    """The link between two hosts fails."""
    with rules(fleet, target, seen, drops(direction, [resolve(fleet, peer)])):
        yield


@kind(4, MACHINES, (5, 15), probability=(0.02, 0.05, 0.1))
def loss(fleet, target, seen, probability):
    share = ["-m", "statistic", "--mode", "random", "--probability", str(probability), "-j", "DROP"]
    with rules(fleet, target, seen, [["INPUT", *share]]):
        yield


@kind(4, BRIDGED, (5, 15), seconds=(0.05, 0.2, 0.5))
def delay(fleet, target, seen, seconds, jitter=0.0):
    """Packets to a host arrive late; this kernel may have no netem, so a helper holds them."""
    queue = str(seen["number"] + 1)
    helper = fleet.probe(target, "delay", queue, str(seconds), str(jitter), f"delay-{queue}")
    time.sleep(0.2)
    try:
        with rules(fleet, target, seen, [["INPUT", "-j", "NFQUEUE", "--queue-num", queue, "--queue-bypass"]]):
            yield
            seen["running"] = helper.poll() is None
    finally:
        helper.kill()
        helper.wait()
    seen["seen"] = seen["seen"] and seen["running"]


@kind(3, BRIDGED, (5, 15), jitter=(0.02, 0.1))
def reorder(fleet, target, seen, jitter):
    yield from delay(fleet, target, seen, 0.0, jitter)


@kind(3, ("store",), (5, 20), seconds=(0.05, 0.2, 0.5))
def store_slow(fleet, target, seen, seconds):
    yield from delay(fleet, target, seen, seconds)


@kind(3, ("store",), (3, 20), direction=("both", "in", "out"))
def store_cut(fleet, target, seen, direction):
    yield from cut(fleet, target, seen, direction)


def remount(disk, option):
    subprocess.run(["mount", "-o", f"remount,{option}", str(disk)], check=True, stderr=subprocess.PIPE)


@kind(3, LEARNING, (4, 15))
def disk_full(fleet, target, seen):
    """The file system shrinks to what is used, so that it is full at once."""
    disk = fleet.disk(target)
    for _ in range(20):
        state = os.statvfs(disk)
        with contextlib.suppress(subprocess.CalledProcessError):
            remount(disk, f"size={(state.f_blocks - state.f_bfree) * state.f_frsize}")
            break
    yield
    state = os.statvfs(disk)
    seen["seen"] = state.f_bavail * state.f_frsize < 1 << 16
    remount(disk, f"size={DISK_MB[target]}m")


@kind(3, ("store",), (4, 15))
def store_full(fleet, target, seen):
    yield from disk_full(fleet, target, seen)


@kind(2, LEARNING, (4, 12))
def disk_readonly(fleet, target, seen):
    """The learner dies, and finds its disk read-only when it starts again: a mounted disk with open files stays writable."""
    disk = fleet.disk(target)
    fleet.kill(target)
    remount(disk, "ro")
    try:
        (disk / "probe").write_bytes(b"")
    except OSError as why:
        seen["seen"] = why.errno == errno.EROFS
    yield
    remount(disk, "rw")


@kind(4, BRIDGED, (5, 20), seconds=(3600, -3600))
def clock(fleet, target, seen, seconds):
    """The clock of a host jumps by an hour, and back at the end."""
    folder = fleet.folder / target
    links.set_clock(folder, f"{seconds:+d}")
    shown = subprocess.run([*links.faked_clock(folder, is_new=False), "date", "+%s"], stdout=subprocess.PIPE, check=True)
    seen["seen"] = abs(int(shown.stdout) - time.time() - seconds) < 5
    yield
    links.set_clock(folder, "+0")


@kind(2, ("leader", *ROUTERS, *ACTOR_NAMES[:3]), (CERTIFICATE_S + 5, CERTIFICATE_S + 12))
def certificate(fleet, target, seen):
    """A process starts with a certificate that expires ten seconds later, and gets a new one at the end."""
    folder = fleet.folder / host_of(target) / "certs"
    earlier = ["env", f"LD_PRELOAD={links.FAKETIME[0]}", f"FAKETIME=-{DAY_S - CERTIFICATE_S}s"]
    renew = [str(fleet.binary), "certs", str(folder), "--renew"]
    subprocess.run([*earlier, *renew, "--days", "1"], check=True, stdout=subprocess.DEVNULL)
    expires = time.time() + CERTIFICATE_S
    fleet.kill(target)
    yield
    seen["seen"] = time.time() > expires
    subprocess.run(renew, check=True, stdout=subprocess.DEVNULL)
    fleet.kill(target)


@kind(1, ("all",), (3, 3))
def upgrade(fleet, target, seen):
    """A process stops in order, and the next version starts."""
    process = fleet.current[target]
    process.is_ending = True
    process.thaw()
    process.child.terminate()
    if fleet.binary_after:
        fleet.binaries[target] = fleet.binary_after
    yield
    seen["seen"] = not process.is_running()


@kind(4, PROCESSES, (3, 3))
def memory(fleet, target, seen):
    """A process reaches the limit of its control group, and the kernel ends it."""
    process = fleet.current[target]
    process.is_ending = True
    pathlib.Path(f"/proc/{process.child.pid}/oom_score_adj").write_text("1000", encoding="ascii")
    fleet.groups.limit_memory(target, HOG_ROOM)
    grow = f"import time; kept = bytearray({HOG_BYTES}); time.sleep(9)"
    hog = subprocess.Popen([*fleet.groups.wrapper(target, None), sys.executable, "-c", grow])
    fleet.helpers.append(hog)
    yield
    hog.kill()
    hog.wait()
    seen["seen"] = not process.is_running()
    if not seen["seen"]:
        process.is_ending = False
        fleet.groups.limit_memory(target, None)
