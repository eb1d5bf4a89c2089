"""Policies of the motion task: contract, observation and episodes."""

import math
from dataclasses import dataclass

import mujoco
import numpy

from .commands import Pushes
from .contract import ServoContract, TransferError
from .robot import Robot
from .trace import largest_difference

TABLES = ("joint_pos", "joint_vel", "body_pos_w", "body_quat_w", "body_lin_vel_w", "body_ang_vel_w")


@dataclass
class MotionContract(ServoContract):
    """Contract of a policy of the motion task, of format 1, checked."""

    push_interval_s: tuple
    push_mps: tuple
    anchor_body: str
    body_names: list
    end_names: list
    rows: int
    motions: list
    future_steps: int
    anchor_height_max_m: float
    anchor_tilt_max: float
    end_height_max_m: float
    residual: bool
    start: dict

    @property
    def width(self):
        """Numbers of one observation."""
        return sum(size for _, size in self.observation)


def read_motion_contract(fields, shared):
    """Returns the contract of its fields; `shared` are those of every robot with servos."""
    of = fields.part("motion")
    motions = of.get("motions")
    keys = {"name", "first_row", "rows", "start_position", "start_velocity"}
    if not isinstance(motions, list) or not motions or not all(isinstance(motion, dict) and keys <= set(motion) for motion in motions):
        raise TransferError(f"`motion.motions` is not a list with {', '.join(sorted(keys))}")
    names = ("xy_m", "z_m", "tilt_rad", "yaw_rad", "xy_mps", "z_mps", "tilt_radps", "yaw_radps", "hinge_rad")
    return MotionContract(
        **shared,
        push_interval_s=tuple(fields.numbers("push_interval_s", 2)),
        push_mps=tuple(fields.numbers("push_mps", 2)),
        anchor_body=of.get("anchor_body_name"),
        body_names=of.names("body_names"),
        end_names=of.names("end_effector_names"),
        rows=int(of.number("rows", above=0.0)),
        motions=motions,
        future_steps=int(of.number("future_steps")),
        anchor_height_max_m=of.number("anchor_height_max_m", above=0.0),
        anchor_tilt_max=of.number("anchor_tilt_max", above=0.0),
        end_height_max_m=of.number("end_effector_height_max_m", above=0.0),
        residual=bool(of.get("residual_action")),
        start={name: of.number(f"start_{name}") for name in names},
    )


def read_tables(policy):
    """Returns the tables of the motion that the ONNX file gives out, by their names."""
    tables, bodies = policy.tables(policy.contract.rows, TABLES), len(policy.contract.body_names)
    for name in ("body_pos_w", "body_quat_w"):
        if tables[name].shape[1] != bodies:
            raise TransferError(f"the output `{name}` has {tables[name].shape[1]} bodies, the contract {bodies}")
    return tables


