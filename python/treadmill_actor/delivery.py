"""Fragments to the learner: sent until a receipt says what became of them, and kept until they are durable."""

import logging
import threading
from dataclasses import dataclass, field

from . import schema

RETRY_S = 0.2
QUARANTINE_RETRY_S = 10.0
#: Answers after which a fragment is sent again, and how much later.
AGAIN_AFTER_S = {"busy": RETRY_S, "stopping": RETRY_S, "quarantined": QUARANTINE_RETRY_S}
log = logging.getLogger("treadmill_actor")


@dataclass
class Book:
    """Where every fragment is: produced = accepted + dropped_by_rule + in_flight."""

    #: The learner that `kept` was given to.
    incarnation: int
    produced: int = 0
    accepted: int = 0
    dropped_by_rule: int = 0
    resent: int = 0
    newest: int = 0
    in_flight: set = field(default_factory=set)
    #: Taken, but not yet part of a checkpoint.
    kept: dict = field(default_factory=dict)
    outcomes: dict = field(default_factory=dict)

    def note_produced(self, sequence):
        """A fragment that is about to be delivered."""
        self.produced += 1
        self.newest = sequence
        self.in_flight.add(sequence)

    def settle(self, sequence, fragment, receipt):
        """Notes what became of a fragment, and lets go of what is durable."""
        outcome = schema.OUTCOME_NAMES.get(receipt.outcome, "unspecified")
        self.outcomes[outcome] = self.outcomes.get(outcome, 0) + 1
        self.in_flight.discard(sequence)
        if outcome in ("accepted", "duplicate"):
            self.accepted += 1
            self.kept[sequence] = fragment
        else:
            self.dropped_by_rule += 1
        self.kept = {number: kept for number, kept in self.kept.items() if number > receipt.durable_through}

    def settled_through(self):
        """Every fragment up to this number is dealt with for good: neither in flight nor kept."""
        still = [*self.in_flight, *self.kept]
        return min(still) - 1 if still else self.newest

    def take_for(self, incarnation):
        """What must go to another learner once more: one that was restarted knows only what was durable."""
        if incarnation == self.incarnation:
            return {}
        self.incarnation = incarnation
        again, self.kept = self.kept, {}
        # A learner that is gone took them; what becomes of them is open again.
        self.accepted -= len(again)
        self.resent += len(again)
        self.in_flight |= set(again)
        return again


class Uploader:
    """Sends the fragments of one actor process."""

    def __init__(self, bus, run, actor, incarnation, receipt_timeout_s, stopping):
        self.bus, self.run, self.actor = bus, run, actor
        self.receipt_timeout_s, self.stopping = receipt_timeout_s, stopping
        self.lock = threading.Lock()
        self.book = Book(incarnation)

    def produced(self, sequence):
        """See Book.note_produced."""
        with self.lock:
            self.book.note_produced(sequence)

    def settled_through(self):
        """See Book.settled_through."""
        with self.lock:
            return self.book.settled_through()

    def deliver(self, sequence, fragment):
        """Sends one fragment until it is settled. Returns its receipt, or None after a request to stop."""
        tries = 0
        while not self.stopping.is_set():
            if tries:
                with self.lock:
                    self.book.resent += 1
            receipt = self.bus.submit(self.run, self.actor, fragment, self.receipt_timeout_s)
            outcome = "no receipt" if receipt is None else schema.OUTCOME_NAMES.get(receipt.outcome, "unspecified")
            pause_s = RETRY_S if receipt is None else AGAIN_AFTER_S.get(outcome)
            if pause_s is None:
                if outcome == "malformed":
                    log.error("the learner refused fragment %d: %s", sequence, receipt.reason)
                with self.lock:
                    self.book.settle(sequence, fragment, receipt)
                return receipt
            if tries % 50 == 5:
                why = "no learner answers" if receipt is None else receipt.reason
                log.warning("%s: %s; keeping fragments and trying on", self.actor, why)
            tries += 1
            self.stopping.wait(pause_s)
        return None

    def send_again(self, incarnation):
        """Sends what another learner than this took and may not have saved once more; idempotent by sequence number."""
        with self.lock:
            again = self.book.take_for(incarnation)
        for sequence, fragment in sorted(again.items()):
            self.deliver(sequence, fragment)
