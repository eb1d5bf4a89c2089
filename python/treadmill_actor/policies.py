"""The newest policy: announced by the learner, fetched by us, on joining too."""

import logging
import threading
import time

from .policy import Policy, PolicyError
from .settings import Settings

RETRY_S = 0.2
log = logging.getLogger("treadmill_actor")


class Refused(Exception):
    """The learner does not let this actor in, and says why."""


def until_answered(ask, what, stopping):
    """Calls `ask` until it returns an answer. None after a request to stop."""
    tries = 0
    while not stopping.is_set():
        answer = ask()
        if answer is not None:
            return answer
        # Not at once: a learner that is just starting is no news.
        if tries % 50 == 5:
            log.warning("%s; retrying", what)
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
        raise Refused(f"run `{run}` refuses this actor: {receipt.reason}")
    bundle = until_answered(lambda: bus.fetch_policy(run), unanswered, stopping)
    if bundle is None:
        return None
    trained = Settings.of(bundle).task
    sizes = (bundle.observation_size, bundle.action_size)
    # The desk said the same; a learner that was begun anew in between may have another task.
    if trained != task.name or sizes != (task.observation_size, task.action_size):
        raise Refused(
            f"run `{run}` trains `{trained or 'a task of its own'}` ({sizes[0]} observations, {sizes[1]} actions), and this "
            f"actor has `{task.name}` ({task.observation_size}, {task.action_size})"
        )
    return bundle


class Policies:
    """Holds the policy in use and replaces it."""

    def __init__(self, bus, bundle, actor, task):
        self.bus, self.actor, self.task = bus, actor, task
        self.run, self.config_hash = bundle.run, bundle.config_hash
        #: Set once the run is another one, or the same begun anew: everything begins again.
        self.other_run = threading.Event()
        self.fetching = threading.Lock()
        self.held = (Policy.from_bundle(bundle), bundle.version)
        self.announced_version = None

    @property
    def current(self):
        """The policy in use and its version."""
        return self.held

    def refresh(self, known=None):
        """Fetches the newest policy unless `known`, a version that was announced or named in a receipt, is in use already."""
        # An announcement and a receipt speak of the same version at nearly the same time: one of them fetches.
        with self.fetching:
            if known is not None and known == self.held[1]:
                return
            bundle = self.bus.fetch_policy(self.run)
            if bundle is None:
                # A learner that was begun anew may be waiting for a registration before it has any policy.
                receipt = self.bus.register(self.run, self.actor, self.task)
                if receipt is not None and not receipt.accepted:
                    self.other_run.set()
                return
            if bundle.run != self.run or bundle.config_hash != self.config_hash:
                self.other_run.set()
                return
            if bundle.version == self.held[1]:
                return
            try:
                self.held = (Policy.from_bundle(bundle), bundle.version)
            except PolicyError as why:
                log.warning("%s; the policy before it stays in use", why)

    def follow(self, announced, poll_s, stopping):
        """Looks whenever a version is announced, and unprompted now and then; runs in a thread of its own."""
        due = time.monotonic() + poll_s
        while not (stopping.is_set() or self.other_run.is_set()):
            heard = announced.wait(min(1.0, max(0.0, due - time.monotonic())))
            announced.clear()
            if heard or time.monotonic() >= due:
                due = time.monotonic() + poll_s
                self.refresh(self.announced_version if heard else None)
