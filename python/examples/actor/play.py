"""Plays an exported policy without exploration in its Gymnasium environment.

Usage: treadmill export RUN --safetensors policy.safetensors
       play.py policy.safetensors --env Humanoid-v5 [--kwargs JSON] [--episodes N] [--render]
"""

import argparse
import json
import sys
from pathlib import Path

import gymnasium
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from treadmill_actor.policy import Policy  # noqa: E402
from treadmill_actor.task import describe, number  # noqa: E402

flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
flags.add_argument("policy", type=Path)
flags.add_argument("--env", required=True, help="Gymnasium ID; MODULE:ID imports the module that registers it")
flags.add_argument("--kwargs", type=json.loads, default={}, help="arguments for gymnasium.make")
flags.add_argument("--episodes", type=int, default=10)
flags.add_argument("--seed", type=int, default=1)
flags.add_argument("--render", action="store_true")
args = flags.parse_args()
policy, facts = Policy.from_export(args.policy.read_bytes())
env = gymnasium.make(args.env, render_mode="human" if args.render else None, **args.kwargs)
task = describe(env, facts.get("task", {}).get("name", "unknown"))
if (task.observation_size, task.action_size) != (policy.observation_size, policy.action_size):
    sys.exit(
        f"error: the policy has {policy.observation_size} observations and {policy.action_size} actions, but "
        f"`{args.env}` has {task.observation_size} and {task.action_size}"
    )
returns, lengths, distances = [], [], []
for episode in range(args.episodes):
    observation, info = env.reset(seed=args.seed + episode)
    positions = [number(info.get("x_position"))]
    total, length, over = 0.0, 0, False
    while not over:
        broken = np.flatnonzero(~np.isfinite(np.ravel(observation)))
        if len(broken):
            sys.exit(f"error: entry {broken[0]} of the observation of `{args.env}` is not finite in step {length + 1}; mend the sensor")
        actions = task.to_env(policy.means(np.float32(observation).reshape(1, -1)))
        observation, reward, terminated, truncated, info = env.step(actions[0].reshape(env.action_space.shape))
        positions.append(number(info.get("x_position")))
        total, length, over = total + float(reward), length + 1, terminated or truncated
    returns.append(total)
    lengths.append(length)
    # Some environments have none after a reset, or none at all.
    known = [position for position in positions if position is not None] or [0.0]
    distances.append(known[-1] - known[0])
print(
    f"return {np.mean(returns):.1f} ± {np.std(returns):.1f}, length {np.mean(lengths):.1f}, "
    f"distance {np.mean(distances):.2f} m, {args.episodes} episodes"
)
