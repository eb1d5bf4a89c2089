"""Compares the speed with Gymnasium's Humanoid-v5 on MuJoCo, in alternating rounds, so that other load affects both.

Usage: pip install "./python/treadmill_gym[train]" "gymnasium[mujoco]"
       bench.py [--rounds N] [--envs N] [--without-ppo]

Random actions are drawn in advance; resets count. Workloads on one core are measured in processor time, which other programs
disturb less than wall-clock time. Training is Stable-Baselines3's PPO with "MlpPolicy": with one environment as in the
tutorial, and with --envs of them. An environment that does nothing shows PPO's share of the time.
"""

import argparse
import os
import platform
import statistics
import time
from importlib.metadata import version
from pathlib import Path

import gymnasium
import numpy as np

import treadmill_gym  # noqa: F401  registers treadmill/Humanoid-v0

OURS, THEIRS = "treadmill/Humanoid-v0", "Humanoid-v5"


class Idle(gymnasium.Env):
    """Environment with the humanoid's spaces and episodes of 25 steps that computes nothing."""

    observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (348,), np.float64)
    action_space = gymnasium.spaces.Box(-0.4, 0.4, (17,), np.float32)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.left = 25
        return np.zeros(348), {}

    def step(self, action):
        self.left -= 1
        return np.zeros(348), 5.0, self.left == 0, False, {}


#: Processor time of all threads of this process, and wall-clock time.
CPU, CLOCK = time.process_time, time.perf_counter


def single(name, seconds, **keywords):
    """Returns the steps per second of one environment."""
    env = gymnasium.make(name, **keywords)
    actions = np.random.default_rng(1).uniform(-0.4, 0.4, (1000, 17)).astype(np.float32)
    env.reset(seed=1)
    steps, started = 0, CPU()
    while (taken := CPU() - started) < seconds:
        for action in actions[:100]:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        steps += 100
    env.close()
    return steps / taken


def vector(name, count, seconds, now=CPU, **keywords):
    """Returns the steps per second of several environments together."""
    env = gymnasium.make_vec(name, count, **keywords)
    actions = np.random.default_rng(1).uniform(-0.4, 0.4, (50, count, 17)).astype(np.float32)
    env.reset(seed=1)
    steps, started = 0, now()
    while (taken := now() - started) < seconds:
        for action in actions[:10]:
            env.step(action)
        steps += 10 * count
    env.close()
    return steps / taken


def ppo(make, count, total):
    """Returns the steps per second of PPO: environments, policy and updates."""
    from stable_baselines3 import PPO

    # The same number of steps between updates as in tutorial_3_ppo.py.
    options = {} if count == 1 else {"n_steps": max(1, 8192 // count), "batch_size": 512}
    model = PPO("MlpPolicy", make(), seed=1, device="cpu", **options)
    started = CPU()
    model.learn(total_timesteps=total)
    taken = CPU() - started
    model.env.close()
    return model.num_timesteps / taken


def dummies(make, count):
    """Wraps `count` Gymnasium environments for Stable-Baselines3."""
    from stable_baselines3.common.vec_env import DummyVecEnv, VecMonitor

    return VecMonitor(DummyVecEnv([make] * count))


def humanoids(count):
    """Returns `count` humanoids that are stepped in one call."""
    from stable_baselines3.common.vec_env import VecMonitor

    from treadmill_gym.sb3 import HumanoidVecEnv

    return VecMonitor(HumanoidVecEnv(count))


def processor():
    """Returns the processor's name, from Linux where possible."""
    lines = Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []
    return next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), platform.processor())


