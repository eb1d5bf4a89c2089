"""Checks an ONNX model with ONNX's own checker, runs it in onnxruntime on the observations of a trace, all at once and the first
one alone, and prints the actions as JSON, one list each.

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
(together,) = session.run(["action"], {"observation": observations})
(alone,) = session.run(["action"], {"observation": observations[:1]})
assert numpy.allclose(alone, together[:1], atol=1e-6), (alone, together[:1])
for action in together.tolist():
    print(json.dumps(action))
