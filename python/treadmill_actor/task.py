"""What a Gymnasium environment is to the learner: a name, sizes, and what actions mean."""

import re
from dataclasses import dataclass

import gymnasium
import numpy as np

_NAME = re.compile(r"[A-Za-z0-9_./:-]{1,128}\Z")


class TaskError(Exception):
    """An environment that cannot be an actor's."""


@dataclass
class Task:
    """The task of one environment."""

    name: str
    observation_size: int
    action_size: int
    low: np.ndarray
    high: np.ndarray
    control_step_s: float
    has_position: bool

    def to_env(self, actions):
        """What the environment takes for the policy's actions.

        The policy's actions are in units of the range: -1 is the lower bound of the environment's Box, 1 the upper one, and
        what lies beyond is clipped to them. The fragment holds the actions as they were before that.
        """
        shares = np.clip(actions, -1.0, 1.0)
        return (self.low + (shares + 1.0) * 0.5 * (self.high - self.low)).astype(np.float32)

    def fill(self, message):
        """Writes itself into the Task of a registration."""
        message.name = self.name
        message.observation_size, message.action_size = self.observation_size, self.action_size
        message.action_low.extend(self.low.tolist())
        message.action_high.extend(self.high.tolist())
        message.control_step_s = self.control_step_s


def describe(env, name):
    """The task of an environment, or TaskError with what is in the way."""
    for kind, space in (("observation", env.observation_space), ("action", env.action_space)):
        if not isinstance(space, gymnasium.spaces.Box):
            raise TaskError(f"the {kind} space of `{name}` is {space}; only Box spaces can be learnt from")
        if not np.issubdtype(space.dtype, np.floating):
            raise TaskError(f"the {kind} space of `{name}` holds {space.dtype}; only real numbers can be learnt from")
    if not _NAME.match(name):
        raise TaskError(f"`{name}` is no name for a task: 1 to 128 of the characters a-z, A-Z, 0-9, _ - . : and /")
    low, high = (np.asarray(end, np.float64).ravel() for end in (env.action_space.low, env.action_space.high))
    # An entry without bounds is treated as if it had -1 and 1.
    bounded = np.isfinite(low) & np.isfinite(high)
    low, high = np.where(bounded, low, -1.0), np.where(bounded, high, 1.0)
    dt = getattr(env.unwrapped, "dt", 0.0)
    return Task(
        name=name,
        observation_size=int(np.prod(env.observation_space.shape)),
        action_size=low.size,
        low=low,
        high=high,
        control_step_s=float(dt) if isinstance(dt, (int, float)) and 0 < dt < 1e3 else 0.0,
        has_position=False,
    )
