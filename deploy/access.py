#!/usr/bin/env python3
"""Checks the access rules of a running stack with an independent client.

Usage: access.py tls/127.0.0.1:7447 CERTS RUN

CERTS is the folder of `treadmill certs --bundles`, RUN the run's name. Needs the PyPI package eclipse-zenoh. For each denied
request, a role with permission sends the same request, so that silence proves the denial.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import traceback

import zenoh

if len(sys.argv) != 4:
    print(__doc__)
    sys.exit(0 if sys.argv[1:] == ["--help"] else 2)


def exit_now(kind, why, where):
    """Ends the process despite open sessions."""
    traceback.print_exception(kind, why, where)
    sys.stderr.flush()
    os._exit(1)


sys.excepthook = exit_now
endpoint, certs, run = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
port = endpoint.rsplit(":", 1)[1]
WAIT_S = 40
# A denied query gets no answer, so each query waits this long.
QUERY_TIMEOUT_S = 3
ATTEMPTS = 5


def config(where, authority=None, own=None):
    settings = zenoh.Config()
    settings.insert_json5("mode", '"client"')
    settings.insert_json5("connect/endpoints", json.dumps([where]))
    settings.insert_json5("connect/timeout_ms", "3000")
    settings.insert_json5("connect/exit_on_failure", "true")
    settings.insert_json5("scouting/multicast/enabled", "false")
    tls = {"verify_name_on_connect": True}
    if authority:
        tls["root_ca_certificate"] = str(authority)
    if own:
        certificate, key = own
        tls |= {"enable_mtls": True, "connect_certificate": str(certificate), "connect_private_key": str(key)}
    settings.insert_json5("transport/link/tls", json.dumps(tls))
    return settings


def session(role):
    folder = certs / role
    return zenoh.open(config(endpoint, folder / "ca.crt", (folder / f"{role}.crt", folder / f"{role}.key")))


class Listener:
    """Records the keys of received samples."""

    def __init__(self, opened, key):
        self.keys = []
        self.received = threading.Event()
        self.subscriber = opened.declare_subscriber(key, self.receive)

    def receive(self, sample):
        self.keys.append(str(sample.key_expr))
        self.received.set()

    def wait_until(self, what, found):
        until = time.monotonic() + WAIT_S
        while not found(self.keys):
            self.received.clear()
            assert self.received.wait(max(0, until - time.monotonic())), f"not within {WAIT_S} s: {what}"


def answers(opened, key, payload=None):
    return [reply for reply in opened.get(key, payload=payload, timeout=QUERY_TIMEOUT_S) if reply.ok is not None]


def expect_rejected(what, settings):
    try:
        zenoh.open(settings).close()
    except zenoh.ZError:
        print(f"rejected: {what}")
    else:
        raise SystemError(f"accepted: {what}")


# Connections need a certificate of this authority.
authority = certs / "observer" / "ca.crt"
expect_rejected("plain text", config(f"tcp/127.0.0.1:{port}"))
expect_rejected("no certificate", config(endpoint, authority))
with tempfile.TemporaryDirectory() as folder:
    key, certificate = f"{folder}/k.pem", f"{folder}/c.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "1",
         "-subj", "/CN=treadmill-operator", "-keyout", key, "-out", certificate],
        check=True, capture_output=True,
    )  # fmt: skip
    expect_rejected("operator certificate of another authority", config(endpoint, authority, (certificate, key)))

observer, actor, evaluator = session("observer"), session("actor"), session("evaluator")

# All roles subscribe to metrics; only the observer receives them.
metrics = {name: Listener(opened, f"treadmill/{run}/metrics/**")
           for name, opened in [("observer", observer), ("actor", actor), ("evaluator", evaluator)]}  # fmt: skip
episodes = Listener(observer, f"treadmill/{run}/episodes/*")
# Another session, because a session delivers each sample to all of its own matching subscribers.
second = session("observer")
wide = Listener(second, "treadmill/**")
metrics["observer"].wait_until("metrics", lambda keys: len(keys) > 50)
for name in ["actor", "evaluator"]:
    assert not metrics[name].keys, f"an {name} reads metrics: {metrics[name].keys[:3]}"
print("reads metrics: observer; not: actor, evaluator")
# A wildcard beyond the permitted keys receives nothing.
assert not wide.keys, wide.keys[:3]

# Actors may publish episodes, but not the learner's keys. Observers may publish nothing.
actor.put(f"treadmill/{run}/metrics/forged/number", b"{}")
actor.put(f"treadmill/{run}/policy/version", b"forged")
second.put(f"treadmill/{run}/episodes/forged-observer", b"{}")
actor.put(f"treadmill/{run}/episodes/forged-actor", b"{}")
episodes.wait_until("the actor's episode", lambda keys: any("forged-actor" in key for key in keys))
seen = len(metrics["observer"].keys)
metrics["observer"].wait_until("metrics of another update", lambda keys: len(keys) > seen + 50)
heard = metrics["observer"].keys + episodes.keys
assert not any("forged/number" in key or "forged-observer" in key for key in heard), "a forged sample was delivered"
print("publishes episodes: actor; not: observer. Publishes metrics: not: actor")

# Only actors may send rollouts. Actors, observers and evaluators may fetch the policy.
rollouts = f"treadmill/{run}/rollouts/stranger"
# The router's link to the learner may break (zenoh#2557); like every actor, ask again then.
receipts = any(answers(actor, rollouts, b"malformed") for _ in range(ATTEMPTS))
assert receipts, "an actor gets a receipt even for a malformed fragment"
for opened in [observer, evaluator]:
    assert not answers(opened, rollouts, b"malformed")
print("sends rollouts: actor; not: observer, evaluator")
for opened in [actor, observer, evaluator]:
    assert answers(opened, f"treadmill/{run}/policy/latest"), "no policy"
print("reads the policy: actor, observer, evaluator")

# Only operators may send commands; observers and actors may read the status. In proto/schema/control.proto, field 1 is the command.
STATUS, CHECKPOINT = b"\x08\x01", b"\x08\x04"
assert answers(session("operator"), f"treadmill/{run}/control", CHECKPOINT), "an operator gets a receipt"
for opened in [actor, observer, evaluator]:
    assert not answers(opened, f"treadmill/{run}/control", CHECKPOINT)
print("sends commands: operator; not: actor, observer, evaluator")
for opened in [observer, actor]:
    assert answers(opened, f"treadmill/{run}/status", STATUS), "no status"
assert not answers(evaluator, f"treadmill/{run}/status", STATUS)
print("reads the status: observer, actor; not: evaluator")
sys.stdout.flush()
os._exit(0)
