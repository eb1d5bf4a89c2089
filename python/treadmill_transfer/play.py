"""Episodes of a policy in MuJoCo."""

from dataclasses import dataclass

import numpy

from .commands import DrawnCommands, FileCommands, Pushes
from .errors import window_errors


@dataclass
class Episode:
    """Result of one episode."""

    steps: int
    fell: bool
    distance_m: float
    errors: numpy.ndarray


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
        fell = robot.has_fallen() or not is_finite
        if fell or robot.is_at_edge() or (shown and not shown()):
            break
    errors = window_errors(numpy.array(velocities), numpy.array(commands), events, contract.control_step_s)
    return Episode(len(velocities), fell, float(robot.position_m[0] - start_x), errors)


def summary(episodes):
    """Returns the means over all episodes, and over all windows of all episodes; None without a window."""
    errors = numpy.concatenate([episode.errors for episode in episodes])
    of = [float(error) for error in errors.mean(axis=0)] if len(errors) else [None, None]
    return {
        "episodes": len(episodes),
        "falls": sum(episode.fell for episode in episodes),
        "velocity_error_mps": of[0],
        "yaw_rate_error_radps": of[1],
        "distance_mean_m": float(numpy.mean([episode.distance_m for episode in episodes])),
        "length_mean": float(numpy.mean([episode.steps for episode in episodes])),
        "windows": len(errors),
    }
