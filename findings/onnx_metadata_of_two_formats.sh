#!/usr/bin/env bash
# A policy that one framework exports for its robots cannot be loaded by another one's controller: one writes the metadata of the ONNX
# file as comma-separated lists, the other reads every entry as JSON.
#
# One would guess: metadata_props are strings by key; a reader takes the keys that it knows, and leaves alone what others wrote.
# Seen: holosoma-inference parses each entry, also of keys that it never uses, before it looks for its gains. A file with the entry
# `joint_names` as mjlab writes it, or with a plain text such as a name of a run, is refused, though gains under its own keys are
# there. The error names neither key nor file. Numbers alone pass: a list of one number is read as a number.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet holosoma-inference==0.1.3 onnx==1.23.2
cd "$folder"
"$folder/python/bin/python" - <<'PYTHON'
import importlib.metadata
import types

import onnx
from holosoma_inference.policies.base import BasePolicy


def load(entries):
    """Returns the gains that the controller finds in a policy with these entries, or its error."""
    node = onnx.helper.make_node("Identity", ["obs"], ["action"])
    tensors = [onnx.helper.make_tensor_value_info(name, onnx.TensorProto.FLOAT, [1, 2]) for name in ("obs", "action")]
    graph = onnx.helper.make_graph([node], "policy", tensors[:1], tensors[1:])
    model = onnx.helper.make_model(graph, ir_version=9, opset_imports=[onnx.helper.make_opsetid("", 17)])
    onnx.helper.set_model_props(model, entries)
    onnx.save(model, "policy.onnx")
    controller = types.SimpleNamespace()
    try:
        BasePolicy.setup_policy(controller, "policy.onnx")
    except ValueError as why:
        return f"{type(why).__name__}: {why}"
    return controller.onnx_kp.tolist()


print("holosoma-inference", importlib.metadata.version("holosoma-inference"), "onnx", onnx.__version__)
own = {"kp": "[40.0, 30.0]", "kd": "[2.0, 1.0]"}
alone = load(own)
beside_list = load({**own, "joint_names": "left_hip,right_hip"})
beside_text = load({**own, "run_path": "my first walk"})
of_one = load({"kp": "40.000", "kd": "2.000"})
print("its own entries:", alone, "| with a list of names:", beside_list, "| with a text:", beside_text, "| of one hinge:", of_one)
assert alone == [40.0, 30.0], alone
assert beside_list.startswith("JSONDecodeError") and "joint_names" not in beside_list, beside_list
assert beside_text.startswith("JSONDecodeError"), beside_text
assert of_one == 40.0, of_one
PYTHON
