"""Zenoh session of an actor; no other module imports zenoh. docs/guide/external-tasks.md describes each key."""

import contextlib
import ipaddress
import json
import logging
import os
import queue
import re
import sys
import threading
import time
from pathlib import Path

import zenoh
from google.protobuf.message import DecodeError

from . import schema

FETCH_TIMEOUT_S = 10.0
#: Longest wait for the first piece of a policy, for which a router may ask the learner, and for each further one.
FIRST_PIECE_TIMEOUT_S, PIECE_TIMEOUT_S = 5.0, 3.0
PIECE_RETRY_S = 0.05
#: Longest wait for a predecessor of the same name to go, and pause between two looks.
NAME_TIMEOUT_S, NAME_RETRY_S = 15.0, 0.5
MESSAGE_BYTES_MAX = 32 << 20
QUEUED_METRICS_MAX = 100_000
#: Time without an answer before the first warning, as the learner may be starting, and between further ones.
FIRST_WARNING_S, WARN_EVERY_S = 1.0, 10.0
#: Protocol, host, port and Zenoh's options.
ENDPOINT = re.compile(r"(tcp|tls)/([^?#]+):([0-9]{1,5})([?#].*)?")
log = logging.getLogger("treadmill_actor")


#: Error with which a standby answers requests for its policy.
FOLLOWS = b"this learner follows"
STANDBY_TIMEOUT_S = 2.0


class BusError(Exception):
    """An endpoint, a certificate or the session is unusable."""


def default_endpoint(tls):
    """Returns where a learner or router of this machine listens by default, with the certificates in `tls` or without."""
    return f"{'tls' if tls is not None else 'tcp'}/127.0.0.1:7447"


def check_endpoint(endpoint, insecure, tls):
    """Raises BusError for a malformed endpoint, plain tcp beyond loopback without `insecure`, and tls without the folder `tls`."""
    parts = ENDPOINT.fullmatch(endpoint)
    if not parts or not 1 <= int(parts[3]) <= 65_535:
        raise BusError(f"endpoint `{endpoint}` is not valid; write tcp/HOST:PORT or tls/HOST:PORT with a port from 1 to 65535")
    protocol, host = parts[1], parts[2].strip("[]")
    if protocol == "tls" and tls is None:
        raise BusError(
            f"endpoint `{endpoint}`: links to it are encrypted, and --tls is missing; name the folder with this machine's "
            "certificates: --tls DIR (`treadmill certs DIR` makes them)"
        )
    try:
        is_loopback = host == "localhost" or ipaddress.ip_address(host).is_loopback
    except ValueError:
        is_loopback = False
    if protocol == "tcp" and not (is_loopback or insecure):
        raise BusError(
            f"endpoint `{endpoint}`: any host on the network can read and forge plain tcp; use tls/HOST:PORT with --tls DIR, "
            "or --insecure on a trusted network"
        )


def configuration(connect, tls=None, role="actor"):
    """Returns Zenoh's client configuration; `tls` is a folder made by `treadmill certs`."""
    config = zenoh.Config()
    settings = {
        "mode": "client",
        "connect/endpoints": connect,
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "connect/retry": {"period_init_ms": 200, "period_max_ms": 2000, "period_increase_factor": 2},
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/tx/lease": 4000,
        "transport/link/tx/keep_alive": 4,
        "transport/link/rx/max_message_size": MESSAGE_BYTES_MAX,
    }
    if tls is not None or any(endpoint.startswith("tls/") for endpoint in connect):
        # Zenoh reads and writes a TLS connection from two threads without a lock (eclipse-zenoh/zenoh#2557), which breaks links
        # under load. It reads this variable when the first session opens.
        os.environ.setdefault("ZENOH_RUNTIME", "(rx:(handover:tx))")
    if tls is not None:
        folder = Path(tls).resolve()
        certificate, key, authority = folder / f"{role}.crt", folder / f"{role}.key", folder / "ca.crt"
        for file in (certificate, key, authority):
            if not file.is_file():
                raise BusError(f"--tls {folder}: `{file}` does not exist; make it with `treadmill certs`")
        settings["transport/link/tls"] = {
            "root_ca_certificate": str(authority),
            "enable_mtls": True,
            "verify_name_on_connect": True,
            "connect_certificate": str(certificate),
            "connect_private_key": str(key),
        }
    for name, value in settings.items():
        config.insert_json5(name, json.dumps(value))
    return config


