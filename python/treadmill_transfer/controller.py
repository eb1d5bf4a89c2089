"""Controller of a robot: observations with their history, and targets of the joints."""

import math

import numpy

from .contract import TransferError


class Controller:
    """Turns what sensors measure into targets, as on the robot."""

    def __init__(self, policy):
        self.policy, self.contract = policy, policy.contract
        unknown = [name for name, _ in self.contract.observation if name not in _TERMS]
        if unknown:
            raise TransferError(f"the contract has the observation term `{unknown[0]}`, which this program does not know")
        self.reset()

    def reset(self):
        """Begins an episode."""
        self.steps = 0
        self.standing_steps = 0
        self.action = numpy.zeros(len(self.contract.joints.names))
        self._frames = None

    def observe(self, robot, command):
        """Returns the whole observation of the present state; once per control step."""
        contract, stands = self.contract, numpy.linalg.norm(command) < self.contract.gait_rests_below
        rested = rested_s(contract, self.standing_steps)
        is_disturbed = rested is not None and not is_calm(contract, robot, rested)
        self.standing_steps = (0 if is_disturbed else self.standing_steps) + 1 if stands else 0
        frame = numpy.concatenate([_TERMS[name](self, robot, command) for name, _ in self.contract.observation])
        if self._frames is None:
            self._frames = [frame] * self.contract.history
        else:
            self._frames = [*self._frames[1:], frame]
        return numpy.concatenate(self._frames)

    def act(self, observation):
        """Returns the action of an observation, in units of the action."""
        broken = numpy.flatnonzero(~numpy.isfinite(observation))
        if len(broken):
            entry, step = self.entry_name(int(broken[0])), self.steps + 1
            raise TransferError(f"{entry} of the observation is not finite in step {step}: a broken sensor, or a model that diverged")
        return self.policy.act(observation)

    def taken(self, action):
        """Notes an action as the last one and returns the joints' targets (rad)."""
        limit = self.contract.action_limit
        self.action = numpy.clip(action, -limit, limit)
        self.steps += 1
        return self.contract.joints.default_rad + self.contract.action_scale * self.action

    def entry_name(self, index):
        """Returns the name of an entry of the observation, such as `base_ang_vel[1]`."""
        per_frame = self.contract.width // self.contract.history
        age = self.contract.history - 1 - index // per_frame
        index %= per_frame
        for name, size in self.contract.observation:
            if index < size:
                break
            index -= size
        part = self.contract.joints.names[index] if size == len(self.contract.joints.names) else index
        return f"{name}[{part}]" + (f", {age} frames ago" if age else "")


def is_calm(contract, robot, rested):
    """Returns whether a robot is not disturbed after so many seconds at rest."""
    is_settled = rested >= contract.gait_rests_settled_s
    limit_radps = contract.gait_rests_settled_rate_radps if is_settled else contract.gait_rests_rate_radps
    return numpy.linalg.norm(robot.angular_radps) <= limit_radps


def rested_s(contract, standing_steps):
    """Returns for how long the gait has rested after so many control steps under a command to stand; None if it does not."""
    if standing_steps == 0:
        return None
    rested = (standing_steps - 1) * contract.control_step_s - contract.gait_rests_after_s
    return rested if rested >= 0.0 else None


def phase(contract, steps, standing_steps):
    """Returns sine and cosine of the gait's phase after so many control steps; zeros where the gait rests."""
    if rested_s(contract, standing_steps) is not None:
        return numpy.zeros(2)
    angle = 2.0 * math.pi * steps * contract.control_step_s / contract.gait_period_s
    return numpy.array([math.sin(angle), math.cos(angle)])


def height_scan(contract, robot):
    """Returns how much higher the ground around the base is than where the robot would stand in the default pose (m)."""
    stands_m, limit_m = robot.position_m[2] - contract.base_height_m, contract.scan_limit_m
    return numpy.clip(robot.ground_around() - stands_m, -limit_m, limit_m)


# One function of (controller, robot, command) for each term.
_TERMS = {
    "base_ang_vel": lambda _, robot, __: robot.angular_radps,
    "projected_gravity": lambda _, robot, __: -robot.rotation[2],
    "velocity_commands": lambda _, __, command: command,
    "joint_pos_rel": lambda self, robot, _: robot.angles_rad - self.contract.joints.default_rad,
    "joint_vel_rel": lambda _, robot, __: robot.rates_radps,
    "last_action": lambda self, _, __: self.action,
    "gait_phase": lambda self, _, __: phase(self.contract, self.steps, self.standing_steps),
    "height_scan": lambda self, robot, _: height_scan(self.contract, robot),
}
