"""Tests of the search by Optuna, with a stand-in for the binary that trains nothing."""

import contextlib
import csv
import io
import importlib.util
import json
import os
import re
import select
import signal
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from unittest import mock

try:
    import optuna
except ImportError as why:
    raise unittest.SkipTest(f"{why.name} is not installed") from why

from treadmill_sweep import cli, search
from treadmill_sweep.progress import Goal, Progress

PYTHON = Path(__file__).resolve().parents[1]
#: Path of the binary, which some tests need.
BINARY = os.environ.get("TREADMILL")
STEPS = 900
#: Limit of every wait (s), which only a broken program reaches.
LIMIT_S = 60

#: Plans a sweep from JSON in a comment of its file. A run writes 30 values: `ppo.gamma` times the share of the steps, plus
#: the seed. At half of them, a run that BLOCKS names waits for a signal; one that FAILS names fails at its start.
STAND_IN = f"""#!{sys.executable}
import json, os, signal, sys
from pathlib import Path

flags = dict(word.split("=", 1) for word in sys.argv[2:] if "=" in word)
keys = dict(word[6:].split("=", 1) for word in sys.argv[2:] if word.startswith("--set="))
folder = Path(flags.get("--run-dir", "."))
if sys.argv[2] == "--draw":
    print("a warning" if "drawless" not in os.environ else os.environ["drawless"], file=sys.stderr)
    sys.exit("drawless" in os.environ)
if sys.argv[1] == "sweep":
    text = Path(sys.argv[2]).read_text()
    if "gama" in text:
        sys.exit(f"error: `{{sys.argv[2]}}`: no such key")
    plan = json.loads(text.splitlines()[0][1:])
    settings, seeds = int(flags.get("--trials", plan.pop("trials"))), plan.pop("seeds")
    plan["trials"] = [{{"setting": run // seeds + 1}} for run in range(settings * seeds)]
    kept = [word for word in sys.argv[3:] if not word.startswith(("--trials", "--parallel", "--plan"))]
    plan |= {{"flags": kept, "parallel": int(flags.get("--parallel", 2)), "deterministic": False, "connect": [], "started_in": os.getcwd()}}
    print(json.dumps(plan | {{"steps": {STEPS}}}))
    sys.exit()

def said(text):
    print(text, flush=True)
    with open(os.environ["SAID"], "w") as pipe:
        pipe.write(f"{{folder.name}} {{os.getpid()}} {{text}}\\n")

def asked(*_):
    said("saved")
    if "deaf" not in os.environ:
        os._exit(0)

signal.signal(signal.SIGINT, asked)
steps = {STEPS}
folder.mkdir(exist_ok=True)
print(" ".join(sys.argv[1:]), flush=True)
if folder.name == os.environ.get("FAILS"):
    sys.exit(3)
log = folder / "metrics.jsonl"
begun = json.loads(log.read_text().splitlines()[-1])["step"] if log.exists() else 0
with open(log, "a") as file:
    for step in range(begun + steps // 30, steps + 1, steps // 30):
        value = float(keys["ppo.gamma"]) * step / steps + int(flags["--seed"])
        for tag, value in (("rollout/ep_rew_mean", value), ("time/time_elapsed", step / 10)):
            file.write(json.dumps({{"run": "r", "tag": tag, "step": step, "value": value, "time_unix_s": 1.0}}) + "\\n")
        file.flush()
        if step == steps // 2 and folder.name in os.environ.get("BLOCKS", "").split():
            said("waits")
            while True:
                signal.pause()
"""


def metric(tag, step, value):
    """Returns a line of a log."""
    return json.dumps({"run": "r", "tag": tag, "step": step, "value": value, "time_unix_s": 1.0}) + "\n"


class FolderCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()


