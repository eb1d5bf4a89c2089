"""Plays an exported policy, unchanged, in Gymnasium's Humanoid-v5 (MuJoCo).

Needs: pip install "gymnasium[mujoco]" numpy
       treadmill export RUN --safetensors policy.safetensors

Usage: sim2sim.py policy.safetensors [--episodes 20] [--seed 0] [--json OUT.json] [--trace OUT.jsonl]
                  [--treadmill target/release/treadmill] [--csv FILE.csv]
       sim2sim.py policy.safetensors --check TRACE.jsonl     # made by `treadmill eval policy.safetensors --trace TRACE.jsonl`

--random plays uniformly random actions instead. --check compares this script's actions with Treadmill's for the same
observations. --treadmill plays the policy and random actions in both simulators and prints one table.

The observation is the policy's own; reward and end of an episode are Humanoid-v5's. Treadmill's rows use the policy's own task, so
returns are comparable only if that is Humanoid-v5 with its defaults.
"""

import argparse
import json
import pathlib
import struct
import subprocess
import sys

import gymnasium
import numpy as np

from experiments import report
from experiments.fidelity.policy import Policy

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
TOLERANCE = 1e-5
# Time step of Humanoid-v5's model.
TIMESTEP_S = 0.003


def play(choose, episodes, seed, frame_skip, trace=None):
    """Returns one dictionary per episode. `choose(data)` returns an observation, or None, and the controls. A control step has
    `frame_skip` time steps."""
    environment = gymnasium.make("Humanoid-v5", frame_skip=frame_skip, disable_env_checker=True)
    data = environment.unwrapped.data
    played = []
    for episode in range(episodes):
        environment.reset(seed=seed + episode)
        start_x, total, length, ended = data.qpos[0], 0.0, 0, False
        while not ended:
            observation, controls = choose(data)
            line = {"episode": episode + 1, "step": length + 1, "qpos": data.qpos.tolist(), "qvel": data.qvel.tolist()}
            _, reward, terminated, truncated, info = environment.step(controls)
            total, length, ended = total + reward, length + 1, terminated or truncated
            if trace:
                line |= {"controls": controls.tolist(), "reward": reward, "x_velocity_mps": info["x_velocity"]}
                line |= {} if observation is None else {"observation": observation.tolist()}
                trace.write(json.dumps(line) + "\n")
        distance_m = float(data.qpos[0] - start_x)
        velocity_mps = distance_m / (length * environment.unwrapped.dt)
        entry = {"return": float(total), "length": length, "distance_m": distance_m, "velocity_mps": velocity_mps}
        played.append(entry | {"fell": bool(terminated)})
    environment.close()
    return played


def summary(agent, played, control_step_s):
    """Returns mean, minimum and maximum over episodes. As in `treadmill eval`, mean velocity is total distance / total time."""
    result = {"agent": agent, "simulator": "MuJoCo", "episodes": len(played), "falls": sum(e["fell"] for e in played)}
    for key in ("return", "length", "distance_m", "velocity_mps"):
        values = [episode[key] for episode in played]
        result |= {f"{key}_mean": float(np.mean(values)), f"{key}_min": min(values), f"{key}_max": max(values)}
    time_s = sum(episode["length"] for episode in played) * control_step_s
    result["velocity_mps_mean"] = sum(episode["distance_m"] for episode in played) / time_s
    return result


def in_treadmill(binary, policy, agent, episodes, seed):
    """Returns the summary of `treadmill eval`."""
    which = [str(policy)] if agent == "policy" else ["--agent", agent]
    command = [str(binary), "eval", *which, "--json"]
    run = subprocess.run([*command, "--episodes", str(episodes), "--seed", str(seed)], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)} failed: {run.stderr.strip()}")
    found = json.loads(run.stdout)
    names = {"return_mean": "return_mean", "length_mean": "length_mean"}
    names |= {"distance_m_mean": "distance_mean_m", "velocity_mps_mean": "velocity_mean_mps", "falls": "falls"}
    facts = {"agent": agent, "simulator": "Treadmill", "episodes": found["episodes"]}
    return facts | {mine: found[theirs] for mine, theirs in names.items()}


