"""Checks an ONNX model with ONNX's checker and runs it on the observations of a trace, all at once and the first one alone.
Prints each action as a JSON list. A broken sensor must be seen in every action: NaN in one entry makes all of them NaN.

Usage: run_onnx.py MODEL TRACE [RUNTIME]

RUNTIME is onnxruntime, openvino or tract, by default onnxruntime.
"""

import json
import sys

import numpy
import onnx


def by_onnxruntime(path, _):
    """Returns a function of a batch."""
    import onnxruntime

    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    return lambda batch: session.run(None, {session.get_inputs()[0].name: batch})[0]


def by_openvino(path, _):
    """Returns a function of a batch."""
    import openvino

    # By default, processors with bfloat16 round to it.
    model = openvino.compile_model(path, "CPU", {"INFERENCE_PRECISION_HINT": "f32"})
    return lambda batch: model(batch)[0]


def by_tract(path, width):
    """Returns a function of a batch."""
    import tract

    def run(batch):
        model = tract.onnx().load(path)
        model.set_input_fact(0, f"{len(batch)},{width},f32")
        return model.into_model().into_runnable().run([batch])[0].to_numpy()

    return run


path, trace = sys.argv[1:3]
model = onnx.load(path)
onnx.checker.check_model(model, full_check=True)
batch, width = model.graph.input[0].type.tensor_type.shape.dim
runtimes = {"onnxruntime": by_onnxruntime, "openvino": by_openvino, "tract": by_tract}
run = runtimes[sys.argv[3] if len(sys.argv) > 3 else "onnxruntime"](path, width.dim_value)
with open(trace, encoding="utf-8") as lines:
    observations = numpy.array([json.loads(line)["observation"] for line in lines], dtype=numpy.float32)
# A model for Unitree's controllers takes one observation at a time.
batches = [observations] if batch.dim_param else numpy.split(observations, len(observations))
together = numpy.concatenate([run(batch) for batch in batches])
alone = run(observations[:1])
assert numpy.allclose(alone, together[:1], atol=1e-6), (alone, together[:1])
for entry in range(width.dim_value):
    broken = observations[:1].copy()
    broken[0, entry] = numpy.nan
    assert numpy.isnan(run(broken)).all(), entry
for action in together.tolist():
    print(json.dumps(action))
