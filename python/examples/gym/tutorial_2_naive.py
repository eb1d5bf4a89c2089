"""Tutorial 2 of 4: a naive learner as a baseline.

It has one preferred action for all observations and adds noise to it. A reward above the average moves the preference towards
the tried action; a lower reward moves it away.

Usage: pip install ./python/treadmill_gym
       tutorial_2_naive.py [--episodes N] [--env ID]
"""

import argparse

import gymnasium
import numpy as np

import treadmill_gym  # noqa: F401  registers treadmill/Humanoid-v0

flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
flags.add_argument("--episodes", type=int, default=300)
flags.add_argument("--rate", type=float, default=0.01, help="step size of the preference")
flags.add_argument("--spread", type=float, default=0.1, help="standard deviation of the noise")
flags.add_argument("--env", default="treadmill/Humanoid-v0")
flags.add_argument("--seed", type=int, default=1)
args = flags.parse_args()

env = gymnasium.make(args.env)
random = np.random.default_rng(args.seed)
low, high = env.action_space.low, env.action_space.high
preferred = np.zeros(env.action_space.shape)
average = 0.0
returns = []
for episode in range(args.episodes):
    env.reset(seed=args.seed + episode)
    total, ended = 0.0, False
    while not ended:
        tried = np.clip(random.normal(preferred, args.spread), low, high)
        _, reward, terminated, truncated, _ = env.step(tried.astype(np.float32))
        surprise = reward - average
        preferred = np.clip(preferred + args.rate * surprise * (tried - preferred), low, high)
        average += 0.01 * surprise
        total, ended = total + reward, terminated or truncated
    returns.append(total)
    if (episode + 1) % max(1, args.episodes // 10) == 0:
        recent = returns[-max(1, args.episodes // 10) :]
        print(f"episode {episode + 1:5}  mean return of the last {len(recent)}: {np.mean(recent):7.2f}")
print(f"preferred action: {np.array2string(preferred, precision=2, suppress_small=True)}")
env.close()
