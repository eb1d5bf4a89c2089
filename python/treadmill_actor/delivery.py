"""Uploads fragments: resends each until the learner settles it, and keeps it until a checkpoint holds it."""

import logging
import threading
from dataclasses import dataclass, field

from . import schema

#: First and longest pause before a fragment is resent. It doubles while the queue is full: each attempt carries the whole fragment.
RETRY_S, RETRY_MAX_S = 0.2, 3.2
QUARANTINE_RETRY_S = 10.0
#: Pause before a fragment is resent, by outcome. Other outcomes settle the fragment.
RETRY_AFTER_S = {"busy": RETRY_S, "stopping": RETRY_S, "quarantined": QUARANTINE_RETRY_S}
log = logging.getLogger("treadmill_actor")


@dataclass
class DeliveryLedger:
    """Accounts for every fragment: produced = accepted + dropped_by_rule + in_flight."""

    #: Incarnation of the learner that accepted the fragments in `kept`.
    incarnation: int
    produced: int = 0
    accepted: int = 0
    dropped_by_rule: int = 0
    resent: int = 0
    newest: int = 0
    in_flight: set = field(default_factory=set)
    #: Accepted fragments that no checkpoint holds yet, by sequence.
    kept: dict = field(default_factory=dict)
    outcomes: dict = field(default_factory=dict)

    def note_produced(self, sequence):
        """Adds a fragment that is about to be sent."""
        self.produced += 1
        self.newest = sequence
        self.in_flight.add(sequence)

    def settle(self, sequence, fragment, receipt):
        """Records the outcome of a fragment and forgets fragments that are durable."""
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
        """Returns the last sequence up to which no fragment is in flight or kept."""
        open_fragments = [*self.in_flight, *self.kept]
        return min(open_fragments) - 1 if open_fragments else self.newest

    def take_unsaved(self, incarnation):
        """Returns the kept fragments if the learner's incarnation changed: a restarted learner has only durable ones."""
        if incarnation == self.incarnation:
            return {}
        self.incarnation = incarnation
        resend, self.kept = self.kept, {}
        # The previous learner accepted them; the new one decides again.
        self.accepted -= len(resend)
        self.resent += len(resend)
        self.in_flight |= set(resend)
        return resend


class Uploader:
    """Uploads the fragments of one actor process; thread-safe."""

    def __init__(self, bus, run, actor, incarnation, receipt_timeout_s, stopping, admits=lambda version: True):
        self.bus, self.run, self.actor, self.admits = bus, run, actor, admits
        self.receipt_timeout_s, self.stopping = receipt_timeout_s, stopping
        self.lock = threading.Lock()
        self.ledger = DeliveryLedger(incarnation)

    def note_produced(self, sequence):
        """See DeliveryLedger.note_produced."""
        with self.lock:
            self.ledger.note_produced(sequence)

    def settled_through(self):
        """See DeliveryLedger.settled_through."""
        with self.lock:
            return self.ledger.settled_through()

    def settles(self, receipt):
        """Returns whether a fragment with this receipt need not be sent again."""
        return self.admits(receipt.version) and schema.OUTCOME_NAMES.get(receipt.outcome) not in RETRY_AFTER_S

    def deliver(self, sequence, fragment):
        """Sends one fragment until a receipt settles it. Returns the receipt, or None after a request to stop."""
        tries = busy = 0
        while not self.stopping.is_set():
            if tries:
                with self.lock:
                    self.ledger.resent += 1
            receipt = self.bus.submit(self.run, self.actor, fragment, self.receipt_timeout_s, self.settles)
            # What an overtaken learner accepts never becomes durable.
            if receipt is not None and not self.admits(receipt.version):
                receipt = None
            outcome = "no receipt" if receipt is None else schema.OUTCOME_NAMES.get(receipt.outcome, "unspecified")
            pause_s = RETRY_S if receipt is None else RETRY_AFTER_S.get(outcome)
            if pause_s is None:
                if outcome == "malformed":
                    log.error("learner rejected fragment %d: %s", sequence, receipt.reason)
                with self.lock:
                    self.ledger.settle(sequence, fragment, receipt)
                return receipt
            if tries % 50 == 5:
                why = "no learner answers" if receipt is None else receipt.reason
                log.warning("%s: %s; keeping fragments and retrying", self.actor, why)
            tries += 1
            if outcome == "busy":
                pause_s = min(RETRY_S * 2**busy, RETRY_MAX_S)
            busy = min(busy + 1, 16) if outcome == "busy" else 0
            self.stopping.wait(pause_s)
        return None

    def resend_unsaved(self, incarnation):
        """Resends fragments that a previous incarnation accepted but may not have saved; the learner drops duplicates."""
        with self.lock:
            resend = self.ledger.take_unsaved(incarnation)
        for sequence, fragment in sorted(resend.items()):
            self.deliver(sequence, fragment)
