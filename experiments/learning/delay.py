#!/usr/bin/env python3
"""Trains in both modes of the learner with actors behind links that are as slow as those between continents.

Usage: delay.py target/release/treadmill FOLDER [--modes sync async] [--seeds 1 2 3] [--steps 4000000] [--delay-ms 150]

Between the learner and its two actors stands a relay that keeps everything back for --delay-ms, in either direction. The
evaluator is not delayed. Prints a line for each run: how fast it was, how old experience was when it was learnt from, and what
was learnt. Needs Python alone.
"""

import argparse
import asyncio
import contextlib
import json
import pathlib
import signal
import statistics

PIECE_BYTES = 1 << 16
# Long links hold much; what is under way is bounded by the fragments that actors may have in flight.
PIECES_UNDER_WAY = 4096


async def relay(reader, writer, delay_s):
    """Passes on what arrives, each piece so much later, and the end of it too."""
    loop, pieces = asyncio.get_running_loop(), asyncio.Queue(PIECES_UNDER_WAY)

    async def take():
        piece = True
        while piece:
            with contextlib.suppress(ConnectionError):
                piece = await reader.read(PIECE_BYTES)
            await pieces.put((loop.time() + delay_s, piece))

    taking = asyncio.create_task(take())
    with contextlib.suppress(ConnectionError):
        while True:
            due, piece = await pieces.get()
            await asyncio.sleep(due - loop.time())
            if not piece:
                break
            writer.write(piece)
            await writer.drain()
    taking.cancel()
    writer.close()


async def listen(port, delay_s):
    """A port of its own from which everything goes to `port`, and back, late; and what is to be awaited at the end."""
    links = []

    async def accept(reader, writer):
        links.append(asyncio.current_task())
        try:
            there, back = await asyncio.open_connection("127.0.0.1", port)
        except ConnectionError:
            # The learner is gone already; actors find that out a little later.
            writer.close()
            return
        await asyncio.gather(relay(reader, back, delay_s), relay(there, writer, delay_s))

    server = await asyncio.start_server(accept, "127.0.0.1", 0)
    return server, server.sockets[0].getsockname()[1], links


async def start(binary, *arguments):
    command = [str(binary), *map(str, arguments)]
    return await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE)


async def train(arguments, mode, seed):
    """One run from its first step to its last."""
    folder = arguments.folder / f"{mode}-{seed}"
    # A thread for each core while actors wait, one while they do not.
    changes = {"learner.mode": mode, "learner.threads": 0 if mode == "sync" else 1}
    changes["learner.max_policy_lag"] = arguments.max_policy_lag
    settings = [part for key, value in changes.items() for part in ("--set", f"{key}={value}")]
    options = ["--seed", seed, "--steps", arguments.steps, "--run-dir", folder, "--json", "--no-progress"]
    learner = await start(arguments.treadmill, "learner", "--listen", "tcp/127.0.0.1:0", *options, *settings)
    while not (folder / "endpoint.txt").exists():
        await asyncio.sleep(0.1)
    endpoint = (folder / "endpoint.txt").read_text(encoding="utf-8").split()[0]
    server, port, links = await listen(int(endpoint.rsplit(":", 1)[1]), arguments.delay_ms / 1000)
    names = [("--connect", f"tcp/127.0.0.1:{port}", "--name", f"far-{number}", "--envs", 32) for number in (1, 2)]
    others = [await start(arguments.treadmill, "actor", *name) for name in names]
    others.append(await start(arguments.treadmill, "evaluator", "--connect", endpoint))
    out, _ = await learner.communicate()
    for other in others:
        other.send_signal(signal.SIGTERM)
        await other.communicate()
    server.close()
    await asyncio.gather(*links)
    tell(mode, seed, folder, json.loads(out.decode().strip().splitlines()[-1]))


def tell(mode, seed, folder, summary):
    lags, trials, last = [], [], {}
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            last[metric["tag"]] = metric["value"]
            if metric["tag"] == "bus/policy_lag_mean":
                lags.append(metric["value"])
            if metric["tag"] == "eval/distance_mean_m":
                trials.append(metric["value"])
    lag = f"lag {statistics.mean(lags):.1f} (median {statistics.median(lags):.1f}, at most {max(lags):.1f})"
    speed = f"{summary['env_steps_per_s']:.0f} steps/s, {summary['wall_s']:.0f} s"
    learnt = f"return {last.get('rollout/ep_rew_mean', 0):.0f}, distance {last.get('rollout/distance_mean_m', 0):.1f} m"
    trial = f"evaluated {statistics.mean(trials[-3:]):.1f} m" if trials else "not evaluated"
    dropped = f"{last['bus/fragments_too_old']:.0f} fragments too old of {last['bus/fragments_accepted']:.0f}"
    print(f"{mode}, seed {seed}: {speed}; {lag}; {learnt}; {trial}; {dropped}", flush=True)


async def all_of_them(arguments):
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for seed in arguments.seeds:
        for mode in arguments.modes:
            await train(arguments, mode, seed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("folder", type=pathlib.Path, help="where the runs go")
    parser.add_argument("--modes", nargs="+", choices=("sync", "async"), default=["sync", "async"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=4_000_000)
    parser.add_argument("--delay-ms", type=float, default=150)
    parser.add_argument("--max-policy-lag", type=int, default=4)
    asyncio.run(all_of_them(parser.parse_args()))


if __name__ == "__main__":
    main()
