"""Tests of the forwarder with recording sinks."""

import fcntl
import itertools
import json
import os
import queue
import socket
import subprocess
import sys
import tempfile
import threading
import types
import unittest
from pathlib import Path
from unittest import mock

from treadmill_actor import forward
from treadmill_actor.bus import read_metric


def metric(run, tag, step, value=1.0):
    """Returns a metric as the learner publishes it."""
    return "metric", {"run": run, "tag": tag, "step": step, "value": value, "time_unix_s": 12.5}


class RecordingRun:
    """Sink that records calls."""

    def __init__(self):
        self.logged, self.video = [], "unfinished"

    def log(self, metrics):
        self.logged += [(m["tag"], m["step"], m["value"]) for m in metrics]

    def finish(self, video):
        self.video = video


class ForwardTest(unittest.TestCase):
    def forwarded(self, events):
        """Forwards `events` until all runs have ended; returns the sinks by the names of their runs."""
        waiting, sinks = queue.Queue(), {}
        for event in events:
            waiting.put(event)
        stopping = threading.Event()
        forward.forward(waiting, lambda name: sinks.setdefault(name, RecordingRun()), stopping, gone_s=0.0)
        return sinks

    def test_runs_are_logged_apart_and_end(self):
        events = [("begun", "a"), metric("a", "x", 1), metric("b", "x", 1, 2.0), metric("a", "y", 2), ("gone", "a"), ("gone", "b")]
        sinks = self.forwarded(events)
        self.assertEqual(sinks["a"].logged, [("x", 1, 1.0), ("y", 2, 1.0)])
        self.assertEqual(sinks["b"].logged, [("x", 1, 2.0)])
        self.assertEqual((sinks["a"].video, sinks["b"].video), (None, None))

    def test_what_is_no_metric_is_dropped(self):
        _, whole = metric("a", "x", 1)
        self.assertEqual(read_metric(json.dumps(whole).encode()), whole)
        wrong = [whole | {"step": None}, whole | {"tag": 3}, whole | {"value": True}, {}, [], 7, "run"]
        endless = [b'{"run":"a","tag":"x","step":1,"value":1.0,"time_unix_s":%s}' % time for time in (b"1e999", b"9" * 400, b"NaN")]
        for data in [b"", b"\xff", b"[" * 100_000, *endless, *(json.dumps(found).encode() for found in wrong)]:
            self.assertIsNone(read_metric(data), data[:80])

    def test_restarted_learner_does_not_end_its_run(self):
        batches = [[metric("a", "x", 1), ("gone", "a")], [("begun", "a")], [], [metric("a", "x", 2)], [("gone", "a")], []]
        clock, opened = itertools.count(step=4.0), []

        def open_run(name):
            opened.append(RecordingRun())
            return opened[-1]

        # The clock advances by four seconds at each look.
        with (
            mock.patch.object(forward, "take_batch", lambda *_: batches.pop(0)),
            mock.patch.object(forward.time, "monotonic", lambda: next(clock)),
        ):
            forward.forward(None, open_run, threading.Event(), gone_s=6.0)
        self.assertEqual([run.logged for run in opened], [[("x", 1, 1.0), ("x", 2, 1.0)]])

    def test_a_signal_ends_it_while_no_learner_answers(self):
        with tempfile.TemporaryDirectory() as folder, socket.create_server(("127.0.0.1", 0)) as listener:
            Path(folder, "mlflow.py").touch()
            paths = os.pathsep.join([folder, str(Path(forward.__file__).parents[1])])
            command = [sys.executable, "-m", "treadmill_actor.forward", "mlflow", "--connect"]
            command.append(f"tcp/127.0.0.1:{listener.getsockname()[1]}")
            with subprocess.Popen(command, env=os.environ | {"PYTHONPATH": paths}) as process:
                listener.accept()
                process.terminate()
                self.assertEqual(process.wait(timeout=60), 0)

    def test_wandb_gets_metrics_of_one_step_together(self):
        wandb = mock.MagicMock()
        with mock.patch.dict(sys.modules, {"wandb": wandb}):
            run = forward.WandbRun("walk", "project", {"ppo.gamma": 0.99})
            run.log([value for _, value in (metric("walk", "a", 5), metric("walk", "b", 5, 2.0), metric("walk", "a", 6))])
            run.finish(Path("policy.gif"))
        calls = [call.args[0] for call in wandb.init.return_value.log.call_args_list]
        self.assertEqual(calls[:2], [{"env_steps": 5, "a": 1.0, "b": 2.0}, {"env_steps": 6, "a": 1.0}])
        wandb.Video.assert_called_once_with("policy.gif", format="gif")
        wandb.init.return_value.finish.assert_called_once()

    def test_mlflow_gets_steps_and_milliseconds(self):
        mlflow, entities = mock.MagicMock(), types.SimpleNamespace(Metric=lambda *args: args, Param=lambda *args: args)
        with mock.patch.dict(sys.modules, {"mlflow": mlflow, "mlflow.entities": entities}):
            run = forward.MlflowRun("walk", "project", {"ppo.gamma": 0.99})
            run.log([metric("walk", "a", 5)[1]])
            run.finish(Path("policy.gif"))
        client = mlflow.MlflowClient.return_value
        self.assertEqual(client.log_batch.call_args_list[0].kwargs["params"], [("ppo.gamma", "0.99")])
        self.assertEqual(client.log_batch.call_args.kwargs["metrics"], [("a", 1.0, 12500, 5)])
        client.log_artifact.assert_called_once_with(run.id, "policy.gif", "video")
        client.set_terminated.assert_called_once_with(run.id)

    def test_a_folder_gives_the_whole_run_and_what_follows(self):
        def line(step):
            return json.dumps({"run": "walk", "tag": "a", "step": step, "value": 1.0, "time_unix_s": 12.5}) + "\n"

        with tempfile.TemporaryDirectory() as name:
            folder, logged, run = Path(name), [], RecordingRun()
            (folder / "config.toml").write_text("[ppo]\ngamma = 0.99\n")
            self.assertEqual(forward.config_of(folder), {"ppo.gamma": 0.99})
            self.assertEqual((forward.folder_of(name), forward.folder_of("walk")), (folder, None))
            metrics = folder / "metrics.jsonl"
            metrics.write_text(line(1) + line(2) + line(3)[:20])
            with open(folder / "lock.json", "w") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                self.assertTrue(forward.is_trained(folder))
                batches = forward.batches_of(folder, threading.Event(), poll_s=0.0)
                logged += [metric["step"] for metric in next(batches)]
                # A resume takes back two steps, and half a line.
                metrics.write_text(line(1))
                metrics.write_text(line(1) + line(2) + line(3))
            self.assertFalse(forward.is_trained(folder))
            logged += [metric["step"] for batch in batches for metric in batch]
            self.assertEqual(logged, [1, 2, 3])
            forward.forward_folder(folder, lambda _: run, lambda: "film.gif", threading.Event())
            self.assertEqual([step for _, step, _ in run.logged], [1, 2, 3])
            self.assertEqual(run.video, "film.gif")

    def test_missing_program_means_no_video(self):
        self.assertIsNone(forward.film("runs/walk-1", "/tmp", program="/no/such/treadmill"))


if __name__ == "__main__":
    unittest.main()
