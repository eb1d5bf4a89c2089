"""Tutorial 3 of 4: trains the humanoid with Stable-Baselines3's PPO, logs to TensorBoard and saves the model.

Usage: pip install "./python/treadmill_gym[train]"
       tutorial_3_ppo.py [--steps N] [--envs N] [--model FILE]
       tensorboard --logdir tensorboard
"""

import argparse

import gymnasium
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecMonitor

import treadmill_gym  # noqa: F401  registers treadmill/Humanoid-v0
from treadmill_gym.sb3 import HumanoidVecEnv

flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
flags.add_argument("--steps", type=int, default=2_000_000)
flags.add_argument("--envs", type=int, default=1, help="humanoids simulated at once; 32 is faster")
flags.add_argument("--model", default="humanoid_ppo.zip")
flags.add_argument("--logs", default="tensorboard")
flags.add_argument("--seed", type=int)
args = flags.parse_args()

if args.envs == 1:
    env = gymnasium.make("treadmill/Humanoid-v0")
    model = PPO("MlpPolicy", env, verbose=1, tensorboard_log=args.logs, seed=args.seed)
else:
    # 8192 steps per update in total, and larger minibatches, which cost less per step.
    env = VecMonitor(HumanoidVecEnv(args.envs))
    steps = max(1, 8192 // args.envs)
    model = PPO("MlpPolicy", env, n_steps=steps, batch_size=512, verbose=1, tensorboard_log=args.logs, seed=args.seed)
model.learn(total_timesteps=args.steps)
model.save(args.model)
print(f"saved {args.model}; to watch it: tutorial_4_watch.py {args.model}; curves: tensorboard --logdir {args.logs}")
env.close()