def check(policy, path):
    """Compares with a trace of `treadmill eval`; exits with 1 if an action differs."""
    largest, steps = 0.0, 0
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            step = json.loads(line)
            difference = np.abs(policy.means(step["observation"]) - np.array(step["action"]))
            largest, steps = max(largest, float(difference.max())), steps + 1
    print(f"{steps} observations: actions differ by at most {largest:.2g}, in units of the action range")
    if steps == 0 or not largest <= TOLERANCE:
        sys.exit(f"actions differ: the tolerance is {TOLERANCE}, and at least one observation is needed")


def table(results):
    """Formats the results as Markdown."""

    def spread(result, key, digits):
        text = f"{result[f'{key}_mean']:.{digits}f}"
        if f"{key}_min" in result:
            text += f" ({result[f'{key}_min']:.{digits}f} to {result[f'{key}_max']:.{digits}f})"
        return text

    header = ["actions", "simulated by", "length (steps)", "distance (m)", "velocity (m/s)", "return", "falls"]
    rows = []
    for result in results:
        columns = [("length", 0), ("distance_m", 2), ("velocity_mps", 2), ("return", 0)]
        numbers = [spread(result, key, digits) for key, digits in columns]
        rows.append([result["agent"], result["simulator"], *numbers, f"{result['falls']} of {result['episodes']}"])
    return report.table(header, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policy", type=pathlib.Path)
    parser.add_argument("--episodes", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--random", action="store_true", help="uniformly random actions instead")
    parser.add_argument("--check", type=pathlib.Path, help="trace of `treadmill eval` for comparing actions")
    parser.add_argument("--trace", type=pathlib.Path, help="file for all steps, one JSON object per line")
    parser.add_argument("--json", type=pathlib.Path, help="file for the results")
    parser.add_argument("--treadmill", type=pathlib.Path, help="the binary, to play in Treadmill too")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    try:
        policy = Policy(arguments.policy)
    except (OSError, ValueError, KeyError, struct.error) as why:
        sys.exit(f"{arguments.policy} is not a policy of `treadmill export --safetensors`: {why!r}")
    if arguments.check:
        check(policy, arguments.check)
        return
    if len(policy.low) != 17:
        sys.exit(f"{arguments.policy} controls {len(policy.low)} motors, but Humanoid-v5 has 17")
    frame_skip = round(policy.facts["control_step_s"] / TIMESTEP_S)
    control_step_s = frame_skip * TIMESTEP_S
    if abs(control_step_s - policy.facts["control_step_s"]) > 1e-9 or frame_skip == 0:
        sys.exit(f"{arguments.policy} has a control step that is no multiple of MuJoCo's time step of {TIMESTEP_S} s")
    rng = np.random.default_rng(arguments.seed)

    def by_policy(data):
        observation = policy.observe(data)
        return observation, policy.controls(observation)

    def at_random(_):
        return None, rng.uniform(policy.low, policy.high).astype(np.float32)

    agents = {"policy": by_policy, "random": at_random}
    chosen = list(agents) if arguments.treadmill else ["random" if arguments.random else "policy"]
    trace = open(arguments.trace, "w", encoding="utf-8") if arguments.trace else None
    results = []
    for agent in chosen:
        if arguments.treadmill:
            more = (agent, arguments.episodes, arguments.seed)
            results.append(in_treadmill(arguments.treadmill, arguments.policy, *more))
        played = play(agents[agent], arguments.episodes, arguments.seed, frame_skip, trace)
        results.append(summary(agent, played, control_step_s))
    if trace:
        trace.close()
    made = report.circumstances()
    count = policy.facts["observation"]["count"]
    origin = f"Observation `{policy.kind}`, statistics over {count / 1e6:.1f} M environment steps. {report.made_by(made)}"
    text = f"{origin} Mean over {arguments.episodes} episodes (minimum to maximum).\n\n{table(results)}"
    print(text)
    if arguments.json:
        report.write_json(arguments.json, {"made": made, "results": results})
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
