"""Command line of `python -m treadmill_actor`."""

import argparse
import importlib
import json
import logging
import re
import socket
import sys
import threading

import gymnasium

from .bus import Bus, BusError, check_endpoint, default_endpoint, dialled
from .policies import JoinRefused
from .rollout import Environments
from .signals import request_stop
from .task import TaskError
from .worker import Worker, unique

NUMBER_MAX = 2**63 - 1
#: Exit code after Ctrl-C while environments are built: 128 + SIGINT, the convention of shells.
EXIT_AT_ONCE = 130
_IDENT = re.compile(r"[a-z0-9_-]{1,64}\Z")


def ident(text):
    """Returns `text` if it is valid as one part of a bus key."""
    if not _IDENT.match(text):
        raise argparse.ArgumentTypeError(f"`{text}` is not 1 to 64 of the characters a-z, 0-9, _ and -")
    return text


def whole(low, high):
    """Returns a function that reads a whole number from `low` to `high`."""

    def read(text):
        if not re.fullmatch("[0-9]{1,20}", text) or not low <= int(text) <= high:
            raise argparse.ArgumentTypeError(f"`{text}` is not a whole number from {low} to {high}")
        return int(text)

    return read


def keywords(text):
    """Returns a JSON object as a dictionary."""
    try:
        read = json.loads(text)
    except ValueError:
        read = None
    if not isinstance(read, dict):
        raise argparse.ArgumentTypeError(f"`{text}` is not a JSON object; write it as '{{\"NAME\": VALUE}}'")
    return read


def parser():
    """Returns the argument parser."""
    what = "Runs a Gymnasium environment for a Treadmill run. Ctrl-C ends it, a second one at once."
    flags = argparse.ArgumentParser(prog="treadmill_actor", description=what)
    flags.add_argument("--env", required=True, metavar="ID", help="Gymnasium ID, for example Humanoid-v5")
    flags.add_argument("--run", required=True, type=ident, metavar="NAME", help="run to join")
    flags.add_argument(
        "--connect", action="append", metavar="ENDPOINT", help="learner or router; default port 7447 on loopback; repeatable"
    )
    flags.add_argument("--envs", type=whole(1, 65_536), default=8, metavar="N", help="environments of this actor; default 8")
    flags.add_argument("--name", type=ident, help="unique actor name; default: host name and a random number")
    flags.add_argument(
        "--import", dest="modules", action="append", default=[], metavar="MODULE", help="imported first; registers the environment"
    )
    flags.add_argument("--kwargs", type=keywords, default={}, metavar="JSON", help="arguments for gymnasium.make")
    flags.add_argument("--task", metavar="NAME", help="task name; default gymnasium/ID")
    flags.add_argument("--tls", metavar="DIR", help="certificate folder made by `treadmill certs`")
    flags.add_argument("--insecure", action="store_true", help="allow plain tcp beyond loopback; any host can forge it")
    flags.add_argument("--seed", type=whole(0, NUMBER_MAX), help="seed of resets and exploration; default: random")
    flags.add_argument("--steps", type=whole(1, NUMBER_MAX), help="end after this many environment steps")
    return flags


def make(env, kwargs):
    """Returns an environment. Raises TaskError for unknown arguments."""
    try:
        return gymnasium.make(env, **kwargs)
    except TypeError as why:
        raise TaskError(f"{why}; correct --kwargs {json.dumps(kwargs)}") from why


def main(arguments=None):
    """Runs the actor until a signal or --steps ends it. Returns the exit code."""
    args = parser().parse_args(arguments)
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(message)s", stream=sys.stderr)
    log = logging.getLogger("treadmill_actor")
    name = args.name or re.sub(r"[^a-z0-9]", "-", socket.gethostname().lower())[:40] + f"-py-{unique() & 0xFFFFFFFF:08x}"
    seed = args.seed if args.seed is not None else unique()
    stopping = threading.Event()
    environments = bus = None
    connect = args.connect or [default_endpoint(args.tls)]
    try:
        for endpoint in connect:
            check_endpoint(endpoint, args.insecure, args.tls)
    except BusError as why:
        parser().error(str(why))
    try:
        for module in args.modules:
            importlib.import_module(module)
        label = args.task or f"gymnasium/{args.env.rsplit(':', 1)[-1]}"
        environments = Environments(lambda: make(args.env, args.kwargs), label, args.envs, seed)
        # Until here a signal ends the process: environments may take long to build.
        request_stop(stopping)
        task = environments.task
        log.info(
            "%s runs `%s`: %d observations, %d actions; distance from x_position in info, else 0",
            name,
            task.name,
            task.observation_size,
            task.action_size,
        )
        worker = None
        while True:
            bus = dialled(lambda: Bus(connect, args.tls), connect, stopping)
            if bus is None:
                return 0
            if worker is None:
                # Another endpoint may be the leader's.
                leaves = len(connect) > 1 and any(endpoint.startswith("tls/") for endpoint in connect)
                worker = Worker(bus, args.run, name, environments, seed, stopping, leaves)
            worker.bus = bus
            worker.work(args.steps)
            if not worker.is_behind_standby or stopping.is_set():
                break
            bus.close()
            connect = connect[1:] + connect[:1]
            log.warning("the endpoint is a standby's, which may not pass fragments on; trying the next one: %s", ", ".join(connect))
        counts = worker.uploader.delivery.outcomes if worker.uploader else {}
        log.info("%s ended after %d env steps; receipts: %s", name, worker.env_steps, counts)
        return 0
    except (JoinRefused, TaskError, BusError, ImportError, gymnasium.error.Error) as why:
        print(f"error: {why}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return EXIT_AT_ONCE
    finally:
        if environments is not None:
            environments.close()
        if bus is not None:
            bus.close()
