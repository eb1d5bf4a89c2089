"""Several humanoids: `gymnasium.make_vec("treadmill/Humanoid-v0", num_envs=64)`."""

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from . import spaces
from ._native import Humanoids, Renderer


class HumanoidVectorEnv(VectorEnv):
    """`num_envs` humanoids, stepped in one call on `threads` threads (0: one per core) without the interpreter lock.

    With the same seeds, results equal those of a `SyncVectorEnv` of `treadmill/Humanoid-v0` bit for bit, for any number of
    threads. `autoreset_mode` is one of Gymnasium's. Other keyword arguments are those of `HumanoidEnv`; the only render mode
    is `"rgb_array"`.
    """

    metadata = {
        "render_modes": ["rgb_array"],
        "render_fps": spaces.RENDER_FPS,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs=1,
        max_episode_steps=1000,
        autoreset_mode=AutoresetMode.NEXT_STEP,
        threads=0,
        render_mode=None,
        width=480,
        height=480,
        camera=None,
        **settings,
    ):
        spaces.check_render_mode(render_mode, self.metadata["render_modes"])
        self.num_envs, self.render_mode = num_envs, render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        # In Gymnasium, -1 and None mean no limit.
        self._limit = max_episode_steps if max_episode_steps not in (None, -1) else 0
        self._native = Humanoids(num_envs, settings, self._limit, threads)
        fps = spaces.render_fps(self._native)
        self.metadata = self.metadata | {"autoreset_mode": self.autoreset_mode, "render_fps": fps}
        self._renderer = Renderer(width, height, camera)
        self.single_observation_space = spaces.observation_space(self._native)
        self.single_action_space = spaces.action_space(self._native)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_structure = spaces.observation_structure(self._native, **settings)
        self._generators = [None] * num_envs
        self._generator_seeds = [None] * num_envs
        self._seeds = np.zeros(num_envs, np.uint64)
        self._observations = np.zeros(self.observation_space.shape)
        self._over = np.zeros(num_envs, np.bool_)
        self._lengths = np.zeros(num_envs, np.int64)

    @property
    def threads(self):
        """Number of threads that step the environments."""
        return self._native.threads

    @property
    def dt(self):
        """Duration of a step in s."""
        return self._native.control_step_s

    @property
    def np_random(self):
        """Random number generators of all environments."""
        return tuple(self._generator(index) for index in range(self.num_envs))

    @property
    def np_random_seed(self):
        """Seeds of the random number generators."""
        return tuple(self._generator_seeds[index] for index, _ in enumerate(self.np_random))

    def _generator(self, index, seed=None):
        if seed is not None or self._generators[index] is None:
            self._generators[index], self._generator_seeds[index] = seeding.np_random(seed)
        return self._generators[index]

    def _draw_seeds(self, mask):
        for index in np.flatnonzero(mask):
            self._seeds[index] = self._generator(index).integers(spaces.SEEDS)

    def reset(self, *, seed=None, options=None):
        """Starts episodes in all environments, or where `options["reset_mask"]` is true.

        A number as `seed` seeds environment i with `seed + i`; a list has a seed or `None` for each."""
        spaces.check_options(options, known=("reset_mask",))
        seeds = self._seed_list(seed)
        mask = self._mask((options or {}).get("reset_mask"))
        for index in np.flatnonzero(mask):
            self._generator(index, seeds[index])
        self._draw_seeds(mask)
        infos = self._native.reset(mask, self._seeds, self._observations)
        self._over[mask], self._lengths[mask] = False, 0
        return self._observations.copy(), infos

    def step(self, actions):
        """Steps all environments. `autoreset_mode` decides how finished episodes restart: in the next step, which ignores their
        action; in the same step, with `final_obs` and `final_info` in the infos; or only by `reset`."""
        actions = spaces.as_actions(actions, self.action_space.shape, "actions")
        resets = self._over
        if self.autoreset_mode is AutoresetMode.NEXT_STEP:
            self._draw_seeds(resets)
        elif resets.any():
            waiting = np.flatnonzero(resets).tolist()
            raise ValueError(f'episodes {waiting} are over: restart them with reset(options={{"reset_mask": ...}})')
        observations, rewards, terminations, truncations, infos = self._native.step(actions, resets, self._seeds)
        # A fall in the last step of an episode is both in Gymnasium, but only a termination in the native module.
        self._lengths = np.where(resets, 0, self._lengths + 1)
        if self._limit:
            truncations |= self._lengths == self._limit
        over = terminations | truncations
        if self.autoreset_mode is AutoresetMode.SAME_STEP and over.any():
            self._restart(over, observations, infos)
            over = np.zeros_like(over)
        self._over = over
        # The next `reset` writes to this array, so the caller gets a copy.
        self._observations = observations
        return observations.copy(), rewards, terminations, truncations, infos

    def _restart(self, over, observations, infos):
        """Restarts finished episodes and adds their last observations and infos, as Gymnasium does."""
        final_obs = np.full(self.num_envs, None, object)
        for index in np.flatnonzero(over):
            final_obs[index] = observations[index].copy()
        final_info = {}
        for name in [name for name in infos if not name.startswith("_")]:
            values, mask = infos[name], infos[f"_{name}"]
            ends = mask & over
            if ends.any():
                final_info[name] = np.zeros_like(values)
                final_info[name][ends] = values[ends]
                final_info[f"_{name}"] = ends
            values[over], mask[over] = 0, False
        self._draw_seeds(over)
        restarted = self._native.reset(over, self._seeds, observations)
        self._lengths[over] = 0
        for name in [name for name in restarted if not name.startswith("_")]:
            infos[name][over], infos[f"_{name}"][over] = restarted[name][over], True
        # If all episodes are over, some entries may have no rows left.
        for name in [name for name in infos if not name.startswith("_") and not infos[f"_{name}"].any()]:
            del infos[name], infos[f"_{name}"]
        infos |= {"final_obs": final_obs, "_final_obs": over.copy(), "final_info": final_info, "_final_info": over.copy()}

    def _seed_list(self, seed):
        if seed is None:
            return [None] * self.num_envs
        if isinstance(seed, (int, np.integer)):
            return [int(seed) + index for index in range(self.num_envs)]
        if len(seed) != self.num_envs:
            raise ValueError(f"seed has {len(seed)} entries, but must have one for each of {self.num_envs} environments")
        return list(seed)

    def _mask(self, mask):
        if mask is None:
            return np.ones(self.num_envs, np.bool_)
        mask = np.asarray(mask)
        if mask.shape != (self.num_envs,) or mask.dtype != np.bool_ or not mask.any():
            raise ValueError(f"reset_mask is {mask!r}, but must have {self.num_envs} entries, True or False, at least one True")
        return np.ascontiguousarray(mask)

    def render(self):
        """Returns a picture `[height, width, 3]` of each environment."""
        if self.render_mode is None:
            raise ValueError('nothing is rendered without a render mode, as in make_vec(..., render_mode="rgb_array")')
        return tuple(self._renderer.picture_of(self._native, index) for index in range(self.num_envs))
