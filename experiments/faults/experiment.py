"""Measures one fault: when it was injected, detected and repaired, and when training recovered."""

import time

from experiments.faults.fleet import FRAGMENT

ACTORS = ("actor-1", "actor-2")
BEFORE_S, AFTER_S = 10, 12
RECOVERY_S = 60


class NotPossible(Exception):
    """This machine cannot inject the fault."""


class Experiment:
    """One fault and its measurements."""

    def __init__(self, fleet):
        self.fleet, self.injected, self.repaired, self.ended = fleet, None, None, None
        self.detected, self.recovered, self.note = None, None, ""
        self.updates_repeated = None

    def inject(self):
        time.sleep(BEFORE_S)
        self.before = self.fleet.speed(time.time() - BEFORE_S, time.time())
        self.injected = time.time()

    def await_gone(self, *names):
        """Waits until the learner logs that these actors are gone; sets `detected`."""
        def all_gone():
            times = [self.fleet.learner_logged(f"actor left actor={name}", self.injected) for name in names]
            return all(times) and max(times)

        self.detected = self.fleet.wait("the learner notices the loss", all_gone, 30) - self.injected

    def await_unanswered(self, names=ACTORS):
        """Waits until these actors log that the learner does not answer; sets `detected`."""
        def all_know():
            times = [self.fleet.current[name].logged("keeping fragments", self.injected) for name in names]
            return all(times) and max(times)

        self.detected = self.fleet.wait("the actors notice the loss", all_know, 30) - self.injected

    def repair(self):
        self.repaired = time.time()

    def await_actors(self, *names, delivers=False, since=None):
        """Waits until these actors are back after `since` or the repair, and training continues; sets `recovered`."""
        since = since or self.repaired

        def all_back():
            def joined(name, at):
                return self.fleet.learner_logged(f"actor joined actor={name}", at)

            logged = self.fleet.delivers if delivers else joined
            times = [logged(name, since) for name in names]
            return all(times) and max(times)

        back = self.fleet.wait("the actors are back", all_back, RECOVERY_S)
        self.fleet.grow(1, RECOVERY_S)
        self.recovered = max(0.0, max(back, self.grown_since(back)) - self.repaired)

    def await_training(self, rounds=1):
        self.fleet.grow(rounds * 2 * FRAGMENT, RECOVERY_S)
        self.recovered = self.grown_since(self.repaired) - self.repaired

    def grown_since(self, moment):
        return min((at for at, _ in self.fleet.samples if at >= moment), default=time.time())

    def finish(self):
        time.sleep(AFTER_S)
        self.ended = time.time()
        until = self.repaired if self.repaired and self.repaired > self.injected + 1 else self.ended - AFTER_S
        self.during = self.fleet.speed(self.injected, until) / self.before
        self.after = self.fleet.speed(self.ended - AFTER_S + 2, self.ended) / self.before