class Imitator:
    """Robot in MuJoCo beside the motion that it imitates."""

    def __init__(self, path, policy, timestep_s=None):
        self.contract, self.policy = policy.contract, policy
        self.robot = Robot(path, self.contract, timestep_s)
        self.model, self.data, self.notes = self.robot.model, self.robot.data, self.robot.notes
        self.tables = read_tables(policy)
        self.bodies = [self._body(path, name) for name in self.contract.body_names]
        self.anchor = self.contract.body_names.index(self.contract.anchor_body)
        # The policy knows the base by its x axis, which points forward.
        is_base = self.contract.anchor_body == self.contract.base_body
        self._anchor_turn = self.contract.base_turn_wxyz if is_base else numpy.array([1.0, 0.0, 0.0, 0.0])
        self.ends = [self.contract.body_names.index(name) for name in self.contract.end_names]
        unknown = [name for name, _ in self.contract.observation if name not in _TERMS]
        if unknown:
            raise TransferError(f"the contract has the observation term `{unknown[0]}`, which this program does not know")

    def _body(self, path, name):
        found = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name)
        if found < 0:
            raise TransferError(f"the model `{path}` has no body `{name}` of the motion")
        return found

    def reset(self, motion, random):
        """Puts the robot where a motion begins, with the offsets of the training."""
        start = self.contract.start
        around = lambda *names: numpy.array([random.uniform(-start[name], start[name]) for name in names])  # noqa: E731
        position = numpy.array(motion["start_position"], dtype=float)
        velocity = numpy.array(motion["start_velocity"], dtype=float)
        if len(position) != 7 + len(self.robot.hinge_names):
            raise TransferError(f"the motion has {len(position) - 7} hinges, the model {len(self.robot.hinge_names)}")
        position[:3] += around("xy_m", "xy_m", "z_m")
        turn, turned, world = numpy.empty(4), numpy.empty(4), numpy.empty(3)
        mujoco.mju_euler2Quat(turn, around("tilt_rad", "tilt_rad", "yaw_rad"), "XYZ")
        mujoco.mju_mulQuat(turned, turn, position[3:7])
        mujoco.mju_rotVecQuat(world, velocity[3:6], position[3:7])
        world += around("tilt_radps", "tilt_radps", "yaw_radps")
        mujoco.mju_rotVecQuat(velocity[3:6], world, turned * [1.0, -1.0, -1.0, -1.0])
        velocity[:3] += around("xy_mps", "xy_mps", "z_mps")
        position[3:7] = turned
        position[7:] += random.uniform(-start["hinge_rad"], start["hinge_rad"], len(position) - 7)
        self.row, self.last_row = motion["first_row"], motion["first_row"] + motion["rows"] - 1
        self.action = numpy.zeros(len(self.contract.joints.names))
        self.robot.set_state(position, velocity)
        # Not in the ground.
        depth_m = max((-contact.dist for contact in self.data.contact if self._is_ground(contact)), default=0.0)
        if depth_m > 0.0:
            position[2] += depth_m
            self.robot.set_state(position, velocity)

    def _is_ground(self, contact):
        return 0 in self.model.body_weldid[self.model.geom_bodyid[contact.geom]]

    def observe(self):
        """Returns the observation of the present state."""
        return numpy.concatenate([_TERMS[name](self) for name, _ in self.contract.observation])

    def step(self):
        """Acts for one control step. Returns whether the robot is still with the motion, and its errors."""
        observation = self.observe()
        if not numpy.isfinite(observation).all():
            raise TransferError(f"entry {numpy.flatnonzero(~numpy.isfinite(observation))[0]} of the observation is not finite")
        limit = self.contract.action_limit
        self.action = numpy.clip(self.policy.act(observation), -limit, limit)
        is_finite = self.robot.step(self.contract.joints.default_rad + self.contract.action_scale * self.action)
        mujoco.mj_kinematics(self.model, self.data)
        places, turns = self.data.xpos[self.bodies], self.data.xquat[self.bodies]
        moved, moved_turns = self._moved()
        distances = numpy.linalg.norm(places - moved, axis=1)
        angles = 2.0 * numpy.arccos(numpy.clip(numpy.abs((turns * moved_turns).sum(axis=1)), 0.0, 1.0))
        anchor_m = self.tables["body_pos_w"][self.row, self.anchor]
        tilts = [_down(self._as_anchor(turn)) for turn in (turns[self.anchor], self.tables["body_quat_w"][self.row, self.anchor])]
        is_with = (
            is_finite
            and abs(places[self.anchor, 2] - anchor_m[2]) <= self.contract.anchor_height_max_m
            and abs(tilts[0] - tilts[1]) <= self.contract.anchor_tilt_max
            and all(abs(places[end, 2] - moved[end, 2]) <= self.contract.end_height_max_m for end in self.ends)
        )
        errors = (float(numpy.linalg.norm(places[self.anchor] - anchor_m)), float(distances.mean()), float(angles.mean()))
        return bool(is_with), errors

    def _moved(self):
        """Returns the motion's bodies, moved so that the anchors lie above each other, with the same heading."""
        places, turns = self.tables["body_pos_w"][self.row], self.tables["body_quat_w"][self.row]
        at, quat = self.data.xpos[self.bodies[self.anchor]], self.data.xquat[self.bodies[self.anchor]]
        between = numpy.empty(4)
        mujoco.mju_mulQuat(between, quat, turns[self.anchor] * [1.0, -1.0, -1.0, -1.0])
        forward = numpy.empty(3)
        mujoco.mju_rotVecQuat(forward, numpy.array([1.0, 0.0, 0.0]), between)
        yaw = math.atan2(forward[1], forward[0])
        turn = numpy.array([math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)])
        moved, moved_turns = numpy.empty_like(places), numpy.empty_like(turns)
        for body, (place, old) in enumerate(zip(places, turns)):
            mujoco.mju_rotVecQuat(moved[body], place - places[self.anchor], turn)
            mujoco.mju_mulQuat(moved_turns[body], turn, old)
        return moved + [at[0], at[1], places[self.anchor, 2]], moved_turns

    def anchor_error(self):
        """Returns position and rotation matrix of the motion's anchor in the frame of the robot's."""
        at, quat = self.data.xpos[self.bodies[self.anchor]], self._as_anchor(self.data.xquat[self.bodies[self.anchor]])
        back, place, turn, matrix = quat * [1.0, -1.0, -1.0, -1.0], numpy.empty(3), numpy.empty(4), numpy.empty(9)
        mujoco.mju_rotVecQuat(place, self.tables["body_pos_w"][self.row, self.anchor] - at, back)
        mujoco.mju_mulQuat(turn, back, self._as_anchor(self.tables["body_quat_w"][self.row, self.anchor]))
        mujoco.mju_quat2Mat(matrix, turn)
        return place, matrix.reshape(3, 3)

    def _as_anchor(self, quat):
        """Returns the orientation of the anchor that the policy knows from that of its body."""
        turned = numpy.empty(4)
        mujoco.mju_mulQuat(turned, numpy.ascontiguousarray(quat), self._anchor_turn)
        return turned

    def further(self):
        """Returns the angles of the further steps that the policy sees."""
        rows = [min(self.row + 1 + step, self.last_row) for step in range(self.contract.future_steps)]
        return self.tables["joint_pos"][rows].ravel()


