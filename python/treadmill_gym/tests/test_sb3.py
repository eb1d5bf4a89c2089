"""Tests of Stable-Baselines3's PPO on the humanoid, and of the tutorial's scripts."""

import subprocess
import sys
import tempfile
import unittest
from importlib.util import find_spec
from pathlib import Path

import gymnasium
import numpy as np

import treadmill_gym  # noqa: F401  registers the environment

ID = "treadmill/Humanoid-v0"
#: Heights that hold the nominal start, which noise always misses: the first step of each episode is a fall.
TOO_NARROW = (1.399999, 1.400001)
EXAMPLES = Path(__file__).resolve().parents[2] / "examples/gym"
NEEDS_SB3 = unittest.skipUnless(find_spec("stable_baselines3"), "stable_baselines3 is not installed")
NEEDS_TENSORBOARD = unittest.skipUnless(find_spec("tensorboard"), "tensorboard is not installed")


@NEEDS_SB3
@NEEDS_TENSORBOARD
class Tutorial(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_ppo_trains_saves_loads_and_acts(self):
        from stable_baselines3 import PPO

        env = gymnasium.make(ID)
        model = PPO("MlpPolicy", env, verbose=0, tensorboard_log=str(self.folder / "logs"), seed=1)
        before = {name: weights.clone() for name, weights in model.policy.state_dict().items()}
        model.learn(total_timesteps=4096)
        self.assertEqual(model.num_timesteps, 4096)
        moved = [name for name, weights in model.policy.state_dict().items() if not weights.equal(before[name])]
        self.assertEqual(len(moved), len(before))
        self.assertGreater(np.mean([episode["r"] for episode in model.ep_info_buffer]), 50)
        self.assertTrue(list(self.folder.glob("logs/PPO_1/events.out.tfevents.*")))
        model.save(self.folder / "humanoid")
        loaded = PPO.load(self.folder / "humanoid", env=gymnasium.make(ID))
        observation, _ = env.reset(seed=3)
        action, _ = loaded.predict(observation, deterministic=True)
        np.testing.assert_array_equal(action, model.predict(observation, deterministic=True)[0])
        self.assertTrue(env.action_space.contains(action))

    def script(self, name, *arguments):
        command = [sys.executable, EXAMPLES / name, *arguments]
        out = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(out.returncode, 0, out.stderr)
        return out.stdout

    def test_the_four_scripts(self):
        output = self.script("tutorial_1_random.py", "--episodes", "2")
        self.assertIn("episode 2: return", output)
        self.assertGreater(output.count("reward"), 20)
        output = self.script("tutorial_2_naive.py", "--episodes", "20")
        self.assertIn("preferred action", output)
        output = self.script("tutorial_3_ppo.py", "--steps", "2048", "--model", "one.zip")
        self.assertIn("saved one.zip", output)
        output = self.script("tutorial_3_ppo.py", "--steps", "2048", "--envs", "16", "--model", "many.zip")
        self.assertIn("ep_rew_mean", output)
        for model in ("one.zip", "many.zip"):
            output = self.script("tutorial_4_watch.py", model, "--episodes", "1", "--gif", "walk.gif")
            self.assertIn("wrote walk.gif", output)
            self.assertEqual((self.folder / "walk.gif").read_bytes()[:6], b"GIF89a")


@NEEDS_SB3
class Vectorised(unittest.TestCase):
    def test_results_equal_those_of_single_environments(self):
        from stable_baselines3.common.vec_env import DummyVecEnv

        from treadmill_gym.sb3 import HumanoidVecEnv

        count, random = 3, np.random.default_rng(1)
        ours = HumanoidVecEnv(count, max_episode_steps=20)
        theirs = DummyVecEnv([lambda: gymnasium.make(ID, max_episode_steps=20)] * count)
        ours.seed(5)
        theirs.seed(5)
        np.testing.assert_array_equal(ours.reset(), theirs.reset())
        ends = set()
        for _ in range(80):
            actions = random.uniform(-0.4, 0.4, (count, 17)).astype(np.float32)
            results, expected = ours.step(actions), theirs.step(actions)
            for one, other in zip(results[:3], expected[:3], strict=True):
                np.testing.assert_array_equal(one, other)
                self.assertEqual(one.dtype, other.dtype)
            for one, other in zip(results[3], expected[3], strict=True):
                self.assertEqual(sorted(one), sorted(other))
                for name, value in other.items():
                    np.testing.assert_array_equal(one[name], value, name)
                if "terminal_observation" in other:
                    ends.add(other["TimeLimit.truncated"])
            for one, other in zip(ours.reset_infos, theirs.reset_infos, strict=True):
                self.assertEqual(sorted(one), sorted(other))
        self.assertEqual(ends, {True, False})

    def test_a_fall_in_the_last_step_is_no_time_limit(self):
        from treadmill_gym.sb3 import HumanoidVecEnv

        env = HumanoidVecEnv(2, max_episode_steps=1, healthy_z_range=TOO_NARROW)
        env.reset()
        _, _, over, infos = env.step(np.zeros((2, 17), np.float32))
        self.assertEqual((over.tolist(), [info["TimeLimit.truncated"] for info in infos]), ([True] * 2, [False] * 2))

    def test_ppo_trains_on_it(self):
        from stable_baselines3 import PPO
        from stable_baselines3.common.vec_env import VecMonitor

        from treadmill_gym.sb3 import HumanoidVecEnv

        model = PPO("MlpPolicy", VecMonitor(HumanoidVecEnv(8)), n_steps=128, seed=1)
        model.learn(total_timesteps=1024)
        self.assertGreater(len(model.ep_info_buffer), 10)

    def test_pictures_are_tiled(self):
        from treadmill_gym.sb3 import HumanoidVecEnv

        env = HumanoidVecEnv(4, render_mode="rgb_array", width=32, height=32)
        env.reset()
        self.assertEqual(env.render().shape, (64, 64, 3))


if __name__ == "__main__":
    unittest.main()
