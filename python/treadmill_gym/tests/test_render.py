"""Tests of pictures and of the window."""

import os
import subprocess
import sys
import unittest
import unittest.mock
from importlib.util import find_spec
from pathlib import Path

import gymnasium
import numpy as np

import treadmill_gym

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "python"))

from treadmill_actor.policy import Policy  # noqa: E402

ID = "treadmill/Humanoid-v0"


def fall(env, steps=60):
    """Steps with zero actions, so that the humanoid falls."""
    for _ in range(steps):
        env.step(np.zeros(17, np.float32))


def right_side(picture):
    """Returns the number of pixels that show right limbs, the only green ones."""
    red, green = (picture[..., channel].astype(int) for channel in (0, 1))
    return int((green - red > 40).sum())


class Pictures(unittest.TestCase):
    def test_a_picture_has_the_requested_size(self):
        env = gymnasium.make(ID, render_mode="rgb_array", width=160, height=120)
        env.reset(seed=1)
        picture = env.render()
        self.assertEqual((picture.shape, picture.dtype), ((120, 160, 3), np.uint8))
        # Sky, floor and body.
        self.assertGreater(len(np.unique(picture.reshape(-1, 3), axis=0)), 100)

    def test_the_picture_depends_on_the_body_only(self):
        env = gymnasium.make(ID, render_mode="rgb_array", width=80, height=60)
        env.reset(seed=1)
        first, again = env.render(), env.render()
        np.testing.assert_array_equal(first, again)
        fall(env)
        self.assertGreater((env.render() != first).any(axis=2).sum(), 80 * 60 // 20)

    def test_the_camera_follows_a_runner(self):
        env = gymnasium.make(ID, observation="compact", render_mode="rgb_array", width=80, height=60)
        observation, info = env.reset(seed=1)
        before = right_side(env.render())
        policy, facts = Policy.from_export((ROOT / "docs/results/policy.safetensors").read_bytes())
        high = np.float32(facts["action"]["high"])
        for _ in range(300):
            means = policy.means(np.float32(observation).reshape(1, -1))[0]
            observation, _, terminated, _, info = env.step(np.clip(means, -1, 1) * high)
            self.assertFalse(terminated)
        self.assertGreater(info["x_position"], 10)
        self.assertGreater(before, 50)
        self.assertGreater(right_side(env.render()), before // 2)

    def test_another_camera_gives_another_picture(self):
        pictures = []
        for camera in (None, (-3.0, 0.0, 1.0)):
            env = gymnasium.make(ID, render_mode="rgb_array", width=80, height=60, camera=camera)
            env.reset(seed=1)
            pictures.append(env.render())
        self.assertFalse(np.array_equal(*pictures))

    def test_a_list_of_pictures_is_gymnasiums(self):
        env = gymnasium.make(ID, render_mode="rgb_array_list", width=32, height=32)
        env.reset(seed=1)
        fall(env, 3)
        self.assertEqual(len(env.render()), 4)

    def test_without_a_mode_there_is_a_warning_and_no_picture(self):
        env = gymnasium.make(ID).unwrapped
        env.reset(seed=1)
        with self.assertWarnsRegex(UserWarning, "render mode"):
            self.assertIsNone(env.render())

    @unittest.skipUnless(hasattr(os, "fork"), "needs fork")
    def test_a_forked_process_renders_too(self):
        code = f"""
import os, gymnasium, treadmill_gym
def picture():
    env = gymnasium.make("{ID}", render_mode="rgb_array", width=64, height=48)
    env.reset(seed=1)
    return env.render().sum()
expected = picture()
child = os.fork()
if child == 0:
    os._exit(0 if picture() == expected else 1)
raise SystemExit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
        # A pool without threads would wait forever.
        self.assertEqual(subprocess.run([sys.executable, "-W", "ignore", "-c", code], timeout=120, check=False).returncode, 0)


@unittest.skipUnless(find_spec("pygame"), "pygame is not installed")
class Windows(unittest.TestCase):
    def setUp(self):
        # The dummy driver draws nothing.
        patch = unittest.mock.patch.dict("os.environ", SDL_VIDEODRIVER="dummy")
        patch.start()
        self.addCleanup(patch.stop)

    def test_steps_are_shown(self):
        import pygame

        env = gymnasium.make(ID, render_mode="human", width=64, height=48)
        env.reset(seed=1)
        shown = pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1)
        like = gymnasium.make(ID, render_mode="rgb_array", width=64, height=48)
        like.reset(seed=1)
        np.testing.assert_array_equal(shown, like.render())
        # Some steps may be skipped, but not all.
        fall(env, 10)
        self.assertFalse(np.array_equal(pygame.surfarray.array3d(pygame.display.get_surface()).swapaxes(0, 1), shown))
        env.close()
        env.close()
        self.assertIsNone(pygame.display.get_surface())

    def test_closing_the_window_ends_it(self):
        import pygame

        env = gymnasium.make(ID, render_mode="human", width=64, height=48)
        env.reset(seed=1)
        pygame.event.post(pygame.event.Event(pygame.QUIT))
        with self.assertRaises(treadmill_gym.WindowClosed):
            fall(env, 10)

    def test_a_missing_display_is_an_error_with_advice(self):
        hidden = {"DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "SDL_VIDEO_DRIVER", "XDG_RUNTIME_DIR"}
        environment = {name: value for name, value in os.environ.items() if name not in hidden}
        code = f'import gymnasium, treadmill_gym; gymnasium.make("{ID}", render_mode="human").reset(seed=1)'
        out = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
        self.assertNotEqual(out.returncode, 0)
        self.assertIn("needs a display", out.stderr.splitlines()[-1])

    def test_missing_pygame_is_an_error_with_advice(self):
        with unittest.mock.patch.dict("sys.modules", pygame=None):
            with self.assertRaisesRegex(gymnasium.error.DependencyNotInstalled, r"treadmill-gym\[human\]"):
                gymnasium.make(ID, render_mode="human")


if __name__ == "__main__":
    unittest.main()
