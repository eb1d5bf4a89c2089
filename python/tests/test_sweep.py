"""Tests of the study of Optuna, by the lines that `treadmill sweep` exchanges with it."""

import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

try:
    import optuna
except ImportError as why:
    raise unittest.SkipTest(f"{why.name} is not installed") from why

from treadmill_sweep import __main__ as command_line
from treadmill_sweep import study

PYTHON = Path(__file__).resolve().parents[1]
KEYS = [["ppo.gamma", "uniform", [0.5, 0.99]], ["ppo.epochs", "choices", ["1", "[2, 3]"]], ["ppo.batch", "integers", [1, 3]]]
KEYS += [["ppo.learning_rate", "log_uniform", [1e-5, 1e-3]]]


class StudyTest(unittest.TestCase):
    def setUp(self):
        optuna.logging.set_verbosity(optuna.logging.ERROR)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.url = f"sqlite:///{folder.name}/study.db"

    def asked(self, *requests):
        """Returns the answers of a process to these requests, each a name with its values."""
        lines = "".join(json.dumps({"call": name} | values) + "\n" for name, values in requests)
        answers = io.StringIO()
        study.serve(io.StringIO(lines), answers)
        return [json.loads(line) for line in answers.getvalue().splitlines()]

    def open(self, **more):
        values = {"storage": self.url, "name": "S", "trials": None, "direction": "maximize", "strategy": "tpe"}
        return "open", values | {"pruner": "none", "seed": 1, "steps": 900, "keys": KEYS} | more

    def test_a_study_proposes_and_keeps_results(self):
        trials = range(4)
        ends = [("end", {"trial": n, "state": "COMPLETE", "value": float(n)}) for n in trials]
        answers = self.asked(self.open(), *[("ask", {"trial": n}) for n in trials], *ends, ("importance", {}))
        for answer in answers[1:5]:
            gamma, epochs, batch, rate = answer["values"]
            self.assertTrue(0.5 <= gamma <= 0.99 and 1e-5 <= rate <= 1e-3, answer)
            self.assertTrue(epochs in ("1", "[2, 3]") and batch in (1, 2, 3), answer)
        self.assertEqual(answers[5:9], [{}] * 4)
        self.assertEqual(set(answers[9]["importance"]), {key for key, _, _ in KEYS})
        found = optuna.load_study(study_name="S", storage=self.url)
        self.assertEqual((found.best_value, found.best_params["ppo.gamma"]), (3.0, answers[4]["values"][0]))
        # Without two results, no key is important.
        self.assertEqual(self.asked(self.open(name="other"), ("importance", {}))[1], {"importance": {}})

    def test_a_study_that_is_opened_again_goes_on(self):
        report = ("report", {"trial": 1, "step": 90, "value": 2.0})
        end = ("end", {"trial": 0, "state": "FAIL", "value": None})
        first = self.asked(self.open(), *[("ask", {"trial": n}) for n in range(3)], report, end)
        # The sweep was killed before it saved the last trial.
        again = self.asked(self.open(trials=2), ("ask", {"trial": 2}), ("ask", {"trial": 3}))
        self.assertEqual(again[0], {"begun": [[1, 90], [2, 0]]})
        self.assertEqual(again[1], first[3])
        self.assertNotIn(again[2]["values"], [answer["values"] for answer in first[1:4]])

    def test_hopeless_trials_are_found(self):
        for pruner in ("median", "hyperband"):
            requests = [self.open(name=pruner, pruner=pruner, direction="minimize", strategy="random")]
            for trial in range(12):
                requests += [("ask", {"trial": trial})]
                values = {"trial": trial, "value": float(trial)}
                requests += [("report", values | {"step": step}) for step in (90, 200, 450, 800)]
                requests += [("end", values | {"state": "COMPLETE"})]
            pruned = [answer["prune"] for answer in self.asked(*requests) if "prune" in answer]
            self.assertEqual(pruned[:4] + pruned[4::4], [False] * 15, "the first trial, and others too early")
            self.assertIn(True, pruned)

    def test_what_is_refused_says_why(self):
        for requests, part in [
            ([self.open(storage="sheet://x")], "sheet"),
            ([self.open(trials=9)], "it is not there"),
            ([self.open(), ("ask", {"trial": 3})], "0 trials, and the sweep 3"),
            ([self.open(), self.open(trials=9)], "and the sweep 9; choose another --run-dir or --storage"),
            ([self.open(), self.open(direction="minimize")], "choose another --run-dir or --storage"),
            ([self.open(name="other"), ("ask", {"trial": 0}), self.open(name="other")], "1 trials, and the sweep 0"),
        ]:
            with self.subTest(part):
                self.assertIn(part, self.asked(*requests)[-1]["error"])

    def test_missing_packages_are_named(self):
        check = ("check", {"strategy": "cmaes"})
        with mock.patch("importlib.util.find_spec", return_value=None):
            self.assertIn("pip install cmaes", self.asked(check)[0]["error"])
        with mock.patch.object(study, "optuna", None):
            self.assertIn("pip install 'optuna>=5,<6'", self.asked(check)[0]["error"])

    def test_the_module_replaces_itself_by_the_binary(self):
        with tempfile.TemporaryDirectory() as folder:
            binary = Path(folder, "treadmill")
            binary.write_text('#!/bin/sh\necho "$TREADMILL_PYTHON" "$@"\n')
            binary.chmod(0o755)
            words = ["search.toml", "--steps", "3", "--treadmill", str(binary), "--resume", "S"]
            command = [sys.executable, "-m", "treadmill_sweep", *words]
            done = subprocess.run(command, env=os.environ | {"PYTHONPATH": str(PYTHON)}, capture_output=True, text=True)
            self.assertEqual(done.stdout, f"{sys.executable} sweep search.toml --steps 3 --resume S\n")
        with mock.patch("sys.stderr", io.StringIO()) as errors, mock.patch.dict(os.environ):
            self.assertEqual(command_line.main(["--treadmill=/nowhere"]), 2)
        self.assertRegex(errors.getvalue(), re.escape("give its path with --treadmill"))
