#!/usr/bin/env python3
"""Trains in both modes of the learner with intercontinental delays between learner and actors.

Usage: delay.py target/release/treadmill FOLDER [--modes sync async] [--seeds 1 2 3] [--steps 4000000] [--delay-ms 150]

A relay between the learner and its two actors delays data by --delay-ms in each direction. The evaluator is not delayed. Prints
speed, policy lag, return and distance of each run. Needs no Python packages.
"""

import argparse
import asyncio
import json
import pathlib
import signal
import statistics

from experiments.faults.links import forward


async def listen(port, delay_s):
    """Starts a delaying relay to `port`. Returns its server, its port, and the tasks to await at the end."""
    links = []

    async def accept(reader, writer):
        links.append(asyncio.current_task())
        try:
            replies, upstream = await asyncio.open_connection("127.0.0.1", port)
        except ConnectionError:
            # The learner has ended before the actors.
            writer.close()
            return
        await asyncio.gather(forward(reader, upstream, lambda: delay_s), forward(replies, writer, lambda: delay_s))

    server = await asyncio.start_server(accept, "127.0.0.1", 0)
    return server, server.sockets[0].getsockname()[1], links


async def start(binary, *arguments):
    command = [str(binary), *map(str, arguments)]
    return await asyncio.create_subprocess_exec(*command, stdout=asyncio.subprocess.PIPE)


async def train(arguments, mode, seed):
    """Trains one run and prints its line."""
    folder = arguments.folder / f"{mode}-{seed}"
    # In mode `sync`, actors wait during the update, so it may use all cores.
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
    report(mode, seed, folder, json.loads(out.decode().strip().splitlines()[-1]))


def report(mode, seed, folder, summary):
    lags, evaluations, last = [], [], {}
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            last[metric["tag"]] = metric["value"]
            if metric["tag"] == "bus/policy_lag_mean":
                lags.append(metric["value"])
            if metric["tag"] == "eval/distance_mean_m":
                evaluations.append(metric["value"])
    lag = f"lag {statistics.mean(lags):.1f} (median {statistics.median(lags):.1f}, maximum {max(lags):.1f})"
    speed = f"{summary['env_steps_per_s']:.0f} steps/s, {summary['wall_s']:.0f} s"
    result = f"return {last.get('rollout/ep_rew_mean', 0):.0f}, distance {last.get('rollout/distance_mean_m', 0):.1f} m"
    evaluated = f"evaluated {statistics.mean(evaluations[-3:]):.1f} m" if evaluations else "not evaluated"
    dropped = f"{last['bus/fragments_too_old']:.0f} fragments too old, {last['bus/fragments_accepted']:.0f} accepted"
    print(f"{mode}, seed {seed}: {speed}; {lag}; {result}; {evaluated}; {dropped}", flush=True)


async def train_all(arguments):
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for seed in arguments.seeds:
        for mode in arguments.modes:
            await train(arguments, mode, seed)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("folder", type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--modes", nargs="+", choices=("sync", "async"), default=["sync", "async"])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2, 3])
    parser.add_argument("--steps", type=int, default=4_000_000)
    parser.add_argument("--delay-ms", type=float, default=150)
    parser.add_argument("--max-policy-lag", type=int, default=4)
    asyncio.run(train_all(parser.parse_args()))


if __name__ == "__main__":
    main()
