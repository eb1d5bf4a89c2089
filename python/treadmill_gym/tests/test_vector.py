"""Tests of several humanoids at once, compared with Gymnasium's SyncVectorEnv of single ones."""

import unittest

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

import treadmill_gym  # noqa: F401  registers the environment

ID = "treadmill/Humanoid-v0"
#: Heights that hold the nominal start, which noise always misses: the first step of each episode is a fall.
TOO_NARROW = (1.399999, 1.400001)


def both(count, mode=AutoresetMode.NEXT_STEP, threads=2, **keywords):
    """Returns our vector environment and Gymnasium's, which wraps single environments."""
    ours = gymnasium.make_vec(ID, count, autoreset_mode=mode, threads=threads, **keywords)
    theirs = gymnasium.make_vec(ID, count, vectorization_mode="sync", vector_kwargs={"autoreset_mode": mode}, **keywords)
    return ours, theirs


class Alike(unittest.TestCase):
    def assert_alike(self, one, other, where="infos"):
        self.assertEqual(sorted(one), sorted(other), where)
        for name, value in other.items():
            place = f"{where}[{name!r}]"
            if isinstance(value, dict):
                self.assert_alike(one[name], value, place)
            elif value.dtype == object:
                for row, expected in zip(one[name], value, strict=True):
                    np.testing.assert_array_equal(row, expected, place)
            else:
                np.testing.assert_array_equal(one[name], value, place)
                self.assertEqual(one[name].dtype, value.dtype, place)

    def play(self, mode, steps, **keywords):
        ours, theirs = both(5, mode, **keywords)
        random = np.random.default_rng(1)
        observations, infos = ours.reset(seed=11)
        expected, expected_infos = theirs.reset(seed=11)
        np.testing.assert_array_equal(observations, expected)
        self.assert_alike(infos, expected_infos)
        ends = 0
        for _ in range(steps):
            actions = random.uniform(-0.4, 0.4, ours.action_space.shape).astype(np.float32)
            results, expected = ours.step(actions), theirs.step(actions)
            for one, other in zip(results[:4], expected[:4], strict=True):
                np.testing.assert_array_equal(one, other)
                self.assertEqual(one.dtype, other.dtype)
            self.assert_alike(results[4], expected[4])
            over = results[2] | results[3]
            ends += over.sum()
            if mode is AutoresetMode.DISABLED and over.any():
                observations, infos = ours.reset(options={"reset_mask": over})
                expected, expected_infos = theirs.reset(options={"reset_mask": over.copy()})
                np.testing.assert_array_equal(observations, expected)
                self.assert_alike(infos, expected_infos)
        self.assertGreater(ends, 10)
        self.assertEqual(ours.np_random_seed, theirs.np_random_seed)

    def test_in_every_autoreset_mode(self):
        for mode in AutoresetMode:
            with self.subTest(mode=mode):
                self.play(mode, 120)

    def test_with_other_settings(self):
        self.play(AutoresetMode.SAME_STEP, 120, observation="compact", task="humanoid-v4", max_episode_steps=15)
        self.play(AutoresetMode.NEXT_STEP, 120, observation="gymnasium-v4", max_episode_steps=7)
        # All episodes end at once.
        self.play(AutoresetMode.NEXT_STEP, 30, terminate_when_unhealthy=False, max_episode_steps=5)
        self.play(AutoresetMode.SAME_STEP, 30, terminate_when_unhealthy=False, max_episode_steps=5)

    def test_a_fall_in_the_last_step_is_terminated_and_truncated(self):
        for mode in AutoresetMode:
            with self.subTest(mode=mode):
                self.play(mode, 30, healthy_z_range=TOO_NARROW, max_episode_steps=1)
                self.play(mode, 30, healthy_z_range=TOO_NARROW, max_episode_steps=2)
        env = gymnasium.make_vec(ID, 2, healthy_z_range=TOO_NARROW, max_episode_steps=1)
        env.reset(seed=1)
        results = env.step(np.zeros((2, 17), np.float32))
        self.assertEqual((results[2].tolist(), results[3].tolist()), ([True] * 2, [True] * 2))

    def test_spaces_and_metadata(self):
        ours, theirs = both(3)
        for name in ("observation_space", "action_space", "single_observation_space", "single_action_space", "num_envs"):
            self.assertEqual(getattr(ours, name), getattr(theirs, name), name)
        for mode in AutoresetMode:
            self.assertIs(both(2, mode)[0].metadata["autoreset_mode"], mode)
        self.assertIn("Humanoid-v0", repr(ours))


