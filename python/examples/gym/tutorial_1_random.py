"""Tutorial 1 of 4: runs episodes with random actions and prints each step.

Usage: pip install ./python/treadmill_gym
       tutorial_1_random.py [--episodes N] [--steps N] [--env ID]
"""

import argparse

import gymnasium

import treadmill_gym  # noqa: F401  registers treadmill/Humanoid-v0

flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
flags.add_argument("--episodes", type=int, default=3)
flags.add_argument("--steps", type=int, default=1000, help="limit per episode")
flags.add_argument("--env", default="treadmill/Humanoid-v0")
flags.add_argument("--seed", type=int, default=1)
args = flags.parse_args()

env = gymnasium.make(args.env)
env.action_space.seed(args.seed)
print(f"observations {env.observation_space.shape}, actions {env.action_space.shape}")
for episode in range(args.episodes):
    env.reset(seed=args.seed + episode)
    total = 0.0
    for step in range(1, args.steps + 1):
        _, reward, terminated, truncated, info = env.step(env.action_space.sample())
        total += reward
        print(f"episode {episode + 1}  step {step:4}  reward {reward:7.3f}  x {info['x_position']:6.2f} m  return {total:8.2f}")
        if terminated or truncated:
            break
    print(f"episode {episode + 1}: return {total:.2f} in {step} steps, {'fell' if terminated else 'still up'}")
env.close()
