"""The flows of an actor over Zenoh: the only module that names it. See docs/guide/external-tasks.md for each of them."""

import ipaddress
import json
from pathlib import Path

import zenoh

from . import schema

FETCH_TIMEOUT_S = 10.0
MESSAGE_BYTES_MAX = 32 << 20


class BusError(Exception):
    """The bus cannot be used."""


def check_endpoint(endpoint, insecure):
    """Refuses plain text beyond this machine unless that is asked for, as the Rust side does."""
    protocol, _, address = endpoint.partition("/")
    host = address.rpartition(":")[0].strip("[]")
    if protocol not in ("tcp", "tls") or not host:
        raise BusError(f"endpoint `{endpoint}` is none; write tcp/HOST:PORT or tls/HOST:PORT")
    try:
        is_loopback = host == "localhost" or ipaddress.ip_address(host).is_loopback
    except ValueError:
        is_loopback = False
    if protocol == "tcp" and not (is_loopback or insecure):
        raise BusError(
            f"endpoint `{endpoint}`: plain tcp beyond loopback can be read and forged by anybody on the network; use "
            "tls/HOST:PORT with --tls DIR, or say --insecure where the network itself is trusted"
        )


def configuration(connect, tls=None, role="actor"):
    """Zenoh's configuration of a client; with `tls`, the folder that `treadmill certs` made."""
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
    if tls is not None:
        folder = Path(tls).resolve()
        certificate, key, authority = folder / f"{role}.crt", folder / f"{role}.key", folder / "ca.crt"
        for file in (certificate, key, authority):
            if not file.is_file():
                raise BusError(f"--tls {folder}: `{file}` is not there; make it with `treadmill certs`")
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


class Bus:
    """A session, and what an actor does with it."""

    def __init__(self, connect, tls=None):
        zenoh.init_log_from_env_or("error")
        self.session = zenoh.open(configuration(connect, tls))

    def close(self):
        """Ends the session."""
        self.session.close()

    def ask(self, key, payload=None, timeout_s=FETCH_TIMEOUT_S, priority=None):
        """The first answer to a query, as bytes; None if none came in time."""
        replies = self.session.get(
            key,
            payload=payload,
            timeout=timeout_s,
            priority=priority or zenoh.Priority.DATA,
            congestion_control=zenoh.CongestionControl.BLOCK,
        )
        for reply in replies:
            if reply.ok is not None:
                return reply.ok.payload.to_bytes()
        return None

    def register(self, run, actor, task):
        """Registers a task. The receipt, or None if no learner answered."""
        registration = schema.TaskRegistration(run=run, actor=actor)
        task.fill(registration.task)
        answer = self.ask(f"treadmill/{run}/tasks/{actor}", registration.SerializeToString())
        return None if answer is None else schema.TaskReceipt.FromString(answer)

    def fetch_policy(self, run):
        """The newest policy bundle, or None if no learner answered."""
        answer = self.ask(f"treadmill/{run}/policy/latest", priority=zenoh.Priority.DATA_HIGH)
        return None if answer is None else schema.PolicyBundle.FromString(answer)

    def submit(self, run, actor, fragment, timeout_s):
        """Sends a fragment. The receipt, or None where none came: it may or may not have arrived."""
        answer = self.ask(f"treadmill/{run}/rollouts/{actor}", fragment, timeout_s)
        return None if answer is None else schema.Receipt.FromString(answer)

    def announcements(self, run, apply):
        """Calls `apply` with each announced version, in a thread of Zenoh's: it must not wait."""

        def take(sample):
            apply(schema.PolicyAnnouncement.FromString(sample.payload.to_bytes()).version)

        return self.session.declare_subscriber(f"treadmill/{run}/policy/version", take)

    def token(self, run, actor):
        """Shows that the actor is there, until it is undeclared."""
        return self.session.liveliness().declare_token(f"treadmill/{run}/actors/{actor}")

    def publisher(self, key):
        """For small messages that may be lost when the link is busy."""
        return self.session.declare_publisher(
            key, congestion_control=zenoh.CongestionControl.DROP, priority=zenoh.Priority.DATA_LOW
        )
