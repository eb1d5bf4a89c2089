"""Tests without a learner or a simulator: `python -m unittest discover -s python/tests`."""

import json
import queue
import sys
import threading
import unittest
from pathlib import Path
from unittest import mock

import gymnasium
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from treadmill_actor import schema  # noqa: E402
from treadmill_actor.policy import HALF_LN_TAU, Policy, PolicyError, checksum, read_safetensors  # noqa: E402
from treadmill_actor.rollout import Collector, Environments  # noqa: E402
from treadmill_actor.settings import Settings  # noqa: E402
from treadmill_actor.task import TaskError, describe  # noqa: E402
from treadmill_actor.worker import Worker  # noqa: E402

GOLDEN = Path(__file__).with_name("golden.json")


class Count(gymnasium.Env):
    """Observes its step count and a constant; terminates at step `fall`, is truncated at step `limit`."""

    def __init__(self, fall=None, limit=None):
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (2,))
        self.action_space = gymnasium.spaces.Box(np.array([-3.0, 0.0]), np.array([1.0, 2.0]), dtype=np.float64)
        self.fall, self.limit, self.seen = fall, limit, []

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.count = 0
        return np.array([0.0, 7.0], np.float32), {"x_position": 1.0}

    def step(self, action):
        self.count += 1
        self.seen.append(action)
        observation = np.array([self.count, 7.0], np.float32)
        return observation, 2.0, self.count == self.fall, self.count == self.limit, {"x_position": 1.0 + self.count}


def linear(action=2):
    """Returns a policy whose mean is the first observation entry, for each action."""
    weight = np.zeros((action, 2), np.float32)
    weight[:, 0] = 1.0
    tensors = {"actor.0.weight": weight, "actor.0.bias": np.zeros(action, np.float32), "log_std": np.zeros(action, np.float32)}
    return Policy(tensors, np.zeros(2), np.ones(2), 10.0)


def config(rollout="", more=""):
    """Returns a configuration as a learner sends it, with keys of a section added."""
    return f"""
        [learner]
        mode = "sync"
        [rollout]
        fragment_steps = 32
        max_in_flight = 0
        {rollout}
        [bus]
        receipt_timeout_ms = 60000
        policy_poll_ms = 10000
        stats_every_ms = 2000
        {more}
    """


class SettingsTest(unittest.TestCase):
    def test_unknown_keys_and_sections_are_ignored(self):
        text = config('compression = "zstd"', "jitter = 0.5\n[weather]\nwind_mps = 3.0\n[weather.deep]\nx = 1")
        read = Settings.of(schema.PolicyBundle(config_toml=f"later = 1\n{text}", wire_version=2, wire_version_min=1))
        self.assertEqual(read, Settings(32, 1, 60.0, 10.0, 2.0, ""))
        asynchronous = Settings.of(schema.PolicyBundle(config_toml=config().replace('"sync"', '"async"')))
        self.assertEqual(asynchronous.fragments_in_flight, 2)

    def test_unknown_values_of_known_keys_are_refused_by_name(self):
        cases = [
            ('mode = "sync"', 'mode = "hybrid"', "`learner.mode` is 'hybrid'"),
            ("max_in_flight = 0", "max_in_flight = 3", "`rollout.max_in_flight` is 3"),
            ("max_in_flight = 0", "max_in_flight = true", "`rollout.max_in_flight` is True"),
            ("max_in_flight = 0", "max_in_flight = 1.0", "`rollout.max_in_flight` is 1.0"),
            ("max_in_flight = 0", "", "`rollout.max_in_flight` is None"),
            ("fragment_steps = 32", "fragment_steps = 5000", "`rollout.fragment_steps` is 5000; allowed: 0 to 4096"),
            ("policy_poll_ms = 10000", 'policy_poll_ms = "auto"', "`bus.policy_poll_ms` is 'auto'"),
        ]
        for known, future, message in cases:
            with self.assertRaisesRegex(TaskError, message):
                Settings.of(schema.PolicyBundle(config_toml=config().replace(known, future)))

    def test_newer_wire_version_is_refused_by_name(self):
        needed = schema.WIRE_VERSION + 1
        bundle = schema.PolicyBundle(run="gym", config_toml=config(), wire_version_min=needed)
        with self.assertRaisesRegex(TaskError, f"run `gym` needs actors of wire version {needed}, this actor has"):
            Settings.of(bundle)

    def test_receipt_then_bundle_then_configuration_set_the_length_of_a_fragment(self):
        def steps(configured, receipt, bundle):
            text = config().replace("fragment_steps = 32", f"fragment_steps = {configured}")
            return Settings.of(schema.PolicyBundle(config_toml=text)).next_fragment_steps(receipt, bundle)

        self.assertEqual([steps(32, 8, 16), steps(32, 0, 16), steps(32, 0, 0), steps(0, 0, 0)], [8, 16, 32, 128])
        self.assertEqual(steps(0, 2**32 - 1, 16), 4096)


