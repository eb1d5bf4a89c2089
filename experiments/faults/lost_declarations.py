#!/usr/bin/env python3
"""Shows a fault of Zenoh 1.10: routers that lose their links at once, and redial at once, mostly lose what they knew.

Usage: lost_declarations.py [--routers 5] [--rounds 5]

One router serves a queryable. Others dial it by way of a relay, which breaks all links in each round; Zenoh redials them within
milliseconds. A round's line has a `.` for each router that then gets an answer, and an `X` for each that gets none.

`common/bus/src/workarounds/redial_pause.rs` says why, and how Treadmill avoids it. Needs the Python package eclipse-zenoh.
"""

import argparse
import asyncio
import contextlib
import json
import threading
import time

import zenoh

LEARNER, RELAY, ROUTERS = 17001, 17002, 17100
KEY, ANSWER_TIMEOUT_S, SETTLE_S = "lost/rollouts", 1.0, 3.0


class Relay:
    """Forwards connections, and breaks them all on request."""

    def __init__(self, port, to):
        self.open, self.loop = set(), asyncio.new_event_loop()
        started = threading.Event()
        threading.Thread(target=self._run, args=(port, to, started), daemon=True).start()
        started.wait()

    def _run(self, port, to, started):
        async def forward(reader, writer):
            with contextlib.suppress(OSError):
                while data := await reader.read(65536):
                    writer.write(data)
                    await writer.drain()
            writer.close()

        async def accept(reader, writer):
            far_reader, far_writer = await asyncio.open_connection("127.0.0.1", to)
            self.open |= {writer, far_writer}
            await asyncio.gather(forward(reader, far_writer), forward(far_reader, writer))

        async def serve():
            server = await asyncio.start_server(accept, "127.0.0.1", port)
            started.set()
            await server.serve_forever()

        self.loop.run_until_complete(serve())

    def break_all(self):
        broken, self.open = self.open, set()
        for writer in broken:
            self.loop.call_soon_threadsafe(writer.transport.abort)


def router(listen, connect):
    """Opens a session that other sessions can dial."""
    config = zenoh.Config()
    settings = {
        "mode": "router",
        "listen/endpoints": [f"tcp/127.0.0.1:{listen}"],
        "connect/endpoints": [f"tcp/127.0.0.1:{port}" for port in connect],
        "connect/timeout_ms": -1,
        "connect/exit_on_failure": False,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
    }
    for name, value in settings.items():
        config.insert_json5(name, json.dumps(value))
    return zenoh.open(config)


def answered(session, number):
    """Returns whether a question gets an answer."""
    replies = session.get(f"{KEY}/{number}", timeout=ANSWER_TIMEOUT_S)
    return any(reply.ok is not None for reply in replies)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--routers", type=int, default=5)
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    learner = router(LEARNER, [])
    queryable = learner.declare_queryable(f"{KEY}/*", lambda query: query.reply(query.key_expr, b""))
    relay = Relay(RELAY, LEARNER)
    routers = [router(ROUTERS + number, [RELAY]) for number in range(arguments.routers)]
    time.sleep(SETTLE_S)
    lost = 0
    for number in range(1 + arguments.rounds):
        if number:
            relay.break_all()
            time.sleep(SETTLE_S)
        answers = [answered(session, index) for index, session in enumerate(routers)]
        lost += answers.count(False)
        print(f"{'before' if number == 0 else f'break {number}'}: {''.join('.X'[not answer] for answer in answers)}", flush=True)
    print(f"{lost} of {arguments.rounds * arguments.routers} routers got no answer after a break")
    queryable.undeclare()
    for session in [*routers, learner]:
        session.close()


if __name__ == "__main__":
    main()
