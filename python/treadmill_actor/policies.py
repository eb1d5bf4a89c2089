"""Joins a run and keeps its newest policy: the learner announces a version, the actor fetches it."""

import logging
import threading
import time

from .policy import Policy, PolicyError
from .settings import Settings

RETRY_S = 0.2
log = logging.getLogger("treadmill_actor")


class JoinRefused(Exception):
    """The learner refused this actor; the message has the reason."""


def until_answered(ask, problem, stopping):
    """Calls `ask` until it returns an answer. Returns None after a request to stop."""
    tries = 0
    while not stopping.is_set():
        answer = ask()
        if answer is not None:
            return answer
        # The first warning comes after a second, because the learner may be starting.
        if tries % 50 == 5:
            log.warning("%s; retrying", problem)
        tries += 1
        stopping.wait(RETRY_S)
    return None


def join(bus, run, actor, task, stopping):
    """Registers the task, then fetches the policy. Returns the bundle, or None after a request to stop."""
    unanswered = f"no learner answers for run `{run}`"
    receipt = until_answered(lambda: bus.register(run, actor, task), unanswered, stopping)
    if receipt is None:
        return None
    if not receipt.accepted:
        raise JoinRefused(f"run `{run}` refused this actor: {receipt.reason}")
    bundle = until_answered(lambda: bus.fetch_policy(run), unanswered, stopping)
    if bundle is None:
        return None
    trained = Settings.of(bundle).task
    sizes = (bundle.observation_size, bundle.action_size)
    # A new learner may have replaced the one that accepted the registration.
    if trained != task.name or sizes != (task.observation_size, task.action_size):
        raise JoinRefused(
            f"run `{run}` trains `{trained or 'the built-in humanoid'}` ({sizes[0]} observations, {sizes[1]} actions), but "
            f"this actor runs `{task.name}` ({task.observation_size}, {task.action_size})"
        )
    return bundle


class Policies:
    """Holds the current policy and replaces it."""

    def __init__(self, bus, bundle, actor, task):
        self.bus, self.actor, self.task = bus, actor, task
        self.run, self.config_hash = bundle.run, bundle.config_hash
        #: Set once the learner serves another run or a new start of this one: the actor must join again.
        self.run_changed = threading.Event()
        self.fetching = threading.Lock()
        self._current = (Policy.from_bundle(bundle), bundle.version)
        #: Steps of a fragment as the newest bundle says; 0 if it leaves them open.
        self.fragment_steps = bundle.fragment_steps
        self.announced_version = None
        #: Highest epoch of a learner of this run so far.
        self.epoch = bundle.version.epoch

    def admits(self, version):
        """Notes a version's epoch. Returns False if another learner has overtaken its learner; 0 is unknown."""
        if 0 < version.epoch < self.epoch:
            return False
        self.epoch = max(self.epoch, version.epoch)
        return True

    @property
    def current(self):
        """Current policy and its version."""
        return self._current

    def refresh(self, known=None):
        """Fetches the newest policy, unless `known` (from an announcement or a receipt) is already current."""
        # An announcement and a receipt often name the same version at once: only one of them fetches.
        with self.fetching:
            if known is not None and known == self._current[1]:
                return
            bundle = self.bus.fetch_policy(self.run, self._current[1], known, self.config_hash)
            if bundle is None:
                # A new learner has no policy before the first registration.
                receipt = self.bus.register(self.run, self.actor, self.task)
                if receipt is not None and not receipt.accepted:
                    self.run_changed.set()
                return
            if not self.admits(bundle.version):
                log.warning("policy of an overtaken learner rejected")
                return
            if bundle.run != self.run or bundle.config_hash != self.config_hash:
                self.run_changed.set()
                return
            # A short answer, that the policy is unchanged, has none.
            self.fragment_steps = bundle.fragment_steps or self.fragment_steps
            if bundle.version == self._current[1]:
                return
            try:
                self._current = (Policy.from_bundle(bundle), bundle.version)
            except PolicyError as why:
                log.warning("%s; keeping the previous policy", why)

    def follow(self, announced, poll_s, stopping):
        """Refreshes after each announcement and every `poll_s`; runs on its own thread."""
        due = time.monotonic() + poll_s
        while not (stopping.is_set() or self.run_changed.is_set()):
            was_announced = announced.wait(min(1.0, max(0.0, due - time.monotonic())))
            announced.clear()
            if was_announced or time.monotonic() >= due:
                due = time.monotonic() + poll_s
                self.refresh(self.announced_version if was_announced else None)
