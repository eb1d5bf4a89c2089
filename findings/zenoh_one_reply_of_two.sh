#!/usr/bin/env bash
# A query to all queryables of a key returns the answer of one.
#
# One would guess: with the target ALL, a query that two programs answer returns both answers, each as it comes.
# Seen: by default one answer comes back, after the slower program has answered; here the fast answer is lost. With
# ConsolidationMode.NONE both come, each at its time.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet eclipse-zenoh==1.10.2
"$folder/python/bin/python" - <<'PYTHON'
import importlib.metadata
import json
import socket
import threading
import time

import zenoh

SLOW_S = 2.0


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


ENDPOINT = f"tcp/127.0.0.1:{free_port()}"


def session(mode):
    config = zenoh.Config()
    config.insert_json5("mode", json.dumps(mode))
    config.insert_json5("listen/endpoints" if mode == "router" else "connect/endpoints", json.dumps([ENDPOINT]))
    config.insert_json5("scouting/multicast/enabled", "false")
    return zenoh.open(config)


def serve(of, text, delay_s):
    def answer(query):
        def later():
            time.sleep(delay_s)
            query.reply("run/status", text)
            query.drop()

        threading.Thread(target=later).start()

    return of.declare_queryable("run/status", answer)


router, fast, slow, asker = session("router"), session("client"), session("client"), session("client")
queryables = serve(fast, "fast", 0.0), serve(slow, "slow", SLOW_S)
time.sleep(1)
print("eclipse-zenoh", importlib.metadata.version("eclipse-zenoh"))
seen = {}
for mode in ("default", "none"):
    options = {} if mode == "default" else {"consolidation": zenoh.ConsolidationMode.NONE}
    begun, seen[mode] = time.monotonic(), []
    for reply in asker.get("run/status", target=zenoh.QueryTarget.ALL, timeout=10, **options):
        seen[mode].append((reply.ok.payload.to_string(), time.monotonic() - begun))
    print(f"{mode}:", ", ".join(f"`{text}` after {after_s:.1f} s" for text, after_s in seen[mode]))
for one in (asker, slow, fast, router):
    one.close()
((_, after_s),) = seen["default"]
assert after_s >= SLOW_S, seen
assert sorted(text for text, _ in seen["none"]) == ["fast", "slow"], seen
PYTHON
