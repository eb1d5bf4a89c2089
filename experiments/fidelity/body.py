"""Loads and simulates the humanoid in MuJoCo, with the variants that measure.py compares in both simulators.

Needs: pip install "gymnasium[mujoco]" numpy
"""

import pathlib
import xml.etree.ElementTree as ElementTree

import gymnasium.envs.mujoco
import mujoco
import numpy as np

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TREADMILL_XML = REPOSITORY / "actor/humanoid/assets/humanoid.xml"
GYMNASIUM_XML = pathlib.Path(gymnasium.envs.mujoco.__file__).parent / "assets/humanoid.xml"

CONTROL_STEP_S = 0.015
CONTROL_LIMIT = 0.4
INTEGRATORS = {
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
}


def variant_xml(path, limits=True, damping=True, symmetric=False):
    """Returns the XML of a variant: without joint limits, without joint damping, or symmetric.

    In Gymnasium's file, the right hip's armature and the right knee's spring differ from the left ones."""
    root = ElementTree.parse(path).getroot()
    for joint in root.iter("joint"):
        if joint.get("type") == "free" or joint.get("joint") is not None:
            continue
        if not limits:
            joint.set("limited", "false")
        if not damping:
            joint.set("damping", "0")
        if symmetric and joint.get("name") == "right_hip_y":
            joint.set("armature", "0.01")
        if symmetric and joint.get("name") == "right_knee":
            joint.set("stiffness", "1")
    return ElementTree.tostring(root, encoding="unicode")


def load(contact=True, **changes):
    """Returns MuJoCo's model of Gymnasium's file with the changes of variant_xml; contact=False disables all contacts."""
    model = mujoco.MjModel.from_xml_string(variant_xml(GYMNASIUM_XML, **changes))
    if not contact:
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    return model


def simulate(model, case, integrator="RK4", timestep_s=0.003):
    """Returns the states after each control step in MuJoCo: qpos [T, 24], qvel [T, 23]. Restores the model's options."""
    before = model.opt.integrator, model.opt.timestep
    model.opt.integrator, model.opt.timestep = INTEGRATORS[integrator], timestep_s
    substeps = round(CONTROL_STEP_S / timestep_s)
    assert abs(substeps * timestep_s - CONTROL_STEP_S) < 1e-9, "the time step does not divide the control step"
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = case["qpos"], case["qvel"]
    mujoco.mj_normalizeQuat(model, data.qpos)
    qpos, qvel = [], []
    for action in case["actions"]:
        data.ctrl[:] = action
        mujoco.mj_step(model, data, nstep=substeps)
        qpos.append(data.qpos.copy())
        qvel.append(data.qvel.copy())
    model.opt.integrator, model.opt.timestep = before
    return np.array(qpos), np.array(qvel)


def overshoot_rad(model, qpos):
    """Returns how far the worst hinge of each state is beyond its range, [T]."""
    low, high = model.jnt_range[1:].T
    angles = qpos[:, 7:]
    return np.maximum(np.maximum(low - angles, angles - high), 0.0).max(axis=1)


def mechanics(model, qpos, qvel):
    """Returns for one state: total energy (J), energy without the centre of mass's (J), and angular momentum about the
    centre of mass (kg m²/s, [3])."""
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = qpos, qvel
    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_fwdVelocity(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    mujoco.mj_subtreeVel(model, data)
    mass_kg = model.body_subtreemass[0]
    speed_mps = np.linalg.norm(data.subtree_linvel[0])
    flight_j = mass_kg * (0.5 * speed_mps**2 - model.opt.gravity[2] * data.subtree_com[0][2])
    total_j = data.energy.sum()
    return total_j, total_j - flight_j, data.subtree_angmom[0].copy()


# Mirroring swaps left and right. Rotations about x and z change sign; so do shoulders, whose axes are not mirror images.
_PAIRS = [(3, 7), (4, 8), (5, 9), (6, 10), (11, 14), (12, 15), (13, 16)]
_HINGE_SIGNS = np.array([-1, 1, -1, 1, 1, 1, 1, 1, 1, 1, 1, -1, -1, 1, -1, -1, 1], float)
_SWAP = np.arange(17)
for _right, _left in _PAIRS:
    _SWAP[_right], _SWAP[_left] = _left, _right
# Actions are in motor order: abdomen_y before abdomen_z.
_MOTOR_SIGNS = _HINGE_SIGNS[[1, 0, *range(2, 17)]]


def mirror_qpos(qpos):
    """Mirrors the state in the plane between left and right, along the last axis."""
    root = qpos[..., :7] * [1, -1, 1, 1, -1, 1, -1]
    return np.concatenate([root, (qpos[..., 7:] * _HINGE_SIGNS)[..., _SWAP]], axis=-1)


def mirror_qvel(qvel):
    """Mirrors velocities like mirror_qpos."""
    root = qvel[..., :6] * [1, -1, 1, -1, 1, -1]
    return np.concatenate([root, (qvel[..., 6:] * _HINGE_SIGNS)[..., _SWAP]], axis=-1)


def mirror_actions(actions):
    """Mirrors actions, in actuator order, like mirror_qpos."""
    return (actions * _MOTOR_SIGNS)[..., _SWAP]
