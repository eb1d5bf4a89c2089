"""How well commands are followed: mean errors over windows of one second."""

import numpy

# Time after a change of command or a push that does not count, and length of a window (s).
SETTLING_S = 1.0
WINDOW_S = 1.0


def windows(events, steps, control_step_s):
    """Returns [begin, end) of all windows of an episode of so many control steps.

    `events` are the steps before which a command changed or a push came. Windows follow each other from one second after an
    event, and contain none.
    """
    settling, length = round(SETTLING_S / control_step_s), max(1, round(WINDOW_S / control_step_s))
    starts = sorted({0, *events})
    found = []
    for begin, end in zip(starts, [*starts[1:], steps]):
        for first in range(begin + settling, min(end, steps) - length + 1, length):
            found.append((first, first + length))
    return found


def window_errors(velocities, commands, events, control_step_s):
    """Returns the errors of each window of an episode: horizontal velocity (m/s) and yaw rate (rad/s), `[window, 2]`.

    `velocities` and `commands` have one row per control step: forward, left (m/s), yaw rate (rad/s) in the heading frame.
    """
    errors = []
    for begin, end in windows(events, len(velocities), control_step_s):
        off = numpy.mean(velocities[begin:end], axis=0) - numpy.mean(commands[begin:end], axis=0)
        errors.append([numpy.hypot(off[0], off[1]), abs(off[2])])
    return numpy.array(errors).reshape(-1, 2)
