"""Command line of `python -m treadmill_transfer`."""

import argparse
import itertools
import json
import math
import sys
import time
import warnings

from . import motion, walk
from .commands import read_commands
from .contract import Policy, TransferError
from .controller import Controller
from .film import Film
from .ground import read_ground
from .play import play_episode, summary
from .robot import Robot
from .trace import TOLERANCES, compare, read_trace


def positive(text):
    """Returns a finite number above 0."""
    value = float(text)
    if not (math.isfinite(value) and value > 0.0):
        raise argparse.ArgumentTypeError(f"`{text}` is not a number above 0")
    return value


def count(text):
    """Returns a whole number above 0."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"`{text}` is not a whole number above 0")
    return int(text)


def tolerance(text):
    """Returns the boundaries that a tolerance is for, and its value."""
    name, _, value = text.rpartition("=")
    if name and name not in TOLERANCES:
        raise argparse.ArgumentTypeError(f"`{name}` is none of: {', '.join(TOLERANCES)}")
    try:
        return ([name] if name else list(TOLERANCES)), positive(value)
    except ValueError:
        raise argparse.ArgumentTypeError(f"`{text}` is not N or BOUNDARY=N") from None


def parser():
    """Returns the argument parser."""
    flags = argparse.ArgumentParser(
        prog="python -m treadmill_transfer", description="Plays an exported policy in MuJoCo by its contract alone."
    )
    flags.add_argument("policy", metavar="POLICY.onnx", help="file of `treadmill export RUN --onnx FILE`")
    flags.add_argument("--model", required=True, metavar="FILE.xml", help="the robot's own MuJoCo file")
    flags.add_argument("--episodes", type=count, default=20, metavar="N", help="episodes to play; default 20")
    flags.add_argument("--seconds", type=positive, default=20.0, metavar="S", help="longest duration of an episode; default 20")
    flags.add_argument("--seed", type=int, default=1, help="seed of commands and pushes; default 1")
    flags.add_argument("--commands", metavar="FILE", help="CSV lines time_s,vx,vy,yaw_rate; default: drawn as in training")
    flags.add_argument("--no-pushes", action="store_true", help="leave out the pushes of the training")
    flags.add_argument("--ground", metavar="FILE", help="height field of `treadmill export RUN --ground FILE` instead of the floor")
    flags.add_argument("--timestep", type=positive, metavar="S", help="physics step; default: the file's, if it divides the control step")
    flags.add_argument("--trace", metavar="FILE", help="compare with a trace of `treadmill eval RUN --trace FILE` instead")
    flags.add_argument(
        "--tolerance",
        type=tolerance,
        action="append",
        default=[],
        metavar="N|BOUNDARY=N",
        help="largest difference from the trace; default " + ", ".join(f"{name}={value:g}" for name, value in TOLERANCES.items()),
    )
    flags.add_argument("--view", action="store_true", help="show the robot in MuJoCo's viewer, in real time")
    flags.add_argument("--film", metavar="FILE", help="write the first episode as a GIF, or with ffmpeg as an MP4")
    flags.add_argument("--json", action="store_true", help="print only one JSON object")
    return flags


def main(arguments=None):
    """Plays or compares. Returns the exit code: 1 if a trace differs, 2 for unusable input."""
    flags = parser()
    args = flags.parse_args(arguments)
    if args.seed < 0:
        flags.error(f"argument --seed: {args.seed} is below 0")
    try:
        policy = Policy(args.policy)
        if isinstance(policy.contract, walk.WalkContract):
            return walked(args, policy)
        if isinstance(policy.contract, motion.MotionContract):
            return imitated(args, policy)
        ground = read_ground(args.ground) if args.ground else None
        rows = read_commands(args.commands) if args.commands else None
        robot = Robot(args.model, policy.contract, args.timestep, ground)
        controller = Controller(policy)
        for note in [] if args.json else robot.notes:
            print(f"note: {note}", file=sys.stderr)
        if args.trace:
            tolerances = tolerances_of(args)
            lines = read_trace(args.trace, len(robot.hinge_names))
            return compared(args, lines, tolerances, *compare(robot, controller, lines, tolerances))
        played(args, robot, controller, rows, ground)
    except TransferError as why:
        print(f"error: {why}", file=sys.stderr)
        return 2
    return 0


def walked(args, policy):
    """Plays or compares a policy of Gymnasium's tasks. Returns the exit code."""
    unused = [flag for flag, value in (("--commands", args.commands), ("--ground", args.ground)) if value]
    if unused:
        raise TransferError(f"{unused[0]} is for policies of the velocity task; leave it out")
    contract, walker = policy.contract, walk.Walker(args.model, policy.contract, args.timestep)
    for note in [] if args.json else walker.notes:
        print(f"note: {note}", file=sys.stderr)
    if args.trace:
        tolerances = tolerances_of(args)
        lines = read_trace(args.trace, len(contract.joint_names), walk.KEYS)
        return compared(args, lines, tolerances, *walk.compare(walker, policy, lines, tolerances))
    steps = max(1, round(args.seconds / contract.control_step_s))
    with Shown(args, walker) as shown:
        episodes = []
        if not args.json:
            print("episode  length  distance m  end")
        for index in range(args.episodes):
            episode = walk.play_episode(walker, policy, steps, args.seed, index, shown.next_episode())
            episodes.append(episode)
            if not args.json:
                end = "fell" if episode["fell"] else "time limit"
                print(f"{index + 1:>7} {episode['length']:>7} {episode['distance_m']:>11.2f}  {end}", flush=True)
            if shown.is_closed():
                break
    result = walk.summary(episodes, contract.control_step_s)
    if args.json:
        print(json.dumps(result))
        return 0
    print()
    print(f"episodes        {result['episodes']}, {result['falls']} of them ended with a fall")
    print(f"distance        {result['distance_mean_m']:.2f} m")
    print(f"velocity        {result['velocity_mean_mps']:.2f} m/s")
    print(f"length          {result['length_mean']:.1f} steps")
    return 0