class PolicyTest(unittest.TestCase):
    def test_mean_and_log_prob_of_one_layer(self):
        # mean = clip((3 - 1) * 2, 3) = 3; log p(4 | 3, 1) = -1/2 - ln 2 pi / 2 for each of two actions.
        policy = linear()
        policy.mean, policy.inverse_std, policy.clip = np.float32([1, 0]), np.float32([2, 1]), np.float32(3)
        means = policy.means(np.float32([[3, 0]]))
        np.testing.assert_allclose(means, [[3, 3]])
        np.testing.assert_allclose(policy.log_prob(np.float32([[4, 4]]), means), [-1 - 2 * HALF_LN_TAU], rtol=1e-6)

    def test_log_std_is_clipped(self):
        policy = linear()
        tensors = {"actor.0.weight": policy.layers[0][0].T, "actor.0.bias": np.zeros(2, np.float32)}
        wild = Policy({**tensors, "log_std": np.float32([-50, 50])}, np.zeros(2), np.ones(2), 10.0)
        np.testing.assert_allclose(wild.std, np.exp([-5, 2]), rtol=1e-6)

    def test_policy_matches_rust(self):
        golden = json.loads(GOLDEN.read_text())
        policy, facts = Policy.from_export(bytes.fromhex(golden["export"]))
        observations, normals = np.float32(golden["observations"]), np.float32(golden["normals"])
        np.testing.assert_allclose(policy.means(observations), golden["means"], atol=1e-6)
        actions, log_probs = policy.sample(observations, normals)
        np.testing.assert_allclose(actions, golden["actions"], atol=1e-6)
        np.testing.assert_allclose(log_probs, golden["log_probs"], atol=1e-5)
        self.assertEqual(checksum(b"treadmill"), golden["checksum"])
        self.assertEqual(len(facts["action"]["low"]), policy.action_size)

    def test_invalid_weights_raise(self):
        for bad in (b"", b"12345678", b"\xff" * 64):
            with self.assertRaises(PolicyError):
                read_safetensors(bad)
        with self.assertRaises(PolicyError):
            Policy({"log_std": np.zeros(1, np.float32)}, np.zeros(2), np.ones(2), 10.0)


