"""A small robot, its contract and a network whose action is known, for the tests of the player."""

import json
import tempfile
import unittest
from pathlib import Path

import numpy
import onnx

# A box on a wide foot, with two hinged arms and a joint that no policy moves.
ROBOT = """
<mujoco>
  <option timestep="0.004" integrator="implicitfast"/>
  <worldbody>
    FLOOR
    <body name="base" pos="0 0 0.2">
      <freejoint/>
      <geom type="box" size="0.2 0.2 0.2" mass="10"/>
      <body name="left" pos="0 0.3 0.1">
        <joint name="left_arm" axis="0 1 0" damping="0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.03" mass="0.5" contype="0" conaffinity="0"/>
      </body>
      <body name="tail" pos="-0.3 0 0.1">
        <joint name="tail" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.1" size="0.02" mass="0.1" contype="0" conaffinity="0"/>
      </body>
      <body name="right" pos="0 -0.3 0.1">
        <joint name="right_arm" axis="0 1 0" damping="0"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.03" mass="0.5" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="left_arm"/><motor joint="tail"/></actuator>
  <keyframe><key qpos="0 0 1 1 0 0 0 0 0 0" ctrl="1 2"/></keyframe>
</mujoco>
"""
FLOOR = '<geom name="floor" type="plane" size="0 0 1"/>'
TERMS = [
    ("base_ang_vel", 3),
    ("projected_gravity", 3),
    ("velocity_commands", 3),
    ("joint_pos_rel", 2),
    ("joint_vel_rel", 2),
    ("last_action", 2),
    ("gait_phase", 2),
]
WIDTH = 17


def contract(**changes):
    """Returns the JSON object of a contract."""
    joints = {
        "joint_names": ["right_arm", "left_arm"],
        "default_joint_pos": [0.2, 0.1],
        "joint_stiffness": [20.0, 30.0],
        "joint_damping": [1.0, 2.0],
        "joint_effort": [5.0, 6.0],
        "joint_armature": [0.01, 0.02],
    }
    held = {
        "joint_names": ["tail"],
        "default_joint_pos": [0.3],
        "joint_stiffness": [10.0],
        "joint_damping": [0.5],
        "joint_effort": [3.0],
        "joint_armature": [0.03],
    }
    return {
        "format": 1,
        "control_step_s": 0.02,
        "substeps": 4,
        **joints,
        "action_scale": [0.1, 0.2],
        "action_limit": 4.0,
        "held_joints": held,
        "base_body": "base",
        "feet_bodies": ["left", "right"],
        "default_base_height_m": 0.2,
        "default_base_orientation_wxyz": [1.0, 0.0, 0.0, 0.0],
        "observation": [{"name": name, "size": size, "unit": "", "frame": ""} for name, size in TERMS],
        "history": {"frames": 2, "order": "oldest first"},
        "gait_period_s": 0.8,
        "height_scan": {"points": [3, 1], "spacing_m": 0.5, "limit_m": 0.2},
        "commands": {
            "lin_vel_x_mps": [-0.5, 1.0],
            "lin_vel_y_mps": [-0.3, 0.3],
            "ang_vel_z_radps": [-0.5, 0.5],
            "resampling_s": [1.0, 2.0],
            "standing_share": 0.2,
            "heading_share": 0.3,
            "heading_gain_per_s": 0.5,
        },
        "fall": {"height_m": 0.1, "tilt_rad": 1.0},
        "push_interval_s": [0.5, 1.0],
        "push_mps": [0.1, 0.2],
        **changes,
    }


def network(path, terms, metadata=None):
    """Writes an ONNX model whose action is clip(observation × weight, ±4), with so many entries of one frame as `weight`."""
    weight = numpy.zeros((2 * WIDTH, 2), dtype=numpy.float32)
    for entry, column, value in terms:
        weight[entry, column] = value
    helper, tensor = onnx.helper, onnx.numpy_helper.from_array
    constants = [tensor(weight, "weight"), tensor(numpy.float32(-4.0), "low"), tensor(numpy.float32(4.0), "high")]
    port = lambda name, width: helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, ["batch", width])  # noqa: E731
    nodes = [
        helper.make_node("MatMul", ["observation", "weight"], ["x"]),
        helper.make_node("Clip", ["x", "low", "high"], ["action"]),
    ]
    graph = helper.make_graph(nodes, "policy", [port("observation", 2 * WIDTH)], [port("action", 2)], constants)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=7)
    entries = {"treadmill.contract": json.dumps(contract())} if metadata is None else metadata
    onnx.helper.set_model_props(model, entries)
    onnx.save(model, path)
    return path


class RobotCase(unittest.TestCase):
    """A test with a folder that has the robot's file."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.model = self.folder / "robot.xml"
        self.model.write_text(ROBOT.replace("FLOOR", FLOOR))