def _down(quat):
    """Returns the vertical part of gravity's direction in a frame."""
    matrix = numpy.empty(9)
    mujoco.mju_quat2Mat(matrix, numpy.ascontiguousarray(quat))
    return -matrix[8]


# One function of the imitator for each term.
_TERMS = {
    "command": lambda self: numpy.concatenate([self.tables["joint_pos"][self.row], self.tables["joint_vel"][self.row]]),
    "command_future": lambda self: self.further(),
    "motion_anchor_pos_b": lambda self: self.anchor_error()[0],
    "motion_anchor_ori_b": lambda self: self.anchor_error()[1][:, :2].ravel(),
    "base_lin_vel": lambda self: self.robot.rotation.T @ self.robot.linear_mps,
    "base_ang_vel": lambda self: self.robot.angular_radps,
    "joint_pos": lambda self: self.robot.angles_rad - self.contract.joints.default_rad,
    "joint_vel": lambda self: self.robot.rates_radps,
    "actions": lambda self: self.action,
}


def compare(imitator, lines, tolerances):
    """Compares observation and action of each line of a trace. Returns the first difference, or None, and the largest of each boundary."""
    contract, first, largest = imitator.contract, None, dict.fromkeys(("observation", "action"), 0.0)
    centre, scale, limit = contract.joints.default_rad, contract.action_scale, contract.action_limit
    names = [f"{name}[{entry}]" for name, size in contract.observation for entry in range(size)]
    episode, step = None, 0
    for line in lines:
        if line["episode"] != episode:
            episode, step = line["episode"], 0
        number = line.get("motion", 0)
        if not isinstance(number, int) or not 0 <= number < len(contract.motions):
            raise TransferError(f"the trace has the motion {number!r}, the contract {len(contract.motions)} motions")
        motion = contract.motions[number]
        imitator.row, imitator.last_row = motion["first_row"] + step, motion["first_row"] + motion["rows"] - 1
        step += 1
        imitator.robot.set_state(line["qpos"], line["qvel"])
        seen = line["observation"][: contract.width]
        # The last action is part of the line alone.
        imitator.action = seen[-len(contract.joints.names) :]
        offset = (imitator.tables["joint_pos"][imitator.row] - centre) / scale if contract.residual else 0.0
        expected_action = numpy.clip(limit * numpy.clip(line["action"], -1.0, 1.0) + offset, -limit, limit)
        for boundary, found, expected, name_of in (
            ("observation", imitator.observe(), seen, names.__getitem__),
            ("action", imitator.policy.act(seen), expected_action, contract.outputs.__getitem__),
        ):
            entry, off = largest_difference(found, expected)
            largest[boundary] = max(largest[boundary], off)
            if first is None and not off <= tolerances[boundary]:
                values = {"here": float(found[entry]), "trace": float(expected[entry]), "tolerance": tolerances[boundary]}
                first = {"boundary": boundary, "episode": int(episode), "step": step, "entry": name_of(entry), **values}
    return first, largest


def play_episode(imitator, seed, index, pushes=True, shown=None):
    """Plays one motion from its beginning. Returns how far it came, and its errors."""
    contract = imitator.contract
    of_start, of_pushes = (numpy.random.default_rng([seed, index, stream]) for stream in range(2))
    motion = contract.motions[index % len(contract.motions)]
    imitator.reset(motion, of_start)
    pushing = Pushes(contract, of_pushes) if pushes else None
    errors, is_with, is_closed = [], True, False
    for step in range(motion["rows"]):
        push = pushing.before(step) if pushing else None
        if push is not None:
            imitator.robot.push(push)
        is_with, error = imitator.step()
        errors.append(error)
        is_closed = bool(shown) and not shown()
        if not is_with or is_closed:
            break
        imitator.row = min(imitator.row + 1, imitator.last_row)
    anchor_m, body_m, body_rad = numpy.mean(errors, axis=0)
    done = len(errors) / motion["rows"] if not is_with or is_closed else 1.0
    return {"motion": motion["name"], "length": len(errors), "done_share": done, "fell": not is_with, "closed": is_closed, "anchor_error_m": float(anchor_m),
            "body_error_m": float(body_m), "body_error_rad": float(body_rad)}


def summary(episodes):
    """Returns the means of episodes, by their lengths."""
    lengths = [episode["length"] for episode in episodes]
    mean = lambda key: float(numpy.average([episode[key] for episode in episodes], weights=lengths))  # noqa: E731
    return {
        "episodes": len(episodes),
        "falls": sum(episode["fell"] for episode in episodes),
        "finished": sum(not (episode["fell"] or episode["closed"]) for episode in episodes),
        "done_share": float(numpy.mean([episode["done_share"] for episode in episodes])),
        **{key: mean(key) for key in ("anchor_error_m", "body_error_m", "body_error_rad")},
    }
