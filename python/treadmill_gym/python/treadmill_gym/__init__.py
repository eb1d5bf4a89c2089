"""Treadmill's humanoid as a Gymnasium environment.

The import registers `treadmill/Humanoid-v0` for `gymnasium.make` and `gymnasium.make_vec`. The vector environment steps all
humanoids in one call.
"""

from gymnasium.envs.registration import register

from .environment import HumanoidEnv
from .vector import HumanoidVectorEnv
from .window import WindowClosed

__all__ = ["HumanoidEnv", "HumanoidVectorEnv", "WindowClosed"]

register(
    id="treadmill/Humanoid-v0",
    entry_point="treadmill_gym.environment:HumanoidEnv",
    vector_entry_point="treadmill_gym.vector:HumanoidVectorEnv",
    max_episode_steps=1000,
)