class ProgressTest(FolderCase):
    def test_goals_are_measured_as_by_the_binary(self):
        tag = "eval/distance_mean_m"
        rows = [(10, 1.0), (20, 12.0), (30, 9.0)]
        text = "".join(metric("time/time_elapsed", step, step / 5) + metric(tag, step, value) for step, value in rows)
        (self.folder / "metrics.jsonl").write_text(text)
        for goal, direction, at, result in [
            (f"highest {tag}", "maximize", 12.0, 9.0),
            (f"lowest {tag}", "minimize", 12.0, 9.0),
            (f"steps until {tag} >= 10", "minimize", -2.0, 20),
            (f"seconds until {tag} >= 10", "minimize", -2.0, 4.0),
            (f"seconds until {tag} >= 10.5", "minimize", -1.5, 4.0),
            (f"steps until {tag} <= 1", "minimize", 11.0, 10),
            (f"steps until {tag} >= 50", "minimize", 38.0, None),
            ("lowest eval/velocity_error", "minimize", None, None),
        ]:
            with self.subTest(goal):
                progress = Progress(Goal(goal), self.folder)
                progress.read()
                found = (progress.goal.direction, progress.at(29), progress.result())
                self.assertEqual((found, progress.at(9), progress.step), ((direction, at, result), None, 30))

    def test_a_log_is_followed_while_it_grows(self):
        log, tag = self.folder / "metrics.jsonl", "rollout/ep_rew_mean"
        progress = Progress(Goal(f"highest {tag}"), self.folder)
        progress.read()
        self.assertIsNone(progress.result())
        line = metric(tag, 2, 7.0)
        log.write_text(metric(tag, 1, 5.0) + line[:20])
        progress.read()
        self.assertEqual(progress.result(), 5.0)
        with open(log, "a") as file:
            file.write(line[20:] + '{"tag":"rollout/ep_rew\n')
        progress.read()
        self.assertEqual((progress.result(), progress.steps), (7.0, [1, 2]))
        # A resumed run replaces its log.
        (self.folder / "new").write_text(metric(tag, 1, 5.0))
        os.replace(self.folder / "new", log)
        progress.read()
        self.assertEqual((progress.result(), progress.steps), (5.0, [1]))


