"""Rows of the table that speed.py writes: what runs on both sides of each comparison."""

import concurrent.futures
import contextlib
import dataclasses
import functools
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import typing

import mujoco

from experiments import report
from experiments.fidelity import body, speed_peers
from experiments.fidelity import measure as fidelity

HEALTHY_M = (1.0, 2.0)
ROBOT_REASON = "the row of the servo robot is left out"
SEEDS = (1, 2, 3)


@dataclasses.dataclass
class Row:
    """Comparison: `ours` and `peer` measure control steps per second."""

    key: str
    what: str
    against: str
    ours: typing.Callable
    peer: typing.Callable
    cores: str = "1"


class Context:
    """Arguments, cores and simulators that several rows share."""

    def __init__(self, arguments, cores):
        self.arguments, self.one, self.two = arguments, set(cores[:1]), set(cores[:2])
        self.binary = arguments.treadmill
        self.substeps = fidelity.default_substeps(self.binary)
        self.step = fidelity.step_name(self.substeps)

    @contextlib.contextmanager
    def pinned(self, cores):
        """Restricts this thread, and the threads and processes that it starts, to these cores."""
        before = os.sched_getaffinity(0)
        os.sched_setaffinity(0, cores)
        try:
            yield
        finally:
            os.sched_setaffinity(0, before)

    def on(self, cores, function, *given):
        """Returns a function that calls `function` on these cores."""

        def run():
            with self.pinned(cores):
                return function(*given)

        return run

    def output(self, command, cores):
        """Runs a command on these cores. Returns the JSON object that it prints, or its first line of errors."""
        with self.pinned(cores):
            run = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if run.returncode != 0:
            return run.stderr.strip().splitlines()[0]
        return json.loads(run.stdout.strip().splitlines()[-1])

    def bench(self, key, *options, cores=None, what="env"):
        """Returns an entry of `treadmill bench`'s result."""
        steps = self.arguments.steps if what == "env" else 500_000
        command = [self.binary, "bench", what, "--json", "--steps", steps, *options]
        result = self.output(command, cores or self.one)
        if isinstance(result, str):
            sys.exit(f"{' '.join(map(str, command))} failed: {result}")
        return result[key]

    @functools.cache
    def rollouts(self, integrator, substeps):
        """Returns MuJoCo's humanoid with these steps."""
        return speed_peers.Rollouts(body.load(), integrator, substeps, HEALTHY_M)

    @functools.cached_property
    def env_pool(self):
        """EnvPool; its threads keep the cores on which they start."""
        with self.pinned(self.two):
            return speed_peers.EnvPool()


def rows(context):
    """Returns the rows that this machine and the arguments allow."""
    seconds, env, physics = context.arguments.seconds, "env_steps_per_s", "physics_only_steps_per_s"

    def rollout(integrator, substeps):
        return context.on(context.one, lambda: context.rollouts(integrator, substeps).speed(seconds))

    gymnasium = context.on(context.one, speed_peers.gymnasium_environment, seconds, 1)
    ours_physics = functools.partial(context.bench, physics)
    label, alone = f"physics alone, {context.step}", "MuJoCo alone"
    compact = functools.partial(context.bench, env)
    full = functools.partial(context.bench, env, "--observation", "gymnasium-v5")
    task = "Gymnasium's Humanoid-v5"
    found = [
        Row("environment", "environment, compact observation", task, compact, gymnasium),
        Row("environment_v5", "environment, Gymnasium's observation", task, full, gymnasium),
        Row("rk4", label, f"{alone}, RK4, 5 × 3 ms", ours_physics, rollout("RK4", 5)),
        Row("euler_5", label, f"{alone}, Euler, 5 × 3 ms", ours_physics, rollout("Euler", 5)),
        Row("euler_2", label, f"{alone}, Euler, 2 × 7.5 ms", ours_physics, rollout("Euler", 2)),
    ]
    if len(context.two) == 2:
        threads = functools.partial(context.bench, env, "--threads", 2, cores=context.two)
        pool = context.on(context.two, lambda: context.env_pool.speed(seconds))
        found.append(Row("env_pool", "64 environments, 2 threads", "EnvPool's Humanoid-v5, the same", threads, pool, "2"))
        found.append(Row("threads", "64 environments, 2 threads", "Treadmill, 1 thread", threads, compact, "2 and 1"))
        # What the machine itself allows: cores share power, cache and memory, and those of a virtual machine may share more.
        both = functools.partial(processes, context)
        found.append(Row("processes", "64 environments, 2 threads", "two Treadmills of 1 thread at once", threads, both, "2"))
    else:
        print("only one core: the rows of two threads are left out", file=sys.stderr)
    found += robot_rows(context)
    if context.arguments.training:
        train = functools.partial(context.bench, env, cores=context.two, what="train")
        peer = context.on(context.two, speed_peers.stable_baselines, 20_480, len(context.two))
        found.append(Row("training", "trained steps, `treadmill bench train`", "Stable-Baselines3's PPO", train, peer, "2"))
    return found


