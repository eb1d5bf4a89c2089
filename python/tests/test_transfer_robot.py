"""Tests of the robot that the player of exported policies builds from a model file and a contract."""

import json
import math
import unittest

import numpy

try:
    import mujoco
    import onnx  # noqa: F401: the samples need it
except ImportError as why:
    raise unittest.SkipTest(f"{why.name} is not installed") from why

from treadmill_transfer.contract import TransferError, read_contract
from treadmill_transfer.robot import Robot, read_model, substeps

from transfer_samples import FLOOR, ROBOT, RobotCase, contract


class RobotTest(RobotCase):
    def test_servos_are_those_of_the_contract(self):
        robot = Robot(self.model, read_contract(json.dumps(contract())))
        model = robot.model
        self.assertEqual([model.actuator(index).name for index in range(model.nu)], ["right_arm", "left_arm", "tail"])
        self.assertEqual((robot.substeps, model.opt.timestep), (5, 0.004))
        self.assertEqual(model.dof_armature[model.joint("tail").dofadr[0]], 0.03)
        # Targets beyond reach: the limit of torque. At rest in the default pose: no torque.
        robot.reset()
        numpy.testing.assert_allclose(robot.data.actuator_force, 0.0, atol=1e-12)
        robot.data.ctrl[:] = [9.0, 0.2, 0.0]
        numpy.testing.assert_allclose(robot.torques_nm(), [5.0, 30.0 * 0.1], rtol=1e-9)
        self.assertAlmostEqual(robot.data.actuator_force[2], -10.0 * 0.3)
        robot.data.qvel[robot.model.joint("left_arm").dofadr[0]] = 0.5
        self.assertAlmostEqual(robot.torques_nm()[1], 30.0 * 0.1 - 2.0 * 0.5)

    def test_time_steps_divide_the_control_step(self):
        self.assertEqual(substeps(0.02, 0.004), (5, 0.004))
        self.assertEqual(substeps(0.02, 0.003), (7, 0.02 / 7))
        self.assertEqual(substeps(0.02, 0.05), (1, 0.02))
        self.assertEqual(substeps(0.02, 0.005, 0.002), (10, 0.002))

    def test_a_base_that_faces_backwards_is_turned(self):
        # The policy knows a base whose x axis is the file's -y axis.
        half = math.sqrt(0.5)
        turned = {**contract(), "base_turn_wxyz": [half, 0.0, 0.0, -half], "default_base_orientation_wxyz": [1.0, 0.0, 0.0, 0.0]}
        robot = Robot(self.model, read_contract(json.dumps(turned)))
        robot.reset()
        numpy.testing.assert_allclose(robot.rotation, numpy.eye(3), atol=1e-12)
        self.assertAlmostEqual(robot.heading_rad, 0.0)
        # In the file's own frame, the base is turned to the left by 90°.
        numpy.testing.assert_allclose(robot.data.qpos[3:7], [half, 0.0, 0.0, half], atol=1e-12)
        state = numpy.array([0, 0, 1, half, half, 0, 0, 0.4, 0.3, 0.5]), numpy.array([1, 2, 3, 0.1, 0.2, 0.3, 4, 5, 6])
        robot.set_state(*state)
        for found, given in zip(robot.state(), state):
            numpy.testing.assert_allclose(found, given, atol=1e-12)
        numpy.testing.assert_allclose(robot.angular_radps, [0.1, 0.2, 0.3], atol=1e-12)
        # 0.1 rad/s about the policy's x axis is -0.1 rad/s about the file's y axis, and 0.2 about y the same about x.
        numpy.testing.assert_allclose(robot.data.qvel[3:6], [0.2, -0.1, 0.3], atol=1e-12)

    def test_excluded_bodies_do_not_touch(self):
        bodies = [mujoco.MjModel.from_xml_path(str(self.model)).body(index).name for index in (1, 2)]
        excluding = Robot(self.model, read_contract(json.dumps({**contract(), "excluded_bodies": [bodies, bodies]})))
        self.assertEqual(excluding.model.nexclude, 1)
        # MuJoCo lets a listed pair touch whatever is excluded.
        listed = '<contact><pair geom1="trunk_box" geom2="left_bar"/></contact></mujoco>'
        text = self.model.read_text().replace('<geom type="box"', '<geom name="trunk_box" type="box"', 1)
        text = text.replace('<geom type="capsule"', '<geom name="left_bar" type="capsule"', 1).replace("</mujoco>", listed)
        self.model.write_text(text)
        self.assertEqual(Robot(self.model, read_contract(json.dumps(contract()))).model.npair, 1)
        excluding = Robot(self.model, read_contract(json.dumps({**contract(), "excluded_bodies": [["base", "left"]]})))
        self.assertEqual((excluding.model.npair, excluding.model.nexclude), (0, 1))
        with self.assertRaisesRegex(TransferError, "excluded_bodies"):
            read_contract(json.dumps({**contract(), "excluded_bodies": [["trunk"]]}))

    def test_rotors_of_the_file_s_actuators_stay(self):
        if not hasattr(mujoco.MjSpec().add_actuator(), "armature"):
            self.skipTest("this MuJoCo knows no rotors of actuators")
        joint = mujoco.MjModel.from_xml_path(str(self.model)).joint("left_arm")
        motor = '<motor joint="left_arm" gear="3" damping="0.1 0.2" armature="0.01"/>'
        self.model.write_text(self.model.read_text().replace('<motor joint="left_arm"/>', motor))
        spec = read_model(self.model)
        numpy.testing.assert_allclose(spec.joint("left_arm").damping, [joint.damping[0] + 0.9, 1.8, 0.0])
        self.assertAlmostEqual(spec.joint("left_arm").armature, joint.armature[0] + 0.09)

    def test_a_pair_may_name_the_floor_of_the_scene(self):
        pair = '<contact><pair geom1="trunk_box" geom2="floor" friction="0.3 0.3"/></contact></mujoco>'
        text = ROBOT.replace("FLOOR", "").replace('<geom type="box"', '<geom name="trunk_box" type="box"', 1)
        self.model.write_text(text.replace("</mujoco>", pair))
        robot = Robot(self.model, read_contract(json.dumps({**contract(), "excluded_bodies": [["base", "left"]]})))
        self.assertEqual((robot.model.npair, robot.model.geom("floor").type[0]), (1, mujoco.mjtGeom.mjGEOM_PLANE))

    def test_servos_inherit_nothing_of_the_file(self):
        defaults = '<default><general gear="60" ctrllimited="true" ctrlrange="-0.1 0.1" delay="0.1" nsample="20"/></default>'
        text = ROBOT.replace("FLOOR", FLOOR)
        plain = self.torques_of(text)
        self.assertGreater(numpy.abs(plain).max(), 1.0)
        numpy.testing.assert_array_equal(self.torques_of(text.replace("<worldbody>", defaults + "<worldbody>")), plain)
        limited = text.replace('name="left_arm"', 'name="left_arm" actuatorfrcrange="-0.1 0.1"')
        self.assertNotEqual(limited, text)
        numpy.testing.assert_array_equal(self.torques_of(limited), plain)
        notes = Robot(self.model, read_contract(json.dumps(contract()))).notes
        self.assertTrue(any("`left_arm` to 0.1 N·m, the contract to 6 N·m" in note for note in notes), notes)

    def torques_of(self, text):
        """Returns the forces on both arms while their servos move them far."""
        self.model.write_text(text)
        robot = Robot(self.model, read_contract(json.dumps(contract())))
        robot.reset()
        robot.step(numpy.array([0.6, -0.5]))
        mujoco.mj_forward(robot.model, robot.data)
        return robot.data.qfrc_actuator[robot._v].copy()

    def test_feet_stand_on_what_carries_them(self):
        text = ROBOT.replace("FLOOR", FLOOR)
        self.model.write_text(text)
        robot = Robot(self.model, read_contract(json.dumps(contract(feet_bodies=["base", "left"]))))
        robot.reset()
        robot.step(robot.contract.joints.default_rad)
        self.assertEqual(robot.feet_stand().tolist(), [True, False])
        robot.position_m[2] += 1.0
        mujoco.mj_forward(robot.model, robot.data)
        self.assertEqual(robot.feet_stand().tolist(), [False, False])


if __name__ == "__main__":
    unittest.main()