class TaskTest(unittest.TestCase):
    def test_actions_are_scaled_to_the_box(self):
        task = describe(Count(), "test/Count-v0")
        commands = task.to_env(np.float32([[-1, -1], [0, 0], [1, 1], [5, -5]]))
        np.testing.assert_allclose(commands, [[-3, 0], [-1, 1], [1, 2], [1, 0]])
        message = schema.TaskRegistration()
        task.fill(message.task)
        self.assertEqual((list(message.task.action_low), message.task.observation_size), ([-3.0, 0.0], 2))

    def test_actions_stay_inside_the_box(self):
        env = Count()
        actions = np.float32([[-1, 1], [-0.3, 0.7], [9, 0]])
        for dtype, largest in ((np.float16, "6e4"), (np.float32, "3.4e38"), (np.float64, "1e308"), (np.longdouble, "1e308")):
            for high in ("0.1", "1", largest):
                env.action_space = gymnasium.spaces.Box(-dtype(high), dtype(high), (2,), dtype)
                commands = describe(env, "test/Count-v0").to_env(actions)
                self.assertTrue(all(map(env.action_space.contains, commands)), (commands, env.action_space))
                shares = np.clip(np.float64(actions), -1, 1)
                np.testing.assert_allclose(np.float64(commands / dtype(high)), shares, rtol=max(np.finfo(dtype).eps, 1e-15))

    def test_unsupported_space_and_name_raise(self):
        env = Count()
        env.action_space = gymnasium.spaces.Discrete(3)
        with self.assertRaisesRegex(TaskError, "action space"):
            describe(env, "test/Count-v0")
        with self.assertRaisesRegex(TaskError, "not a task name"):
            describe(Count(), "a b")

    def test_a_mirror_of_the_environment_is_registered(self):
        env = Count()
        self.assertEqual(describe(env, "test/Count-v0").observation_mirror, [])
        env.mirror = (np.array([1]), [1])
        message = schema.TaskRegistration().task
        describe(env, "test/Count-v0").fill(message)
        self.assertEqual((list(message.observation_mirror), list(message.action_mirror)), ([1], [1]))
        env.mirror = ([0.5], [1])
        with self.assertRaisesRegex(TaskError, "`mirror` of `test/Count-v0`.*whole numbers"):
            describe(env, "test/Count-v0")

    def test_unbounded_entries_use_plus_minus_one(self):
        env = Count()
        env.action_space = gymnasium.spaces.Box(-np.inf, np.inf, (2,))
        task = describe(env, "test/Count-v0")
        np.testing.assert_allclose(task.to_env(np.float32([[0.5, 9]])), [[0.5, 1]])

    def test_entries_with_one_end_stay_inside_it(self):
        env = Count()
        env.action_space = gymnasium.spaces.Box(np.float32([3, -np.inf]), np.float32([np.inf, 5]))
        task = describe(env, "test/Count-v0")
        np.testing.assert_allclose(task.to_env(np.float32([[-1, -1], [9, 9]])), [[3, 3], [5, 5]])


