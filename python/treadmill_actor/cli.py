"""Command line of `python -m treadmill_actor`."""

import argparse
import importlib
import json
import logging
import re
import signal
import socket
import sys
import threading

import gymnasium

from .bus import Bus, BusError, check_endpoint, dialled
from .policies import JoinRefused
from .rollout import Environments
from .task import TaskError
from .worker import Worker, unique

_IDENT = re.compile(r"[a-z0-9_-]{1,64}\Z")


def ident(text):
    """Returns `text` if it is valid as one part of a bus key."""
    if not _IDENT.match(text):
        raise argparse.ArgumentTypeError(f"`{text}` is not 1 to 64 of the characters a-z, 0-9, _ and -")
    return text


def parser():
    """Returns the argument parser."""
    flags = argparse.ArgumentParser(prog="treadmill_actor", description="Runs a Gymnasium environment for a Treadmill run.")
    flags.add_argument("--env", required=True, metavar="ID", help="Gymnasium ID, for example Humanoid-v5")
    flags.add_argument("--run", required=True, type=ident, metavar="NAME", help="run to join")
    flags.add_argument(
        "--connect", action="append", metavar="ENDPOINT", help="learner or router; default tcp/127.0.0.1:7447; repeatable"
    )
    flags.add_argument("--envs", type=int, default=8, metavar="N", help="environments of this actor; default 8")
    flags.add_argument("--name", type=ident, help="unique actor name; default: host name and a random number")
    flags.add_argument(
        "--import", dest="modules", action="append", default=[], metavar="MODULE", help="imported first; registers the environment"
    )
    flags.add_argument("--kwargs", type=json.loads, default={}, metavar="JSON", help="arguments for gymnasium.make")
    flags.add_argument("--task", metavar="NAME", help="task name; default gymnasium/ID")
    flags.add_argument("--tls", metavar="DIR", help="certificate folder made by `treadmill certs`")
    flags.add_argument("--insecure", action="store_true", help="allow plain tcp beyond loopback; any host can forge it")
    flags.add_argument("--seed", type=int, help="seed of resets and exploration; default: random")
    flags.add_argument("--steps", type=int, help="end after this many environment steps")
    return flags


def main(arguments=None):
    """Runs the actor until a signal or --steps ends it. Returns the exit code."""
    args = parser().parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(message)s", stream=sys.stderr)
    log = logging.getLogger("treadmill_actor")
    if not 1 <= args.envs <= 65_536:
        parser().error(f"argument --envs: {args.envs} is not 1 to 65536")
    name = args.name or re.sub(r"[^a-z0-9]", "-", socket.gethostname().lower())[:40] + f"-py-{unique() & 0xFFFFFFFF:08x}"
    seed = args.seed if args.seed is not None else unique()
    stopping = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stopping.set())
    environments = bus = None
    connect = args.connect or ["tcp/127.0.0.1:7447"]
    try:
        for endpoint in connect:
            check_endpoint(endpoint, args.insecure)
    except BusError as why:
        parser().error(str(why))
    try:
        for module in args.modules:
            importlib.import_module(module)
        label = args.task or f"gymnasium/{args.env.rsplit(':', 1)[-1]}"
        environments = Environments(lambda: gymnasium.make(args.env, **args.kwargs), label, args.envs, seed)
        task = environments.task
        log.info(
            "%s runs `%s`: %d observations, %d actions; %s",
            name,
            task.name,
            task.observation_size,
            task.action_size,
            "distance from x_position" if task.has_position else "no x_position in info, so distance is 0",
        )
        bus = dialled(lambda: Bus(connect, args.tls), stopping)
        if bus is None:
            return 0
        worker = Worker(bus, args.run, name, environments, seed, stopping)
        worker.work(args.steps)
        counts = worker.uploader.ledger.outcomes if worker.uploader else {}
        log.info("%s ended after %d env steps; receipts: %s", name, worker.env_steps, counts)
        return 0
    except (JoinRefused, TaskError, BusError, ImportError, gymnasium.error.Error) as why:
        print(f"error: {why}", file=sys.stderr)
        return 1
    finally:
        if environments is not None:
            environments.close()
        if bus is not None:
            bus.close()
