"""Compares URDF files in Treadmill and in MuJoCo's own URDF reader: what `robot` prints, and the motion under random torques.

Usage: compare_urdf.py treadmill FILE...

MuJoCo's robot gets a free joint, the height at which Treadmill's stands, and a motor for each hinge. Both move it in flight,
without shapes, since MuJoCo looks for all meshes in one folder. MuJoCo starts each of 40 control steps of 2 ms from Treadmill's
state and takes 200 steps of 0.01 ms. The error is that of the velocity after the step, in the norm of the kinetic energy,
relative to its change. Fails if a number differs by more than 1e-6, or the motion by more than 1 %.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import compare
import mujoco
import numpy as np

CONTROL_STEP_S = 0.002
REFERENCE_STEPS = 200
MOTION_LIMIT = 0.01
# An ordinary control step, without noise, and without an end before 40 steps.
SETTINGS = {
    "reset_noise_scale": "0",
    "terminate_when_unhealthy": "false",
    "healthy_z_range": "[-inf,inf]",
    "control_step_s": str(CONTROL_STEP_S),
    "substeps": "50",
    "max_episode_steps": "40",
}


def without_shapes(file: str) -> ElementTree.Element:
    """Returns a URDF of links and joints alone. Joints that Treadmill holds still are fixed, and no motor is stronger than the
    robot's weight at 5 cm: files say 50,000 N·m, which turn a hinge through its range in one step."""
    robot = ElementTree.parse(file).getroot()
    for element in list(robot):
        if element.tag not in ("link", "joint"):
            robot.remove(element)
    for link in robot.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    joints = list(robot.iter("joint"))
    masses = {link.get("name"): float(mass.get("value")) for link in robot.iter("link") if (mass := link.find("inertial/mass")) is not None}
    heavy = {name for name, mass in masses.items() if mass > 0}
    # A parent of a link with mass moves mass.
    for _ in joints:
        heavy |= {joint.find("parent").get("link") for joint in joints if joint.find("child").get("link") in heavy}
    for joint in joints:
        if joint.find("mimic") is not None or joint.find("child").get("link") not in heavy:
            joint.set("type", "fixed")
        if (limit := joint.find("limit")) is not None:
            limit.set("effort", str(min(float(limit.get("effort", 0)), 0.05 * 9.81 * sum(masses.values()))))
    return robot


def in_mujoco(robot: ElementTree.Element) -> mujoco.MjSpec:
    """Returns MuJoCo's reading of a URDF with a free root and motors."""
    efforts = {joint.get("name"): float(joint.find("limit").get("effort")) for joint in robot.iter("joint") if joint.find("limit") is not None}
    # Fused links would lose their names.
    ElementTree.SubElement(ElementTree.SubElement(robot, "mujoco"), "compiler", fusestatic="false")
    spec = mujoco.MjSpec.from_string(ElementTree.tostring(robot, encoding="unicode"))
    root = spec.worldbody.first_body()
    if not root.joints:
        root.add_freejoint()
    for joint in list(spec.joints):
        if joint.type == mujoco.mjtJoint.mjJNT_HINGE and efforts[joint.name] > 0:
            gear = [efforts[joint.name], 0, 0, 0, 0, 0]
            spec.add_actuator(name=joint.name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT, gear=gear)
    return spec


def motion(binary: str, robot: ElementTree.Element, model: mujoco.MjModel) -> float:
    """Returns the largest error of a control step."""
    with tempfile.TemporaryDirectory() as folder:
        file, trace = pathlib.Path(folder, "robot.urdf"), pathlib.Path(folder, "trace.jsonl")
        file.write_bytes(ElementTree.tostring(robot))
        command = [binary, "eval", "--agent", "random", "--model", file, "--episodes", "1", "--trace", trace, "--print-every", "0"]
        settings = [part for key, value in SETTINGS.items() for part in ("--set", f"env.{key}={value}")]
        subprocess.run([*command, *settings, "--json"], check=True, capture_output=True)
        lines = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    data, mass_matrix = mujoco.MjData(model), np.zeros((model.nv, model.nv))
    model.opt.timestep = CONTROL_STEP_S / REFERENCE_STEPS
    least = 0.1 * model.body_subtreemass[0] * (9.81 * CONTROL_STEP_S) ** 2
    worst = 0.0
    for line, following in zip(lines, lines[1:]):
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:], data.ctrl[:] = line["qpos"], line["qvel"], np.clip(line["action"], -1, 1)
        before = data.qvel.copy()
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, mass_matrix)
        mujoco.mj_step(model, data, REFERENCE_STEPS)
        change, error = data.qvel - before, np.array(following["qvel"]) - data.qvel
        worst = max(worst, float(np.sqrt(error @ mass_matrix @ error / max(change @ mass_matrix @ change, least))))
    return worst


def main() -> int:
    binary, *files = sys.argv[1:]
    is_equal = True
    for file in files:
        spec = in_mujoco(without_shapes(file))
        found = compare.differences(binary, file, spec)
        spec.worldbody.first_body().pos = [0, 0, 0]
        error = motion(binary, without_shapes(file), spec.compile())
        print(file, {quantity: f"{difference:.1e}" for quantity, difference in found.items()}, f"motion {error:.1e}", flush=True)
        is_equal &= max(found.values()) <= compare.LIMIT and error <= MOTION_LIMIT
    return 0 if is_equal else 1


if __name__ == "__main__":
    sys.exit(main())
