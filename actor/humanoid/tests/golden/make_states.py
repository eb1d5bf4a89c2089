#!/usr/bin/env python3
"""Writes states.bin: observations of Gymnasium's Humanoid-v5 and -v4 in random states of this project's humanoid.

    pip install "gymnasium[mujoco]"
    python3 actor/humanoid/tests/golden/make_states.py            # writes states.bin beside this script
    python3 actor/humanoid/tests/golden/make_states.py --check    # only compares the model with Gymnasium's own

Physics quantities come from MuJoCo after mj_forward and mj_rnePostConstraint, observations and contact cost from
Gymnasium's classes. `--model gymnasium` uses Gymnasium's humanoid.xml instead of the project's. Both describe the same
robot, so the file is the same within single precision. The script prints the largest difference of the two models and
fails if it exceeds rounding.

Format, little-endian: the eight bytes "TMSTATES", then u32 numbers: states, nq, nv, nu, size of the v5 observation,
size of the v4 observation, tendons. Then for each state, as f32: qpos, qvel, ctrl, observation v5, observation v4,
tendon lengths, tendon velocities, contact cost, number of contacts, and for each contact: first link, second link
(the index of the body without the world, -1 for the floor), point x, y, z (m), and the force x, y, z (N) on the first.
"""

import argparse
import pathlib
import struct
import sys

import gymnasium
import mujoco
import numpy as np
from gymnasium.envs.mujoco import humanoid_v4, humanoid_v5

HERE = pathlib.Path(__file__).resolve().parent
ASSET = HERE.parent.parent / "assets" / "humanoid.xml"
GYMNASIUM = pathlib.Path(humanoid_v5.__file__).parent / "assets" / "humanoid.xml"
STATES = 200
"""Number of states; the last quarter is near the floor."""
SEED = 20240615


def environments(xml):
    """Returns Gymnasium's two environments on one MuJoCo model and its data; v4 accepts no file, so its model is replaced."""
    v5 = humanoid_v5.HumanoidEnv(xml_file=str(xml))
    v4 = humanoid_v4.HumanoidEnv()
    v4.model, v4.data = v5.model, v5.data
    return v5, v4


def random_states(model, random):
    """Yields qpos, qvel and ctrl, rounded to single precision so that every reader gets the same numbers."""
    low, high = model.jnt_range[1:].T
    for number in range(STATES):
        height = random.uniform(2.5, 4.0) if number < STATES * 3 // 4 else random.uniform(0.1, 1.4)
        turn = random.normal(size=4)
        qpos = np.concatenate((
            random.uniform(-3, 3, size=2), [height], turn / np.linalg.norm(turn), random.uniform(low, high)
        ))
        qvel = random.uniform(-5, 5, size=model.nv)
        ctrl = random.uniform(-0.4, 0.4, size=model.nu)
        yield tuple(part.astype(np.float32).astype(np.float64) for part in (qpos, qvel, ctrl))


def set_state(environment, qpos, qvel, ctrl):
    """Sets MuJoCo's state and computes all derived quantities."""
    model, data = environment.model, environment.data
    mujoco.mj_resetData(model, data)
    data.qpos[:], data.qvel[:], data.ctrl[:] = qpos, qvel, ctrl
    mujoco.mj_forward(model, data)
    mujoco.mj_rnePostConstraint(model, data)


def contacts(model, data):
    """Returns rows of first link, second link, point and force on the first link, for each active contact."""
    rows = []
    for number in range(data.ncon):
        contact = data.contact[number]
        if contact.efc_address < 0:
            continue
        wrench = np.zeros(6)
        mujoco.mj_contactForce(model, data, number, wrench)
        assert not wrench[3:].any(), "a contact with torsion needs a format with moments"
        force = contact.frame.reshape(3, 3).T @ wrench[:3]
        links = [model.geom_bodyid[geom] - 1 for geom in contact.geom]
        rows.append(np.concatenate((links, contact.pos, -force)))
    return rows


def inertias(model):
    """Returns the inertia of each body about its centre of mass, in the body's axes."""
    matrices = []
    for body in range(model.nbody):
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.body_iquat[body])
        turn = turn.reshape(3, 3)
        matrices.append(turn @ np.diag(model.body_inertia[body]) @ turn.T)
    return np.array(matrices)


def compare_models():
    """Prints the largest differences from Gymnasium's model; returns whether they are only rounding."""
    ours, theirs = (mujoco.MjModel.from_xml_path(str(path)) for path in (ASSET, GYMNASIUM))
    same = True
    quantities = {name: [getattr(model, name) for model in (ours, theirs)] for name in (
        "body_mass", "body_ipos", "body_pos", "body_quat", "body_parentid", "body_weldid", "jnt_type", "jnt_range",
        "jnt_axis", "jnt_pos", "jnt_stiffness", "dof_damping", "dof_armature", "actuator_gear",
        "actuator_ctrlrange", "actuator_trnid", "tendon_range", "wrap_prm", "wrap_objid", "geom_friction",
        "geom_condim", "geom_margin", "geom_size", "qpos0",
    )}
    quantities["inertia"] = [inertias(model) for model in (ours, theirs)]
    for name, (left, right) in quantities.items():
        if left.shape != right.shape:
            difference = np.inf
        else:
            difference = np.abs(np.asarray(left, dtype=float) - right).max(initial=0)
        same &= bool(difference < 1e-9)
        print(f"{name:20} {difference:.3g}")
    print(f"mass {ours.body_mass.sum():.9f} kg here, {theirs.body_mass.sum():.9f} kg in Gymnasium's file")
    return same


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--check", action="store_true", help="write nothing")
    arguments.add_argument("--model", choices=("ours", "gymnasium"), default="ours")
    arguments.add_argument("--output", type=pathlib.Path, default=HERE / "states.bin")
    options = arguments.parse_args()
    print(f"gymnasium {gymnasium.__version__}, mujoco {mujoco.__version__}; largest differences of the models:")
    same = compare_models()
    if options.check:
        sys.exit(0 if same else 1)

    paths = (ASSET, GYMNASIUM) if options.model == "ours" else (GYMNASIUM, ASSET)
    (v5, v4), (other, _) = (environments(path) for path in paths)
    model, data = v5.model, v5.data
    body, largest, touching = b"", 0.0, 0
    for qpos, qvel, ctrl in random_states(model, np.random.default_rng(SEED)):
        set_state(v5, qpos, qvel, ctrl)
        set_state(other, qpos, qvel, ctrl)
        seen, rows = v5._get_obs(), contacts(model, data)
        # Contact forces are excluded: the two files set different solvers.
        forces = 6 * (model.nbody - 1)
        largest = max(largest, np.abs(seen[:-forces] - other._get_obs()[:-forces]).max())
        touching += bool(rows)
        numbers = [qpos, qvel, ctrl, seen, v4._get_obs(), data.ten_length, data.ten_velocity]
        numbers += [[v5.contact_cost, len(rows)], *rows]
        body += np.concatenate(numbers).astype("<f4").tobytes()
    sizes = (STATES, model.nq, model.nv, model.nu, len(seen), len(v4._get_obs()), model.ntendon)
    options.output.write_bytes(b"TMSTATES" + struct.pack("<7I", *sizes) + body)
    print(f"{STATES} states, {touching} with contacts; observations of the two models differ by {largest:.3g}")
    print(f"wrote {options.output}: {options.output.stat().st_size} bytes")
    sys.exit(0 if same and largest < 1e-6 else 1)


if __name__ == "__main__":
    main()
