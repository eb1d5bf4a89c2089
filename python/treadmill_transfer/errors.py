"""How well commands are followed: mean errors over windows of one second, and how still a robot stands."""

import numpy

# Time after a change of command or a push that does not count, and length of a window (s).
SETTLING_S = 1.0
WINDOW_S = 1.0
# Norm of a command (m/s, m/s, rad/s) below which it says: stand, and the wait before the robot must stand still (s).
STANDING_COMMAND = 0.1
STILL_AFTER_S = 2.0


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


def rests(commands, events, control_step_s):
    """Returns [begin, end) of the control steps in which a robot must stand still: from two seconds after an event on, while the
    command says: stand.
    """
    stands = numpy.linalg.norm(commands, axis=1) < STANDING_COMMAND
    starts, found = sorted({0, *events}), []
    for begin, end in zip(starts, [*starts[1:], len(stands)]):
        begin += round(STILL_AFTER_S / control_step_s)
        # A heading's yaw rate changes without an event.
        edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[False], stands[begin:end], [False]])))
        found += [(begin + int(first), begin + int(last)) for first, last in edges.reshape(-1, 2)]
    return found


def still(places_m, rates_radps, standing, spans):
    """Returns what each rest adds: largest distance from its first place (m), control steps, sum of the hinges' mean squared rates,
    and feet that were lifted, `[rest, 4]`.

    `places_m` (x and y), `rates_radps` (hinges) and `standing` (feet, true or false) have one row per control step.
    """
    squares, lifted = numpy.mean(numpy.square(rates_radps), axis=1), numpy.zeros(len(standing))
    lifted[1:] = (standing[:-1] & ~standing[1:]).sum(axis=1)
    rows = []
    for begin, end in spans:
        drifts = numpy.linalg.norm(places_m[begin:end] - places_m[begin], axis=1)
        rows.append([drifts.max(), end - begin, squares[begin:end].sum(), lifted[begin:end].sum()])
    return numpy.array(rows).reshape(-1, 4)
