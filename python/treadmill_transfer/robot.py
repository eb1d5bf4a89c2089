"""MuJoCo's model of a robot, as its file says, with the contract's servos."""

import math

import mujoco
import numpy

from .contract import TransferError, one_line
from .ground import BASE_M

_GEOMS = mujoco.mjtGeom
DIVERGED = (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC)
# Height above everything, from which rays look down (m).
_SKY_M = 1e3
# Distance from the edge of a given ground at which an episode ends, as in training (m).
_EDGE_M = 1.0
# Vertical force above which a foot stands, as in training (N).
_STANDING_N = 1.0


class Robot:
    """Robot in MuJoCo, driven by targets of its policy's joints.

    `timestep_s` replaces the file's time step, `ground` its floor.
    """

    def __init__(self, path, contract, timestep_s=None, ground=None):
        self.contract, self.ground = contract, ground
        self.notes = []
        spec = read_model(path)
        _add_servos(spec, path, contract, self.notes)
        replace_floor(spec, ground, self.notes)
        self.substeps, spec.option.timestep = substeps(contract.control_step_s, spec.option.timestep, timestep_s)
        self.model = compiled(spec, path)
        self.data = mujoco.MjData(self.model)
        self._turn_back = contract.base_turn_wxyz * [1.0, -1.0, -1.0, -1.0]
        self._find(path)

    def _find(self, path):
        model, contract = self.model, self.contract
        self.base = model.body(contract.base_body).id
        root = model.body_jntadr[self.base]
        if root < 0 or model.jnt_type[root] != mujoco.mjtJoint.mjJNT_FREE:
            raise TransferError(f"the body `{contract.base_body}` of the model `{path}` has no free joint")
        # Bodies without joints of their own move with the foot.
        self._feet = [model.body_weldid[model.body(name).id] for name in contract.feet_bodies]
        self._root_q, self._root_v = model.jnt_qposadr[root], model.jnt_dofadr[root]

        def places(names):
            ids = [model.joint(name).id for name in names]
            for name, joint in zip(names, ids):
                if model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_HINGE:
                    raise TransferError(f"the joint `{name}` of the model `{path}` is no hinge")
            return model.jnt_qposadr[ids], model.jnt_dofadr[ids]

        self._q, self._v = places(contract.joints.names)
        self._held_q, _ = places(contract.held.names)
        hinges = [joint for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE]
        # Names in the order of the file, as in a trace.
        self.hinge_names = [model.joint(joint).name for joint in hinges]
        self._all_q, self._all_v = model.jnt_qposadr[hinges], model.jnt_dofadr[hinges]
        self.policy_hinges = [self.hinge_names.index(name) for name in contract.joints.names]
        free = [name for name in self.hinge_names if name not in contract.joints.names + contract.held.names]
        if free:
            self.notes.append(f"joints without a servo, since the contract does not name them: {', '.join(free)}")
        ground = {_GEOMS.mjGEOM_PLANE: [], _GEOMS.mjGEOM_HFIELD: []}
        for geom in range(model.ngeom):
            kind = _GEOMS(model.geom_type[geom])
            if kind in ground and model.body_weldid[model.geom_bodyid[geom]] == 0:
                ground[kind].append(geom)
        self._planes, self._fields = ground[_GEOMS.mjGEOM_PLANE], ground[_GEOMS.mjGEOM_HFIELD]

    def reset(self, start=(0.0, 0.0, 0.0, 0.0)):
        """Puts the robot in its default pose, at `start`: x, y, height of the ground there (m), yaw (rad)."""
        x, y, z, yaw = start
        mujoco.mj_resetData(self.model, self.data)
        qpos, contract = self.data.qpos, self.contract
        turned = numpy.empty(4)
        turn = numpy.array([math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)])
        mujoco.mju_mulQuat(turned, turn, self._in_file(contract.base_orientation_wxyz))
        qpos[self._root_q : self._root_q + 7] = [x, y, z + contract.base_height_m, *turned]
        qpos[self._q], qpos[self._held_q] = contract.joints.default_rad, contract.held.default_rad
        self.data.ctrl[:] = numpy.concatenate([contract.joints.default_rad, contract.held.default_rad])
        mujoco.mj_forward(self.model, self.data)

    def set_state(self, qpos, qvel):
        """Sets a state: root, then the hinges in the order of the file."""
        mujoco.mj_resetData(self.model, self.data)
        data, contract = self.data, self.contract
        data.qpos[self._root_q : self._root_q + 3], data.qpos[self._all_q] = qpos[:3], qpos[7:]
        data.qpos[self._root_q + 3 : self._root_q + 7] = self._in_file(qpos[3:7])
        data.qvel[self._root_v : self._root_v + 3], data.qvel[self._all_v] = qvel[:3], qvel[6:]
        mujoco.mju_rotVecQuat(data.qvel[self._root_v + 3 : self._root_v + 6], qvel[3:6], contract.base_turn_wxyz)
        data.ctrl[len(contract.joints.names) :] = contract.held.default_rad
        mujoco.mj_forward(self.model, data)

    def state(self):
        """Returns the position and velocity vectors, in the order of `set_state`."""
        data = self.data
        orientation = numpy.empty(4)
        mujoco.mju_mulQuat(orientation, data.qpos[self._root_q + 3 : self._root_q + 7], self.contract.base_turn_wxyz)
        position = numpy.concatenate([self.position_m, orientation, data.qpos[self._all_q]])
        return position, numpy.concatenate([self.linear_mps, self.angular_radps, data.qvel[self._all_v]])

    def _in_file(self, orientation_wxyz):
        """Returns the orientation of the file's base from that of the base that the policy knows."""
        turned = numpy.empty(4)
        mujoco.mju_mulQuat(turned, orientation_wxyz, self._turn_back)
        return turned

    def step(self, targets_rad):
        """Simulates one control step with these targets of the policy's joints. Returns whether the state stayed finite."""
        self.data.ctrl[: len(targets_rad)] = targets_rad
        mujoco.mj_step(self.model, self.data, self.substeps)
        # MuJoCo puts a robot whose state diverged back to its start, and counts a warning.
        return not any(self.data.warning[kind].number for kind in DIVERGED)

    def torques_nm(self):
        """Returns the torques of the policy's joints in the present state, with the targets of the last step."""
        mujoco.mj_forward(self.model, self.data)
        return self.data.actuator_force[: len(self.contract.joints.names)].copy()

    def push(self, velocity_mps):
        """Adds a horizontal velocity to the whole robot."""
        self.data.qvel[self._root_v : self._root_v + 2] += velocity_mps

    @property
    def position_m(self):
        """Position of the base."""
        return self.data.qpos[self._root_q : self._root_q + 3]

    @property
    def rotation(self):
        """Rotation matrix of the base that the policy knows, whose x axis points forward."""
        matrix, turned = numpy.empty(9), numpy.empty(4)
        mujoco.mju_mulQuat(turned, self.data.qpos[self._root_q + 3 : self._root_q + 7], self.contract.base_turn_wxyz)
        mujoco.mju_quat2Mat(matrix, turned)
        return matrix.reshape(3, 3)

    @property
    def linear_mps(self):
        """Velocity of the base's origin in the world frame."""
        return self.data.qvel[self._root_v : self._root_v + 3]

    @property
    def angular_radps(self):
        """Angular velocity of the base that the policy knows, in its own frame."""
        rates = numpy.empty(3)
        mujoco.mju_rotVecQuat(rates, self.data.qvel[self._root_v + 3 : self._root_v + 6], self._turn_back)
        return rates

    @property
    def angles_rad(self):
        """Angles of the policy's joints."""
        return self.data.qpos[self._q]

    @property
    def rates_radps(self):
        """Rates of the policy's joints."""
        return self.data.qvel[self._v]

    @property
    def all_rates_radps(self):
        """Rates of all hinges, in the order of the file."""
        return self.data.qvel[self._all_v].copy()

    def feet_stand(self):
        """Returns for each foot of the contract whether the ground carries it."""
        up_n = numpy.zeros(len(self._feet))
        wrench = numpy.empty(6)
        for index, contact in enumerate(self.data.contact):
            bodies = self.model.body_weldid[self.model.geom_bodyid[contact.geom]]
            feet = [foot for foot, body in enumerate(self._feet) if body in bodies]
            if not feet:
                continue
            mujoco.mj_contactForce(self.model, self.data, index, wrench)
            # The force of the first geometry's body on the second one's, in the frame of the contact.
            upwards_n = contact.frame.reshape(3, 3).T[2] @ wrench[:3]
            for foot in feet:
                up_n[foot] += upwards_n if bodies[1] == self._feet[foot] else -upwards_n
        return up_n > _STANDING_N

    @property
    def heading_rad(self):
        """Yaw of the base's x axis, projected to the ground."""
        forward = self.rotation[:, 0]
        return math.atan2(forward[1], forward[0])

    def velocity_in_heading(self):
        """Returns forward and left velocity in the heading frame (m/s) and yaw rate (rad/s)."""
        return heading_velocity(self.rotation, self.linear_mps, self.angular_radps)

    def ground_m(self, place=None):
        """Returns the height of planes and height fields at a place, by default below the base; boxes and the like do not count."""
        x, y = self.position_m[:2] if place is None else place
        heights = [self.data.geom_xpos[plane][2] for plane in self._planes]
        for field in self._fields:
            distance = mujoco.mj_rayHfield(self.model, self.data, field, numpy.array([x, y, _SKY_M]), numpy.array([0.0, 0.0, -1.0]))
            if distance >= 0.0:
                heights.append(_SKY_M - distance)
        return max(heights, default=0.0)

    def ground_around(self):
        """Returns the heights of the ground at the contract's points: rows from the right to the left, each from the back to the front."""
        (length, width), spacing_m = self.contract.scan_points, self.contract.scan_spacing_m
        x, y, _ = self.position_m
        cos, sin = math.cos(self.heading_rad), math.sin(self.heading_rad)
        heights = []
        for left in (spacing_m * (index - (width - 1) / 2.0) for index in range(width)):
            for forward in (spacing_m * (index - (length - 1) / 2.0) for index in range(length)):
                heights.append(self.ground_m((x + cos * forward - sin * left, y + sin * forward + cos * left)))
        return numpy.array(heights)

    def is_at_edge(self):
        """Returns whether the base is so near to the edge of a given ground that it would soon fall off."""
        if self.ground is None:
            return False
        place, limits = self.position_m[:2], numpy.array([self.ground.x_m, self.ground.y_m])
        return bool((place < limits[:, 0] + _EDGE_M).any() or (place > limits[:, 1] - _EDGE_M).any())

    def has_fallen(self):
        """Returns whether the base is too low above the ground or too tilted."""
        # Stairs and gaps just below the base say little about how it stands.
        ground_m = self.ground_m() if self.ground is None else self.ground_around().mean()
        height_m = self.position_m[2] - ground_m
        tilt_rad = math.acos(min(1.0, max(-1.0, self.rotation[2, 2])))
        return bool(height_m < self.contract.fall_height_m or tilt_rad > self.contract.fall_tilt_rad)


