"""Tutorial 4 of 4: shows the trained humanoid in a window, or writes a GIF without a display.

Usage: pip install "./python/treadmill_gym[train,human]"
       tutorial_4_watch.py humanoid_ppo.zip [--episodes N] [--gif FILE]
"""

import argparse
import sys
from pathlib import Path

import gymnasium
from stable_baselines3 import PPO

import treadmill_gym

flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
flags.add_argument("model", nargs="?", default="humanoid_ppo.zip")
flags.add_argument("--episodes", type=int, default=3)
flags.add_argument("--steps", type=int, default=1000, help="limit per episode")
flags.add_argument("--gif", type=Path, help="write an animation instead of opening a window")
flags.add_argument("--seed", type=int, default=1)
args = flags.parse_args()


def environment():
    """Returns the environment and the GIF's path, which is None with a window."""
    if args.gif is None:
        env = gymnasium.make("treadmill/Humanoid-v0", render_mode="human")
        try:
            env.reset(seed=args.seed)
            return env, None
        except gymnasium.error.Error as why:
            print(f"{why}\nwriting an animation instead: humanoid.gif", file=sys.stderr)
    env = gymnasium.make("treadmill/Humanoid-v0", render_mode="rgb_array", width=320, height=240)
    return env, args.gif or Path("humanoid.gif")


model = PPO.load(args.model)
env, gif = environment()
images = []
try:
    for episode in range(args.episodes):
        observation, info = env.reset(seed=args.seed + episode)
        total, steps, ended = 0.0, 0, False
        while not ended and steps < args.steps:
            action, _ = model.predict(observation, deterministic=True)
            observation, reward, terminated, truncated, info = env.step(action)
            total, steps, ended = total + reward, steps + 1, terminated or truncated
            # Every third step: 22 images per second.
            if gif is not None and steps % 3 == 0:
                images.append(env.render())
        print(f"episode {episode + 1}: return {total:.1f}, {steps} steps, {info['x_position']:.2f} m")
except treadmill_gym.WindowClosed:
    print("window closed")
if images:
    from PIL import Image

    first, *others = [Image.fromarray(image) for image in images]
    first.save(gif, save_all=True, append_images=others, duration=45, loop=0)
    print(f"wrote {gif}: {len(images)} images")
env.close()
