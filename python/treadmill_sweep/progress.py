"""Goal of a sweep, and what a run has reached of it while its log grows."""

import bisect
import contextlib
import json
import os

#: Columns of `sweep.csv` that are the last value of a metric.
COLUMNS = {"env_steps": "time/total_timesteps", "wall_s": "time/time_elapsed", "best_distance_m": "eval/distance_mean_m"}
COLUMNS |= {"velocity_error_mps": "eval/velocity_error", "return": "rollout/ep_rew_mean"}
COLUMNS |= {"fall_fraction": "rollout/fall_fraction"}


class Goal:
    """What trials are compared by; the binary has checked its text."""

    def __init__(self, text):
        self.text, words = text, text.split()
        self.is_value, self.counts_seconds = len(words) == 2, words[0] == "seconds"
        self.direction = "maximize" if words[0] == "highest" else "minimize"
        self.tag = words[1 if self.is_value else 2]
        self.sign, self.number = (1.0, 0.0) if self.is_value else (-1.0 if words[3] == ">=" else 1.0, float(words[4]))

    def compared(self, value):
        """Returns what pruners compare: the metric, or by how much it misses the number of the goal."""
        return self.sign * (value - self.number)


class Progress:
    """Metrics of one run, read as they are written."""

    def __init__(self, goal, run):
        self.goal, self.path, self.file, self.offset = goal, run / "metrics.jsonl", None, 0
        self.last, self.steps, self.values, self.step, self.first_step, self.seconds = {}, [], [], 0, None, None

    def read(self):
        """Reads the lines that were completed since the last call."""
        if not self.path.exists():
            return
        with open(self.path, "rb") as file:
            now = os.fstat(file.fileno())
            # A run that goes on replaces its log by one without the steps that it repeats.
            if now.st_ino != self.file or now.st_size < self.offset:
                self.__init__(self.goal, self.path.parent)
                self.file = now.st_ino
            file.seek(self.offset)
            text = file.read()
        lines = text[: text.rfind(b"\n") + 1]
        self.offset += len(lines)
        for line in lines.splitlines():
            # A crash may have cut a line; the run drops it when it goes on.
            with contextlib.suppress(ValueError, KeyError, TypeError):
                metric = json.loads(line)
                self.add(metric["tag"], metric["step"], metric["value"])

    def add(self, tag, step, value):
        """Adds the next metric."""
        # Of evaluations, the best distance counts.
        self.last[tag] = max(value, self.last.get(tag, value)) if tag == "eval/distance_mean_m" else value
        self.step = step if tag == "time/time_elapsed" else self.step
        if tag == self.goal.tag:
            self.steps.append(step)
            self.values.append(value)
            if self.first_step is None and not self.goal.is_value and self.goal.compared(value) <= 0.0:
                self.first_step = step
        if self.seconds is None and self.first_step is not None and self.step >= self.first_step:
            self.seconds = self.last["time/time_elapsed"]

    def at(self, step):
        """Returns what pruners compare at these environment steps; None before the first value."""
        index = bisect.bisect_right(self.steps, step)
        return self.goal.compared(self.values[index - 1]) if index else None

    def result(self):
        """Returns what the goal counts; None if it is not reached."""
        if self.goal.is_value:
            return self.values[-1] if self.values else None
        return self.seconds if self.goal.counts_seconds else self.first_step

    def row(self):
        """Returns what `sweep.csv` has of the metrics."""
        best_m = self.last.get("eval/distance_mean_m", self.last.get("rollout/distance_best_m"))
        row = {column: self.last.get(tag) for column, tag in COLUMNS.items()}
        return row | {"env_steps": self.step, "best_distance_m": best_m}