class SweepCase(FolderCase):
    def setUp(self):
        super().setUp()
        self.binary, self.root = self.folder / "treadmill", self.folder / "sweep"
        self.binary.write_text(STAND_IN)
        self.binary.chmod(0o755)
        os.mkfifo(self.folder / "said")
        # Opened for both, it never ends.
        self.said = open(os.open(self.folder / "said", os.O_RDWR), "rb", buffering=0)
        self.addCleanup(self.said.close)
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.SIG_DFL))
        self.addCleanup(signal.signal, signal.SIGTERM, signal.signal(signal.SIGTERM, signal.SIG_DFL))

    def write(self, more="", trials=1, seeds=1, seed=1, goal="highest rollout/ep_rew_mean", **entries):
        """Writes a search file. All but its keys, strategy and pruner are read by the binary only."""
        plan = {"trials": trials, "seeds": seeds, "seed": seed, "goal": goal}
        lines = [f"#{json.dumps(plan)}\n", *(f"{name} = {json.dumps(value)}\n" for name, value in entries.items())]
        keys = "[keys]\nppo.gamma = { uniform = [0.5, 0.99] }\nppo.epochs = { choices = [1, [2, 3]] }\n"
        (self.folder / "search.toml").write_text("".join(lines) + (more or keys))

    def environment(self, **more):
        return os.environ | {"PYTHONPATH": str(PYTHON), "SAID": str(self.folder / "said")} | more

    def words(self, *flags):
        return [str(self.folder / "search.toml"), "--treadmill", str(self.binary), "--run-dir", str(self.root), *flags]

    def call(self, *words, **more):
        """Returns exit code, standard output and standard error of a command line."""
        out, err = io.StringIO(), io.StringIO()
        with mock.patch.dict(os.environ, self.environment(**more)):
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = cli.main([*words])
        return code, out.getvalue(), err.getvalue()

    def start(self, *words, **more):
        """Starts a process that is killed at the end of the test."""
        process = subprocess.Popen(
            [sys.executable, "-m", "treadmill_sweep", *words],
            env=self.environment(**more),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def heard(self):
        """Returns name, process and message of the next trial that says something."""
        line = b""
        while not line.endswith(b"\n"):
            self.assertTrue(select.select([self.said], [], [], LIMIT_S)[0], line)
            line += self.said.read(1)
        return line.decode().split()

    def await_end(self, process):
        """Waits for the end of another process."""
        self.assertTrue(select.select([process], [], [], LIMIT_S)[0])
        os.close(process)

    def rows(self):
        return list(csv.DictReader((self.root / "sweep.csv").read_text().splitlines()))


class FileTest(SweepCase):
    def test_wrong_entries_are_named(self):
        for entries, parts in [
            ({"strategy": "grid"}, ['`strategy` is "grid"', "the binary does this"]),
            ({"strategy": "gp"}, ['`strategy` is "gp"; allowed: "tpe", "cmaes", "random"']),
            ({"strategy": 3}, ["`strategy` is 3; allowed"]),
            ({"strategy": ["tpe"]}, ['`strategy` is ["tpe"]; allowed']),
            ({"pruner": "halving"}, ['`pruner` is "halving"; allowed: "none", "median", "hyperband"']),
            ({"more": "ppo.gama = 1"}, ["search.toml`: no such key"]),
            ({"more": "strategy = tpe"}, ["search.toml` is not valid TOML"]),
        ]:
            with self.subTest(entries=entries):
                self.write(**entries)
                code, _, err = self.call(*self.words())
                self.assertEqual((code, self.root.exists()), (2, False))
                for part in parts:
                    self.assertIn(part, err)

    def test_command_lines_are_checked(self):
        self.write()
        for words, part in [
            ([], "cannot read the search file"),
            (["missing.toml"], "`missing.toml`"),
            (["--resume", str(self.folder)], "there is no sweep"),
            (["--resume", str(self.folder), "--preset", "walk"], "keeps its flags"),
            (["search.toml", "--resume", str(self.folder)], "keeps its flags"),
            ([str(self.folder / "search.toml"), "--treadmill", "/nowhere"], "give its path with --treadmill"),
            (self.words("--storage", "sheet://x"), "cannot be opened at `sheet://x`"),
        ]:
            with self.subTest(words=words):
                code, _, err = self.call(*words)
                self.assertEqual((code, err[:7]), (2, "error: "))
                self.assertIn(part, err)

    @unittest.skipUnless(BINARY, "TREADMILL does not name the binary")
    def test_the_binary_checks_keys_and_goals(self):
        for text, part in [
            ("[keys]\nppo.gama = { uniform = [0.9, 1] }", "did you mean `ppo.gamma`?"),
            ("[keys]\nppo.gamma = { uniform = [0.9, 2] }", "allowed: 0 to 1"),
            ("goal = 'highest far'\n[keys]\nppo.gamma = { uniform = [0.9, 1] }", "there is no metric `far`"),
            ("trials = 0\n[keys]\nppo.gamma = { uniform = [0.9, 1] }", "`trials` is 0"),
            ("stratgy = 1\n[keys]\nppo.gamma = { uniform = [0.9, 1] }", "did you mean `strategy`?"),
        ]:
            with self.assertRaisesRegex(search.SweepError, "^`search.toml`.*" + re.escape(part)):
                search.read("search.toml", text, BINARY, [])

    @unittest.skipUnless(BINARY, "TREADMILL does not name the binary")
    def test_the_binary_fills_in_what_is_missing(self):
        text = "strategy = 'random'\nseeds = 2\n[keys.ppo]\ngamma = { uniform = [0.9, 1] }\nepochs = { choices = [1, 2] }"
        plan = search.read("search.toml", text, BINARY, ["--preset=smoke", "--steps", "2M", "--parallel=2", "--seed=4"])
        expected = {"trials": 8, "seeds": 2, "seed": 4, "steps": 2000000, "strategy": "random", "pruner": "none", "parallel": 2}
        self.assertEqual({name: plan[name] for name in expected}, expected)
        self.assertEqual(plan["keys"], {"ppo.gamma": ("uniform", [0.9, 1]), "ppo.epochs": ("choices", [1, 2])})
        self.assertEqual(plan["goal"], "highest eval/distance_mean_m")
        actors = max(1, len(os.sched_getaffinity(0)) // 2)
        self.assertEqual(plan["flags"], ["--preset=smoke", "--steps=2M", f"--actors={actors}"])


class RunTest(SweepCase):
    def test_a_sweep_keeps_what_its_trials_reached(self):
        strategy = "cmaes" if importlib.util.find_spec("cmaes") else "tpe"
        self.write(trials=3, seeds=2, seed=5, strategy=strategy)
        code, out, err = self.call(*self.words("--preset", "walk", "--json"))
        self.assertEqual(code, 0, err)
        rows, result = self.rows(), json.loads(out.splitlines()[-1])
        self.assertEqual([row["seed"] for row in rows], ["5", "6"] * 3)
        self.assertEqual([(row["trial"], row["setting"]) for row in rows], [(str(n + 1), str(n // 2 + 1)) for n in range(6)])
        for row in rows:
            self.assertAlmostEqual(float(row["goal"]), float(row["ppo.gamma"]) + int(row["seed"]))
        best = max(rows, key=lambda row: float(row["ppo.gamma"]))
        first = result["settings"][0]
        self.assertEqual((first["setting"], result["complete"]), (int(best["setting"]), 3))
        self.assertEqual(set(result["importance"]), {"ppo.gamma", "ppo.epochs"})
        self.assertEqual((best["env_steps"], best["state"], best["wall_s"]), (str(STEPS), "complete", "90.0"))
        self.assertAlmostEqual(first["mean"], float(best["ppo.gamma"]) + 5.5)
        self.assertAlmostEqual(first["deviation"], 0.5**0.5)
        self.assertIn("Importance of each key", out)
        self.assertIn(f"{self.root}/sweep.png", out)
        drawn = json.loads((self.root / "trials.json").read_text())["trials"]
        self.assertEqual([(row["seed"], row["setting"], row["exit"]) for row in drawn], [(5 + n % 2, n // 2 + 1, 0) for n in range(6)])
        self.assertEqual(dict(drawn[2]["keys"])["ppo.gamma"], f"{float(rows[2]['ppo.gamma']):.6g}")
        command = (self.root / "trial-2.log").read_text().splitlines()[0]
        for word in ("train", "--preset walk", "--resume-or-start", "--seed=6", "--no-progress", "--json", "--actors="):
            self.assertIn(word, command)
        study = optuna.load_study(study_name="sweep", storage=f"sqlite:///{self.root}/study.db")
        self.assertGreater(len(study.trials[0].intermediate_values), 20)
        code, _, err = self.call(*self.words())
        self.assertEqual((code, "already holds a sweep" in err), (2, True))
        code, _, _ = self.call("--resume", str(self.root), "--trials", "4")
        settings = {row["setting"]: row["ppo.gamma"] for row in self.rows()}
        self.assertEqual((code, len(settings), len(set(settings.values()))), (0, 4, 4), "no setting is drawn twice")

    def test_hopeless_trials_are_pruned(self):
        # Hyperband assigns brackets by name and number. The second trial of the first bracket is worse than the first one.
        bracket = [number + 1 for number in range(9) if zlib.crc32(f"sweep_{number}".encode()) % 17 < 9]
        bad = bracket[1]
        self.write(trials=bad, strategy="random", pruner="hyperband", goal="lowest rollout/ep_rew_mean")
        # Values fall until the trial that waits, whose seed makes it the worst.
        text = self.binary.read_text().replace("+ int(flags", f"+ 9 * (folder.name == 'trial-{bad}') + int(flags")
        self.binary.write_text(text)
        code, out, err = self.call(*self.words("--parallel", "1"), BLOCKS=f"trial-{bad}")
        self.assertEqual(code, 0, err)
        states = {row["trial"]: row["state"] for row in self.rows()}
        self.assertEqual((states.pop(str(bad)), set(states.values())), ("pruned", {"complete"}))
        self.assertIn("saved", (self.root / f"trial-{bad}.log").read_text())
        self.assertIn(f"trial-{bad}: pruned", out)

    def test_a_trial_that_fails_or_misses_the_goal_is_a_result(self):
        self.write(trials=3, goal="steps until rollout/ep_rew_mean >= 1.3")
        code, out, err = self.call(*self.words("--json"), FAILS="trial-2", drawless="error: nothing to draw")
        self.assertEqual(code, 0, err)
        rows = self.rows()
        self.assertEqual((rows[1]["exit"], rows[1]["state"], rows[1]["goal"]), ("3", "failed", ""))
        self.assertIn("trial-2: failed with exit code 3, see trial-2.log", out)
        self.assertIn("the picture is missing: nothing to draw", out)
        self.assertEqual((rows[0]["state"], json.loads(out.splitlines()[-1])["failed"]), ("complete", 1))
        self.assertEqual(int(rows[0]["goal"]) % 30, 0)
        self.root = self.folder / "far"
        self.write(trials=2, goal="steps until rollout/ep_rew_mean >= 9")
        code, out, _ = self.call(*self.words("--json"), drawless="")
        self.assertEqual((code, {row["state"] for row in self.rows()}), (0, {"not reached"}))
        self.assertIn("the picture is missing: exit code 1", out)
        self.root = self.folder / "failed"
        code, _, err = self.call(*self.words("--trials", "1"), FAILS="trial-1")
        self.assertEqual((code, "all trials failed" in err), (1, True))

    def test_on_a_full_disk_no_trial_begins(self):
        self.write()
        with mock.patch("shutil.disk_usage", return_value=mock.Mock(free=1 << 20)):
            code, _, err = self.call(*self.words())
        self.assertEqual((code, "is full" in err, (self.root / "trial-1").exists()), (1, True, False))
        self.assertEqual(self.call("--resume", str(self.root))[0], 0)


class EndTest(SweepCase):
    def begin(self, **more):
        """Starts a sweep whose two trials wait half-way. Returns its process and those of the trials."""
        self.write(trials=3)
        sweep = self.start(*self.words("--parallel", "2"), BLOCKS="trial-1 trial-2", **more)
        heard = [self.heard() for _ in range(2)]
        self.assertEqual({(name, message) for name, _, message in heard}, {("trial-1", "waits"), ("trial-2", "waits")})
        return sweep, [os.pidfd_open(int(process)) for _, process, _ in heard]

    def goes_on(self):
        """Resumes the sweep and checks that no trial began anew."""
        code, out, err = self.call("--resume", str(self.root), "--json")
        self.assertEqual((code, json.loads(out.splitlines()[-1])["complete"]), (0, 3), err)
        for number in (1, 2, 3):
            lines = (self.root / f"trial-{number}/metrics.jsonl").read_text().splitlines()
            self.assertEqual(len(lines), 60)
        self.assertEqual(sorted(row["trial"] for row in self.rows()), ["1", "2", "3"])

    def test_trials_end_with_a_killed_sweep_and_go_on(self):
        sweep, trials = self.begin()
        sweep.kill()
        for trial in trials:
            self.await_end(trial)
        sweep.wait()
        self.goes_on()

    def test_ctrl_c_lets_trials_save(self):
        sweep, trials = self.begin()
        code, _, err = self.call("--resume", str(self.root))
        self.assertEqual((code, "is in use by another sweep" in err), (2, True))
        sweep.send_signal(signal.SIGINT)
        out, _ = sweep.communicate(timeout=LIMIT_S)
        self.assertEqual(sweep.returncode, 0)
        self.assertIn(f"go on with: python -m treadmill_sweep --resume {self.root}", out)
        self.assertEqual({self.heard()[2] for _ in trials}, {"saved"})
        self.goes_on()

    def test_a_second_ctrl_c_ends_at_once(self):
        sweep, trials = self.begin(deaf="1")
        sweep.send_signal(signal.SIGINT)
        self.assertEqual({self.heard()[2] for _ in trials}, {"saved"})
        sweep.send_signal(signal.SIGINT)
        self.assertEqual(sweep.wait(LIMIT_S), 130)
        for trial in trials:
            self.await_end(trial)

    def test_a_killed_trial_goes_on_by_itself(self):
        self.write()
        sweep = self.start(*self.words(), BLOCKS="trial-1")
        _, process, _ = self.heard()
        os.kill(int(process), signal.SIGKILL)
        out, _ = sweep.communicate(timeout=LIMIT_S)
        self.assertEqual((sweep.returncode, "trial-1: complete" in out), (0, True), out)
