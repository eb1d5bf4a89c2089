"""Several humanoids: `gymnasium.make_vec("treadmill/Humanoid-v0", num_envs=64)`."""

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from . import spaces
from ._native import Humanoids, Renderer


class HumanoidVectorEnv(VectorEnv):
    """`num_envs` humanoids that are stepped in one call, which lets go of the interpreter's lock, on `threads` threads.

    Gives what a `SyncVectorEnv` of as many `treadmill/Humanoid-v0` gives with the same seeds, number for number, on any number
    of threads (0 means one per core). `autoreset_mode` is one of Gymnasium's. The other keyword arguments are those of
    `HumanoidEnv`; of pictures there is `render_mode="rgb_array"` only.
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
        self.metadata = self.metadata | {"autoreset_mode": self.autoreset_mode}
        # -1 and None are Gymnasium's words for no limit.
        limit = max_episode_steps if max_episode_steps not in (None, -1) else 0
        self._native = Humanoids(num_envs, settings, limit, threads)
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

    @property
    def threads(self):
        """How many threads step the environments."""
        return self._native.threads

    @property
    def dt(self):
        """Duration of a step in s."""
        return self._native.control_step_s

    @property
    def np_random(self):
        """The random number generators of all environments."""
        return tuple(self._generator(index) for index in range(self.num_envs))

    @property
    def np_random_seed(self):
        """What they were seeded with."""
        return tuple(self._generator_seeds[index] for index, _ in enumerate(self.np_random))

    def _generator(self, index, seed=None):
        if seed is not None or self._generators[index] is None:
            self._generators[index], self._generator_seeds[index] = seeding.np_random(seed)
        return self._generators[index]

    def _draw_seeds(self, mask):
        for index in np.flatnonzero(mask):
            self._seeds[index] = self._generator(index).integers(spaces.SEEDS)

    def reset(self, *, seed=None, options=None):
        """Starts episodes in all environments, or in those that `options["reset_mask"]` says. A whole number as `seed` seeds the
        first environment, and each further one with one more; a list has a seed or `None` for each."""
        spaces.check_options(options, known=("reset_mask",))
        seeds = self._listed(seed)
        mask = self._mask((options or {}).get("reset_mask"))
        for index in np.flatnonzero(mask):
            self._generator(index, seeds[index])
        self._draw_seeds(mask)
        infos = self._native.reset(mask, self._seeds, self._observations)
        self._over[mask] = False
        return self._observations.copy(), infos

    def step(self, actions):
        """A control step of each. What happens with episodes that are over is said by `autoreset_mode`: begin anew with the next
        step, whose action is not used; begin anew in the same one, with `final_obs` and `final_info` in the infos; or nothing,
        and `reset` has to be called for them first."""
        actions = spaces.as_actions(actions, self.action_space.shape, "actions")
        resets = self._over
        if self.autoreset_mode is AutoresetMode.NEXT_STEP:
            self._draw_seeds(resets)
        elif resets.any():
            waiting = np.flatnonzero(resets).tolist()
            raise ValueError(f'episodes {waiting} are over: reset(options={{"reset_mask": ...}}) starts them anew')
        observations, rewards, terminations, truncations, infos = self._native.step(actions, resets, self._seeds)
        over = terminations | truncations
        if self.autoreset_mode is AutoresetMode.SAME_STEP and over.any():
            self._begin_anew(over, observations, infos)
            over = np.zeros_like(over)
        self._over = over
        # Ours to write to at the next `reset`; theirs to keep.
        self._observations = observations
        return observations.copy(), rewards, terminations, truncations, infos

    def _begin_anew(self, over, observations, infos):
        """Starts new episodes where they are over, and says as Gymnasium does how the old ones ended."""
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
        begun = self._native.reset(over, self._seeds, observations)
        for name in [name for name in begun if not name.startswith("_")]:
            infos[name][over], infos[f"_{name}"][over] = begun[name][over], True
        # Where all are over nothing may be left to tell of.
        for name in [name for name in infos if not name.startswith("_") and not infos[f"_{name}"].any()]:
            del infos[name], infos[f"_{name}"]
        infos |= {"final_obs": final_obs, "_final_obs": over.copy(), "final_info": final_info, "_final_info": over.copy()}

    def _listed(self, seed):
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
        """A picture of each as an array, `[height, width, 3]`."""
        if self.render_mode is None:
            raise ValueError('nothing is rendered without a render mode, as in make_vec(..., render_mode="rgb_array")')
        return tuple(self._renderer.picture_of(self._native, index) for index in range(self.num_envs))
