#!/usr/bin/env bash
# MuJoCo lets a knee of a URDF bend the wrong way if one end of its range is 0 and left out.
#
# One would guess: `<limit lower="-0.5" effort="9" velocity="3"/>` is a range from -0.5 to 0, because the format says that `upper` is
# 0 where it is absent, as urdfdom reads it.
# Seen: the model has the range [-0.5, 0], but the joint is not limited, without a warning; it turns as far as it is pushed. With
# upper="0" written out it is limited. A range that ends before it begins is not limited either, also without a warning; equal ends
# are not limited, but warned of.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet mujoco==4.0.0
cd "$folder"
"$folder/python/bin/python" - <<'PYTHON'
import mujoco

ROBOT = """<robot name="leg"><link name="thigh"/>
  <link name="shank"><inertial><origin xyz="0 0 -0.2"/><mass value="2"/>
    <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="knee" type="revolute"><parent link="thigh"/><child link="shank"/><axis xyz="0 1 0"/>
    <limit {} effort="9" velocity="3"/></joint></robot>"""


def turned(limit):
    """Returns range, whether it holds, and the angle after a push of 5 N·m for one second without gravity."""
    model = mujoco.MjModel.from_xml_string(ROBOT.format(limit))
    model.opt.gravity[:] = 0
    data = mujoco.MjData(model)
    data.qfrc_applied[0] = 5
    mujoco.mj_step(model, data, round(1 / model.opt.timestep))
    return model.jnt_range[0].tolist(), bool(model.jnt_limited[0]), round(float(data.qpos[0]), 2)


print("mujoco", mujoco.__version__)
half, whole, reverse = (turned(limit) for limit in ('lower="-0.5"', 'lower="-0.5" upper="0"', 'lower="0.5" upper="-0.5"'))
print("upper left out:", half, "| written:", whole, "| reversed:", reverse)
assert half[:2] == ([-0.5, 0.0], False) and half[2] > 1, half
assert whole[:2] == ([-0.5, 0.0], True) and whole[2] < 0.1, whole
assert reverse[1] is False and reverse[2] > 1, reverse
PYTHON