def processes(context):
    """Returns the summed speed of two processes, one per core, at the same time."""

    def run(core):
        return context.bench("env_steps_per_s", cores={core})

    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return sum(pool.map(run, context.two))


def robot_rows(context):
    """Returns the row of the servo robot, or none with a message."""
    file, substeps = context.arguments.robot, context.arguments.robot_substeps
    low, high = (float(height) for height in context.arguments.robot_healthy.split(","))
    options = ["--model", file, "--set", f"env.healthy_z_range=[{low},{high}]", "--set", f"env.substeps={substeps}"]
    if not file.exists():
        print(f"{file} does not exist: {ROBOT_REASON}", file=sys.stderr)
        return []
    tried = context.output([context.binary, "bench", "env", "--json", "--steps", 64, *options], context.one)
    if isinstance(tried, str):
        print(f"{tried}: {ROBOT_REASON}", file=sys.stderr)
        return []
    rollouts = speed_peers.Rollouts(mujoco.MjModel.from_xml_path(str(file)), "Euler", substeps, (low, high))
    ours = functools.partial(context.bench, "physics_only_steps_per_s", *options)
    theirs = context.on(context.one, rollouts.speed, context.arguments.seconds)
    step = fidelity.step_name(substeps)
    against = f"MuJoCo alone, Euler, {step}, the same file"
    return [Row("robot", f"29 servo hinges on bumps, physics alone, {step}", against, ours, theirs)]


def state_errors(context):
    """Returns mean joint-angle errors (rad) against MuJoCo's RK4: name → [0.15 s in flight, 0.3 s into an episode]."""
    example = context.arguments.open_loop
    if not example.exists():
        print(f"{example} does not exist: state errors are left out", file=sys.stderr)
        return {}
    with tempfile.TemporaryDirectory() as folder:
        candidates = fidelity.Candidates(fidelity.OpenLoop(example, pathlib.Path(folder)), context.substeps)
        candidates.keep([candidates.default, fidelity.euler_name(2), fidelity.euler_name(5)])
        played = fidelity.random_cases()
        flight = fidelity.rollouts(candidates, played["flights"], (0.15,), contact=False, limits=True)
        episode = fidelity.rollouts(candidates, played["drops_random"], (0.3,), contact=True, limits=True)
    pairs = zip(flight["rows"], episode["rows"])
    return {one["name"]: [one["angle_mean_rad"][0], two["angle_mean_rad"][0]] for one, two in pairs}


def times_to_10_m(context):
    """Returns the training time (s) at which each run's policy first walked 10 m: run → s, or None if it never did."""
    if context.arguments.training and not context.arguments.runs:
        with tempfile.TemporaryDirectory() as root, context.pinned(context.two):
            folders = [train(context, pathlib.Path(root), seed) for seed in SEEDS]
            return {folder.name: time_to_10_m(folder) for folder in folders}
    return {folder.name: time_to_10_m(folder) for folder in context.arguments.runs}


def train(context, root, seed):
    """Trains the default preset. Returns the run folder."""
    folder = root / f"seed {seed}"
    command = [context.binary, "train", "--seed", seed, "--steps", 4_000_000, "--run-dir", folder]
    command += ["--set", "eval.episodes=20", "--json", "--no-progress"]
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)
    return folder


def time_to_10_m(folder):
    """Returns how long the learner had run (s) when it had learnt from the steps of the first policy that walks 10 m."""
    by_step = report.by_step(folder)
    walked = [values for values in by_step.values() if values.get("eval/distance_mean_m", 0) >= 10]
    if not walked:
        return None
    steps = min(values["eval/total_timesteps"] for values in walked)
    updates = [values for values in by_step.values() if values.get("time/total_timesteps", 0) >= steps]
    return min(values["time/time_elapsed"] for values in updates)


def notes(context, errors, walks):
    """Formats what stands below the table."""
    found = []
    if errors:
        listed = [f"{name} {flight:.2g} and {episode:.2g}" for name, (flight, episode) in errors.items() if "RK4" not in name]
        where = "Mean joint-angle errors against MuJoCo's RK4 (rad), after 0.15 s in flight and 0.3 s into an episode"
        found.append(f"{where}: {'; '.join(listed)}.\n")
    if walks:
        done = [seconds for seconds in walks.values() if seconds is not None]
        listed = ", ".join(f"{name} {seconds:.0f} s" if seconds else f"{name} never" for name, seconds in walks.items())
        middle = f"{statistics.median(done):.0f} s" if len(done) == len(walks) else "unknown"
        lead = f"Training time until the policy walks 10 m, on {len(context.two)} cores"
        found.append(f"{lead}: **{middle}** in the median ({listed}).\n")
    return found