class RolloutTest(unittest.TestCase):
    def collect(self, steps, **ends):
        environments = Environments(lambda: Count(**ends), "test/Count-v0", 2, 1)
        collector = Collector(environments, "run", "py", 5, 9, 3)
        fragment, episodes = collector.collect(linear(), schema.PolicyVersion(incarnation=1, number=2), 0, steps)
        return schema.Fragment.FromString(fragment), episodes

    def test_fragments_differ_in_length_and_count_steps(self):
        collector = Collector(Environments(Count, "test/Count-v0", 2, 1), "run", "py", 5, 9, 3)
        lengths = [3, 1, 4]
        fragments = [
            schema.Fragment.FromString(collector.collect(linear(), schema.PolicyVersion(), 0, steps)[0]) for steps in lengths
        ]
        self.assertEqual([fragment.steps for fragment in fragments], lengths)
        # Two environments: 6, then 2 and 8 more.
        self.assertEqual([fragment.env_steps for fragment in fragments], [6, 8, 16])
        self.assertEqual([len(fragment.rewards) for fragment in fragments], [24, 8, 32])
        self.assertTrue(all(0 < fragment.collect_s < 60 for fragment in fragments))
        self.assertTrue(all(fragment.wire_version == schema.WIRE_VERSION for fragment in fragments))
        self.assertTrue(all(fragment.physics_version == 0 for fragment in fragments))

    def test_arrays_are_time_major(self):
        fragment, _ = self.collect(3)
        self.assertEqual((fragment.sequence, fragment.actor_incarnation, fragment.version.number), (1, 5, 2))
        observations = np.frombuffer(fragment.observations, "<f4").reshape(3, 2, 2)
        np.testing.assert_allclose(observations[:, 0, 0], [0, 1, 2])
        self.assertEqual(len(fragment.actions), 4 * 3 * 2 * 2)
        self.assertEqual((fragment.flags, len(fragment.rewards)), (bytes(6), 24))
        # No episode ended, so each environment has a last observation.
        np.testing.assert_allclose(np.frombuffer(fragment.last_observations, "<f4"), [3, 7, 3, 7])

    def test_log_probs_use_unclipped_actions(self):
        fragment, _ = self.collect(2)
        actions = np.frombuffer(fragment.actions, "<f4").reshape(4, 2)
        means = np.frombuffer(fragment.observations, "<f4").reshape(4, 2)[:, :1]
        expected = np.sum(-0.5 * (actions - means) ** 2 - HALF_LN_TAU, axis=1)
        np.testing.assert_allclose(np.frombuffer(fragment.log_probs, "<f4"), expected, atol=1e-5)

    def test_terminated_episode_has_no_last_observation(self):
        fragment, episodes = self.collect(3, fall=3)
        self.assertEqual(fragment.flags, bytes([0, 0, 0, 0, 1, 1]))
        self.assertEqual(fragment.last_observations, b"")
        self.assertEqual([episode["cause"] for episode in episodes], ["terminated"] * 2)
        self.assertEqual((fragment.episodes[0].return_sum, fragment.episodes[0].distance_m), (6.0, 3.0))

    def test_truncated_episode_keeps_its_last_observation(self):
        fragment, episodes = self.collect(3, limit=2)
        self.assertEqual(fragment.flags, bytes([0, 0, 2, 2, 0, 0]))
        last = np.frombuffer(fragment.last_observations, "<f4").reshape(4, 2)[:, 0]
        np.testing.assert_allclose(last, [2, 2, 1, 1])
        self.assertEqual([episode["cause"] for episode in episodes], ["time_limit"] * 2)

    def test_non_finite_observation_ends_the_episode(self):
        environments = Environments(Count, "test/Count-v0", 1, 1)
        # Fragments have single precision.
        for observation, reward in ((np.nan, 1.0), (1e39, 1.0), (1.0, np.inf), (1.0, -1e40)):
            environments.envs[0].step = lambda action: (np.array([observation, 7.0]), reward, False, False, {})
            rewards, flags, cut_off, episodes = environments.step(np.zeros((1, 2), np.float32))
            self.assertEqual((rewards[0], flags[0], cut_off, episodes[0]["cause"]), (0.0, 1, {}, "non_finite"))
            self.assertTrue(np.isfinite(environments.observations).all())

    def test_shapes_beside_the_space_are_named(self):
        environments = Environments(Count, "test/Count-v0", 1, 1)
        step = lambda observation, reward: setattr(environments.envs[0], "step", lambda _: (observation, reward, False, False, {}))  # noqa: E731
        step(np.zeros(3), 1.0)
        with self.assertRaisesRegex(TaskError, r"`test/Count-v0` gives an observation of shape \(3,\), but its .* shape \(2,\)"):
            environments.step(np.zeros((1, 2), np.float32))
        step(np.zeros(2), np.zeros(2))
        with self.assertRaisesRegex(TaskError, r"gives a reward of shape \(2,\); it must be one number"):
            environments.step(np.zeros((1, 2), np.float32))
        step(np.zeros((1, 2)), np.array([3.0]))
        self.assertEqual(environments.step(np.zeros((1, 2), np.float32))[0][0], 3.0)
        environments.envs[0].reset = lambda seed=None: (np.zeros(()), {})
        with self.assertRaisesRegex(TaskError, r"of shape \(\), but"):
            environments.reset()

    def test_terms_of_the_reward_are_means_over_the_fragment(self):
        environments = Environments(Count, "test/Count-v0", 2, 1)
        for number, env in enumerate(environments.envs):
            infos = {"reward_forward": 3.0 * number, "reward_ctrl": np.float32(-0.5), "reward_Bad": 1.0, "reward_text": "x"}
            more = {"reward_endless": np.inf} | {f"reward_{index}": 1 for index in range(100)}
            env.step = lambda action, info=infos | more: (np.array([1.0, 7.0]), 2.0, False, False, info)
        collector = Collector(environments, "run", "py", 5, 9, 3)
        for _ in range(2):
            fragment, _ = collector.collect(linear(), schema.PolicyVersion(), 0, 4)
            terms = [(term.name, term.mean) for term in schema.Fragment.FromString(fragment).reward_terms]
            self.assertEqual(terms[:3], [("forward", 1.5), ("ctrl", -0.5), ("0", 1.0)])
            self.assertEqual(len(terms), 63, "64 at most, and one is not finite")

    def test_distance_is_from_the_first_to_the_last_position(self):
        def distance(at_reset, at_step):
            environments = Environments(lambda: Count(fall=3), "test/Count-v0", 1, 1)
            [env] = environments.envs
            first, step = env.reset()[0], env.step
            env.reset = lambda seed=None: (first, at_reset)
            env.step = lambda action: (*step(action)[:4], at_step)
            environments.reset()
            env.count, positions = 0, iter((5.0, 6.0, 8.0))
            for position in positions:
                at_step.update({key: make(position) for key, make in kinds.items()})
                episodes = environments.step(np.zeros((1, 2), np.float32))[3]
            return episodes[0]["distance_m"]

        kinds = {"x_position": float}
        self.assertEqual(distance({"x_position": 4}, {}), 4.0)
        # Gymnasium's older MuJoCo environments have none after a reset.
        self.assertEqual(distance({}, {}), 3.0)
        kinds = {"x_position": lambda position: np.array([position], np.float32)}
        self.assertEqual(distance({"x_position": np.array(4.0)}, {}), 4.0)
        kinds = {"x_position": lambda position: np.array([position, 0.0]), 7: float, ("reward_x",): float}
        self.assertEqual(distance({"x_position": "here"}, {}), 0.0)

    def test_a_stop_drops_the_fragment(self):
        stopping, outbox = threading.Event(), queue.Queue()
        environments = Environments(Count, "test/Count-v0", 2, 1)
        worker = Worker(None, "run", "py", environments, 1, stopping)
        worker.uploader = mock.Mock(**{"settled_through.return_value": 0})
        policies = mock.Mock(current=(linear(), schema.PolicyVersion()), fragment_steps=0)
        policies.run_changed.is_set.return_value = False
        settings = Settings.of(schema.PolicyBundle(config_toml=config()))
        collector = Collector(environments, "run", "py", 5, 9, 3)
        [_, last] = environments.envs
        step = last.step
        last.step = lambda action: last.count == 2 and stopping.set() or step(action)
        self.assertTrue(worker._simulate(collector, settings, policies, threading.Semaphore(1), outbox, None, None))
        self.assertEqual([len(env.seen) for env in environments.envs], [3, 3])
        self.assertTrue(outbox.empty())
        worker.uploader.produce.assert_not_called()

    def test_new_run_begins_with_new_episodes(self):
        environments = Environments(Count, "test/Count-v0", 2, 1)
        environments.step(np.zeros((2, 2), np.float32))
        environments.reset()
        self.assertEqual((environments.returns, environments.lengths), ([0.0, 0.0], [0, 0]))
        np.testing.assert_allclose(environments.observations[:, 0], [0, 0])

    def test_fragment_is_shortened_to_the_limit(self):
        environments = Environments(lambda: Count(limit=1), "test/Count-v0", 2, 1)
        collector = Collector(environments, "run", "py", 5, 9, 3)
        collector.steps_max = 7
        fragment, _ = collector.collect(linear(), schema.PolicyVersion(), 0, 4096)
        self.assertEqual(schema.Fragment.FromString(fragment).steps, 7)
        # Every step ends an episode here, which is the largest fragment of so many steps.
        with mock.patch("treadmill_actor.rollout.FRAGMENT_BYTES_MAX", 16_000):
            small = Collector(environments, "run", "py", 5, 9, 3)
        fragment, episodes = small.collect(linear(), schema.PolicyVersion(), 0, 4096)
        self.assertEqual((len(episodes), small.steps_max > 10), (2 * small.steps_max, True))
        self.assertLessEqual(len(fragment), 16_000)

    def test_too_many_environments_raise(self):
        environments = Environments(Count, "test/Count-v0", 2, 1)
        with mock.patch("treadmill_actor.rollout.FRAGMENT_BYTES_MAX", 12_300), self.assertRaisesRegex(TaskError, "fewer --envs"):
            Collector(environments, "run", "py", 5, 9, 3)


if __name__ == "__main__":
    unittest.main()