def read_metric(data):
    """Returns a metric, or None if the message is not one: on an open bus anybody may send."""
    try:
        metric = json.loads(data)
        texts, numbers = [metric[key] for key in ("run", "tag")], [metric[key] for key in ("step", "value", "time_unix_s")]
    except (ValueError, TypeError, LookupError, RecursionError):
        return None
    is_number = [isinstance(number, (int, float)) and not isinstance(number, bool) for number in numbers]
    if not all(is_number) or not all(isinstance(text, str) for text in texts):
        return None
    # Integers of JSON may be larger than any float.
    return metric if all(-sys.float_info.max <= number <= sys.float_info.max for number in numbers) else None


def decoded(kind, data):
    """Returns a message of this class, or None if `data` is None or no such message: on an open bus anybody may answer."""
    try:
        return None if data is None else kind.FromString(data)
    except DecodeError:
        return None


def dialled(open_session, endpoints, stopping):
    """Returns what `open_session` returns, or None after a request to stop. Raises BusError if it raises.

    Zenoh blocks until a learner or router answers, without a message, and signals do not end that; so it dials on a thread of
    its own.
    """
    opened = queue.Queue()

    def dial():
        try:
            opened.put((open_session(), None))
        except Exception as why:  # noqa: BLE001: raised again in the calling thread
            opened.put((None, why))

    threading.Thread(target=dial, daemon=True).start()
    warn_at = time.monotonic() + FIRST_WARNING_S
    while not stopping.is_set():
        try:
            session, why = opened.get(timeout=0.1)
        except queue.Empty:
            if time.monotonic() >= warn_at:
                log.warning("no answer from %s; retrying", ", ".join(endpoints))
                warn_at = time.monotonic() + WARN_EVERY_S
            continue
        if why is not None:
            raise BusError(str(why)) from why
        return session
    return None


def observe(connect, tls, run, events):
    """Opens a session that puts ("metric", metric), ("begun", run) and ("gone", run) into an unbounded queue.

    Metrics are dropped while QUEUED_METRICS_MAX events wait; they come again with the next update.

    `run` is a name, or `*` for all runs.
    """
    zenoh.init_log_from_env_or("error")
    session = zenoh.open(configuration(connect, tls, "observer"))

    def receive_metric(sample):
        metric = read_metric(sample.payload.to_bytes())
        if metric is not None and events.qsize() < QUEUED_METRICS_MAX:
            events.put(("metric", metric))

    def receive_token(sample):
        name = str(sample.key_expr).split("/")[1]
        events.put(("begun" if sample.kind == zenoh.SampleKind.PUT else "gone", name))

    session.declare_subscriber(f"treadmill/{run}/metrics/**", receive_metric)
    session.liveliness().declare_subscriber(f"treadmill/{run}/learner", receive_token, history=True)
    return session


def fetch_pieces(ask, key, request):
    """Returns the policy bundle that a server sends in pieces, or None if it does not answer.

    If the known version is the newest, the bundle has only run, version and configuration hash.
    """
    data, first = b"", None
    deadline = time.monotonic() + FETCH_TIMEOUT_S
    while time.monotonic() < deadline:
        request.offset = len(data)
        timeout_s = FIRST_PIECE_TIMEOUT_S if first is None else PIECE_TIMEOUT_S
        piece = decoded(schema.PolicyPiece, ask(key, request.SerializeToString(), timeout_s, zenoh.Priority.DATA_HIGH))
        if piece is None:
            if first is None:
                return None
            time.sleep(PIECE_RETRY_S)
            continue
        if piece.total_bytes == 0:
            return schema.PolicyBundle(run=piece.run, version=piece.version, config_hash=request.config_hash)
        if first is not None and piece.version != first.version:
            # The server has a newer version by now.
            data, first = b"", None
        if piece.offset != len(data) or not piece.data or piece.total_bytes > MESSAGE_BYTES_MAX:
            time.sleep(PIECE_RETRY_S)
            continue
        first = first or piece
        data += piece.data
        if len(data) >= first.total_bytes:
            return decoded(schema.PolicyBundle, data)
    return None


