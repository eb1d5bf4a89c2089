"""Collects fragments: T steps of N environments under one policy."""

import logging
import math
import re
import time

import numpy as np

from . import schema
from .task import TaskError, describe, number

TERMINATED, TRUNCATED = 1, 2
FRAGMENT_BYTES_MAX = 30 << 20
#: Most bytes of a fragment's header with its terms of the reward, and of one episode in it.
HEADER_BYTES, EPISODE_BYTES = 12_288, 40
#: Terms of the reward in info, such as reward_forward, as Gymnasium's own environments have them.
REWARD_TERM, REWARD_TERMS_MAX = re.compile(r"reward_([a-z0-9_]{1,64})"), 64
log = logging.getLogger("treadmill_actor")


class Environments:
    """N environments, stepped one after the other, and their episodes."""

    def __init__(self, make, name, count, seed):
        self.envs = [make() for _ in range(count)]
        self.task = describe(self.envs[0], name)
        self.seeds = np.random.SeedSequence(seed).generate_state(count).tolist()
        self.observations = np.zeros((count, self.task.observation_size), np.float32)
        self.returns = [0.0] * count
        self.lengths = [0] * count
        #: First and last x_position of each episode; None without one.
        self.starts = [None] * count
        self.positions = [None] * count
        #: Sum of each term of the reward over all environments and steps since the fragment began.
        self.reward_sums = {}
        for index in range(count):
            self._reset(index, self.seeds[index])

    def __len__(self):
        return len(self.envs)

    def reset(self):
        """Begins new episodes: returns under the policy of another run do not count."""
        for index in range(len(self)):
            self._reset(index)

    def _reset(self, index, seed=None):
        observation, info = self.envs[index].reset(seed=seed)
        self.observations[index] = self._flat(self.envs[index], observation)
        if not np.isfinite(self.observations[index]).all():
            raise TaskError(f"the first observation of `{self.task.name}` is not finite")
        self.returns[index], self.lengths[index] = 0.0, 0
        self.starts[index] = self.positions[index] = number(info.get("x_position"))

    def _flat(self, env, observation):
        """Returns an observation as one row."""
        shape, wanted = np.shape(observation), env.observation_space.shape
        if math.prod(shape) != self.task.observation_size:
            raise TaskError(f"`{self.task.name}` gives an observation of shape {shape}, but its observation_space has shape {wanted}")
        return np.ravel(observation)

    def step(self, actions):
        """Steps all environments. Returns rewards, flags, last observations of truncated episodes, and finished episodes."""
        commands = self.task.to_env(actions)
        rewards, flags = np.zeros(len(self), np.float32), np.zeros(len(self), np.uint8)
        cut_off, episodes = {}, []
        for index, env in enumerate(self.envs):
            before = self.observations[index].copy()
            observation, reward, terminated, truncated, info = env.step(commands[index].reshape(env.action_space.shape))
            # Beyond single precision, which fragments have, is a fault too.
            with np.errstate(over="ignore"):
                self.observations[index] = self._flat(env, observation)
                if np.size(reward) != 1:
                    raise TaskError(f"`{self.task.name}` gives a reward of shape {np.shape(reward)}; it must be one number")
                reward = np.ravel(reward)[0]
                fault = not (np.isfinite(self.observations[index]).all() and np.isfinite(np.float32(reward)))
            if fault:
                # A numerical fault ends the episode with the last finite observation and reward 0.
                self.observations[index], reward, terminated = before, 0.0, True
            else:
                self._add_reward_terms(info)
            rewards[index] = reward
            self.returns[index] += float(reward)
            self.lengths[index] += 1
            position = number(info.get("x_position"))
            if position is not None:
                self.positions[index] = position
                # Some environments have it in the infos of steps only.
                if self.starts[index] is None:
                    self.starts[index] = position
            if not (terminated or truncated):
                continue
            # Terminated takes precedence: there is no next state to bootstrap from.
            flags[index] = TERMINATED if terminated else TRUNCATED
            if not terminated:
                cut_off[index] = self.observations[index].copy()
            cause = "non_finite" if fault else "terminated" if terminated else "time_limit"
            episodes.append(self._episode(index, cause))
            self._reset(index)
        return rewards, flags, cut_off, episodes

    def _add_reward_terms(self, info):
        for key, value in info.items():
            name, term = isinstance(key, str) and REWARD_TERM.fullmatch(key), number(value)
            if name and term is not None:
                self.reward_sums[name[1]] = self.reward_sums.get(name[1], 0.0) + term

    def _episode(self, index, cause):
        """Returns the episode's summary. Distance comes from x_position in info, and is 0 without it."""
        position = self.positions[index]
        distance = position - self.starts[index] if position is not None else 0.0
        if not math.isfinite(distance):
            distance = 0.0
        duration = self.lengths[index] * self.task.control_step_s
        return {
            "return_sum": self.returns[index],
            "length": self.lengths[index],
            "distance_m": distance,
            "velocity_mean_mps": distance / duration if duration > 0 else 0.0,
            "cause": cause,
        }

    def close(self):
        """Closes the environments."""
        for env in self.envs:
            env.close()


