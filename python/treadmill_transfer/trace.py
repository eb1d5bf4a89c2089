"""Comparison with a trace of `treadmill eval RUN --trace FILE`, boundary by boundary.

Each line of a trace is replayed alone: MuJoCo starts from its state, so that differences do not add up. Four boundaries follow
each other: the observation of that state, the policy's action for the trace's observation, the joints' torques after one control
step with the trace's action, and the state then.
"""

import json

import numpy

from .contract import TransferError

# Observation and action differ by rounding only: 1e-6. Torques (as shares of each joint's effort) and states (m, rad, and rates
# times the control step) differ because each simulator has its own contacts. Largest of 1,000 steps of a G1 that walks, with the
# file of its training: 0.18 and 0.153, where a foot lands.
TOLERANCES = {"observation": 1e-4, "action": 1e-4, "torque": 0.3, "state": 0.3}
KEYS = ("observation", "action", "episode", "command", "qpos", "qvel", "torque")
_ROOT_Q = ["base x", "base y", "base z", *(f"base quaternion {part}" for part in "wxyz")]
_ROOT_V = [f"base {kind} {axis}" for kind in ("velocity", "angular velocity") for axis in "xyz"]


def read_trace(path, hinges, keys=KEYS):
    """Returns the lines of a trace of a robot with so many hinges, with at least these keys."""
    lines = []
    try:
        with open(path, encoding="utf-8") as file:
            for number, text in enumerate(file, start=1):
                lines.append(_read_line(path, number, text, hinges, keys))
    except (OSError, UnicodeDecodeError) as why:
        raise TransferError(f"cannot read the trace `{path}`: {getattr(why, 'strerror', None) or why}") from why
    if not lines:
        raise TransferError(f"the trace `{path}` is empty")
    return lines


def _read_line(path, number, text, hinges, keys):
    where = f"the trace `{path}`, line {number}:"
    try:
        line = json.loads(text)
        missing = [key for key in keys if key not in line]
        if missing:
            raise TransferError(f"{where} `{missing[0]}` is missing; write it with `treadmill eval RUN --trace FILE`")
        for key in (key for key in keys if key != "episode"):
            line[key] = numpy.array(line[key], dtype=float)
    except (TypeError, ValueError) as why:
        raise TransferError(f"{where} not a JSON object of numbers ({why})") from why
    for key, expected in (("qpos", 7 + hinges), ("qvel", 6 + hinges), ("torque", hinges), ("command", 3)):
        if key in keys and line[key].shape != (expected,):
            raise TransferError(f"{where} `{key}` has {line[key].size} numbers, but the model needs {expected}")
    return line


def largest_difference(found, expected, weight=1.0):
    """Returns where two lists of numbers differ most, and by how much."""
    off = numpy.abs(found - expected) * weight
    entry = int(numpy.argmax(off))
    return entry, float(off[entry])


def compare(robot, controller, lines, tolerances):
    """Returns the first boundary that differs, or None, and the largest difference of each boundary."""
    contract, first, largest = robot.contract, None, dict.fromkeys(TOLERANCES, 0.0)
    step_s, names = contract.control_step_s, contract.joints.names
    state_names = _ROOT_Q + robot.hinge_names + _ROOT_V + [f"rate of {name}" for name in robot.hinge_names]
    # A rate counts by how far it leads in one control step.
    weights = numpy.concatenate([numpy.ones(7 + len(robot.hinge_names)), numpy.full(6 + len(robot.hinge_names), step_s)])
    episode, step = None, 0
    for index, line in enumerate(lines):
        if line["episode"] != episode:
            episode, step = line["episode"], 0
            controller.reset()
        step += 1

        def check(boundary, found, expected, name_of, weight=1.0):
            nonlocal first
            if len(found) != len(expected):
                raise TransferError(f"{boundary} of step {step}: {len(expected)} numbers in the trace, {len(found)} here")
            entry, off = largest_difference(found, expected, weight)
            largest[boundary] = max(largest[boundary], off)
            if first is None and not off <= tolerances[boundary]:
                values = {"here": float(found[entry]), "trace": float(expected[entry])}
                tolerance = tolerances[boundary] / (weight[entry] if numpy.ndim(weight) else weight)
                first = {"boundary": boundary, "episode": episode, "step": step, "entry": name_of(entry), **values}
                first["tolerance"] = float(tolerance)

        robot.set_state(line["qpos"], line["qvel"])
        seen = line["observation"][: contract.width]
        check("observation", controller.observe(robot, line["command"]), seen, controller.entry_name)
        taken = contract.action_limit * numpy.clip(line["action"], -1.0, 1.0)
        check("action", controller.act(seen), taken, names.__getitem__)
        robot.step(controller.taken(taken))
        check("torque", robot.torques_nm(), line["torque"][robot.policy_hinges], names.__getitem__, 1.0 / contract.joints.effort_nm)
        following = lines[index + 1] if index + 1 < len(lines) else None
        if following and following["episode"] == episode:
            position, velocity = robot.state()
            expected = following["qpos"].copy()
            if position[3:7] @ expected[3:7] < 0.0:
                # Both signs of a quaternion are the same rotation.
                expected[3:7] *= -1.0
            found = numpy.concatenate([position, velocity])
            check("state", found, numpy.concatenate([expected, following["qvel"]]), state_names.__getitem__, weights)
    return first, largest
