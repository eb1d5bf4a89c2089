"""Episodes of a policy in MuJoCo."""

import math
from dataclasses import dataclass

import numpy

from .commands import DrawnCommands, FileCommands, Pushes
from .errors import rests, still, window_errors


@dataclass
class Episode:
    """Result of one episode."""

    steps: int
    fell: bool
    distance_m: float
    errors: numpy.ndarray
    still: numpy.ndarray


def play_episode(robot, controller, steps, seed, index, rows=None, pushes=True, start=(0.0, 0.0, 0.0, 0.0), shown=None):
    """Plays one episode of at most `steps` control steps; `seed` and `index` determine its random numbers. Near the edge of a
    given ground it ends without a fall.

    `rows` are commands of a file. `shown` is called after each step and returns whether to go on.
    """
    contract = robot.contract
    of_commands, of_pushes = (numpy.random.default_rng([seed, index, stream]) for stream in range(2))
    schedule = DrawnCommands(contract, of_commands) if rows is None else FileCommands(rows, contract.control_step_s)
    pushing = Pushes(contract, of_pushes) if pushes else None
    robot.reset(start)
    controller.reset()
    start_x = robot.position_m[0]
    velocities, commands, events, fell = [], [], [], False
    places, rates, standing = [], [], []
    for step in range(steps):
        command, is_new = schedule.at(step, robot.heading_rad)
        action = controller.act(controller.observe(robot, command))
        push = pushing.before(step) if pushing else None
        if push is not None:
            robot.push(push)
        if is_new or push is not None:
            events.append(step)
        is_finite = robot.step(controller.taken(action))
        velocities.append(robot.velocity_in_heading())
        commands.append(command)
        places.append(robot.position_m[:2].copy())
        rates.append(robot.all_rates_radps)
        standing.append(robot.feet_stand())
        fell = robot.has_fallen() or not is_finite
        if fell or robot.is_at_edge() or (shown and not shown()):
            break
    commands = numpy.array(commands)
    errors = window_errors(numpy.array(velocities), commands, events, contract.control_step_s)
    spans = rests(commands, events, contract.control_step_s)
    stood = still(numpy.array(places), numpy.array(rates), numpy.array(standing), spans)
    return Episode(len(velocities), fell, float(robot.position_m[0] - start_x), errors, stood)


def summary(episodes, control_step_s):
    """Returns the means over all episodes, over all windows of all episodes, and over all times to stand still; None without one."""
    drifts, steps, squares, lifts = numpy.concatenate([episode.still for episode in episodes]).T
    has_stood = steps.sum() > 0
    errors = numpy.concatenate([episode.errors for episode in episodes])
    of = [float(error) for error in errors.mean(axis=0)] if len(errors) else [None, None]
    return {
        "episodes": len(episodes),
        "falls": sum(episode.fell for episode in episodes),
        "velocity_error_mps": of[0],
        "yaw_rate_error_radps": of[1],
        "standing_drift_m": float(drifts.mean()) if has_stood else None,
        "standing_hinge_radps": math.sqrt(squares.sum() / steps.sum()) if has_stood else None,
        "standing_lifts_per_s": float(lifts.sum() / (steps.sum() * control_step_s)) if has_stood else None,
        "distance_mean_m": float(numpy.mean([episode.distance_m for episode in episodes])),
        "length_mean": float(numpy.mean([episode.steps for episode in episodes])),
        "windows": len(errors),
    }
