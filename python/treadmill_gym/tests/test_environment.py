"""One humanoid: `python -m unittest discover -s python/treadmill_gym/tests`, with the package installed."""

import pickle
import subprocess
import sys
import unittest
import unittest.mock
import warnings
from importlib.util import find_spec

import gymnasium
import numpy as np
from gymnasium.utils.env_checker import check_env

import treadmill_gym  # noqa: F401  registers the environment

ID = "treadmill/Humanoid-v0"

#: Minimal trunk on one driven leg.
HOPPER = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="trunk" pos="0 0 0.9">
      <freejoint/>
      <geom name="chest" type="box" size="0.1 0.1 0.2"/>
      <body name="leg" pos="0 0 -0.2">
        <joint name="hip" axis="0 1 0" range="-1 1" damping="1" armature="0.1"/>
        <geom name="leg" type="capsule" fromto="0 0 0 0 0 -0.6" size="0.05"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor name="hip" joint="hip" gear="20" ctrlrange="-0.5 1"/></actuator>
</mujoco>"""


def play(env, steps, seed):
    """Plays fixed random actions and returns observations, rewards, terminations and infos."""
    random = np.random.default_rng(7)
    observation, info = env.reset(seed=seed)
    results = [(observation, 0.0, False, info)]
    for _ in range(steps):
        action = random.uniform(-0.4, 0.4, env.action_space.shape).astype(np.float32)
        observation, reward, terminated, _, info = env.step(action)
        results.append((observation, reward, terminated, info))
    return results


class Registered(unittest.TestCase):
    def test_a_module_in_the_name_is_enough(self):
        code = f'import gymnasium; print(gymnasium.make("treadmill_gym:{ID}").observation_space.shape)'
        out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        self.assertEqual(out.stdout.strip(), "(348,)")

    def test_make_adds_the_time_limit(self):
        env = gymnasium.make(ID, terminate_when_unhealthy=False)
        env.reset(seed=1)
        for step in range(1, 1001):
            *_, terminated, truncated, _ = env.step(np.zeros(17, np.float32))
            self.assertEqual((terminated, truncated), (False, step == 1000))

    def test_a_shorter_time_limit_is_gymnasiums_own_keyword(self):
        env = gymnasium.make(ID, max_episode_steps=3, terminate_when_unhealthy=False)
        env.reset(seed=1)
        self.assertEqual([env.step(np.zeros(17))[3] for _ in range(3)], [False, False, True])


class Checked(unittest.TestCase):
    def check(self, **keywords):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            check_env(gymnasium.make(ID, **keywords).unwrapped)
        # Gymnasium's own humanoid gets these warnings too: about unbounded observations and the range of actions.
        texts = [str(warning.message) for warning in caught]
        self.assertEqual([text for text in texts if "infinity" not in text and "normalized" not in text], [])

    def test_gymnasiums_checker_has_no_other_warnings(self):
        # The dummy driver draws nothing.
        with unittest.mock.patch.dict("os.environ", SDL_VIDEODRIVER="dummy"):
            self.check()
            self.check(observation="compact", task="humanoid-v4")
            self.check(observation="gymnasium-v4", render_mode="rgb_array")


class Spaces(unittest.TestCase):
    def test_sizes_of_observations(self):
        sizes = {"gymnasium-v5": 348, "gymnasium-v4": 376, "compact": 45}
        for observation, size in sizes.items():
            env = gymnasium.make(ID, observation=observation)
            self.assertEqual(env.observation_space.shape, (size,))
            self.assertEqual(sum(list(env.unwrapped.observation_structure.values())[1:]), size)
        env = gymnasium.make(ID, include_cfrc_ext_in_observation=False, exclude_current_positions_from_observation=False)
        self.assertEqual(env.observation_space.shape, (348 - 78 + 2,))

    @unittest.skipUnless(find_spec("mujoco"), "MuJoCo is not installed")
    def test_spaces_and_infos_equal_those_of_gymnasiums_humanoid(self):
        theirs, ours = gymnasium.make("Humanoid-v5"), gymnasium.make(ID)
        self.assertEqual(ours.observation_space, theirs.observation_space)
        self.assertEqual(ours.action_space, theirs.action_space)
        self.assertEqual(ours.unwrapped.observation_structure, theirs.unwrapped.observation_structure)
        self.assertAlmostEqual(ours.unwrapped.dt, theirs.unwrapped.dt)
        self.assertEqual(ours.metadata["render_fps"], theirs.metadata["render_fps"])
        (one, one_info), (other, other_info) = ours.reset(seed=1), theirs.reset(seed=1)
        self.assertEqual(list(one_info), list(other_info))
        self.assertEqual(one.dtype, other.dtype)
        # Both start within 0.01 of the same pose; masses and inertias are the same.
        np.testing.assert_allclose(one[:45], other[:45], atol=0.021)
        np.testing.assert_allclose(one[45:175], other[45:175], atol=0.1)
        one, other = ours.step(np.zeros(17, np.float32)), theirs.step(np.zeros(17, np.float32))
        self.assertEqual(list(one[4]), list(other[4]))
        self.assertAlmostEqual(one[1], other[1], delta=0.5)
        for name, value in other[4].items():
            self.assertEqual(np.shape(one[4][name]), np.shape(value), name)


class Seeded(unittest.TestCase):
    def test_equal_seeds_give_equal_episodes(self):
        env, other = gymnasium.make(ID), gymnasium.make(ID)
        play(other, 5, seed=9)
        for one, two in zip(play(env, 40, seed=3), play(other, 40, seed=3), strict=True):
            np.testing.assert_array_equal(one[0], two[0])
            self.assertEqual(one[1:3], two[1:3])

    def test_other_seeds_and_further_episodes_differ(self):
        env = gymnasium.make(ID)
        first, _ = env.reset(seed=3)
        second, _ = env.reset()
        third, _ = env.reset(seed=4)
        self.assertFalse(np.array_equal(first, second) or np.array_equal(first, third))
        env.reset(seed=3)
        np.testing.assert_array_equal(env.reset()[0], second)

    def test_the_generator_is_gymnasiums(self):
        env = gymnasium.make(ID).unwrapped
        env.reset(seed=3)
        self.assertEqual(env.np_random_seed, 3)
        state = env.np_random.bit_generator.state
        env.np_random = np.random.default_rng(5)
        one, _ = env.reset()
        env.np_random = np.random.default_rng(5)
        np.testing.assert_array_equal(env.reset()[0], one)
        self.assertNotEqual(env.np_random.bit_generator.state, state)

    def test_a_pickled_environment_has_its_settings(self):
        env = pickle.loads(pickle.dumps(gymnasium.make(ID, observation="compact").unwrapped))
        self.assertEqual(env.reset(seed=1)[0].shape, (45,))

    def test_reset_options_are_refused_by_name(self):
        with self.assertRaisesRegex(ValueError, "`speed` is not known"):
            gymnasium.make(ID).reset(options={"speed": 3})


class Stepped(unittest.TestCase):
    def test_the_reward_is_the_sum_of_its_parts(self):
        for _, reward, _, info in play(gymnasium.make(ID), 20, seed=1)[1:]:
            parts = ("reward_survive", "reward_forward", "reward_ctrl", "reward_contact")
            self.assertAlmostEqual(reward, sum(info[name] for name in parts), places=5)

    def test_weights_are_used(self):
        keywords = {"forward_reward_weight": 0, "ctrl_cost_weight": 0, "contact_cost_weight": 0, "healthy_reward": 3}
        env = gymnasium.make(ID, **keywords)
        env.reset(seed=1)
        self.assertEqual(env.step(np.ones(17))[1], 3.0)

    def test_actions_are_clipped_to_their_range(self):
        ends = []
        for size in (0.4, 100.0):
            env = gymnasium.make(ID)
            env.reset(seed=1)
            ends.append(env.step(np.full(17, size, np.float32))[0])
        np.testing.assert_array_equal(*ends)

    def test_bad_actions_are_refused_and_change_nothing(self):
        env, other = gymnasium.make(ID), gymnasium.make(ID)
        env.reset(seed=1)
        other.reset(seed=1)
        bad = np.zeros(17, np.float32)
        bad[3] = np.nan
        for action, why in [
            (bad, r"action\[3\] is NaN"),
            (np.zeros(16), r"shape \(16,\), but must have \(17,\)"),
            (np.zeros((1, 17)), "shape"),
            (0.1, "shape"),
            ("walk", "cannot be read as numbers"),
            (None, "action"),
            (np.full(17, 1e300), "inf"),
        ]:
            with self.assertRaisesRegex(ValueError, why), np.errstate(over="ignore"):
                env.unwrapped.step(action)
        np.testing.assert_array_equal(env.step(np.zeros(17))[0], other.step(np.zeros(17))[0])

    def test_returned_observations_are_copies(self):
        results = play(gymnasium.make(ID), 3, seed=1)
        kept = results[1][0].copy()
        results[2][0][:] = 0
        np.testing.assert_array_equal(results[1][0], kept)


class Keywords(unittest.TestCase):
    def refuse(self, why, kind=ValueError, **keywords):
        for make in (gymnasium.make, lambda name, **keywords: gymnasium.make_vec(name, 2, **keywords)):
            with self.assertRaisesRegex(kind, why):
                make(ID, **keywords)

    def test_each_is_refused_by_name_and_value(self):
        self.refuse("unknown keyword argument `helthy_reward`.*healthy_reward", TypeError, helthy_reward=1.0)
        self.refuse("healthy_reward is 'much', but must be a number", healthy_reward="much")
        self.refuse("healthy_reward is nan, but must be a finite number", healthy_reward=float("nan"))
        self.refuse("healthy_z_range.*but must be", healthy_z_range=(2.0, 1.0))
        self.refuse("healthy_z_range is 1.0, but must be two numbers", healthy_z_range=1.0)
        self.refuse("starts with its root at 1.4 m", healthy_z_range=(1.5, 2.0))
        self.refuse("reset_noise_scale is -1, but must be 0 to 1", reset_noise_scale=-1)
        self.refuse("substeps is 0, but must be 1 to 1000", substeps=0)
        self.refuse("substeps is 2.5", substeps=2.5)
        self.refuse("control_step_s is 0.2, but must be 0.001 to 0.1", control_step_s=0.2)
        self.refuse("control_step_s is 'fast', but must be a number", control_step_s="fast")
        self.refuse("unknown keyword argument `solver_iterations`", TypeError, solver_iterations=1)
        self.refuse("observation is 'all', but must be .*gymnasium-v5", observation="all")
        self.refuse("task is 5, but must be a text", task=5)
        self.refuse("self_collision is 'no', but must be true or false", self_collision="no")
        self.refuse("frame_skip is 4, but must be 5.*control_step_s.*substeps", frame_skip=4)
        self.refuse("include_cvel_in_observation", observation="gymnasium-v4", include_cvel_in_observation=False)
        self.refuse("width is 4, but must be a whole number between 16 and 4096", width=4)
        self.refuse("height is -3, but must be a whole number", height=-3)
        self.refuse("camera is .0.0, 0.0, 5.0., but must be None, or x, y and z", camera=(0.0, 0.0, 5.0))
        self.refuse("camera is 'front'", camera="front")
        self.refuse("render_mode is 'depth_array'", render_mode="depth_array")
        self.refuse("nowhere.xml", FileNotFoundError, xml_file="nowhere.xml")
        self.refuse("xml_file is 3", xml_file=3)

    def test_gymnasiums_own_values_are_accepted(self):
        env = gymnasium.make(ID, xml_file="humanoid.xml", frame_skip=5, contact_cost_range=(-np.inf, 10.0))
        self.assertEqual(env.observation_space.shape, (348,))

    def test_the_control_step_sets_dt_and_pictures_per_second(self):
        for keywords, dt, fps in (({}, 0.015, 67), ({"control_step_s": 0.02}, 0.02, 50)):
            env = gymnasium.make(ID, **keywords)
            self.assertEqual((env.unwrapped.dt, env.unwrapped.metadata["render_fps"]), (dt, fps))
            envs = gymnasium.make_vec(ID, 2, **keywords)
            self.assertEqual((envs.dt, envs.metadata["render_fps"]), (dt, fps))

    def test_controls_beyond_their_range_cost_what_they_cost_in_gymnasium(self):
        env = gymnasium.make(ID)
        env.reset(seed=0)
        action = np.array([(-1) ** motor * 0.1 * motor for motor in range(17)], np.float32)
        info = env.unwrapped.step(action)[4]
        self.assertAlmostEqual(info["reward_ctrl"], -1.496000005394221, 9)

    def test_a_robot_from_a_file(self):
        import tempfile
        from pathlib import Path

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "hopper.xml"
            path.write_text(HOPPER)
            self.refuse("healthy_z_range=.0.63, 1.26.", xml_file=path)
            env = gymnasium.make(ID, xml_file=path, observation="compact", healthy_z_range=(0.5, 1.2))
            self.assertEqual(env.observation_space.shape, (13,))
            np.testing.assert_array_equal([env.action_space.low, env.action_space.high], [[-0.5], [1.0]])
            path.write_text(HOPPER.replace('damping="1"', 'frictionloss="-0.1"'))
            self.refuse("hopper.xml.*frictionloss", xml_file=str(path), healthy_z_range=(0.5, 1.2))


if __name__ == "__main__":
    unittest.main()
