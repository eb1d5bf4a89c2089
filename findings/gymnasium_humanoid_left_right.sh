#!/usr/bin/env bash
# Gymnasium's humanoid is not symmetric.
#
# One would guess: the model of Humanoid-v5 has equal left and right limbs, so the mirrored state and action give the mirrored
# motion.
# Seen: two hinges of the legs differ, in armature and in stiffness.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet 'gymnasium[mujoco]==1.4.0' mujoco==4.0.0
"$folder/python/bin/python" - <<'PYTHON'
import importlib.metadata
import pathlib

import gymnasium.envs.mujoco
import mujoco

file = pathlib.Path(gymnasium.envs.mujoco.__file__).parent / "assets/humanoid.xml"
model = mujoco.MjModel.from_xml_path(str(file))
print("gymnasium", importlib.metadata.version("gymnasium"), "mujoco", mujoco.__version__)
different = set()
for joint in range(model.njnt):
    right = model.joint(joint)
    if right.name.startswith("right_"):
        left = model.joint(right.name.replace("right_", "left_"))
        for what in ("stiffness", "armature", "damping", "frictionloss"):
            values = float(getattr(right, what)[0]), float(getattr(left, what)[0])
            if values[0] != values[1]:
                print(f"{right.name}: {what} {values[0]:g}, on the left {values[1]:g}")
                different.add((right.name, what))
assert different == {("right_hip_y", "armature"), ("right_knee", "stiffness")}, different
PYTHON
