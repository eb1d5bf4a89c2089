"""Runs the trials of a study as child processes: `treadmill train`, some at a time."""

import ctypes
import functools
import os
import shutil
import signal
import statistics
import subprocess
import time

import optuna
from optuna.trial import TrialState

from . import search
from .progress import Goal, Progress

#: Free room (bytes) below which no further trial begins, and times that a killed run goes on before that is its result.
ROOM_MIN_BYTES, KILLS_MAX = 64 << 20, 8
#: Values that a trial reports, and time between looks at its log (s).
REPORTS, POLL_S = 50, 0.2
LIBC, PR_SET_PDEATHSIG = ctypes.CDLL(None), 1


def tie(parent):
    """Lets the kernel kill this process when the sweep ends, in whatever way."""
    if LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL) or os.getppid() != parent:
        os._exit(1)


class Run:
    """One seed of a trial: an ordinary run in a process of its own."""

    def __init__(self, sweep, number, seed, keys):
        self.name, self.seed, self.plan, self.process, self.code, self.kills = f"trial-{number}", seed, sweep.plan, None, None, 0
        self.folder = sweep.root / self.name
        self.progress = Progress(sweep.goal, self.folder)
        own = ["--resume-or-start", "--no-progress", "--no-page", "--json", f"--run-dir={self.folder}", f"--seed={seed}"]
        own += [f"--set={key}={value}" for key, value in keys]
        own += [f"--connect={endpoint}" for endpoint in self.plan["connect"]]
        if self.plan["connect"]:
            # Its actors are those of a pool, in which other sweeps may be.
            protocol = "tls" if any(flag.startswith("--tls") for flag in self.plan["flags"]) else "tcp"
            own += [f"--listen={protocol}/127.0.0.1:0", f"--run={self.plan['bus_name']}-{self.name}"]
        command = "learner" if self.plan["connect"] else "train"
        self.command = [self.plan["treadmill"], command, *self.plan["flags"], *own]

    def start(self):
        """Begins the run or goes on with it."""
        # Ctrl-C reaches only the sweep, which then stops its trials.
        apart = {"process_group": 0, "preexec_fn": functools.partial(tie, os.getpid()), "stdin": subprocess.DEVNULL}
        with open(f"{self.folder}.log", "ab") as log:
            self.process = subprocess.Popen(self.command, stdout=log, stderr=log, cwd=self.plan["started_in"], **apart)

    def has_ended(self, is_pruned, is_stopped):
        """Reads the log. Returns whether the run has just ended with a result; one that was killed goes on."""
        code = self.process.poll() if self.process else None
        self.progress.read()
        if code is None:
            return False
        self.process = None
        is_whole = code > 0 or code == 0 and self.progress.step >= self.plan["steps"]
        if is_whole or is_pruned or self.kills >= KILLS_MAX:
            self.code = 128 - code if code < 0 else code
        elif not is_stopped:
            self.kills += 1
            self.start()
        return self.code is not None


class Trial:
    """Trial of the study: the mean over its seeds."""

    def __init__(self, sweep, trial):
        self.sweep, self.trial, self.is_pruned = sweep, trial, "pruned" in trial.user_attrs
        keys, seeds, steps = [*search.propose(trial, sweep.plan["keys"])], sweep.plan["seeds"], sweep.plan["steps"]
        first, self.interval = trial.number * seeds + 1, max(1, steps // REPORTS)
        self.runs = [Run(sweep, first + seed, sweep.plan["seed"] + seed, keys) for seed in range(seeds)]
        self.next = (sweep.trials()[trial.number].last_step or 0) + self.interval
        for run in self.runs:
            run.code = trial.user_attrs.get(run.name, {}).get("exit")
            if run.code is None and not self.is_pruned:
                run.start()

    def goes_on(self):
        """Reports what the runs have logged, and stops a hopeless trial. Returns whether a run goes on."""
        for run in self.runs:
            if run.has_ended(self.is_pruned, self.sweep.stops):
                goal = None if run.code else run.progress.result()
                self.trial.set_user_attr(run.name, {"seed": run.seed, "exit": run.code, "goal": goal} | run.progress.row())
        goes_on = any(run.process for run in self.runs)
        while not self.is_pruned and self.next < min([self.sweep.plan["steps"], *(run.progress.step for run in self.runs)]):
            values = [run.progress.at(self.next) for run in self.runs]
            if None not in values:
                self.trial.report(statistics.fmean(values), self.next)
                # Pruners also see a trial that has ended, because others are compared with it.
                is_open = self.sweep.goal.is_value or None in [run.progress.result() for run in self.runs]
                if self.trial.should_prune() and is_open and goes_on:
                    self.is_pruned = True
                    self.trial.set_user_attr("pruned", self.next)
                    self.stop()
            self.next += self.interval
        return goes_on

    def stop(self):
        """Requests the runs to save and end."""
        for run in self.runs:
            if run.process:
                run.process.send_signal(signal.SIGINT)

    def finish(self):
        """Records the result in the study."""
        results = [run.progress.result() for run in self.runs]
        word = "failed" if any(run.code for run in self.runs) else "not reached" if None in results else "complete"
        word = "pruned" if self.is_pruned else word
        # Samplers rank a trial that has not reached the goal like a pruned one, by what it misses.
        state = {"failed": TrialState.FAIL, "complete": TrialState.COMPLETE}.get(word, TrialState.PRUNED)
        self.trial.set_user_attr("state", word)
        self.sweep.study.tell(self.trial, statistics.fmean(results) if word == "complete" else None, state)


class Sweep:
    """Study with its folder and plan."""

    def __init__(self, root, plan, study):
        self.root, self.plan, self.goal, self.study, self.stops, self.active = root, plan, Goal(plan["goal"]), study, 0, []
        self.begun = [optuna.Trial(study, trial._trial_id) for trial in self.trials() if trial.state == TrialState.RUNNING]

    def trials(self):
        """Returns the trials as the study has them."""
        return self.study.get_trials(deepcopy=False)

    def interrupt(self, *_):
        """Takes Ctrl-C. At the second one, the kernel kills the trials with this process."""
        self.stops += 1
        if self.stops > 1:
            os._exit(130)

    def run(self, ended):
        """Runs the trials that have not ended, and calls `ended` with each. Returns how many could not begin."""
        at_once, was_asked = max(1, self.plan["parallel"] // self.plan["seeds"]), False
        while True:
            left = 0
            while len(self.active) < at_once and not self.stops:
                left = self.plan["trials"] - len(self.trials()) + len(self.begun)
                if left <= 0 or shutil.disk_usage(self.root).free < ROOM_MIN_BYTES:
                    break
                self.active.append(Trial(self, self.begun.pop(0) if self.begun else self.study.ask()))
            if not self.active:
                return max(0, left)
            time.sleep(POLL_S)
            if self.stops and not was_asked:
                was_asked = True
                print("stopping: trials save after this update; press Ctrl-C again to stop at once", flush=True)
                for trial in self.active:
                    trial.stop()
            for trial in [trial for trial in self.active if not trial.goes_on()]:
                self.active.remove(trial)
                if trial.is_pruned or None not in [run.code for run in trial.runs]:
                    trial.finish()
                    ended(self, self.trials()[trial.trial.number])
