#!/usr/bin/env bash
# mjlab writes gains, scales and angles into its ONNX files with three digits after the point, so small robots lose theirs.
#
# One would guess: the metadata of an exported policy holds the numbers with which it was trained, in single precision at least.
# Seen: a damping of 0.0004 N·m·s/rad is written as 0.000, 0.0037 as 0.004 (8 % more), a scale of 0.00125 as 0.001 (20 % less). Robots of
# 3 kg with hobby servos have such gains. A controller that takes them from the file runs without damping.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet --no-deps mjlab==1.6.0
"$folder/python/bin/pip" install --quiet onnx==1.23.2
cd "$folder"
"$folder/python/bin/python" - <<'PYTHON'
import importlib.metadata
import importlib.util
import sys
import types
from unittest import mock

import onnx

# The writer's own file; what it imports for the types of its other functions is not needed.
for name in ("torch", "mjlab.entity", "mjlab.envs", "mjlab.envs.mdp", "mjlab.envs.mdp.actions"):
    sys.modules[name] = mock.MagicMock(spec=types.ModuleType(name))
sys.modules["mjlab.entity"].Entity = sys.modules["mjlab.envs"].ManagerBasedRlEnv = object
sys.modules["mjlab.envs.mdp.actions"].JointPositionAction = object
path = importlib.metadata.distribution("mjlab").locate_file("mjlab/rl/exporter_utils.py")
spec = importlib.util.spec_from_file_location("exporter_utils", path)
writer = importlib.util.module_from_spec(spec)
spec.loader.exec_module(writer)

node = onnx.helper.make_node("Identity", ["obs"], ["action"])
tensors = [onnx.helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, [1, 3]) for name in ("obs", "action")]
onnx.save(onnx.helper.make_model(onnx.helper.make_graph([node], "policy", tensors[:1], tensors[1:])), "policy.onnx")
given = [0.0004, 0.0037, 0.00125]
writer.attach_metadata_to_onnx("policy.onnx", {"joint_damping": given})
written = onnx.load("policy.onnx").metadata_props[0].value
print("mjlab", importlib.metadata.version("mjlab"), "onnx", onnx.__version__)
print("given:", given, "| written:", written)
assert written == "0.000,0.004,0.001", written
PYTHON