def heading_velocity(rotation, linear_mps, angular_radps):
    """Returns forward and left velocity in the heading frame, and yaw rate, from the world's velocity and the base's rates."""
    heading = math.atan2(rotation[1, 0], rotation[0, 0])
    cos, sin = math.cos(heading), math.sin(heading)
    x, y = linear_mps[0], linear_mps[1]
    return numpy.array([cos * x + sin * y, cos * y - sin * x, rotation[2] @ angular_radps])


def substeps(control_step_s, file_s, wanted_s=None):
    """Returns number and duration of the physics steps of a control step.

    The duration is that of the file if it divides the control step, else the nearest one that does.
    """
    step_s = file_s if wanted_s is None else wanted_s
    count = max(1, round(control_step_s / step_s)) if step_s > 0.0 else 1
    if step_s > 0.0 and abs(count * step_s - control_step_s) < 1e-9:
        return count, step_s
    if wanted_s is not None:
        advice = f"try {control_step_s / count:g}"
        raise TransferError(f"--timestep {wanted_s:g} does not divide the control step of {control_step_s:g} s; {advice}")
    counts = {max(1, math.floor(control_step_s / step_s)), math.ceil(control_step_s / step_s)} if step_s > 0.0 else {1}
    count = min(sorted(counts), key=lambda count: abs(control_step_s / count - step_s))
    return count, control_step_s / count


