"""Schedules of commands and pushes, in control steps."""

import csv
import math

import numpy

from .contract import TransferError


class DrawnCommands:
    """Commands drawn as the contract says: resampled, some of them standing or with a heading."""

    def __init__(self, contract, random):
        self._contract, self._random = contract, random
        self._until = 0

    def at(self, step, heading_rad):
        """Returns the command of a control step, and whether it is a new one. Steps come in order, from 0."""
        is_new = step >= self._until
        if is_new:
            self._draw(step)
        command = self._command.copy()
        if self._heading_rad is not None:
            error = math.remainder(self._heading_rad - heading_rad, 2.0 * math.pi)
            command[2] = numpy.clip(self._contract.heading_gain_per_s * error, *self._contract.ranges[2])
        return command, is_new

    def _draw(self, step):
        contract, random = self._contract, self._random
        self._until = step + max(1, round(random.uniform(*contract.resampling_s) / contract.control_step_s))
        stands, has_heading = random.random() < contract.standing_share, random.random() < contract.heading_share
        self._command, heading = random.uniform(*contract.ranges.T), random.uniform(-math.pi, math.pi)
        self._heading_rad = heading if has_heading and not stands else None
        if stands:
            self._command = numpy.zeros(3)


class FileCommands:
    """Commands of a file's rows: (time_s, [vx, vy, yaw rate]); before the first row the robot stands."""

    def __init__(self, rows, control_step_s):
        self._rows = [(round(time_s / control_step_s), command) for time_s, command in rows]
        self._last = None

    def at(self, step, _):
        """Returns the command of a control step, and whether it is a new one. Steps come in order, from 0."""
        command = numpy.zeros(3)
        for begin, row in self._rows:
            if begin > step:
                break
            command = row
        is_new = self._last is None or bool((command != self._last).any())
        self._last = command
        return command, is_new


def read_commands(path):
    """Returns the rows of a CSV file with the lines time_s,vx,vy,yaw_rate; a line of names may come first."""
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            without_comments = (line.partition("#")[0].strip() for line in file)
            lines = [(number, line) for number, line in enumerate(csv.reader(without_comments), start=1) if line]
    except (OSError, UnicodeDecodeError, csv.Error) as why:
        raise TransferError(f"cannot read the commands `{path}`: {getattr(why, 'strerror', None) or why}") from why
    if lines and lines[0][1][0].strip() == "time_s":
        del lines[0]
    rows = []
    for number, line in lines:
        try:
            numbers = numpy.array([float(cell) for cell in line])
        except ValueError:
            numbers = numpy.empty(0)
        if numbers.shape != (4,) or not numpy.isfinite(numbers).all() or numbers[0] < 0.0:
            raise TransferError(f"the commands `{path}`, line {number}: `{','.join(line)}` is not time_s,vx,vy,yaw_rate")
        if rows and numbers[0] <= rows[-1][0]:
            raise TransferError(f"the commands `{path}`, line {number}: time {numbers[0]:g} s is not after that of the line before")
        rows.append((numbers[0], numbers[1:]))
    if not rows:
        raise TransferError(f"the commands `{path}` have no line of time_s,vx,vy,yaw_rate")
    return rows


class Pushes:
    """Pushes of the training's randomisation."""

    def __init__(self, contract, random):
        self._contract, self._random = contract, random
        self._next = self._interval() if contract.push_mps[1] > 0.0 else None

    def _interval(self):
        return max(1, round(self._random.uniform(*self._contract.push_interval_s) / self._contract.control_step_s))

    def before(self, step):
        """Returns the velocity (m/s) that a push adds before a control step; None without a push."""
        if step != self._next:
            return None
        speed_mps, angle = self._random.uniform(*self._contract.push_mps), self._random.uniform(0.0, 2.0 * math.pi)
        self._next = step + self._interval()
        return speed_mps * numpy.array([math.cos(angle), math.sin(angle)])
