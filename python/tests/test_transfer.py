"""Tests of the player of exported policies, with a small robot and a network whose action is known."""

import contextlib
import io
import json
import math
import os
import subprocess
import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy

try:
    import mujoco
    import onnx  # noqa: F401: the samples need it
    import onnxruntime  # noqa: F401: the player needs it
except ImportError as why:
    raise unittest.SkipTest(f"{why.name} is not installed") from why

from treadmill_transfer import cli, errors
from treadmill_transfer.commands import DrawnCommands, FileCommands, Pushes, read_commands
from treadmill_transfer.contract import Policy, TransferError, read_contract
from treadmill_transfer.controller import Controller, height_scan, phase
from treadmill_transfer.ground import Ground
from treadmill_transfer.play import play_episode, summary
from treadmill_transfer.robot import Robot, heading_velocity
from treadmill_transfer.trace import TOLERANCES, compare

from transfer_samples import FLOOR, ROBOT, RobotCase, WIDTH, contract, network


class TransferTest(RobotCase):
    def setUp(self):
        super().setUp()
        # The newest frame's command moves the arms: x the first joint, y the second.
        self.onnx = network(str(self.folder / "policy.onnx"), [(WIDTH + 6, 0, 1.0), (WIDTH + 7, 1, -50.0)])

    def run_cli(self, *arguments):
        """Returns exit code, standard output and standard error of a command line."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = cli.main([str(argument) for argument in arguments])
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def test_observation_has_the_frames_of_the_contract(self):
        policy = Policy(self.onnx)
        robot, controller = Robot(self.model, policy.contract), Controller(policy)
        robot.reset()
        half = math.pi / 12.0
        # Pitched forwards by 30°, turning, with moved arms: left first in the file, second in the contract.
        robot.set_state(
            numpy.array([0, 0, 1, math.cos(half), 0, math.sin(half), 0, 0.4, 0.3, 0.5]),
            numpy.array([1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6]),
        )
        command = numpy.array([0.5, -0.25, 0.125])
        first = controller.observe(robot, command)
        expected = [0.1, 0.2, 0.3, 0.5, 0.0, -math.cos(2 * half), *command, 0.3, 0.3, 6.0, 4.0, 0.0, 0.0, 0.0, 1.0]
        numpy.testing.assert_allclose(first, expected * 2, atol=1e-12)
        targets = controller.taken(numpy.array([1.0, 9.0]))
        numpy.testing.assert_allclose(targets, [0.2 + 0.1, 0.1 + 4.0 * 0.2])
        second = controller.observe(robot, command)
        numpy.testing.assert_allclose(second[:WIDTH], expected, atol=1e-12)
        angle = 2.0 * math.pi * 0.02 / 0.8
        numpy.testing.assert_allclose(second[WIDTH + 13 :], [1.0, 4.0, math.sin(angle), math.cos(angle)])
        self.assertEqual(controller.entry_name(WIDTH + 12), "joint_vel_rel[left_arm]")
        self.assertEqual(controller.entry_name(1), "base_ang_vel[1], 1 frames ago")
        self.assertAlmostEqual(phase(policy.contract, 10, 0)[0], 1.0)
        policy.contract.gait_rests_below, policy.contract.gait_rests_after_s = 0.1, 0.04
        controller.reset()
        shown, still = [], numpy.array([0.05, 0.05, 0.06])
        for command in (still, still, still, still, numpy.array([0.06, 0.06, 0.06]), still):
            shown.append(bool(controller.observe(robot, command)[-2:].any()))
            controller.taken(numpy.zeros(2))
        self.assertEqual(shown, [True, True, False, False, True, True])

    def test_a_push_wakes_a_gait_at_rest(self):
        policy = Policy(self.onnx)
        contract = policy.contract
        contract.gait_rests_below, contract.gait_rests_after_s = 0.1, 0.04
        contract.gait_rests_rate_radps, contract.gait_rests_settled_s, contract.gait_rests_settled_rate_radps = 1.5, 0.1, 0.3
        robot, controller = Robot(self.model, contract), Controller(policy)
        robot.reset()
        shown = []
        # It rests from the third step on, and is settled from the eighth on.
        for rate_radps in [0.0, 0.0, 1.4, 1.4, 1.6, 0.0, 0.0, 0.0, 0.29, 0.29, 0.29, 0.29, 0.29, 0.29, 0.31, 0.0, 0.0]:
            robot.set_state(numpy.array([0, 0, 1, 1, 0, 0, 0, 0, 0, 0]), numpy.array([0, 0, 0, rate_radps, 0, 0, 0, 0, 0]))
            shown.append(bool(controller.observe(robot, numpy.zeros(3))[-2:].any()))
            controller.taken(numpy.zeros(2))
        self.assertEqual("".join("s" if phase else "-" for phase in shown), "ss--ss-------" + "-ss-")

    def test_velocity_is_seen_in_the_heading_frame(self):
        cos, sin = math.cos(0.3), math.sin(0.3)
        # Turned left by 90°, then pitched about its own left by 0.3.
        turned = numpy.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        rotation = turned @ numpy.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
        found = heading_velocity(rotation, numpy.array([-0.2, 0.7, 5.0]), numpy.array([1.0, 2.0, 3.0]))
        numpy.testing.assert_allclose(found, [0.7, 0.2, -sin + 3.0 * cos])

    def test_windows_begin_a_second_after_a_change_and_contain_none(self):
        self.assertEqual(errors.windows([0, 170], 330, 0.02), [(50, 100), (100, 150), (220, 270), (270, 320)])
        self.assertEqual(errors.windows([0, 99, 198], 290, 0.02), [])

    def test_errors_equal_values_by_hand(self):
        velocities, commands = numpy.zeros((150, 3)), numpy.tile([0.4, 0.0, 0.2], (150, 1))
        # Before the first window nothing counts. In a window means count, so that swaying cancels.
        velocities[:50] = 9.0
        velocities[50:100:2], velocities[51:100:2] = [0.7, 0.4, -0.1], [0.7, 0.4, 0.3]
        velocities[100:150] = [0.4, -0.1, 0.2]
        found = errors.window_errors(velocities, commands, [0], 0.02)
        numpy.testing.assert_allclose(found, [[0.5, 0.1], [0.1, 0.0]], atol=1e-12)

    def test_a_robot_that_is_to_stand_is_measured_after_two_seconds(self):
        commands = numpy.zeros((400, 3))
        commands[150:200] = [0.1, 0.0, 0.0]
        spans = errors.rests(commands, [0, 150, 200], 0.02)
        self.assertEqual(spans, [(100, 150), (300, 400)])
        # A heading turns the robot without a new command.
        commands[340:350] = [0.0, 0.0, 0.2]
        self.assertEqual(errors.rests(commands, [0, 150, 200], 0.02), [(100, 150), (300, 340), (350, 400)])
        places, rates, standing = numpy.zeros((400, 2)), numpy.zeros((400, 2)), numpy.ones((400, 2), dtype=bool)
        places[:100], rates[:100], standing[:99] = 9.0, 9.0, False
        places[120], rates[130], standing[140], standing[320, 1] = [0.3, 0.4], [3.0, 1.0], False, False
        found = errors.still(places, rates, standing, spans)
        numpy.testing.assert_allclose(found, [[0.5, 50, 5.0, 2], [0.0, 100, 0.0, 1]])

    def test_a_broken_sensor_is_named(self):
        policy = Policy(self.onnx)
        controller = Controller(policy)
        observation = numpy.zeros(policy.contract.width)
        observation[WIDTH + 1] = math.nan
        with self.assertRaisesRegex(TransferError, r"base_ang_vel\[1\] of the observation is not finite in step 1"):
            controller.act(observation)

    def test_commands_are_resampled_within_their_ranges(self):
        whole = read_contract(json.dumps(contract()))
        schedule, changes, stands, seen = DrawnCommands(whole, numpy.random.default_rng(3)), [], 0, []
        for step in range(20_000):
            command, is_new = schedule.at(step, 0.4)
            if is_new:
                changes.append(step)
                stands += not command.any()
            seen.append(command)
        low, high = numpy.min(seen, axis=0), numpy.max(seen, axis=0)
        self.assertTrue((low >= whole.ranges[:, 0]).all() and (high <= whole.ranges[:, 1]).all())
        self.assertTrue((high - low > 0.8 * (whole.ranges[:, 1] - whole.ranges[:, 0])).all())
        held = numpy.diff(changes)
        self.assertTrue(held.min() >= 50 and held.max() <= 100)
        self.assertTrue(0.1 < stands / len(changes) < 0.3)

    def test_a_heading_is_turned_to_the_short_way_round(self):
        commands = {**contract()["commands"], "heading_share": 1.0, "standing_share": 0.0}
        schedule = DrawnCommands(read_contract(json.dumps(contract(commands=commands))), numpy.random.default_rng(1))
        schedule.at(0, 0.0)
        schedule._heading_rad = -3.0
        command, is_new = schedule.at(1, 3.0)
        self.assertFalse(is_new)
        self.assertAlmostEqual(command[2], 0.5 * (2.0 * math.pi - 6.0))

    def test_pushes_come_at_the_contracts_intervals(self):
        whole = read_contract(json.dumps(contract()))
        pushes = Pushes(whole, numpy.random.default_rng(5))
        found = [(step, push) for step in range(2000) if (push := pushes.before(step)) is not None]
        gaps = numpy.diff([0, *(step for step, _ in found)])
        self.assertTrue(len(found) > 35 and gaps.min() >= 25 and gaps.max() <= 50)
        speeds = [numpy.hypot(*push) for _, push in found]
        self.assertTrue(min(speeds) >= 0.1 and max(speeds) <= 0.2)
        self.assertIsNone(Pushes(read_contract(json.dumps(contract(push_mps=[0.0, 0.0]))), numpy.random.default_rng(5)).before(25))

    def test_commands_of_a_file_begin_at_their_times(self):
        rows = FileCommands([(0.1, numpy.array([1.0, 0.0, 0.0])), (0.2, numpy.array([1.0, 0.0, 0.0]))], 0.02)
        found = [rows.at(step, 0.0) for step in range(12)]
        self.assertEqual([step for step, (_, is_new) in enumerate(found) if is_new], [0, 5])
        self.assertEqual([command[0] for command, _ in found], [0.0] * 5 + [1.0] * 7)

    def test_a_file_of_commands_may_have_comments(self):
        path = self.folder / "commands.csv"
        path.write_text("\ufefftime_s,vx,vy,yaw_rate\n# first\n0,1,0,0  # forwards\n\n2.5, 0,0,-0.5\n", encoding="utf-8")
        rows = [(time_s, list(command)) for time_s, command in read_commands(path)]
        self.assertEqual(rows, [(0.0, [1.0, 0.0, 0.0]), (2.5, [0.0, 0.0, -0.5])])

    def test_a_state_that_diverges_is_a_fall(self):
        policy = Policy(self.onnx)
        robot, controller = Robot(self.model, policy.contract), Controller(policy)

        def throw(velocity_mps):
            robot.data.qvel[0] = 1e12

        # Without it MuJoCo writes a log into the present folder.
        mujoco.set_mju_user_warning(lambda _: None)
        self.addCleanup(mujoco.set_mju_user_warning, None)
        with mock.patch.object(robot, "push", throw):
            episode = play_episode(robot, controller, 150, 1, 0)
        self.assertTrue(episode.fell)
        self.assertLess(episode.steps, 150)

    def test_an_episode_is_played_and_ends_with_a_fall(self):
        policy = Policy(self.onnx)
        robot, controller = Robot(self.model, policy.contract), Controller(policy)
        rows = [(0.0, numpy.array([0.5, 0.02, 0.0]))]
        episode = play_episode(robot, controller, 150, 1, 0, rows, pushes=False)
        self.assertEqual((episode.steps, episode.fell, len(episode.errors)), (150, False, 2))
        # It stands where it is, so its error is the command, and the arms are at their targets.
        self.assertAlmostEqual(episode.errors[0][0], math.hypot(0.5, 0.02), delta=0.01)
        numpy.testing.assert_allclose(controller.action, [0.5, -1.0], rtol=1e-6)
        numpy.testing.assert_allclose(robot.angles_rad, [0.2 + 0.05, 0.1 - 0.2], atol=0.1)
        again = play_episode(robot, controller, 150, 1, 0, rows, pushes=False)
        self.assertEqual(again.distance_m, episode.distance_m)
        pushed = [play_episode(robot, controller, 150, 1, 0) for _ in range(2)]
        self.assertEqual(pushed[0].distance_m, pushed[1].distance_m)
        self.assertNotEqual(pushed[0].distance_m, play_episode(robot, controller, 150, 2, 0).distance_m)
        still = summary([play_episode(robot, controller, 150, 1, 0, [(0.0, numpy.zeros(3))], pushes=False)], 0.02)
        self.assertEqual(still["standing_lifts_per_s"], 0.0)
        self.assertTrue(still["standing_drift_m"] < 0.01 and still["standing_hinge_radps"] < 0.5, still)
        policy.contract.fall_height_m = 0.3
        fallen = play_episode(robot, controller, 150, 1, 0)
        self.assertEqual((fallen.steps, json.dumps(fallen.fell)), (1, "true"))
        both = summary([episode, fallen], 0.02)
        self.assertIsNone(both["standing_drift_m"])
        self.assertEqual((both["episodes"], both["falls"], both["length_mean"], both["windows"]), (2, 1, 75.5, 2))
        self.assertAlmostEqual(both["velocity_error_mps"], episode.errors[:, 0].mean())
        self.assertIsNone(summary([fallen], 0.02)["velocity_error_mps"])

    def test_a_ground_replaces_the_floor(self):
        heights = numpy.array([[0.5, 0.5, 0.9], [0.5, 0.5, 0.9]])
        ground = Ground(numpy.array([-1.0, 3.0]), numpy.array([-2.0, 2.0]), heights, numpy.array([[0.0, 0.0, 0.5, math.pi / 2]]))
        for text in (ROBOT.replace("FLOOR", FLOOR), ROBOT.replace("FLOOR", "")):
            self.model.write_text(text)
            robot = Robot(self.model, read_contract(json.dumps(contract())), ground=ground)
            robot.reset(ground.starts[0])
            self.assertAlmostEqual(robot.position_m[2], 0.7)
            self.assertAlmostEqual(robot.ground_m(), 0.5)
            self.assertAlmostEqual(robot.heading_rad, math.pi / 2)
            self.assertFalse(robot.has_fallen())
            robot.step(robot.contract.joints.default_rad)
            self.assertAlmostEqual(robot.position_m[2], 0.7, delta=0.005)
            # Points half a metre apart along the heading, limited to 0.2 m.
            robot.reset((1.0, 0.0, 0.5, 0.0))
            numpy.testing.assert_allclose(height_scan(robot.contract, robot), [0.0, 0.0, 0.1], atol=1e-6)
            robot.position_m[2] -= 0.15
            numpy.testing.assert_allclose(height_scan(robot.contract, robot), [0.15, 0.15, 0.2], atol=1e-6)
            robot.position_m[0] = 2.0
            self.assertAlmostEqual(robot.ground_m(), 0.7, delta=1e-6)
            # The three points are at 0.5, 0.5 and 0.6 m.
            robot.contract.fall_height_m = 0.14
            robot.position_m[0], robot.position_m[2] = 1.0, 0.65
            self.assertTrue(robot.has_fallen())
            robot.position_m[2] = 0.68
            self.assertFalse(robot.has_fallen())

    def test_an_episode_ends_without_a_fall_near_the_edge_of_a_ground(self):
        ground = Ground(numpy.array([-4.0, 2.0]), numpy.array([-2.0, 2.0]), numpy.zeros((2, 2)), numpy.zeros((1, 4)))
        policy = Policy(self.onnx)
        robot, controller = Robot(self.model, policy.contract, ground=ground), Controller(policy)
        for start, at_edge in [((0.9, 0.9), False), ((-2.9, -0.9), False), ((1.1, 0.0), True), ((0.0, -1.1), True), ((-3.1, 0.0), True)]:
            robot.reset((*start, 0.0, 0.0))
            self.assertEqual(robot.is_at_edge(), at_edge, start)
        ended = play_episode(robot, controller, 150, 1, 0, pushes=False, start=(1.1, 0.0, 0.0, 0.0))
        self.assertEqual((ended.steps, ended.fell), (1, False))
        self.assertEqual(play_episode(robot, controller, 20, 1, 0, pushes=False).steps, 20)

    def test_a_trace_is_compared_boundary_by_boundary(self):
        policy = Policy(self.onnx)
        robot, controller = Robot(self.model, policy.contract), Controller(policy)
        robot.reset()
        lines, command = [], numpy.array([0.5, 0.02, 0.0])
        for _ in range(4):
            qpos, qvel = robot.state()
            robot.set_state(qpos, qvel)
            observation = controller.observe(robot, command)
            action = controller.act(observation)
            robot.step(controller.taken(action))
            torque = numpy.zeros(3)
            torque[robot.policy_hinges] = robot.torques_nm()
            # The critic's part of an observation follows, and quaternions have two signs.
            qpos[3:7] *= -1.0
            lines.append({
                "observation": numpy.append(observation, 7.0), "action": action / 4.0, "episode": 1,
                "command": command, "qpos": qpos, "qvel": qvel, "torque": torque,
            })  # fmt: skip
        first, largest = compare(robot, controller, lines, TOLERANCES)
        self.assertIsNone(first)
        self.assertTrue(max(largest.values()) < 1e-6, largest)
        for key, index, boundary, entry in [
            ("observation", WIDTH + 1, "observation", "base_ang_vel[1]"),
            ("action", 1, "action", "left_arm"),
            ("torque", 2, "torque", "right_arm"),
        ]:
            changed = [dict(line) for line in lines]
            changed[2][key] = lines[2][key].copy()
            changed[2][key][index] += 50.0 if key == "torque" else 0.01
            first, _ = compare(robot, controller, changed, TOLERANCES)
            self.assertEqual((first["boundary"], first["step"], first["entry"]), (boundary, 3, entry))
        changed = [dict(line) for line in lines]
        changed[3]["qvel"] = lines[3]["qvel"] + numpy.eye(9)[6] * 20.0
        first, _ = compare(robot, controller, changed, TOLERANCES)
        self.assertEqual((first["boundary"], first["step"], first["entry"]), ("state", 3, "rate of left_arm"))
        self.assertAlmostEqual(first["tolerance"], TOLERANCES["state"] / 0.02)

        path = self.folder / "trace.jsonl"

        def as_text(line):
            return json.dumps({key: numpy.asarray(value).tolist() for key, value in line.items()})

        path.write_text("\n".join(map(as_text, changed)))
        command_line = [self.onnx, "--model", self.model, "--trace", path]
        code, out, _ = self.run_cli(*command_line)
        self.assertEqual(code, 1)
        self.assertIn("first difference: state at step 3 of episode 1, rate of left_arm", out)
        code, out, _ = self.run_cli(*command_line, "--tolerance", "state=1", "--json")
        # The changed rate is also seen in the next observation.
        self.assertEqual((code, json.loads(out)["first_difference"]["boundary"]), (1, "observation"))
        self.assertEqual(self.run_cli(*command_line, "--tolerance", "100")[0], 0)
        path.write_text(as_text({**lines[0], "qpos": lines[0]["qpos"][1:]}))
        code, _, err = self.run_cli(*command_line)
        self.assertEqual(code, 2)
        self.assertIn("trace.jsonl`, line 1: `qpos` has 9 numbers, but the model needs 10", err)

    def test_the_last_line_is_one_json_object(self):
        code, out, err = self.run_cli(self.onnx, "--model", self.model, "--episodes", 2, "--seconds", 3, "--json")
        self.assertEqual((code, err), (0, ""))
        result = json.loads(out.splitlines()[-1])
        wanted = {"episodes", "falls", "velocity_error_mps", "yaw_rate_error_radps", "distance_mean_m", "length_mean", "standing_drift_m"}
        self.assertTrue(wanted <= set(result))
        self.assertEqual((result["episodes"], result["length_mean"]), (2, 150.0))
        code, out, _ = self.run_cli(self.onnx, "--model", self.model, "--episodes", 2, "--seconds", 3)
        self.assertEqual(code, 0)
        self.assertIn("velocity error", out)

    @unittest.skipUnless(sys.platform == "linux", "other systems always have a display")
    def test_a_missing_display_is_named_in_one_line(self):
        # Without the check, the viewer ends the process.
        command = [sys.executable, "-m", "treadmill_transfer", self.onnx, "--model", str(self.model), "--view", "--json"]
        environment = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment["PYTHONPATH"] = str(Path(cli.__file__).parents[1])
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), done.stderr)
        self.assertRegex(done.stderr, "^error: --view cannot open a window .*DISPLAY.*; leave it out")

    def test_bad_input_is_named_in_one_line(self):
        def refused(*parts, policy=self.onnx, model=self.model, more=()):
            code, out, err = self.run_cli(policy, "--model", model, "--episodes", 1, "--seconds", 0.1, *more)
            self.assertEqual((code, out, err.count("\n")), (2, "", 1), err)
            for part in parts:
                self.assertIn(part, err)

        refused("nowhere.onnx", "no such file", "treadmill export", policy="nowhere.onnx")
        refused("robot.xml", "not an ONNX model", policy=self.model)
        foreign = network(str(self.folder / "foreign.onnx"), [], metadata={"a": "b"})
        refused("foreign.onnx", "has no contract", policy=foreign)
        network(foreign, [], metadata={"treadmill.contract": json.dumps(contract(format=2))})
        refused("foreign.onnx", "`format` is 2", policy=foreign)
        network(foreign, [], metadata={"treadmill.contract": json.dumps(contract(action_scale=[1.0]))})
        refused("foreign.onnx", "`action_scale` is not a list of 2", policy=foreign)
        network(foreign, [], metadata={"treadmill.contract": json.dumps(contract(observation=[{"name": "eyes", "size": 17}]))})
        refused("`eyes`", policy=foreign)
        refused("missing.xml", model="missing.xml")
        self.model.write_text(ROBOT.replace("FLOOR", FLOOR).replace("right_arm", "right_hand"))
        self.assertRaises(ValueError, mujoco.MjModel.from_xml_string, "<mujoco")
        refused("robot.xml", "has no joint `right_arm`", "left_arm, tail, right_hand")
        self.model.write_text(ROBOT.replace("FLOOR", FLOOR))
        commands = self.folder / "commands.csv"
        refused("commands.csv", more=("--commands", commands))
        commands.write_text("time_s,vx,vy,yaw_rate\n0,0,0,0\n1,2,x,4\n")
        refused("commands.csv", "line 3", "1,2,x,4", more=("--commands", commands))
        refused("--timestep 0.003", "0.02", more=("--timestep", 0.003))
        ground = self.folder / "ground.json"
        ground.write_text('{"x_m": [0, 1]}')
        refused("ground.json", "'y_m'", more=("--ground", ground))


if __name__ == "__main__":
    unittest.main()
