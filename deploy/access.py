#!/usr/bin/env python3
"""Asks a running stack, with an independent client, who may do what.

    python3 access.py tls/127.0.0.1:7447 CERTS RUN

CERTS is the folder of `treadmill certs --bundles`, RUN the run's name. Needs the PyPI package eclipse-zenoh. Every refusal
stands beside the same request by somebody who may, so that silence is known to be a refusal.
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



def give_up(kind, why, where):
    """Sessions that are still open would keep the process."""
    traceback.print_exception(kind, why, where)
    sys.stderr.flush()
    os._exit(1)


sys.excepthook = give_up
endpoint, certs, run = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
port = endpoint.rsplit(":", 1)[1]
PATIENCE_S = 40
# What is refused is never answered, so it can only be given a fair chance.
CHANCE_S = 3


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
    """What comes on a key."""

    def __init__(self, opened, key):
        self.keys = []
        self.bell = threading.Event()
        self.subscriber = opened.declare_subscriber(key, self.take)

    def take(self, sample):
        self.keys.append(str(sample.key_expr))
        self.bell.set()

    def await_that(self, what, found):
        until = time.monotonic() + PATIENCE_S
        while not found(self.keys):
            self.bell.clear()
            assert self.bell.wait(max(0, until - time.monotonic())), f"waited in vain: {what}"


def answers(opened, key, payload=None):
    return [reply for reply in opened.get(key, payload=payload, timeout=CHANCE_S) if reply.ok is not None]


def refused_at_the_door(what, settings):
    try:
        zenoh.open(settings).close()
    except zenoh.ZError:
        print(f"refused: {what}")
    else:
        raise SystemError(f"let in: {what}")


# Without a certificate of this authority nobody gets in.
authority = certs / "observer" / "ca.crt"
refused_at_the_door("plain text", config(f"tcp/127.0.0.1:{port}"))
refused_at_the_door("no certificate", config(endpoint, authority))
with tempfile.TemporaryDirectory() as stranger:
    key, certificate = f"{stranger}/k.pem", f"{stranger}/c.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "1",
         "-subj", "/CN=treadmill-operator", "-keyout", key, "-out", certificate],
        check=True, capture_output=True,
    )  # fmt: skip
    refused_at_the_door("an operator of another authority", config(endpoint, authority, (certificate, key)))

observer, actor, evaluator = session("observer"), session("actor"), session("evaluator")

# Everybody listens to the same keys; only the observer hears.
metrics = {name: Listener(opened, f"treadmill/{run}/metrics/**")
           for name, opened in [("observer", observer), ("actor", actor), ("evaluator", evaluator)]}  # fmt: skip
episodes = Listener(observer, f"treadmill/{run}/episodes/*")
# In a session of its own: what a session sends or gets for one of its keys, it hands to all of its own that match.
second = session("observer")
wide = Listener(second, "treadmill/**")
metrics["observer"].await_that("metrics", lambda keys: len(keys) > 50)
for name in ["actor", "evaluator"]:
    assert not metrics[name].keys, f"an {name} reads metrics: {metrics[name].keys[:3]}"
print("reads metrics: observer; not: actor, evaluator")
# One key wider than what may be read is nothing.
assert not wide.keys, wide.keys[:3]

# An actor may tell of episodes and may not speak for the learner, nor an observer for anybody.
actor.put(f"treadmill/{run}/metrics/forged/number", b"{}")
actor.put(f"treadmill/{run}/policy/version", b"forged")
second.put(f"treadmill/{run}/episodes/forged-observer", b"{}")
actor.put(f"treadmill/{run}/episodes/forged-actor", b"{}")
episodes.await_that("the actor's episode", lambda keys: any("forged-actor" in key for key in keys))
seen = len(metrics["observer"].keys)
metrics["observer"].await_that("metrics of another update", lambda keys: len(keys) > seen + 50)
heard = metrics["observer"].keys + episodes.keys
assert not any("forged/number" in key or "forged-observer" in key for key in heard), "somebody speaks for others"
print("tells of episodes: actor; not: observer. Metrics: not: actor")

# Rollouts are taken from actors alone, policies are given to all who act or watch, trials to evaluators.
asked = f"treadmill/{run}/rollouts/stranger"
assert answers(actor, asked, b"nonsense"), "an actor's rollout, nonsense as it is, gets a receipt"
for opened in [observer, evaluator]:
    assert not answers(opened, asked, b"nonsense")
print("answered about rollouts: actor; not: observer, evaluator")
for opened in [actor, observer, evaluator]:
    assert answers(opened, f"treadmill/{run}/policy/latest"), "the policy"
print("reads the policy: actor, observer, evaluator")

# The learner is commanded by operators alone, and tells how it goes to whoever watches. The messages are those of
# proto/schema/control.proto: field 1 is the command.
TELL, CHECKPOINT = b"\x08\x01", b"\x08\x04"
assert answers(session("operator"), f"treadmill/{run}/control", CHECKPOINT), "an operator gets a receipt"
for opened in [actor, observer, evaluator]:
    assert not answers(opened, f"treadmill/{run}/control", CHECKPOINT)
print("commands: operator; not: actor, observer, evaluator")
assert answers(observer, f"treadmill/{run}/status", TELL), "an observer is told how it goes"
for opened in [actor, evaluator]:
    assert not answers(opened, f"treadmill/{run}/status", TELL)
print("asks how it goes: observer; not: actor, evaluator")
sys.stdout.flush()
os._exit(0)
