"""Several humanoids as a vector environment of Stable-Baselines3:

    from stable_baselines3.common.vec_env import VecMonitor
    from treadmill_gym.sb3 import HumanoidVecEnv

    model = PPO("MlpPolicy", VecMonitor(HumanoidVecEnv(64)))

Stable-Baselines3 also works with `gymnasium.make("treadmill/Humanoid-v0")` and `make_vec_env`; this class steps all humanoids
in one call.
"""

import numpy as np
from gymnasium.vector import AutoresetMode
from stable_baselines3.common.vec_env import VecEnv

from .vector import HumanoidVectorEnv


class HumanoidVecEnv(VecEnv):
    """`n_envs` humanoids; keyword arguments are those of `HumanoidVectorEnv`. Wrap it in `VecMonitor` to get episode returns."""

    def __init__(self, n_envs, **settings):
        self.env = HumanoidVectorEnv(n_envs, autoreset_mode=AutoresetMode.SAME_STEP, **settings)
        super().__init__(n_envs, self.env.single_observation_space, self.env.single_action_space)
        self.metadata = self.metadata | {"render_fps": self.env.metadata["render_fps"]}
        self._actions = None

    def reset(self):
        """Starts an episode in each environment; seeds given to `seed` are used once."""
        for options in self._options:
            if options:
                raise ValueError(f"unknown reset options {options}; there are none")
        observations, infos = self.env.reset(seed=self._seeds)
        self.reset_infos = self._rows(infos)
        self._reset_seeds()
        self._reset_options()
        return observations

    def step_async(self, actions):
        """Keeps the actions for `step_wait`."""
        self._actions = actions

    def step_wait(self):
        """Steps all environments; where an episode ends, the next one starts at once."""
        observations, rewards, terminations, truncations, infos = self.env.step(self._actions)
        over = terminations | truncations
        rows = self._rows(infos)
        if over.any():
            ends = self._rows(infos["final_info"])
            for index in np.flatnonzero(over):
                self.reset_infos[index] = rows[index]
                rows[index] = ends[index] | {"terminal_observation": infos["final_obs"][index]}
        for row, truncated in zip(rows, (truncations & ~terminations).tolist(), strict=True):
            row["TimeLimit.truncated"] = truncated
        return observations, rewards.astype(np.float32), over, rows

    def _rows(self, infos):
        """Returns the info of each environment as a dictionary."""
        rows = [{} for _ in range(self.num_envs)]
        for name in infos:
            if name.startswith("_") or name in ("final_obs", "final_info"):
                continue
            values = infos[name]
            # Single numbers as Python numbers, several as arrays.
            values = values.tolist() if values.ndim == 1 else values
            for row, value, has_entry in zip(rows, values, infos[f"_{name}"].tolist(), strict=True):
                if has_entry:
                    row[name] = value
        return rows

    def get_images(self):
        """Returns a picture of each environment, with `render_mode="rgb_array"`."""
        return list(self.env.render())

    def close(self):
        """Closes the environments."""
        self.env.close()

    def get_attr(self, attr_name, indices=None):
        """Returns the attribute, which is the same for all environments."""
        value = getattr(self.env, attr_name)
        return [value for _ in self._get_indices(indices)]

    def set_attr(self, attr_name, value, indices=None):
        """Raises an error: settings are fixed at construction."""
        raise AttributeError(f"`{attr_name}` cannot be set: pass it to HumanoidVecEnv as a keyword argument")

    def env_method(self, method_name, *method_args, indices=None, **method_kwargs):
        """Raises an error: single environments are not objects."""
        raise AttributeError(f"`{method_name}` cannot be called: single humanoids of a HumanoidVecEnv have no methods")

    def env_is_wrapped(self, wrapper_class, indices=None):
        """Returns False: no environment is wrapped."""
        return [False for _ in self._get_indices(indices)]
