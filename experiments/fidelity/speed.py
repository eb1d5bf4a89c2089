"""Compares the speed of Treadmill's environment with Gymnasium's Humanoid-v5 and plain MuJoCo, in turn on one core.

Needs: pip install "gymnasium[mujoco]" numpy
       cargo build --release

Usage: taskset -c 0 speed.py target/release/treadmill [--rounds 5] [--seconds 3] [--json OUT.json] [--doc docs/results/fidelity.md]

Each candidate runs once per round, so that changes of the machine's speed affect all. Actions are random, resets are included, and
a step is one control step of 15 ms. Treadmill steps 64 humanoids in turn, like an actor; MuJoCo steps one, which stays in the
processor's cache. Run it on an idle machine.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

import gymnasium
import mujoco
import numpy as np

import body
import report

HEALTHY_M = (1.0, 2.0)
RAW = {"RK4": "MuJoCo, RK4, 5 × 3 ms", "Euler": "MuJoCo, Euler, 5 × 3 ms", "implicitfast": "MuJoCo, implicitfast, 5 × 3 ms"}
GYMNASIUM = "Gymnasium Humanoid-v5"
COMPACT, FULL = "Treadmill, compact observation", "Treadmill, gymnasium-v5 observation"
PHYSICS = "Treadmill, physics only"


def actions(seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(-body.CONTROL_LIMIT, body.CONTROL_LIMIT, (4096, 17)).astype(np.float32)


def treadmill(binary, steps, observation):
    """Returns the output of `bench env`, or None if the binary lacks --observation."""
    command = [str(binary), "bench", "env", "--steps", str(steps), "--json"]
    if observation != "compact":
        command += ["--observation", observation]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode == 2 and "--observation" in run.stderr:
        return None
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)} failed: {run.stderr.strip()}")
    return json.loads(run.stdout.strip().splitlines()[-1])


def gymnasium_speed(seconds, seed):
    """Returns control steps per second of the environment in its usual loop."""
    environment = gymnasium.make("Humanoid-v5", disable_env_checker=True)
    environment.reset(seed=seed)
    steps, given, begun = 0, actions(seed), time.perf_counter()
    while time.perf_counter() - begun < seconds:
        for action in given[steps % 4096 : steps % 4096 + 64]:
            _, _, terminated, truncated, _ = environment.step(action)
            if terminated or truncated:
                environment.reset()
        steps += 64
    return steps / (time.perf_counter() - begun)


def raw_speed(integrator, seconds, seed):
    """Returns control steps per second of plain MuJoCo: no observation, no reward."""
    model = body.load()
    model.opt.integrator = body.INTEGRATORS[integrator]
    data, rng, given = mujoco.MjData(model), np.random.default_rng(seed), actions(seed)
    steps, begun = 0, time.perf_counter()
    while time.perf_counter() - begun < seconds:
        for action in given[steps % 4096 : steps % 4096 + 64]:
            data.ctrl[:] = action
            mujoco.mj_step(model, data, nstep=5)
            if not HEALTHY_M[0] < data.qpos[2] < HEALTHY_M[1]:
                mujoco.mj_resetData(model, data)
                data.qpos[:] += rng.uniform(-0.01, 0.01, 24)
                data.qvel[:] = rng.uniform(-0.01, 0.01, 23)
        steps += 64
    return steps / (time.perf_counter() - begun)


def one_round(arguments, number):
    """Returns control steps per second of each candidate."""
    found = {}
    compact = treadmill(arguments.treadmill, arguments.steps, "compact")
    found[COMPACT], found[PHYSICS] = compact["env_steps_per_s"], compact["physics_only_steps_per_s"]
    full = treadmill(arguments.treadmill, arguments.steps, "gymnasium-v5")
    if full:
        found[FULL] = full["env_steps_per_s"]
    found[GYMNASIUM] = gymnasium_speed(arguments.seconds, number)
    for integrator, name in RAW.items():
        found[name] = raw_speed(integrator, arguments.seconds, number)
    return found


def table(rounds):
    """Formats median, range and median ratios; each ratio is taken within one round."""

    def median(name):
        return statistics.median(found[name] for found in rounds)

    def ratio(name, base):
        return f"{statistics.median(found[name] / found[base] for found in rounds):.2f}"

    rows = []
    for name in sorted(rounds[0], key=median, reverse=True):
        rates = [found[name] for found in rounds]
        spread = f"{min(rates):.0f} to {max(rates):.0f}"
        rows.append([name, f"{median(name):.0f}", spread, ratio(name, GYMNASIUM), ratio(name, RAW["RK4"])])
    return report.table(["", "control steps/s", "range", "× Gymnasium", "× MuJoCo, RK4"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=3.0, help="per MuJoCo candidate and round")
    parser.add_argument("--steps", type=int, default=20_000, help="per Treadmill candidate and round")
    parser.add_argument("--core", type=int, help="core to pin to; default: the first allowed one")
    parser.add_argument("--json", type=pathlib.Path, help="file for all numbers")
    parser.add_argument("--doc", type=pathlib.Path, help="page whose generated part is replaced")
    arguments = parser.parse_args()
    core = min(os.sched_getaffinity(0)) if arguments.core is None else arguments.core
    os.sched_setaffinity(0, {core})
    load = os.getloadavg()[0]
    rounds = [one_round(arguments, number) for number in range(arguments.rounds)]
    made = report.circumstances(body.REPOSITORY)
    text = f"{report.made_by(made)} {len(rounds)} rounds; load of the machine before: {load:.1f}.\n\n{table(rounds)}"
    if FULL not in rounds[0]:
        text += "\nLeft out: the gymnasium-v5 observation, because this binary's `bench env` has no `--observation`.\n"
    print(text)
    if arguments.json:
        report.write_json(arguments.json, {"made": made, "load": load, "rounds": rounds})
    if arguments.doc:
        report.replace(arguments.doc, "speed.py", text)


if __name__ == "__main__":
    main()