class Collector:
    """Collects one fragment after the other; episodes continue across fragments."""

    def __init__(self, environments, run, actor, incarnation, config_hash, seed):
        self.environments = environments
        self.header = {"run": run, "actor": actor, "actor_incarnation": incarnation, "config_hash": config_hash}
        self.random = np.random.default_rng(seed)
        self.sequence = 0
        #: Environment steps in all fragments.
        self.env_steps = 0
        envs, task = len(environments), environments.task
        # A step may end an episode of each environment, and so has an episode's summary and a last observation.
        step_bytes = envs * (4 * (2 * task.observation_size + task.action_size + 2) + 1 + EPISODE_BYTES)
        #: Most steps that always fit into a fragment.
        self.steps_max = (FRAGMENT_BYTES_MAX - HEADER_BYTES - 4 * envs * task.observation_size) // step_bytes
        if self.steps_max < 1:
            raise TaskError(
                f"one step of {envs} environments has up to {step_bytes >> 20} MiB; a fragment has at most "
                f"{FRAGMENT_BYTES_MAX >> 20} MiB; use fewer --envs"
            )

    def collect(self, policy, version, settled_through, steps, is_stopping=lambda: False):
        """Returns the next fragment of `steps` steps, or as many as fit, encoded, and its finished episodes.

        Returns None, without a fragment, once `is_stopping()` is true: a step of some environments takes seconds.
        """
        begun = time.monotonic()
        environments, task = self.environments, self.environments.task
        steps, envs = min(steps, self.steps_max), len(environments)
        observations = np.empty((steps, envs, task.observation_size), np.float32)
        actions = np.empty((steps, envs, task.action_size), np.float32)
        log_probs, rewards = np.empty((steps, envs), np.float32), np.empty((steps, envs), np.float32)
        flags = np.empty((steps, envs), np.uint8)
        last_observations, episodes = [], []
        environments.reward_sums.clear()
        for t in range(steps):
            if is_stopping():
                return None
            normals = self.random.standard_normal((envs, task.action_size), dtype=np.float32)
            observations[t] = environments.observations
            actions[t], log_probs[t] = policy.sample(observations[t], normals)
            rewards[t], flags[t], cut_off, ended = environments.step(actions[t])
            episodes.extend(ended)
            for env in range(envs):
                if flags[t, env] == TRUNCATED:
                    last_observations.append(cut_off[env])
                elif t + 1 == steps and flags[t, env] == 0:
                    last_observations.append(environments.observations[env].copy())
        self.sequence += 1
        self.env_steps += steps * envs
        planes = {
            "observations": observations,
            "actions": actions,
            "log_probs": log_probs,
            "rewards": rewards,
            "last_observations": np.asarray(last_observations, np.float32),
        }
        fragment = schema.Fragment(
            **self.header,
            sequence=self.sequence,
            version=version,
            steps=steps,
            envs=envs,
            observation_size=task.observation_size,
            action_size=task.action_size,
            flags=flags.tobytes(),
            settled_through=settled_through,
            env_steps=self.env_steps,
            wire_version=schema.WIRE_VERSION,
            **{name: plane.astype("<f4", copy=False).tobytes() for name, plane in planes.items()},
        )
        for episode in episodes:
            fragment.episodes.add(**{**episode, "cause": schema.END_CAUSES[episode["cause"]]})
        for name, total in list(environments.reward_sums.items())[:REWARD_TERMS_MAX]:
            if math.isfinite(total):
                fragment.reward_terms.add(name=name, mean=total / (steps * envs))
        fragment.collect_s = time.monotonic() - begun
        return fragment.SerializeToString(), episodes