class Bus:
    """Zenoh session with the queries and publications of an actor."""

    def __init__(self, connect, tls=None):
        zenoh.init_log_from_env_or("error")
        self.session = zenoh.open(configuration(connect, tls))

    def close(self):
        """Closes the session."""
        # Zenoh gives up if the other end stands still.
        with contextlib.suppress(zenoh.ZError):
            self.session.close()

    def ask(self, key, payload=None, timeout_s=FETCH_TIMEOUT_S, priority=None):
        """Returns the first answer to a query as bytes, or None after the timeout."""
        return next(self.answers(key, payload, timeout_s, priority), None)

    def answers(self, key, payload=None, timeout_s=FETCH_TIMEOUT_S, priority=None):
        """Yields the answers to a query as bytes. A learner that was overtaken may answer beside its successor, or stay silent."""
        try:
            replies = self.session.get(
                key,
                payload=payload,
                timeout=timeout_s,
                # By default, Zenoh holds answers until all have come.
                consolidation=zenoh.ConsolidationMode.NONE,
                priority=priority or zenoh.Priority.DATA,
                congestion_control=zenoh.CongestionControl.BLOCK,
            )
        except zenoh.ZError:
            # At the end, a thread may still ask.
            if self.session.is_closed():
                return
            raise
        for reply in replies:
            if reply.ok is not None:
                yield reply.ok.payload.to_bytes()

    def register(self, run, actor, task):
        """Registers a task. Returns the receipt, or None if no learner answered."""
        registration = schema.TaskRegistration(run=run, actor=actor)
        task.fill(registration.task)
        return decoded(schema.TaskReceipt, self.ask(f"treadmill/{run}/tasks/{actor}", registration.SerializeToString()))

    def fetch_policy(self, run, known=None, announced=None, config_hash=0):
        """Returns the newest policy bundle, or None if no learner answered.

        With `known` and `config_hash`, the version and configuration in use, the bundle lacks what this actor has.
        """
        request = schema.PolicyRequest(known=known, announced=announced, config_hash=config_hash)
        # The router that this session dialled may have the policy.
        nodes = [f"/{node}" for node in self.session.info.routers_zid()]
        for node in [*nodes, ""]:
            bundle = fetch_pieces(self.ask, f"treadmill/{run}/policy/pieces{node}", request)
            if bundle is not None:
                return bundle
        return None

    def is_behind_standby(self, run):
        """Returns whether what this session dialled is a learner that only follows; over TLS it may not pass fragments on."""
        request = schema.PolicyRequest().SerializeToString()
        for node in self.session.info.routers_zid():
            replies = self.session.get(f"treadmill/{run}/policy/pieces/{node}", payload=request, timeout=STANDBY_TIMEOUT_S)
            if any(reply.err is not None and reply.err.payload.to_bytes() == FOLLOWS for reply in replies):
                return True
        return False

    def submit(self, run, actor, fragment, timeout_s, settles=lambda receipt: True):
        """Sends a fragment. Returns the first receipt that `settles` accepts, or else the last one. None without any: the fragment
        may or may not have arrived."""
        last = None
        for answer in self.answers(f"treadmill/{run}/rollouts/{actor}", fragment, timeout_s):
            receipt = decoded(schema.Receipt, answer)
            if receipt is not None:
                last = receipt
                if settles(receipt):
                    break
        return last

    def announcements(self, run, apply):
        """Calls `apply` with each announced version, on a Zenoh thread: `apply` must not block."""

        def receive(sample):
            announcement = decoded(schema.PolicyAnnouncement, sample.payload.to_bytes())
            if announcement is not None:
                apply(announcement.version)

        return self.session.declare_subscriber(f"treadmill/{run}/policy/version", receive)

    def wait_for_name(self, run, actor, stopping):
        """Waits until no other actor of this name is in the run; a predecessor may have ended without notice.

        Raises BusError if another one stays.
        """
        deadline = time.monotonic() + NAME_TIMEOUT_S
        token = f"treadmill/{run}/actors/{actor}"
        while any(reply.ok is not None for reply in self.session.liveliness().get(token, timeout=2.0)):
            if time.monotonic() > deadline:
                raise BusError(f"an actor named `{actor}` is in the run `{run}` already; choose another --name")
            if stopping.wait(NAME_RETRY_S):
                return

    def token(self, run, actor):
        """Declares the liveliness token of the actor."""
        return self.session.liveliness().declare_token(f"treadmill/{run}/actors/{actor}")

    def publisher(self, key):
        """Returns a publisher for small messages that Zenoh may drop on a busy link."""
        return self.session.declare_publisher(
            key, congestion_control=zenoh.CongestionControl.DROP, priority=zenoh.Priority.DATA_LOW
        )
