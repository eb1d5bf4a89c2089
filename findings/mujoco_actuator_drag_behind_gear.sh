#!/usr/bin/env bash
# MuJoCo: the quadratic drag of a rotor behind a gear is too small by the gear, the cubic one by its square.
#
# One would guess: `damping="a b c"` of an actuator, "contributed by the actuator to its transmission target" like its armature, is
# the drag of the spinning rotor, a v + b v |v| + c v³ at the rotor's speed v. Behind a gear of 10 the rotor turns ten times as fast as
# the joint and its torque arrives tenfold: 10² of the linear coefficient, 10³ of the quadratic and 10⁴ of the cubic one.
# Seen: all three are multiplied by 10². A rotor with drag in the square of its speed, as a fan has, brakes the joint with a tenth of
# its torque, and differently from a joint at the rotor's own speed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet mujoco==4.0.0
cd "$folder"
"$folder/python/bin/python" - <<'PYTHON'
import mujoco

ROBOT = """<mujoco><worldbody><body><joint name="j"/><geom size="0.1" mass="1"/></body></worldbody>
  <actuator><motor joint="j" gear="{}" damping="{}"/></actuator></mujoco>"""


def torque(gear, damping, rate):
    """Returns the passive torque at a joint that turns at this rate."""
    model = mujoco.MjModel.from_xml_string(ROBOT.format(gear, damping))
    data = mujoco.MjData(model)
    data.qvel[0] = rate
    mujoco.mj_forward(model, data)
    return -data.qfrc_passive[0]


print("mujoco", mujoco.__version__)
gear, rate = 10, 2.0
for power, damping in enumerate(("0.1", "0 0.1", "0 0 0.1"), start=1):
    of_rotor = gear * 0.1 * (gear * rate) ** power
    found = torque(gear, damping, rate)
    print(f"drag of power {power}: a rotor at {gear * rate} rad/s gives the joint {of_rotor:g} N·m; MuJoCo {found:g} N·m")
    assert abs(found * gear ** (power - 1) - of_rotor) < 1e-9 * of_rotor, found
PYTHON