def compare(title, rounds, sides):
    """Runs all sides in alternating rounds. Prints and returns medians; also prints each round's ratio to the first side."""
    rates = {name: [] for name in sides}
    for _ in range(rounds):
        for name, run in sides.items():
            rates[name].append(run())
    print(f"\n{title}\n\n| | steps/s | × | least to greatest |\n|---|---|---|---|")
    base = next(iter(rates.values()))
    for name, found in rates.items():
        ratios = [one / other for one, other in zip(found, base, strict=True)]
        span = f"{min(ratios):.2f} to {max(ratios):.2f}"
        print(f"| {name} | {statistics.median(found):.0f} | {statistics.median(ratios):.2f} | {span} |", flush=True)
    return {name: statistics.median(found) for name, found in rates.items()}


def main():
    """Runs all comparisons."""
    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("--rounds", type=int, default=7)
    flags.add_argument("--seconds", type=float, default=1.0, help="duration of each environment in each round")
    flags.add_argument("--envs", type=int, default=64)
    flags.add_argument("--ppo-steps", type=int, default=4096, help="steps with one environment; four times as many with several")
    flags.add_argument("--without-ppo", action="store_true")
    args = flags.parse_args()
    packages = ["gymnasium", "mujoco", "numpy"] + ([] if args.without_ppo else ["torch", "stable_baselines3"])
    versions = ", ".join(f"{name} {version(name)}" for name in packages)
    print(f"{processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}; Python {platform.python_version()}, {versions}")
    print(f"{args.rounds} alternating rounds; medians. × is the ratio to the first row of each table, round by round.")
    n, s = args.envs, args.seconds
    compare(
        "Environment, one core, random actions, processor time",
        args.rounds,
        {
            f"`make`, {THEIRS}": lambda: single(THEIRS, s),
            f"`make`, {OURS}": lambda: single(OURS, s),
            "the same, compact observation": lambda: single(OURS, s, observation="compact"),
            f"`make_vec`, {n} of {THEIRS} (SyncVectorEnv)": lambda: vector(THEIRS, n, s),
            f"`make_vec`, {n} of {OURS}, 1 thread": lambda: vector(OURS, n, s, threads=1),
        },
    )
    cores, one_process_each = os.cpu_count(), {"vectorization_mode": "async"}
    compare(
        f"Environments, all {cores} cores, random actions, wall-clock time",
        args.rounds,
        {
            f"`make_vec`, {cores} of {THEIRS} (AsyncVectorEnv)": lambda: vector(THEIRS, cores, s, CLOCK, **one_process_each),
            f"`make_vec`, {n} of {OURS}": lambda: vector(OURS, n, s, CLOCK),
        },
    )
    if args.without_ppo:
        return
    import torch

    # With one thread, waiting does not count as processor time.
    torch.set_num_threads(1)
    tutorial = compare(
        "Training as in the tutorial: PPO, one environment, one core, processor time",
        args.rounds,
        {
            THEIRS: lambda: ppo(lambda: gymnasium.make(THEIRS), 1, args.ppo_steps),
            OURS: lambda: ppo(lambda: gymnasium.make(OURS), 1, args.ppo_steps),
            "nothing": lambda: ppo(Idle, 1, args.ppo_steps),
        },
    )
    several = compare(
        f"Training with {n} environments: PPO, minibatches of 512, one core, processor time",
        args.rounds,
        {
            f"{THEIRS}, DummyVecEnv": lambda: ppo(lambda: dummies(lambda: gymnasium.make(THEIRS), n), n, 4 * args.ppo_steps),
            f"{OURS}, DummyVecEnv": lambda: ppo(lambda: dummies(lambda: gymnasium.make(OURS), n), n, 4 * args.ppo_steps),
            f"{OURS}, HumanoidVecEnv": lambda: ppo(lambda: humanoids(n), n, 4 * args.ppo_steps),
            "nothing, DummyVecEnv": lambda: ppo(lambda: dummies(Idle, n), n, 4 * args.ppo_steps),
        },
    )
    gain = several[f"{OURS}, HumanoidVecEnv"] / tutorial[THEIRS]
    print(f"\n{n} of {OURS} in one call make {gain:.1f} times the steps that the tutorial makes on {THEIRS}.")


if __name__ == "__main__":
    main()
