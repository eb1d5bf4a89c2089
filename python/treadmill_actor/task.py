"""Describes a Gymnasium environment to the learner: name, sizes, action ranges."""

import numbers
import operator
import re
from dataclasses import dataclass

import gymnasium
import numpy as np

_NAME = re.compile(r"[A-Za-z0-9_./:-]{1,128}\Z")


class TaskError(Exception):
    """The environment or its configuration is unusable."""


def number(value):
    """Returns an entry of info as a float if it is a real number or an array of one, else None."""
    if isinstance(value, np.ndarray) and value.size == 1:
        value = value.item()
    return float(value) if isinstance(value, numbers.Real) else None


@dataclass
class Task:
    """Description of one environment."""

    name: str
    observation_size: int
    action_size: int
    low: np.ndarray
    high: np.ndarray
    control_step_s: float
    #: Numbers from 1 of the entries that a mirrored observation and a mirrored action hold; empty without a mirror image.
    observation_mirror: list
    action_mirror: list
    #: Action space.
    box: gymnasium.spaces.Box

    def to_env(self, actions):
        """Maps policy actions to the environment's Box: -1 is the lower bound, 1 the upper one; clips the rest.

        Returns rows of the Box's dtype. Fragments hold the unclipped policy actions.
        """
        shares = (np.clip(np.asarray(actions, np.float64), -1.0, 1.0) + 1.0) / 2.0
        # The difference of the bounds may overflow.
        commands = self.low * (1.0 - shares) + self.high * shares
        # Rounding must not leave the Box.
        return np.clip(commands.astype(self.box.dtype), self.box.low.ravel(), self.box.high.ravel())

    def fill(self, message):
        """Copies the description into the Task message of a registration."""
        message.name = self.name
        message.observation_size, message.action_size = self.observation_size, self.action_size
        message.action_low.extend(self.low.tolist())
        message.action_high.extend(self.high.tolist())
        message.control_step_s = self.control_step_s
        message.observation_mirror.extend(self.observation_mirror)
        message.action_mirror.extend(self.action_mirror)


def _mirror(env, name):
    """Returns the environment's attribute `mirror`, a pair of lists of whole numbers; two empty lists without it."""
    if not env.has_wrapper_attr("mirror"):
        return [], []
    given = env.get_wrapper_attr("mirror")
    try:
        observation, action = ([operator.index(number) for number in numbers_] for numbers_ in given)
    except (TypeError, ValueError):
        raise TaskError(f"the attribute `mirror` of `{name}` is {given!r}; it must be two lists of whole numbers") from None
    return observation, action


def describe(env, name):
    """Returns the description of an environment. Raises TaskError if its spaces or `name` are not supported."""
    for kind, space in (("observation", env.observation_space), ("action", env.action_space)):
        if not isinstance(space, gymnasium.spaces.Box):
            raise TaskError(f"the {kind} space of `{name}` is {space}; only Box is supported")
        if not np.issubdtype(space.dtype, np.floating):
            raise TaskError(f"the {kind} space of `{name}` has dtype {space.dtype}; only floating-point numbers are supported")
    if not _NAME.match(name):
        raise TaskError(f"`{name}` is not a task name; allowed: 1 to 128 of the characters a-z, A-Z, 0-9, _ - . : and /")
    low, high = (np.asarray(end, np.float64).ravel() for end in (env.action_space.low, env.action_space.high))
    # Where an end is missing the range is 2 wide, so that it holds no action outside the Box: -1 to 1 without any end.
    low_given, high_given = np.isfinite(low), np.isfinite(high)
    low, high = (
        np.where(low_given, low, np.where(high_given, high - 2.0, -1.0)),
        np.where(high_given, high, np.where(low_given, low + 2.0, 1.0)),
    )
    dt = getattr(env.unwrapped, "dt", 0.0)
    observation_mirror, action_mirror = _mirror(env, name)
    return Task(
        name=name,
        observation_size=int(np.prod(env.observation_space.shape)),
        action_size=low.size,
        low=low,
        high=high,
        control_step_s=float(dt) if isinstance(dt, (int, float)) and 0 < dt < 1e3 else 0.0,
        observation_mirror=observation_mirror,
        action_mirror=action_mirror,
        box=env.action_space,
    )
