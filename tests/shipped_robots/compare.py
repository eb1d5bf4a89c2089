"""Compares what Treadmill reads from robots' files with MuJoCo: masses, inertias, axes, ranges.

Usage: compare.py treadmill FILE...

Poses are those of all hinges at zero. Prints the greatest difference of each quantity, and fails above 1e-6.
"""

import json
import subprocess
import sys

import mujoco
import numpy as np

LIMIT = 1e-6


def load(file: str) -> mujoco.MjSpec:
    """Loads a file; a file without a floor, which its pairs may name, gets one."""
    spec = mujoco.MjSpec.from_file(file)
    if not any(geom.type in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD) for geom in spec.worldbody.geoms):
        spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
    return spec


def differences(binary: str, file: str, spec: mujoco.MjSpec) -> dict[str, float]:
    """Returns the greatest difference of each quantity."""
    printed = subprocess.run([binary, "robot", file, "--json"], check=True, capture_output=True, text=True)
    ours = json.loads(printed.stdout)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qpos[:] = 0
    data.qpos[:7] = model.qpos0[:7]
    if file.endswith(".urdf"):
        # A URDF has no height.
        data.qpos[2] = ours["height_m"]
    mujoco.mj_kinematics(model, data)
    worst: dict[str, float] = {}

    def compare(quantity: str, theirs, found) -> None:
        difference = float(np.abs(np.asarray(theirs) - np.asarray(found)).max())
        worst[quantity] = max(worst.get(quantity, 0.0), difference)

    hinges = [joint for joint in range(model.njnt) if model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE]
    assert len(hinges) == len(ours["hinges"]), file
    for joint, hinge in zip(hinges, ours["hinges"]):
        dof = model.jnt_dofadr[joint]
        assert model.joint(joint).name in ("", hinge["name"]), hinge["name"]
        compare("axis", data.xaxis[joint], hinge["axis"])
        compare("anchor (m)", data.xanchor[joint], hinge["anchor_m"])
        compare("armature (kg·m²)", model.dof_armature[dof], hinge["armature_kgm2"])
        compare("damping (N·m·s/rad)", model.dof_damping[dof], hinge["damping_nmsprad"])
        compare("friction loss (N·m)", model.dof_frictionloss[dof], hinge["friction_loss_nm"])
        assert bool(model.jnt_limited[joint]) == (hinge["min_rad"] is not None), hinge["name"]
        if model.jnt_limited[joint]:
            compare("range (rad)", model.jnt_range[joint], [hinge["min_rad"], hinge["max_rad"]])
    moving = [body for body in range(1, model.nbody) if model.body_weldid[body] != 0]
    assert len(moving) == len(ours["links"]), file
    for body, link in zip(moving, ours["links"]):
        compare("mass (kg)", model.body_mass[body], link["mass_kg"])
        if model.body_mass[body] > 0:
            turn = data.ximat[body].reshape(3, 3)
            compare("centre of mass (m)", data.xipos[body], link["centre_of_mass_m"])
            compare("inertia (kg·m²)", turn @ np.diag(model.body_inertia[body]) @ turn.T, link["inertia_kgm2"])
    return worst


def main() -> int:
    binary, *files = sys.argv[1:]
    is_equal = True
    for file in files:
        found = differences(binary, file, load(file))
        print(file, {quantity: f"{difference:.1e}" for quantity, difference in found.items()})
        is_equal &= max(found.values()) <= LIMIT
    return 0 if is_equal else 1


if __name__ == "__main__":
    sys.exit(main())