class Vector(unittest.TestCase):
    def test_the_module_in_the_name_works_in_other_processes(self):
        name = f"treadmill_gym:{ID}"
        theirs = gymnasium.make_vec(name, 2, vectorization_mode="async", vector_kwargs={"context": "spawn"})
        ours = gymnasium.make_vec(name, 2)
        np.testing.assert_array_equal(ours.reset(seed=1)[0], theirs.reset(seed=1)[0])
        theirs.close()

    def test_results_do_not_depend_on_threads(self):
        actions = np.random.default_rng(2).uniform(-0.4, 0.4, (60, 7, 17)).astype(np.float32)
        ends = []
        for threads in (1, 2, 3):
            env = gymnasium.make_vec(ID, 7, threads=threads)
            self.assertEqual(env.unwrapped.threads, threads)
            env.reset(seed=5)
            ends.append(np.stack([env.step(action)[0] for action in actions]))
        np.testing.assert_array_equal(ends[0], ends[1])
        np.testing.assert_array_equal(ends[0], ends[2])

    def test_one_seed_each(self):
        env = gymnasium.make_vec(ID, 3)
        one, _ = env.reset(seed=[4, None, 4])
        np.testing.assert_array_equal(one[0], one[2])
        self.assertFalse(np.array_equal(one[0], one[1]))
        with self.assertRaisesRegex(ValueError, "2 entries.*3 environments"):
            env.reset(seed=[1, 2])

    def test_a_time_limit_truncates(self):
        env = gymnasium.make_vec(ID, 2, max_episode_steps=4)
        env.reset(seed=1)
        for step in range(1, 5):
            _, _, terminations, truncations, _ = env.step(np.zeros((2, 17), np.float32))
            self.assertEqual((terminations.tolist(), truncations.tolist()), ([False] * 2, [step == 4] * 2))

    def test_without_a_time_limit(self):
        for limit in (-1, None):
            env = gymnasium.make_vec(ID, 1, max_episode_steps=limit, terminate_when_unhealthy=False)
            env.reset(seed=1)
            self.assertFalse(any(env.step(np.zeros((1, 17)))[3].any() for _ in range(1002)))

    def test_invalid_arguments_are_refused(self):
        env = gymnasium.make_vec(ID, 2)
        env.reset(seed=1)
        before, _ = env.reset(seed=1)
        bad = np.zeros((2, 17), np.float32)
        bad[1, 4] = np.inf
        with self.assertRaisesRegex(ValueError, r"actions\[1\]\[4\] is inf"):
            env.step(bad)
        with self.assertRaisesRegex(ValueError, r"shape \(17,\), but must have \(2, 17\)"):
            env.step(np.zeros(17))
        with self.assertRaisesRegex(ValueError, "reset_mask"):
            env.reset(options={"reset_mask": np.zeros(2, bool)})
        for count in (0, -1, 2.5, "two", 10**6):
            with self.assertRaisesRegex(ValueError, "num_envs is .*between 1 and 65536"):
                gymnasium.make_vec(ID, count)
        with self.assertRaisesRegex(ValueError, "threads is 5000"):
            gymnasium.make_vec(ID, 2, threads=5000)
        with self.assertRaisesRegex(ValueError, "max_episode_steps is -5"):
            gymnasium.make_vec(ID, 2, max_episode_steps=-5)
        with self.assertRaisesRegex(ValueError, "Sometimes"):
            gymnasium.make_vec(ID, 2, autoreset_mode="Sometimes")
        waiting = gymnasium.make_vec(ID, 1, autoreset_mode=AutoresetMode.DISABLED, max_episode_steps=1)
        waiting.reset(seed=1)
        waiting.step(np.zeros((1, 17)))
        with self.assertRaisesRegex(ValueError, r"\[0\] are over.*reset_mask"):
            waiting.step(np.zeros((1, 17)))
        np.testing.assert_array_equal(env.reset(seed=1)[0], before)

    def test_pictures_of_each(self):
        env = gymnasium.make_vec(ID, 2, render_mode="rgb_array", width=64, height=48)
        env.reset(seed=1)
        self.assertEqual([picture.shape for picture in env.render()], [(48, 64, 3)] * 2)
        with self.assertRaisesRegex(ValueError, "render mode"):
            gymnasium.make_vec(ID, 2).render()


if __name__ == "__main__":
    unittest.main()
