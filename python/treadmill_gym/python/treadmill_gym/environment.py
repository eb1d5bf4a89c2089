"""One humanoid: `gymnasium.make("treadmill/Humanoid-v0")`."""

import gymnasium
from gymnasium.utils import EzPickle

from . import spaces
from ._native import Humanoid, Renderer
from .window import Window


class HumanoidEnv(gymnasium.Env, EzPickle):
    """Task of Gymnasium's Humanoid-v5, simulated by Treadmill.

    `render_mode` is `"rgb_array"` or `"human"`; `width` and `height` are in pixels; `camera` is x, y and z from the body to the
    camera in m. Other keyword arguments: `observation`, `task`, `xml_file`, `control_step_s`, `substeps`, `self_collision`,
    and the weights, ranges and flags of Gymnasium's Humanoid-v5. README.md has a table.

    Raises `TypeError` for an unknown keyword and `ValueError` for an invalid value.
    """

    metadata = {"render_modes": ["human", "rgb_array"], "render_fps": spaces.RENDER_FPS}

    def __init__(self, render_mode=None, width=480, height=480, camera=None, **settings):
        EzPickle.__init__(self, render_mode, width, height, camera, **settings)
        spaces.check_render_mode(render_mode, self.metadata["render_modes"])
        self.render_mode = render_mode
        self._native = Humanoid(settings)
        self.metadata = self.metadata | {"render_fps": spaces.render_fps(self._native)}
        self._renderer = Renderer(width, height, camera)
        self._window = Window(width, height, self.metadata["render_fps"]) if render_mode == "human" else None
        self.observation_space = spaces.observation_space(self._native)
        self.action_space = spaces.action_space(self._native)
        self.observation_structure = spaces.observation_structure(self._native, **settings)

    @property
    def dt(self):
        """Duration of a step in s."""
        return self._native.control_step_s

    def reset(self, *, seed=None, options=None):
        """Starts an episode: every position and velocity within `reset_noise_scale` of its nominal value."""
        super().reset(seed=seed)
        spaces.check_options(options)
        observation, info = self._native.reset(int(self.np_random.integers(spaces.SEEDS)))
        if self._window is not None:
            self.render()
        return observation, info

    def step(self, action):
        """Does a control step; the motors receive `action` clipped to its range, as in MuJoCo."""
        action = spaces.as_actions(action, self.action_space.shape, "action")
        observation, reward, terminated, info = self._native.step(action)
        if self._window is not None and self._window.is_due():
            self.render()
        # `gymnasium.make` adds a wrapper for time limits.
        return observation, reward, terminated, False, info

    def render(self):
        """Returns a picture `[height, width, 3]`; with `render_mode="human"`, shows it and returns None."""
        if self.render_mode is None:
            gymnasium.logger.warn('nothing is rendered without a render mode, as in make(..., render_mode="rgb_array")')
            return None
        picture = self._renderer.picture(self._native)
        if self._window is None:
            return picture
        self._window.show(picture)
        return None

    def close(self):
        """Closes the window, if there is one."""
        # Gymnasium also closes environments whose constructor failed.
        if getattr(self, "_window", None) is not None:
            self._window.close()
