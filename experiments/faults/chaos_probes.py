"""Helpers that the chaos run starts on hosts: they watch the manifest or the bus, or delay packets.

Usage: chaos_probes.py manifest URL FILE
       chaos_probes.py bus ENDPOINT CERTIFICATES ACTORS FILE
       chaos_probes.py delay QUEUE SECONDS JITTER FILE

Watchers append a JSON object per line to FILE. The second one needs the Python package eclipse-zenoh.
"""

import heapq
import json
import random
import select
import socket
import struct
import sys
import time
import urllib.error
import urllib.request

POLL_S = 0.1
# Announcements may be on their way when another learner begins to lead.
GRACE_S = 1.0
SUMMARY_S = 5
PACKETS_MAX, BUFFER_BYTES = 16_384, 8 << 20
NETFILTER, SO_RCVBUFFORCE = 12, 33
PACKET, VERDICT, CONFIG = 3 << 8, 3 << 8 | 1, 3 << 8 | 2


def watch_manifest(url, file):
    """Notes each manifest, and first that the store answers."""
    last = None
    with open(file, "a", encoding="utf-8", buffering=1) as out:
        while True:
            begun = time.time()
            try:
                with urllib.request.urlopen(url, timeout=1) as answer:
                    manifest = json.load(answer)
            except urllib.error.HTTPError as why:
                # Access to a bucket that does not exist yet is refused.
                manifest = {} if why.code in (403, 404) else None
            except (OSError, ValueError):
                manifest = None
            if manifest is not None and manifest != last:
                last = manifest
                out.write(json.dumps({"at": time.time()} | manifest) + "\n")
            time.sleep(max(0.0, begun + POLL_S - time.time()))


# Counts of an actor's statistics that never fall.
COUNTS = ("env_steps", "episodes", "produced", "accepted", "dropped_by_rule", "resent")


class Observer:
    """What a client on the actors' side hears: epochs of announcements, and of the policies with which actors act."""

    def __init__(self, out):
        self.out, self.highest, self.since = out, 0, 0.0
        self.acting = {}
        self.counts = {"announcements": 0, "late": 0, "statistics": 0, "overtaken_statistics": 0, "acts_on_lower": 0}

    def note(self, what, **fields):
        self.out.write(json.dumps({"at": time.time(), "what": what} | fields) + "\n")

    def announced(self, version):
        now = time.monotonic()
        self.counts["announcements"] += 1
        if version.epoch > self.highest:
            self.highest, self.since = version.epoch, now
            self.note("epoch", epoch=version.epoch, number=version.number)
        elif 0 < version.epoch < self.highest and now - self.since > GRACE_S:
            self.counts["late"] += 1
            self.note("late", epoch=version.epoch, highest=self.highest, number=version.number)

    def acts(self, stats):
        """Compares the epoch of an actor's policy with the highest that the same process had before."""
        self.counts["statistics"] += 1
        key, epoch = (stats.actor, stats.incarnation), stats.version.epoch
        counts = [getattr(stats, name) for name in COUNTS]
        before, known = self.acting.get(key, (0, [0] * len(COUNTS)))
        # A message on another way may overtake this one; its process had counted more by then. One that waits for a learner makes
        # no steps, but sends fragments again.
        if any(now < then for now, then in zip(counts, known, strict=True)):
            self.counts["overtaken_statistics"] += 1
            return
        if 0 < epoch < before:
            self.counts["acts_on_lower"] += 1
            self.note("acts_on_lower", actor=stats.actor, epoch=epoch, before=before, counts=counts, known=known)
        self.acting[key] = (max(epoch, before), counts)


def watch_bus(endpoint, certificates, actors, file):
    from treadmill_actor import bus, schema

    if "epoch" not in schema.PolicyVersion.DESCRIPTOR.fields_by_name:
        sys.exit("python/treadmill_actor/schema.binpb has no PolicyVersion.epoch; regenerate it")
    config = bus.configuration([endpoint], certificates, "observer")
    # A killed process would leave its segments in /dev/shm.
    config.insert_json5("transport/shared_memory/enabled", "false")
    session = bus.zenoh.open(config)
    with open(file, "a", encoding="utf-8", buffering=1) as out:
        observer = Observer(out)

        def announced(sample):
            observer.announced(schema.PolicyAnnouncement.FromString(sample.payload.to_bytes()).version)

        def acts(sample):
            observer.acts(schema.ActorStats.FromString(sample.payload.to_bytes()))

        subscribers = [session.declare_subscriber("treadmill/*/policy/version", announced)]
        for actor in actors.split(","):
            subscribers.append(session.declare_subscriber(f"treadmill/*/actors/{actor}/stats", acts))
        while True:
            time.sleep(SUMMARY_S)
            observer.note("counts", **observer.counts)


def attribute(kind, value):
    return struct.pack("=HH", 4 + len(value), kind) + value + bytes(-len(value) % 4)


def message(kind, queue, attributes):
    """Returns a netlink message to a queue of netfilter."""
    body = struct.pack("!BBH", 0, 0, queue) + attributes
    return struct.pack("=IHHII", 16 + len(body), kind, 1, 0, 0) + body


def delay(queue, seconds, jitter):
    """Holds each packet that iptables puts into a queue; with jitter, packets overtake each other."""
    sock = socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, NETFILTER)
    sock.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, BUFFER_BYTES)
    sock.bind((0, 0))
    # Bind; copy only the packets' numbers; hold many; let packets through if more wait (1), unsegmented (4).
    sock.send(message(CONFIG, queue, attribute(1, struct.pack("!BBH", 1, 0, socket.AF_INET))))
    sock.send(message(CONFIG, queue, attribute(2, struct.pack("!IB", 0, 1))))
    sock.send(message(CONFIG, queue, attribute(3, struct.pack("!I", PACKETS_MAX))))
    sock.send(message(CONFIG, queue, attribute(4, struct.pack("!I", 5)) + attribute(5, struct.pack("!I", 5))))
    held, passed = [], 0
    while True:
        wait = max(0.0, held[0][0] - time.monotonic()) if held else None
        if select.select([sock], [], [], wait)[0]:
            data, at = sock.recv(1 << 16), 0
            while at + 16 <= len(data):
                length, kind = struct.unpack_from("=IH", data, at)
                if kind == PACKET:
                    due = time.monotonic() + seconds + random.random() * jitter
                    heapq.heappush(held, (due, struct.unpack_from("!I", data, at + 24)[0]))
                at += (length + 3) & ~3
        while held and held[0][0] <= time.monotonic():
            _, packet = heapq.heappop(held)
            sock.send(message(VERDICT, queue, attribute(2, struct.pack("!II", 1, packet))))
            passed += 1
            if passed == 1:
                print(f"delaying packets of queue {queue}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    kind, *given = sys.argv[1:]
    if kind == "manifest":
        watch_manifest(*given)
    elif kind == "bus":
        watch_bus(*given)
    else:
        delay(int(given[0]), float(given[1]), float(given[2]))
