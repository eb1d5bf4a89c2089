"""Command lines: wrong flags, and signals to processes without a learner."""

import contextlib
import io
import os
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

PYTHON = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PYTHON))

from treadmill_actor import cli  # noqa: E402

# Blocks where BLOCKS says, after a line on standard output.
ENVIRONMENT = """
import os, threading
import gymnasium

class Env(gymnasium.Env):
    observation_space = action_space = gymnasium.spaces.Box(-1, 1, (1,))

    def __init__(self):
        self.block("__init__")

    def reset(self, *, seed=None, options=None):
        return self.observation_space.sample(), {}

    def close(self):
        self.block("close")

    def block(self, where):
        if where == os.environ["BLOCKS"]:
            print(where, flush=True)
            threading.Event().wait()

gymnasium.register("Env-v0", Env)
"""


class FlagsTest(unittest.TestCase):
    def run_cli(self, *flags):
        """Returns exit code and standard error of an actor with these flags, which must not dial."""
        err = io.StringIO()
        patches = mock.patch.object(cli, "dialled", lambda *_: None), mock.patch("logging.basicConfig")
        with contextlib.redirect_stderr(err), patches[0], patches[1]:
            try:
                code = cli.main(["--env", "Pendulum-v1", "--run", "gym", *flags])
            except SystemExit as end:
                code = end.code
        return code, err.getvalue()

    def test_wrong_flags_are_refused(self):
        cases = [
            ("--seed", "-1", "--seed: `-1` is not a whole number from 0 to"),
            ("--seed", "1e3", "`1e3` is not a whole number"),
            ("--steps", "0", "--steps: `0` is not a whole number from 1 to"),
            ("--steps", "-4", "`-4` is not"),
            ("--envs", "65537", "`65537` is not a whole number from 1 to 65536"),
            *(("--kwargs", text, f"`{text}` is not a JSON object") for text in ("[1]", "null", "{", "7")),
            ("--connect", "tcp/127.0.0.1:99999", "endpoint `tcp/127.0.0.1:99999` is not valid"),
            ("--connect", "tls/127.0.0.1:1", "--tls is missing"),
        ]
        for flag, value, message in cases:
            with self.subTest(flag=flag, value=value):
                code, err = self.run_cli(flag, value)
                self.assertEqual(code, 2)
                self.assertIn(message, err)

    def test_unknown_arguments_of_the_environment_are_named(self):
        code, err = self.run_cli("--kwargs", '{"nope": 1}', "--envs", "1")
        self.assertEqual((code, err.count("\n")), (1, 1))
        self.assertRegex(err, "^error: .*'nope'.*correct --kwargs")


class SignalsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        Path(self.folder, "blocking.py").write_text(ENVIRONMENT)
        # Background jobs of a shell ignore Ctrl-C, and so would the processes that they start.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.SIG_DFL))
        # It accepts connections, and does not answer.
        self.learner = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(self.learner.close)
        self.connect = ["--connect", f"tcp/127.0.0.1:{self.learner.getsockname()[1]}"]

    def start(self, *command, blocks=""):
        """Starts a Python process that is killed at the end of the test."""
        paths = os.pathsep.join([self.folder, str(PYTHON)])
        process = subprocess.Popen(
            [sys.executable, *command, *self.connect],
            env=os.environ | {"PYTHONPATH": paths, "BLOCKS": blocks},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, process, text):
        """Waits for a line of output with this text."""
        self.assertTrue(any(text in line for line in process.stdout), text)

    def actor(self, blocks):
        flags = ["--import", "blocking", "--env", "Env-v0", "--run", "gym", "--envs", "1"]
        return self.start("-m", "treadmill_actor", *flags, blocks=blocks)

    def test_ctrl_c_ends_the_actor_while_it_builds_its_environments(self):
        actor = self.actor(blocks="__init__")
        self.wait_for(actor, "__init__")
        actor.send_signal(signal.SIGINT)
        self.assertEqual(actor.wait(timeout=60), 130)

    def test_a_second_signal_ends_the_actor_at_once(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                actor = self.actor(blocks="close")
                self.wait_for(actor, "runs `gymnasium/Env-v0`")
                actor.send_signal(signal.SIGTERM)
                # It is ending, but the environment hangs.
                self.wait_for(actor, "close")
                actor.send_signal(number)
                self.assertEqual(actor.wait(timeout=60), -number)

    def test_ctrl_c_ends_the_recorder_while_no_learner_answers(self):
        recorder = self.start(str(PYTHON / "examples/actor/record.py"), self.folder)
        connection, _ = self.learner.accept()
        self.addCleanup(connection.close)
        recorder.send_signal(signal.SIGINT)
        self.assertEqual(recorder.wait(timeout=60), 0)


if __name__ == "__main__":
    unittest.main()
