#!/usr/bin/env bash
# MuJoCo bolts a robot's URDF to the world and drops the names of links.
#
# One would guess: the root link of a URDF becomes a body of that name, with its mass; a link on a fixed joint keeps its name,
# so a sensor or a foot can be found by it.
# Seen: the root link is part of the world and its mass is gone; a fixed link's mass moves to its parent and its name is gone. The
# two settings that keep them are in an extension element, `<mujoco><compiler fusestatic="false"/></mujoco>` for the names; even
# then the root has no free joint. A `mimic` joint, in contrast, is coupled.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet mujoco==4.0.0
"$folder/python/bin/python" - <<'PYTHON'
import mujoco

INERTIAL = '<inertial><mass value="{}"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
ROBOT = f"""<robot name="leg">{{}}
  <link name="pelvis">{INERTIAL.format(8)}</link>
  <link name="thigh">{INERTIAL.format(4)}</link>
  <link name="shank">{INERTIAL.format(2)}</link>
  <link name="foot">{INERTIAL.format(1)}</link>
  <joint name="hip" type="revolute"><parent link="pelvis"/><child link="thigh"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="30" velocity="2"/></joint>
  <joint name="knee" type="revolute"><parent link="thigh"/><child link="shank"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="30" velocity="2"/><mimic joint="hip" multiplier="0.5"/></joint>
  <joint name="ankle" type="fixed"><parent link="shank"/><child link="foot"/></joint>
</robot>"""


def bodies(extension):
    model = mujoco.MjModel.from_xml_string(ROBOT.format(extension))
    masses = {model.body(body).name: float(model.body_mass[body]) for body in range(model.nbody)}
    return masses, model.neq, [int(kind) for kind in model.jnt_type]


print("mujoco", mujoco.__version__)
usual, kept = bodies(""), bodies('<mujoco><compiler fusestatic="false"/></mujoco>')
print("as it is:", usual)
print("fusestatic false:", kept)
hinge = int(mujoco.mjtJoint.mjJNT_HINGE)
assert usual == ({"world": 0, "thigh": 4, "shank": 3}, 1, [hinge, hinge]), usual
assert kept == ({"world": 0, "pelvis": 8, "thigh": 4, "shank": 2, "foot": 1}, 1, [hinge, hinge]), kept
PYTHON
