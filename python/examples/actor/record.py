"""Writes each accepted fragment of a run to a NumPy file.

Usage: record.py FOLDER [--connect ENDPOINT] [--run NAME] [--actor NAME] [--tls DIR] [--count N]

The learner publishes copies on `treadmill/{run}/@rollouts/{actor}` while that key has a subscriber. A slow link drops copies;
gaps in `sequence` show it. Each file, ACTOR-INCARNATION-SEQUENCE.npz, holds

    observations [T, N, observation], actions [T, N, action], log_probs [T, N], rewards [T, N],
    terminated [T, N], truncated [T, N], last_observations [K, observation], last_at [K, 2] (its step and environment),
    episode_returns, episode_lengths, version (incarnation and number), sequence
"""

import argparse
import sys
import threading
from pathlib import Path

import numpy as np
import zenoh

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from treadmill_actor import schema  # noqa: E402
from treadmill_actor.bus import configuration, default_endpoint, dialled  # noqa: E402


def arrays(fragment):
    """Decodes a fragment into arrays."""
    shape = (fragment.steps, fragment.envs)
    flags = np.frombuffer(fragment.flags, np.uint8).reshape(shape)
    terminated, truncated = flags & 1 != 0, flags & 2 != 0
    needs_last = truncated.copy()
    needs_last[-1] |= ~terminated[-1]

    def array(name, *width):
        return np.frombuffer(getattr(fragment, name), "<f4").reshape(*shape, *width)

    return {
        "observations": array("observations", fragment.observation_size),
        "actions": array("actions", fragment.action_size),
        "log_probs": array("log_probs"),
        "rewards": array("rewards"),
        "terminated": terminated,
        "truncated": truncated,
        "last_observations": np.frombuffer(fragment.last_observations, "<f4").reshape(-1, fragment.observation_size),
        "last_at": np.argwhere(needs_last),
        "episode_returns": np.array([episode.return_sum for episode in fragment.episodes]),
        "episode_lengths": np.array([episode.length for episode in fragment.episodes]),
        "version": np.array([fragment.version.incarnation, fragment.version.number], np.uint64),
        "sequence": np.uint64(fragment.sequence),
    }


def main():
    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("folder", type=Path)
    flags.add_argument("--connect", action="append")
    flags.add_argument("--run", default="*")
    flags.add_argument("--actor", default="*")
    flags.add_argument("--tls", metavar="DIR", help="folder with ca.crt, observer.crt and observer.key")
    flags.add_argument("--count", type=int, help="end after this many fragments")
    args = flags.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    connect = args.connect or [default_endpoint(args.tls)]
    config = configuration(connect, args.tls, role="observer")
    written, done = 0, threading.Event()
    with dialled(lambda: zenoh.open(config), connect, done) as session:
        # If the disk is slower than the run, the ring drops the oldest copies.
        copies = session.declare_subscriber(
            f"treadmill/{args.run}/@rollouts/{args.actor}", zenoh.handlers.RingChannel(64)
        )
        while not done.is_set():
            sample = copies.try_recv()
            if sample is None:
                done.wait(0.02)
                continue
            fragment = schema.Fragment.FromString(sample.payload.to_bytes())
            name = f"{fragment.actor}-{fragment.actor_incarnation:016x}-{fragment.sequence:08d}.npz"
            np.savez_compressed(args.folder / name, **arrays(fragment))
            written += 1
            print(f"{name}: {fragment.steps} steps of {fragment.envs} environments", flush=True)
            if args.count is not None and written >= args.count:
                done.set()


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
