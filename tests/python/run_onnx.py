"""Checks an ONNX model and runs it in onnxruntime on the observations of a trace.

Runs all observations as one batch, and the first one alone as well. Prints each action as a JSON list.

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
(batched,) = session.run(["action"], {"observation": observations})
(single,) = session.run(["action"], {"observation": observations[:1]})
assert numpy.allclose(single, batched[:1], atol=1e-6), (single, batched[:1])
for action in batched.tolist():
    print(json.dumps(action))