def read_model(path):
    """Returns the model of a file without its actuators."""
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except Exception as why:  # noqa: BLE001: MuJoCo raises several classes
        raise TransferError(f"cannot read the model `{path}` ({one_line(why)})") from why
    # What spins in an actuator belongs to its joint, as in training.
    _move_rotors(spec)
    # Keyframes hold controls of the file's actuators, and such sensors their forces.
    actuator = mujoco.mjtObj.mjOBJ_ACTUATOR
    for item in [*spec.keys, *spec.actuators, *(sensor for sensor in spec.sensors if sensor.objtype == actuator)]:
        spec.delete(item)
    # MuJoCo 4.0.0 computes wrong accelerations with its sparse solver (its issue 3767).
    spec.option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    return spec


def _move_rotors(spec):
    """Adds armature and damping of the file's actuators to their joints, times the square of the gear."""
    for actuator in spec.actuators:
        joint = spec.joint(actuator.target) if actuator.trntype == mujoco.mjtTrn.mjTRN_JOINT else None
        # Versions before 4.0 have neither.
        if joint is None or not hasattr(actuator, "armature"):
            continue
        square = actuator.gear[0] ** 2
        joint.armature += square * actuator.armature
        joint.damping = numpy.asarray(joint.damping) + square * numpy.asarray(actuator.damping)


def compiled(spec, path):
    """Returns the compiled model of a file with the contract's actuators."""
    try:
        return spec.compile()
    except ValueError as why:
        raise TransferError(f"the model `{path}` does not compile with the contract's actuators ({one_line(why)})") from why


def joint_of(spec, path, name):
    """Returns a joint of the contract."""
    joint = spec.joint(name)
    if joint is None:
        known = ", ".join(known.name for known in spec.joints if known.name)
        raise TransferError(f"the model `{path}` has no joint `{name}` of the contract; it has: {known}")
    return joint


