#!/usr/bin/env python3
"""Counts which pushes end in a fall here and in MuJoCo, from the same states with the same policy.

Usage: pushes.py POLICY.onnx TRACE.jsonl --model FILE.xml

The trace has a push every three seconds:

    treadmill eval POLICY.safetensors --episodes 40 --trace TRACE.jsonl --set 'randomisation.push_mps=[0.7,0.7]' \\
        --set 'randomisation.push_interval_s=[3.0,3.0]'

MuJoCo begins with the state one control step after each push, and follows the trace's commands until the next one. Needs what
`python -m treadmill_transfer` needs.
"""

import argparse
import itertools
import json

import numpy
from treadmill_transfer.contract import Policy
from treadmill_transfer.controller import Controller
from treadmill_transfer.robot import Robot
from treadmill_transfer.trace import read_trace

PUSH_EVERY_S = 3.0


def falls_in_mujoco(robot, controller, lines, begin, steps):
    """Returns whether the robot falls within `steps` from the state of line `begin` of an episode."""
    limit = robot.contract.action_limit
    controller.reset()
    for line in lines[:begin]:
        controller.taken(limit * numpy.clip(line["action"], -1.0, 1.0))
    robot.set_state(lines[begin]["qpos"], lines[begin]["qvel"])
    for step in range(begin, begin + steps):
        command = lines[min(step, len(lines) - 1)]["command"]
        robot.step(controller.taken(controller.act(controller.observe(robot, command))))
        if robot.has_fallen():
            return True
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policy")
    parser.add_argument("trace")
    parser.add_argument("--model", required=True)
    parser.add_argument("--steps", type=int, default=1000, help="control steps of a whole episode of the trace; default 1000")
    arguments = parser.parse_args()
    policy = Policy(arguments.policy)
    robot, controller = Robot(arguments.model, policy.contract), Controller(policy)
    every = round(PUSH_EVERY_S / policy.contract.control_step_s)
    counts = dict.fromkeys(("pushes", "falls", "falls_in_mujoco", "the_same"), 0)
    for _, episode in itertools.groupby(read_trace(arguments.trace, len(robot.hinge_names)), lambda line: line["episode"]):
        lines = list(episode)
        for push in range(every, len(lines) - 1, every):
            falls = len(lines) < arguments.steps and len(lines) <= push + every
            in_mujoco = falls_in_mujoco(robot, controller, lines, push + 1, every - 1)
            for key, value in zip(counts, (1, falls, in_mujoco, falls and in_mujoco)):
                counts[key] += value
    print(json.dumps(counts))


if __name__ == "__main__":
    main()
