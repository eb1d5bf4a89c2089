"""Starting states and actions for both simulators.

A case is {"qpos": [24], "qvel": [23], "actions": [T, 17]} in MuJoCo's conventions; actions have single precision.
"""

import numpy as np

from experiments.fidelity import body

_MODEL = body.load()
_LOW, _HIGH = _MODEL.jnt_range[1:].T


def _actions(rng, steps, limit):
    return rng.uniform(-limit, limit, (steps, 17)).astype(np.float32).astype(float)


def _rotation(rng):
    quaternion = rng.normal(size=4)
    return quaternion / np.linalg.norm(quaternion)


def _posture(rng, share):
    middle, half = (_LOW + _HIGH) / 2, (_HIGH - _LOW) / 2
    return middle + rng.uniform(-share, share, 17) * half


def flights(rng, count, steps, limit):
    """Starts high above the floor: random orientation, angles in the inner 80 % of their ranges, fast motion, random actions."""
    made = []
    for _ in range(count):
        qpos = np.concatenate([[0, 0, 5], _rotation(rng), _posture(rng, 0.8)])
        qvel = np.concatenate([rng.normal(size=3), rng.uniform(-2, 2, 3), rng.uniform(-3, 3, 17)])
        made.append({"qpos": qpos, "qvel": qvel, "actions": _actions(rng, steps, limit)})
    return made


def passive_flights(rng, count, steps):
    """Starts too high to land: every joint moves, and no motor acts."""
    made = []
    for _ in range(count):
        qpos = np.concatenate([[0, 0, 40], _rotation(rng), _posture(rng, 0.5)])
        qvel = np.concatenate([rng.normal(size=3), rng.uniform(-2, 2, 3), rng.uniform(-2, 2, 17)])
        made.append({"qpos": qpos, "qvel": qvel, "actions": np.zeros((steps, 17))})
    return made


def drops(rng, count, steps, limit):
    """Episode starts: nominal pose with the task's reset noise. The feet are 11 cm above the floor and land after 0.15 s."""
    made = []
    for _ in range(count):
        qpos = _MODEL.qpos0 + rng.uniform(-0.01, 0.01, 24)
        qpos[3:7] /= np.linalg.norm(qpos[3:7])
        made.append({"qpos": qpos, "qvel": rng.uniform(-0.01, 0.01, 23), "actions": _actions(rng, steps, limit)})
    return made


def thrashing(rng, count, steps):
    """Episode starts, then full torque of every motor with random signs, even when the body lies on the floor."""
    made = drops(rng, count, steps, 0.0)
    for case in made:
        signs = rng.choice([-1.0, 1.0], (steps, 17))
        case["actions"] = np.float32(body.CONTROL_LIMIT).astype(float) * signs
    return made


def perturbed(cases, size, seed):
    """Returns the cases with each number of the start changed by up to `size`."""
    rng = np.random.default_rng(seed)
    made = []
    for case in cases:
        qpos = case["qpos"] + rng.uniform(-size, size, 24)
        made.append({**case, "qpos": qpos, "qvel": case["qvel"] + rng.uniform(-size, size, 23)})
    return made


def mirrored(cases):
    """Returns the mirror image of each case."""
    return [
        {
            "qpos": body.mirror_qpos(case["qpos"]),
            "qvel": body.mirror_qvel(case["qvel"]),
            "actions": body.mirror_actions(case["actions"]),
        }
        for case in cases
    ]