def imitated(args, policy):
    """Plays a policy of the motion task. Returns the exit code."""
    unused = [flag for flag, value in (("--commands", args.commands), ("--ground", args.ground)) if value]
    if unused:
        raise TransferError(f"{unused[0]} is not for policies of the motion task; leave it out")
    imitator = motion.Imitator(args.model, policy, args.timestep)
    for note in [] if args.json else imitator.notes:
        print(f"note: {note}", file=sys.stderr)
    if args.trace:
        tolerances = tolerances_of(args)
        lines = read_trace(args.trace, len(imitator.robot.hinge_names), walk.KEYS)
        return compared(args, lines, tolerances, *motion.compare(imitator, lines, tolerances))
    with Shown(args, imitator) as shown:
        episodes = []
        if not args.json:
            print("episode  length  done %  bodies cm  bodies deg  end")
        for index in range(args.episodes):
            episode = motion.play_episode(imitator, args.seed, index, not args.no_pushes, shown.next_episode())
            episodes.append(episode)
            if not args.json:
                done, bodies, turned = 100.0 * episode["done_share"], 100.0 * episode["body_error_m"], math.degrees(episode["body_error_rad"])
                end = "fell" if episode["fell"] else "closed" if episode["closed"] else "finished"
                print(f"{index + 1:>7} {episode['length']:>7} {done:>7.0f} {bodies:>10.1f} {turned:>11.1f}  {end}", flush=True)
            if shown.is_closed():
                break
    result = motion.summary(episodes)
    if args.json:
        print(json.dumps(result))
        return 0
    print()
    print(f"finished        {result['finished']} of {result['episodes']}; {100.0 * result['done_share']:.1f} % of the motion in the mean")
    print(f"anchor          {100.0 * result['anchor_error_m']:.1f} cm")
    print(f"bodies          {100.0 * result['body_error_m']:.1f} cm, {math.degrees(result['body_error_rad']):.1f} degrees")
    return 0


def tolerances_of(args):
    """Returns the tolerance of each boundary."""
    tolerances = dict(TOLERANCES)
    for names, value in args.tolerance:
        tolerances.update(dict.fromkeys(names, value))
    return tolerances


