"""Delivery of fragments, with receipts made up here."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from treadmill_actor import schema  # noqa: E402
from treadmill_actor.delivery import DeliveryLedger, Uploader  # noqa: E402


def receipt(outcome, durable_through=0):
    return schema.Receipt(outcome=schema.OUTCOMES[outcome], durable_through=durable_through)


class DeliveryTest(unittest.TestCase):
    def test_accepted_fragment_is_kept_until_durable(self):
        ledger = DeliveryLedger(incarnation=1)
        for sequence in (1, 2, 3):
            ledger.note_produced(sequence)
        ledger.settle(2, b"2", receipt("accepted"))
        ledger.settle(1, b"1", receipt("too_old"))
        self.assertEqual((list(ledger.kept), ledger.settled_through()), ([2], 1))
        ledger.settle(3, b"3", receipt("duplicate", 2))
        self.assertEqual((list(ledger.kept), ledger.settled_through()), ([3], 2))
        self.assertEqual((ledger.produced, ledger.accepted, ledger.dropped_by_rule, len(ledger.in_flight)), (3, 2, 1, 0))

    def test_new_incarnation_gets_unsaved_fragments(self):
        ledger = DeliveryLedger(incarnation=1)
        ledger.note_produced(1)
        ledger.settle(1, b"1", receipt("accepted"))
        self.assertEqual(ledger.take_unsaved(1), {})
        self.assertEqual(ledger.take_unsaved(2), {1: b"1"})
        self.assertEqual((ledger.accepted, ledger.resent, ledger.in_flight, ledger.settled_through()), (0, 1, {1}, 0))
        self.assertEqual(ledger.take_unsaved(2), {})

    def test_fragment_is_resent_until_settled(self):
        answers = [None, *[receipt("busy")] * 7, None, receipt("busy"), receipt("stopping"), receipt("quarantined"), receipt("malformed")]
        bus = SimpleNamespace(submit=lambda *_: answers.pop(0))
        waits = []
        stopping = SimpleNamespace(is_set=lambda: False, wait=waits.append)
        uploader = Uploader(bus, "run", "py", 1, 60.0, stopping)
        uploader.note_produced(1)
        self.assertEqual(uploader.deliver(1, b"1").outcome, schema.OUTCOMES["malformed"])
        self.assertEqual(waits, [0.2, 0.2, 0.4, 0.8, 1.6, 3.2, 3.2, 3.2, 0.2, 0.2, 0.2, 10.0])
        self.assertEqual((uploader.ledger.resent, uploader.ledger.dropped_by_rule), (12, 1))

    def test_receipt_of_an_overtaken_learner_does_not_settle(self):
        answers = [receipt("accepted"), receipt("accepted")]
        answers[0].version.epoch, answers[1].version.epoch = 6, 7
        bus = SimpleNamespace(submit=lambda *_: answers.pop(0))
        stopping = SimpleNamespace(is_set=lambda: False, wait=lambda pause_s: None)
        uploader = Uploader(bus, "run", "py", 1, 60.0, stopping, lambda version: version.epoch >= 7)
        uploader.note_produced(1)
        self.assertEqual(uploader.deliver(1, b"1").version.epoch, 7)
        self.assertEqual((uploader.ledger.accepted, uploader.ledger.resent), (1, 1))


if __name__ == "__main__":
    unittest.main()
