"""Delivery of fragments, with receipts made up here: the table of events that the Rust actor passes too."""

import json
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

from treadmill_actor import schema  # noqa: E402
from treadmill_actor.delivery import Delivery, Uploader  # noqa: E402

TABLE = ROOT / "common/experience/tests/delivery_events.json"


def receipt(outcome, durable_through=0):
    return schema.Receipt(outcome=schema.OUTCOMES[outcome], durable_through=durable_through)


class Actor:
    """Delivery with the epochs that an actor keeps for it."""

    def __init__(self):
        self.delivery, self.epoch = Delivery(incarnation=1), 0

    def admits(self, epoch):
        is_current = epoch == 0 or epoch >= self.epoch
        self.epoch = max(self.epoch, epoch)
        return is_current

    def take(self, step):
        """Returns the actions that follow an event, without warnings."""
        delivery, sequence, event = self.delivery, step.get("sequence"), step["event"]
        if event == "produced":
            delivery.produce(sequence, b"%d" % sequence)
            return [{"send": sequence, "pause_ms": 0}]
        if event == "heard":
            self.admits(step["epoch"])
            return []
        if event == "adopted":
            return [{"send": again, "pause_ms": 0} for again in sorted(delivery.adopted(step["incarnation"]))]
        was_pending = sequence in delivery.pending
        if event == "silent":
            pause_s = delivery.silent(sequence)
        else:
            answer = receipt(step["outcome"], step.get("durable_through", 0))
            pause_s = delivery.answered(sequence, answer, self.admits(step.get("epoch", 0)))
        if pause_s is not None:
            return [{"send": sequence, "pause_ms": round(1000 * pause_s)}]
        return [{"settled": sequence}] if was_pending else []


class DeliveryTest(unittest.TestCase):
    def test_every_step_of_the_table_gives_its_actions(self):
        for scenario in json.loads(TABLE.read_text(encoding="utf-8")):
            actor = Actor()
            for step in scenario["steps"]:
                expected = [action for action in step["actions"] if action != {"warn": True}]
                self.assertEqual(actor.take(step), expected, (scenario["name"], step))
            delivery = actor.delivery
            counts = {name: getattr(delivery, name) for name in ("produced", "accepted", "dropped_by_rule", "resent")}
            counts |= {"in_flight": len(delivery.pending), "awaiting_durability": len(delivery.kept)}
            counts["settled_through"] = delivery.settled_through()
            self.assertEqual(counts, scenario["end"], scenario["name"])

    def test_fragment_is_sent_until_it_is_settled(self):
        answers = [None, receipt("busy"), receipt("busy"), receipt("quarantined"), receipt("malformed")]
        bus = SimpleNamespace(submit=lambda *_: answers.pop(0))
        waits = []
        stopping = SimpleNamespace(is_set=lambda: False, wait=waits.append)
        uploader = Uploader(bus, "run", "py", 1, 60.0, stopping)
        uploader.produce(1, b"1")
        self.assertEqual(uploader.deliver(1, b"1").outcome, schema.OUTCOMES["malformed"])
        self.assertEqual(waits, [0.2, 0.2, 0.4, 10.0])
        self.assertEqual((uploader.delivery.resent, uploader.delivery.dropped_by_rule), (4, 1))

    def test_receipt_of_an_overtaken_learner_does_not_settle(self):
        answers = [receipt("accepted"), receipt("accepted")]
        answers[0].version.epoch, answers[1].version.epoch = 6, 7
        bus = SimpleNamespace(submit=lambda *_: answers.pop(0))
        stopping = SimpleNamespace(is_set=lambda: False, wait=lambda pause_s: None)
        uploader = Uploader(bus, "run", "py", 1, 60.0, stopping, lambda version: version.epoch >= 7)
        uploader.produce(1, b"1")
        self.assertEqual(uploader.deliver(1, b"1").version.epoch, 7)
        self.assertEqual((uploader.delivery.accepted, uploader.delivery.resent), (1, 1))


if __name__ == "__main__":
    unittest.main()
