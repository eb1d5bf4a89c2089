#!/usr/bin/env bash
# A router that redials at once no longer knows the queryables behind the broken link.
#
# One would guess: Zenoh repairs a broken link, and a query through it gets an answer again.
# Seen: when the links of five routers break together and Zenoh redials them within milliseconds, some routers stay linked and get no
# answer any more, for as long as the link lives.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet eclipse-zenoh==1.10.2
"$folder/python/bin/python" - <<'PYTHON'
import asyncio
import contextlib
import importlib.metadata
import json
import socket
import threading
import time

import zenoh

ROUTERS, ROUNDS, SETTLE_S = 5, 5, 3.0


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Relay:
    """Forwards connections, and breaks all of them on request."""

    def __init__(self, port, to):
        self.open, self.loop = set(), asyncio.new_event_loop()
        ready = threading.Event()
        threading.Thread(target=lambda: self.loop.run_until_complete(self.serve(port, to, ready)), daemon=True).start()
        ready.wait()

    async def serve(self, port, to, ready):
        async def forward(reader, writer):
            with contextlib.suppress(OSError):
                while data := await reader.read(1 << 16):
                    writer.write(data)
                    await writer.drain()
            writer.close()

        async def accept(reader, writer):
            far_reader, far_writer = await asyncio.open_connection("127.0.0.1", to)
            self.open |= {writer, far_writer}
            await asyncio.gather(forward(reader, far_writer), forward(far_reader, writer))

        server = await asyncio.start_server(accept, "127.0.0.1", port)
        ready.set()
        await server.serve_forever()

    def break_all(self):
        broken, self.open = self.open, set()
        for writer in broken:
            self.loop.call_soon_threadsafe(writer.transport.abort)


def router(listen, connect):
    config = zenoh.Config()
    for name, value in {
        "mode": "router",
        "listen/endpoints": [f"tcp/127.0.0.1:{listen}"],
        "connect/endpoints": [f"tcp/127.0.0.1:{port}" for port in connect],
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }.items():
        config.insert_json5(name, json.dumps(value))
    return zenoh.open(config)


print("eclipse-zenoh", importlib.metadata.version("eclipse-zenoh"))
port, relayed = free_port(), free_port()
server = router(port, [])
queryable = server.declare_queryable("answers/*", lambda query: query.reply(query.key_expr, b""))
relay = Relay(relayed, port)
routers = [router(free_port(), [relayed]) for _ in range(ROUTERS)]
lost = 0
for number in range(1 + ROUNDS):
    if number:
        relay.break_all()
    time.sleep(SETTLE_S)
    answers = [any(reply.ok for reply in one.get(f"answers/{index}", timeout=1.0)) for index, one in enumerate(routers)]
    print("before" if number == 0 else f"break {number}", "".join(".X"[not answered] for answered in answers), flush=True)
    assert number or all(answers), answers
    lost += answers.count(False)
print(f"{lost} of {ROUNDS * ROUTERS} queries after a break had no answer")
for one in (*routers, server):
    one.close()
assert lost, "every router recovered: this has changed"
PYTHON
