"""Checks an ONNX model with ONNX's checker and runs it in onnxruntime on the observations of a trace, all at once and the
first one alone. Prints each action as a JSON list.

Usage: run_onnx.py MODEL TRACE
"""

import json
import sys

import numpy
import onnx
import onnxruntime

model, trace = sys.argv[1:]
onnx.checker.check_model(onnx.load(model), full_check=True)
session = onnxruntime.InferenceSession(model, providers=["CPUExecutionProvider"])
with open(trace, encoding="utf-8") as lines:
    observations = numpy.array([json.loads(line)["observation"] for line in lines], dtype=numpy.float32)
port = session.get_inputs()[0]
# A model for Unitree's controllers takes one observation at a time.
batches = [observations] if isinstance(port.shape[0], str) else numpy.split(observations, len(observations))
together = numpy.concatenate([session.run(None, {port.name: batch})[0] for batch in batches])
(alone,) = session.run(None, {port.name: observations[:1]})
assert numpy.allclose(alone, together[:1], atol=1e-6), (alone, together[:1])
for action in together.tolist():
    print(json.dumps(action))
