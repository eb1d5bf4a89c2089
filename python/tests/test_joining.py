"""Policies and receipts that an actor fetches, with answers made up here."""

import json
import socket
import sys
import threading
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np
import zenoh

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from treadmill_actor import bus, schema  # noqa: E402
from treadmill_actor.bus import Bus, BusError, check_endpoint, default_endpoint, dialled, fetch_pieces  # noqa: E402
from treadmill_actor.policies import Policies  # noqa: E402
from treadmill_actor.policy import checksum  # noqa: E402
from treadmill_actor.worker import Worker  # noqa: E402


class JoiningTest(unittest.TestCase):
    def bundle(self, config_hash=9):
        weight = np.zeros((2, 2), "<f4")
        header = {
            "actor.0.weight": {"dtype": "F32", "shape": [2, 2], "data_offsets": [0, 16]},
            "actor.0.bias": {"dtype": "F32", "shape": [2], "data_offsets": [16, 24]},
            "log_std": {"dtype": "F32", "shape": [2], "data_offsets": [24, 32]},
        }
        text = json.dumps(header).encode()
        weights = len(text).to_bytes(8, "little") + text + weight.tobytes() + bytes(16)
        return schema.PolicyBundle(
            run="run", config_hash=config_hash, weights=weights, checksum=checksum(weights), observation_clip=10.0,
            observation_mean=bytes(8), observation_inverse_std=np.ones(2, "<f4").tobytes(),
        )

    def policies(self, answers, receipt=None):
        bus = SimpleNamespace(fetch_policy=lambda *_: answers.pop(0), register=lambda *_: receipt)
        return Policies(bus, self.bundle(), "py", None)

    def test_a_standby_is_recognised_and_left(self):
        with socket.create_server(("127.0.0.1", 0)) as free:
            endpoint = f"tcp/127.0.0.1:{free.getsockname()[1]}"
        config = zenoh.Config()
        for key, value in (("mode", '"router"'), ("listen/endpoints", json.dumps([endpoint])), ("scouting/multicast/enabled", "false")):
            config.insert_json5(key, value)
        with zenoh.open(config) as standby:
            own = Bus([endpoint])
            self.assertFalse(own.is_behind_standby("run"))
            key = f"treadmill/*/policy/pieces/{standby.info.zid()}"
            mark = standby.declare_queryable(key, lambda query: query.reply_err(b"this learner follows"))
            self.assertTrue(own.is_behind_standby("run"))
            worker = Worker(own, "run", "py", None, 1, threading.Event(), leaves_standby=True)
            worker.work()
            self.assertTrue(worker.is_behind_standby)
            mark.undeclare()
            self.assertFalse(own.is_behind_standby("run"))
            own.close()

    def test_new_configuration_sets_run_changed(self):
        policies = self.policies([self.bundle(config_hash=8)])
        policies.refresh()
        self.assertTrue(policies.run_changed.is_set())

    def test_policy_of_an_overtaken_learner_is_ignored(self):
        older, newer = self.bundle(), self.bundle()
        newer.version.incarnation, newer.version.epoch = 3, 8
        older.version.incarnation, older.version.epoch = 2, 7
        policies = self.policies([newer, older])
        policies.refresh()
        policies.refresh()
        self.assertEqual(policies.current[1].epoch, 8)
        self.assertFalse(policies.admits(older.version))
        self.assertTrue(policies.admits(schema.PolicyVersion()))

    def test_damaged_weights_are_ignored(self):
        damaged = self.bundle()
        damaged.version.number, damaged.checksum = 5, 1
        policies = self.policies([damaged])
        policies.refresh()
        self.assertEqual((policies.current[1].number, policies.run_changed.is_set()), (0, False))

    def fetched(self, answers):
        """Returns what fetch_pieces makes of these answers, and the offsets that it asked for."""
        offsets = []

        def ask(key, payload, timeout_s, priority):
            offsets.append(schema.PolicyRequest.FromString(payload).offset)
            return answers.pop(0)

        return fetch_pieces(ask, "key", schema.PolicyRequest(config_hash=9)), offsets

    def test_pieces_make_up_the_bundle(self):
        def piece(bundle, number, start, end=None):
            data = bundle.SerializeToString()
            version = schema.PolicyVersion(number=number)
            total = len(data)
            return schema.PolicyPiece(
                run="run", version=version, total_bytes=total, offset=start, data=data[start:end]
            ).SerializeToString()

        old, new = self.bundle(), self.bundle(config_hash=8)
        self.assertEqual(self.fetched([piece(old, 1, 0)]), (old, [0]))
        # The second piece is lost once.
        self.assertEqual(self.fetched([piece(old, 1, 0, 50), None, piece(old, 1, 50)]), (old, [0, 50, 50]))
        # The server has a newer version by then.
        answers = [piece(old, 1, 0, 50), piece(new, 2, 50), piece(new, 2, 0, 60), piece(new, 2, 60)]
        self.assertEqual(self.fetched(answers), (new, [0, 50, 0, 60]))
        self.assertEqual(self.fetched([None]), (None, [0]))
        # Some other program answers once, then in place of the learner.
        self.assertEqual(self.fetched([piece(old, 1, 0, 50), b"\xff", piece(old, 1, 50)]), (old, [0, 50, 50]))
        self.assertEqual(self.fetched([b"\xff"]), (None, [0]))

    def test_an_answer_that_is_no_message_is_none(self):
        bus = Bus.__new__(Bus)
        bus.answers = lambda *_, **__: iter([b"\xff"])
        self.assertIsNone(bus.submit("run", "py", b"", 1.0))
        self.assertIsNone(bus.register("run", "py", SimpleNamespace(fill=lambda task: None)))

    def test_a_fragment_is_settled_by_the_first_receipt_that_settles_it(self):
        bus = Bus.__new__(Bus)
        versions = [schema.PolicyVersion(epoch=epoch, number=1) for epoch in (1, 2, 3)]
        bus.answers = lambda *_, **__: (schema.Receipt(version=version).SerializeToString() for version in versions)
        for least, settling in ((2, 2), (9, 3)):
            receipt = bus.submit("run", "py", b"", 1.0, lambda receipt, least=least: receipt.version.epoch >= least)
            self.assertEqual(receipt.version.epoch, settling)

    def test_short_answer_means_an_unchanged_policy(self):
        unchanged = schema.PolicyPiece(run="run", version=schema.PolicyVersion(number=4)).SerializeToString()
        bundle, _ = self.fetched([unchanged])
        self.assertEqual((bundle.run, bundle.version.number, bundle.config_hash), ("run", 4, 9))

    def test_task_is_registered_again_without_a_policy(self):
        refused = self.policies([None], schema.TaskReceipt(accepted=False, reason="another task"))
        refused.refresh()
        self.assertTrue(refused.run_changed.is_set())
        accepted = self.policies([None], schema.TaskReceipt(accepted=True))
        accepted.refresh()
        self.assertFalse(accepted.run_changed.is_set())

    def test_the_default_endpoint_is_encrypted_with_certificates(self):
        self.assertEqual((default_endpoint("certs"), default_endpoint(None)), ("tls/127.0.0.1:7447", "tcp/127.0.0.1:7447"))

    def test_endpoints_are_checked(self):
        for fine in ("tcp/127.0.0.1:7447", "tcp/[::1]:1", "tcp/localhost:65535", "tls/learner:7447", "tls/learner:1?a=b#c=d:e"):
            check_endpoint(fine, insecure=False, tls="certs")
        check_endpoint("tcp/learner:7447", insecure=True, tls=None)
        refused = [
            ("plain tcp", ["tcp/learner:7447", "tcp/0.0.0.0:1"]),
            ("1 to 65535", ["udp/127.0.0.1:1", "tcp/learner", "tcp/:1", "127.0.0.1:1"]),
            ("1 to 65535", [f"tcp/127.0.0.1:{port}" for port in ("", "x", "0", "-1", "65536", "99999")]),
            ("--tls DIR", ["tls/learner:7447"]),
        ]
        for message, endpoints in refused:
            for endpoint in endpoints:
                with self.subTest(endpoint), self.assertRaisesRegex(BusError, f"^endpoint `{endpoint}`.*{message}"):
                    check_endpoint(endpoint, insecure=False, tls=None)

    def test_an_endpoint_that_does_not_answer_is_logged(self):
        warned, stopping = threading.Event(), threading.Event()

        def open_session():
            warned.wait(60)
            return "session"

        # The learner starts after the second warning.
        log = mock.Mock(**{"warning.side_effect": lambda *_: log.warning.call_count == 2 and warned.set()})
        with mock.patch.multiple(bus, FIRST_WARNING_S=0.0, WARN_EVERY_S=0.0, log=log):
            self.assertEqual(dialled(open_session, ["tcp/a:1", "tcp/b:2"], stopping), "session")
        self.assertTrue(warned.is_set())
        text, *fields = log.warning.call_args.args
        self.assertEqual(text % tuple(fields), "no answer from tcp/a:1, tcp/b:2; retrying")

    def test_a_closed_session_has_no_answers(self):
        learner = Bus.__new__(Bus)
        learner.session = mock.Mock(**{"get.side_effect": zenoh.ZError("session closed"), "is_closed.return_value": True})
        self.assertEqual(list(learner.answers("key")), [])
        learner.session.is_closed.return_value = False
        with self.assertRaises(zenoh.ZError):
            list(learner.answers("key"))

    def test_a_learner_that_stands_still_does_not_fail_the_close(self):
        learner = Bus.__new__(Bus)
        learner.session = mock.Mock(**{"close.side_effect": zenoh.ZError("close operation timed out!")})
        learner.close()
        learner.session.close.assert_called_once()


if __name__ == "__main__":
    unittest.main()