def compared(args, lines, tolerances, first, largest):
    """Prints the result of a comparison; returns 1 if a boundary differs."""
    if args.json:
        print(json.dumps({"steps": len(lines), "first_difference": first, "largest": largest, "tolerances": tolerances}))
        return 1 if first else 0
    for name, value in largest.items():
        print(f"{name:<12} differs by at most {value:.3g}, tolerance {tolerances[name]:g}")
    if first is None:
        print(f"all {len(lines)} steps agree within the tolerances")
        return 0
    print(
        f"first difference: {first['boundary']} at step {first['step']} of episode {first['episode']}, {first['entry']}: "
        f"{first['here']:.6g} here, {first['trace']:.6g} in the trace, tolerance {first['tolerance']:g}"
    )
    return 1


def played(args, robot, controller, rows, ground):
    """Plays the episodes and prints their results."""
    steps = max(1, round(args.seconds / robot.contract.control_step_s))
    starts = itertools.cycle([(0.0, 0.0, 0.0, 0.0)] if ground is None else ground.starts)
    episodes = []
    if not args.json:
        print("episode  length  distance m  velocity error m/s  yaw rate error rad/s  end")
    with Shown(args, robot) as shown:
        for index, start in zip(range(args.episodes), starts):
            pushes, each = not args.no_pushes, shown.next_episode()
            episode = play_episode(robot, controller, steps, args.seed, index, rows, pushes, start, each)
            episodes.append(episode)
            if not args.json:
                velocity, yaw = [f"{error:.3f}" for error in episode.errors.mean(axis=0)] if len(episode.errors) else "--"
                end = "fell" if episode.fell else "time limit"
                print(f"{index + 1:>7} {episode.steps:>7} {episode.distance_m:>11.2f} {velocity:>19} {yaw:>21}  {end}", flush=True)
            if shown.is_closed():
                break
    result = summary(episodes, robot.contract.control_step_s)
    if args.json:
        print(json.dumps(result))
        return
    error = lambda value, unit: "none: no window of 1 s without a change" if value is None else f"{value:.3f} {unit}"  # noqa: E731
    print()
    print(f"episodes        {result['episodes']}, {result['falls']} of them ended with a fall")
    print(f"velocity error  {error(result['velocity_error_mps'], 'm/s')}")
    print(f"yaw rate error  {error(result['yaw_rate_error_radps'], 'rad/s')}")
    if result["standing_drift_m"] is not None:
        drift, hinges, lifts = (result[f"standing_{key}"] for key in ("drift_m", "hinge_radps", "lifts_per_s"))
        print(f"standing        drifts {drift:.2f} m, hinges turn at {hinges:.2f} rad/s, {lifts:.2f} lifts/s of a foot")
    print(f"distance        {result['distance_mean_m']:.2f} m")
    print(f"length          {result['length_mean']:.1f} steps")


def open_viewer(robot):
    """Opens MuJoCo's viewer."""
    try:
        import glfw
        import mujoco.viewer

        # Without a display, the viewer ends the process. On macOS, MuJoCo itself starts GLFW.
        with warnings.catch_warnings(action="ignore"):
            has_display = sys.platform == "darwin" or glfw.init()
        if not has_display:
            raise RuntimeError(glfw.get_error()[1].decode())
        return mujoco.viewer.launch_passive(robot.model, robot.data)
    except Exception as why:  # noqa: BLE001: no window, no OpenGL
        raise TransferError(f"--view cannot open a window ({why}); leave it out") from why


class Shown:
    """Where episodes are shown: in a window, in a film, or nowhere."""

    def __init__(self, args, robot):
        self.robot = robot
        # The film first, which may be refused.
        self.film = Film(args.film, robot) if args.film else None
        self.viewer = open_viewer(robot) if args.view else None
        self.episodes = 0

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if self.film and kind is None:
            self.film.save()

    def is_closed(self):
        """Returns whether the window was closed."""
        return self.viewer is not None and not self.viewer.is_running()

    def next_episode(self):
        """Returns a function that shows each step, and returns whether to go on; None if nothing is shown."""
        self.episodes += 1
        film = self.film if self.episodes == 1 else None
        if film is None and self.viewer is None:
            return None
        due = time.monotonic()

        def shown():
            nonlocal due
            if film:
                film.add()
            if self.viewer is None:
                return True
            due += self.robot.contract.control_step_s
            time.sleep(max(0.0, due - time.monotonic()))
            self.viewer.sync()
            return self.viewer.is_running()

        return shown
