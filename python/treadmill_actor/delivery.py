"""Delivers fragments: each is sent until a receipt settles it, and kept until a checkpoint holds it."""

import logging
import threading
from dataclasses import dataclass, field

from . import schema

#: First and longest pause before a fragment is sent again. It doubles while the learner is busy: each attempt carries the whole fragment.
RETRY_S, RETRY_MAX_S = 0.2, 3.2
QUARANTINE_RETRY_S = 10.0
#: Pause before a fragment is sent again, by outcome. Other outcomes settle the fragment.
RETRY_AFTER_S = {"busy": RETRY_S, "stopping": RETRY_S, "quarantined": QUARANTINE_RETRY_S}
RETRIES_PER_WARNING, RETRIES_BEFORE_WARNING = 50, 5
#: Why a fragment is sent again that no learner has answered: a slow disk looks like a lost link from here.
NO_RECEIPT = "no receipt came: the learner may be gone, out of reach, or waiting for its disk or store, as its log says"
log = logging.getLogger("treadmill_actor")


@dataclass
class Pending:
    """Fragment without a receipt that settles it."""

    fragment: bytes
    retries: int = 0
    #: Attempts in a row that found the learner busy.
    busy: int = 0


@dataclass
class Delivery:
    """State of every fragment: produced = accepted + dropped_by_rule + in flight. Follows common/experience/src/delivery.rs.

    Events return the pause in seconds before the fragment is sent again, or None if nothing is to be sent."""

    #: Incarnation of the learner that accepted the fragments in `kept`.
    incarnation: int
    produced: int = 0
    accepted: int = 0
    dropped_by_rule: int = 0
    resent: int = 0
    newest: int = 0
    pending: dict = field(default_factory=dict)
    #: Accepted fragments that no checkpoint holds yet, by number.
    kept: dict = field(default_factory=dict)
    outcomes: dict = field(default_factory=dict)

    def produce(self, sequence, fragment):
        """Takes a fragment that is about to be sent."""
        self.produced += 1
        self.newest = sequence
        self.pending[sequence] = Pending(fragment)

    def answered(self, sequence, receipt, is_current=True):
        """Takes a learner's answer; `is_current` is false if another learner has overtaken that one."""
        if not is_current:
            return self._retry(sequence, RETRY_S, "a learner answers that another one has overtaken")
        if sequence not in self.pending:
            return None
        outcome = schema.OUTCOME_NAMES.get(receipt.outcome, "unspecified")
        pause_s = RETRY_AFTER_S.get(outcome)
        if pause_s is not None:
            busy = self.pending[sequence].busy if outcome == "busy" else 0
            pause_s = self._retry(sequence, min(pause_s * 2**busy, max(pause_s, RETRY_MAX_S)), receipt.reason)
            self.pending[sequence].busy = min(busy + 1, 16) if outcome == "busy" else 0
            return pause_s
        fragment = self.pending.pop(sequence).fragment
        self.outcomes[outcome] = self.outcomes.get(outcome, 0) + 1
        if outcome in ("accepted", "duplicate"):
            self.accepted += 1
            self.kept[sequence] = fragment
        else:
            self.dropped_by_rule += 1
        self.kept = {number: kept for number, kept in self.kept.items() if number > receipt.durable_through}
        return None

    def silent(self, sequence):
        """Takes that no learner answered in time."""
        return self._retry(sequence, RETRY_S, NO_RECEIPT)

    def adopted(self, incarnation):
        """Takes the incarnation of the policy in use. Returns the fragments to send again, by number: another learner has only
        the durable ones."""
        if incarnation == self.incarnation:
            return {}
        self.incarnation = incarnation
        again, self.kept = self.kept, {}
        # The previous learner accepted them; the new one decides again.
        self.accepted -= len(again)
        self.resent += len(again)
        self.pending |= {sequence: Pending(fragment) for sequence, fragment in again.items()}
        return again

    def settled_through(self):
        """Returns the last number up to which no fragment is pending or kept."""
        open_fragments = [*self.pending, *self.kept]
        return min(open_fragments) - 1 if open_fragments else self.newest

    def _retry(self, sequence, pause_s, reason):
        if sequence not in self.pending:
            return None
        pending = self.pending[sequence]
        if pending.retries % RETRIES_PER_WARNING == RETRIES_BEFORE_WARNING:
            log.warning("%s; keeping fragments and retrying", reason)
        pending.retries, pending.busy = pending.retries + 1, 0
        self.resent += 1
        return pause_s


class Uploader:
    """Uploads the fragments of one actor process; thread-safe."""

    def __init__(self, bus, run, actor, incarnation, receipt_timeout_s, stopping, admits=lambda version: True):
        self.bus, self.run, self.actor, self.admits = bus, run, actor, admits
        self.receipt_timeout_s, self.stopping = receipt_timeout_s, stopping
        self.lock = threading.Lock()
        self.delivery = Delivery(incarnation)

    def produce(self, sequence, fragment):
        """See Delivery.produce."""
        with self.lock:
            self.delivery.produce(sequence, fragment)

    def settled_through(self):
        """See Delivery.settled_through."""
        with self.lock:
            return self.delivery.settled_through()

    def settles(self, receipt):
        """Returns whether a fragment with this receipt need not be sent again."""
        return self.admits(receipt.version) and schema.OUTCOME_NAMES.get(receipt.outcome) not in RETRY_AFTER_S

    def deliver(self, sequence, fragment):
        """Sends a produced fragment until a receipt settles it. Returns the receipt, or None after a request to stop."""
        while not self.stopping.is_set():
            receipt = self.bus.submit(self.run, self.actor, fragment, self.receipt_timeout_s, self.settles)
            with self.lock:
                if receipt is None:
                    pause_s = self.delivery.silent(sequence)
                else:
                    pause_s = self.delivery.answered(sequence, receipt, self.admits(receipt.version))
            if pause_s is None:
                if schema.OUTCOME_NAMES.get(receipt.outcome) == "malformed":
                    log.error("%s: learner rejected fragment %d: %s", self.actor, sequence, receipt.reason)
                return receipt
            self.stopping.wait(pause_s)
        return None

    def resend_unsaved(self, incarnation):
        """Sends fragments again that a previous incarnation accepted but may not have saved; the learner drops duplicates."""
        with self.lock:
            again = self.delivery.adopted(incarnation)
        for sequence, fragment in sorted(again.items()):
            self.deliver(sequence, fragment)