def plain_actuator():
    """Returns the attributes of an actuator of an empty model."""
    actuator = mujoco.MjSpec().add_actuator()
    own = {"classname", "compiler", "id", "info", "name", "plugin", "signature", "target", "userdata"}
    keys = [key for key in dir(actuator) if not key.startswith("_") and key not in own]
    values = {key: getattr(actuator, key) for key in keys}
    return {key: value for key, value in values.items() if not callable(value)}


def _is_excluded(spec, pair):
    return any({exclude.bodyname1, exclude.bodyname2} == set(pair) for exclude in spec.excludes)


def _add_servos(spec, path, contract, notes):
    for name, what in [(contract.base_body, "the base"), *((foot, "a foot") for foot in contract.feet_bodies)]:
        if spec.body(name) is None:
            raise TransferError(f"the model `{path}` has no body `{name}`, {what} of the contract")
    for pair in contract.excluded_bodies:
        # Bodies that the file has welded together, or excluded already, cannot touch anyway.
        if all(spec.body(name) is not None for name in pair) and not _is_excluded(spec, pair):
            spec.add_exclude(bodyname1=pair[0], bodyname2=pair[1])
    # Pairs that the file lists touch whatever is excluded.
    excluded = [set(pair) for pair in contract.excluded_bodies]
    for listed in list(spec.pairs):
        geoms = [spec.geom(name) for name in (listed.geomname1, listed.geomname2)]
        # A robot's file may name the floor of its scene.
        if all(geoms) and {geom.parent.name for geom in geoms} in excluded:
            spec.delete(listed)
    plain = plain_actuator()
    for joints in (contract.joints, contract.held):
        for index, name in enumerate(joints.names):
            joint = joint_of(spec, path, name)
            joint.armature = joints.armature_kgm2[index]
            # The contract's effort is the only limit of torque.
            if joint.actfrclimited != mujoco.mjtLimited.mjLIMITED_FALSE and 0.0 < joint.actfrcrange[1] < joints.effort_nm[index]:
                limits = f"{joint.actfrcrange[1]:g} N·m, the contract to {joints.effort_nm[index]:g} N·m, which holds"
                notes.append(f"the file limits the torque of the joint `{name}` to {limits}")
            joint.actfrclimited = mujoco.mjtLimited.mjLIMITED_FALSE
            kp, kd, effort_nm = joints.kp[index], joints.kd[index], joints.effort_nm[index]
            servo = spec.add_actuator(name=name, target=name)
            # An actuator begins with the file's defaults: gear, limits of control, delays.
            for key, value in plain.items():
                setattr(servo, key, value)
            servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
            servo.gaintype, servo.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
            servo.ctrllimited = servo.actlimited = mujoco.mjtLimited.mjLIMITED_FALSE
            servo.forcelimited, servo.forcerange = mujoco.mjtLimited.mjLIMITED_TRUE, [-effort_nm, effort_nm]
            servo.gainprm[0], servo.biasprm[1], servo.biasprm[2] = kp, -kp, -kd


def replace_floor(spec, ground, notes):
    """Puts a given ground in place of the model's floor, or a plane where there is none."""
    floors = [geom for geom in spec.geoms if geom.type in (_GEOMS.mjGEOM_PLANE, _GEOMS.mjGEOM_HFIELD)]
    if ground is None:
        if not floors:
            # The name by which pairs of contacts may know the floor of another file, as in training.
            name = "floor" if spec.geom("floor") is None else "treadmill_floor"
            spec.worldbody.add_geom(name=name, type=_GEOMS.mjGEOM_PLANE, size=[0.0, 0.0, 0.05])
            notes.append("the model has no floor, so a plane was added")
        return
    low_m, high_m = ground.heights_m.min(), ground.heights_m.max()
    # MuJoCo wants heights of 0 to 1 and a size above 0.
    span_m = max(high_m - low_m, 1e-3)
    (x_low, x_high), (y_low, y_high) = ground.x_m, ground.y_m
    rows, columns = ground.heights_m.shape
    spec.add_hfield(
        name="treadmill_ground",
        nrow=rows,
        ncol=columns,
        size=[(x_high - x_low) / 2.0, (y_high - y_low) / 2.0, span_m, BASE_M],
        userdata=((ground.heights_m - low_m) / span_m).ravel(),
    )
    # In place of the first floor, whose name pairs of contacts may use.
    for floor in floors[1:]:
        spec.delete(floor)
    field = floors[0] if floors else spec.worldbody.add_geom(name="treadmill_ground")
    field.type, field.hfieldname, field.material = _GEOMS.mjGEOM_HFIELD, "treadmill_ground", ""
    field.pos, field.quat = [(x_low + x_high) / 2.0, (y_low + y_high) / 2.0, low_m], [1.0, 0.0, 0.0, 0.0]
