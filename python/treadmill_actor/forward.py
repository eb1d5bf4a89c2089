"""Forwards the metrics of runs to MLflow or Weights & Biases, and a video of the policy at the end.

    python -m treadmill_actor.forward mlflow runs/walk-1             # a run's folder on this machine
    python -m treadmill_actor.forward wandb walk --connect tls/HOST:7447 --tls certs

Keeps the name, environment step and time of each metric. A folder gives its whole run, over all resumes, with its configuration,
whether it has ended or is trained now; while a process trains it, what it writes follows. Then the best policy is filmed by
`treadmill eval`. From the bus come the metrics from now on, until the run's learner has been gone for ten seconds. Ctrl-C ends all
runs; a second one ends the process at once.
"""

import argparse
import fcntl
import importlib
import json
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
import time
import tomllib
from pathlib import Path

from .signals import request_stop

GONE_S = 10.0
"""Time without a learner after which a run has ended: a learner that restarts is back sooner."""
BATCH_MAX = 1000
"""Most metrics of one call; MLflow's limit."""
PARAMS_MAX = 100
"""Most parameters of one call; MLflow's limit."""
POLL_S = 1.0
"""Interval at which the files of a run that is trained are read."""


class MlflowRun:
    """Run of an MLflow experiment."""

    def __init__(self, name, project, config, tracking_uri=None):
        from mlflow import MlflowClient
        from mlflow.entities import Param

        self.client = MlflowClient(tracking_uri)
        known = self.client.get_experiment_by_name(project)
        experiment = known.experiment_id if known else self.client.create_experiment(project)
        self.id = self.client.create_run(experiment, run_name=name).info.run_id
        params = [Param(key, str(value)) for key, value in config.items()]
        for first in range(0, len(params), PARAMS_MAX):
            self.client.log_batch(self.id, params=params[first : first + PARAMS_MAX])

    def log(self, metrics):
        """Logs metrics."""
        from mlflow.entities import Metric

        points = [Metric(m["tag"], m["value"], int(m["time_unix_s"] * 1000), m["step"]) for m in metrics]
        self.client.log_batch(self.id, metrics=points)

    def finish(self, video):
        """Ends the run; `video` is a file or None."""
        if video:
            self.client.log_artifact(self.id, str(video), "video")
        self.client.set_terminated(self.id)


class WandbRun:
    """Run of a Weights & Biases project."""

    def __init__(self, name, project, config):
        import wandb

        self.wandb = wandb
        self.run = wandb.init(project=project, name=name, config=config, reinit="create_new")
        # Its own steps count calls.
        self.run.define_metric("*", step_metric="env_steps")

    def log(self, metrics):
        """Logs metrics, those of one environment step together."""
        for step in sorted({metric["step"] for metric in metrics}):
            self.run.log({"env_steps": step} | {m["tag"]: m["value"] for m in metrics if m["step"] == step})

    def finish(self, video):
        """Ends the run; `video` is a file or None."""
        if video:
            self.run.log({"video": self.wandb.Video(str(video), format=video.suffix[1:])})
        self.run.finish()


def film(folder, target, program="treadmill"):
    """Films one episode of the run in `folder`. Returns the file below `target`, or None with a message."""
    video = Path(target) / ("policy.mp4" if shutil.which("ffmpeg") else "policy.gif")
    command = [program, "eval", str(folder), "--episodes", "1", "--film", str(video)]
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        problem = done.stderr.strip() if done.returncode else None
    except OSError as error:
        problem = f"{error}; put `treadmill` on the PATH, or name it with --treadmill"
    if problem:
        print(f"no video of {folder}: {problem}", file=sys.stderr)
        return None
    return video


def take_batch(events, timeout_s):
    """Waits for an event and returns all that wait, at most BATCH_MAX; empty after the timeout."""
    try:
        batch = [events.get(timeout=timeout_s)]
    except queue.Empty:
        return []
    while len(batch) < BATCH_MAX and not events.empty():
        batch.append(events.get())
    return batch


def forward(events, open_run, stopping, gone_s=GONE_S):
    """Logs metrics until every run that began has ended, or until a request to stop.

    `events` holds ("metric", metric), ("begun", run) and ("gone", run). `open_run(name)` returns a sink.
    """
    sinks, gone_since = {}, {}
    try:
        while not stopping.is_set():
            batch = take_batch(events, 0.2)
            for kind, value in batch:
                if kind == "gone":
                    gone_since[value] = time.monotonic()
                elif kind == "begun":
                    gone_since.pop(value, None)
            metrics = [value for kind, value in batch if kind == "metric"]
            for name in dict.fromkeys(metric["run"] for metric in metrics):
                if name not in sinks:
                    sinks[name] = open_run(name)
                sinks[name].log([metric for metric in metrics if metric["run"] == name])
            ended = [name for name, since in gone_since.items() if time.monotonic() - since >= gone_s]
            for name in ended:
                del gone_since[name]
                if name in sinks:
                    sinks.pop(name).finish(None)
                    if not sinks:
                        return
    finally:
        for sink in sinks.values():
            sink.finish(None)


def is_trained(folder):
    """Returns whether a process has the lock of the run in `folder`."""
    try:
        with open(folder / "lock.json") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        pass
    return False


def batches_of(folder, stopping, poll_s=POLL_S):
    """Yields the metrics of the run in `folder` in order, until its end or a request to stop."""
    position, file = 0, folder / "metrics.jsonl"
    while True:
        # Asked before reading, so that the last lines of a process that ends now are read too.
        goes_on = is_trained(folder) and not stopping.is_set()
        if file.exists():
            with open(file, "rb") as lines:
                # A resume takes back what followed its checkpoint.
                position = min(position, file.stat().st_size)
                lines.seek(position)
                batch = []
                # The last line may be incomplete.
                while (line := lines.readline()).endswith(b"\n"):
                    position += len(line)
                    batch.append(json.loads(line))
                    if len(batch) == BATCH_MAX:
                        yield batch
                        batch = []
                if batch:
                    yield batch
        if not goes_on:
            return
        stopping.wait(poll_s)


def forward_folder(folder, open_run, make_video, stopping, poll_s=POLL_S):
    """Logs the whole run in `folder`."""
    sink = None
    try:
        for batch in batches_of(folder, stopping, poll_s):
            sink = sink or open_run(batch[0]["run"])
            sink.log(batch)
    finally:
        if sink:
            sink.finish(make_video())


def config_of(folder):
    """Returns the configuration of the run in `folder`, by `section.key`."""
    with open(folder / "config.toml", "rb") as file:
        sections = tomllib.load(file)
    return {f"{section}.{key}": value for section, keys in sections.items() for key, value in keys.items()}


def folder_of(run):
    """Returns the folder of a run that was named, here or below runs/, or None."""
    return next((path for path in (Path(run), Path("runs") / run) if (path / "config.toml").is_file()), None)


def main():
    """Runs the command line."""
    from . import bus

    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("to", choices=["mlflow", "wandb"])
    flags.add_argument("run", nargs="?", default="*", help="folder of a run, or its name on the bus; default all")
    flags.add_argument("--connect", action="append", help="endpoint of the learner or a router; default port 7447 on loopback")
    flags.add_argument("--tls", help="folder with ca.crt, observer.crt and observer.key")
    flags.add_argument("--insecure", action="store_true", help="allow plain tcp beyond loopback")
    flags.add_argument("--project", default="treadmill", help="project or experiment that the runs belong to")
    flags.add_argument("--tracking-uri", help="of MLflow, for example sqlite:///mlflow.db, or a server's address")
    flags.add_argument("--treadmill", default="treadmill", help="program that films the policy")
    args = flags.parse_args()
    events, stopping = queue.Queue(), threading.Event()
    request_stop(stopping)
    folder = None if args.connect else folder_of(args.run)
    config = config_of(folder) if folder else {}

    def open_run(name):
        print(f"forwarding run `{name}` to {args.to}", flush=True)
        if args.to == "wandb":
            return WandbRun(name, args.project, config)
        return MlflowRun(name, args.project, config, args.tracking_uri)

    try:
        importlib.import_module(args.to)
        if folder:
            with tempfile.TemporaryDirectory() as target:
                forward_folder(folder, open_run, lambda: film(folder, target, args.treadmill), stopping)
            return 0
        if "/" in args.run:
            raise ValueError(f"`{args.run}` is neither a run's folder with config.toml nor a run's name")
        run, connect = args.run, args.connect or [bus.default_endpoint(args.tls)]
        for endpoint in connect:
            bus.check_endpoint(endpoint, args.insecure, args.tls)
        session = bus.dialled(lambda: bus.observe(connect, args.tls, run, events), connect, stopping)
    except ImportError:
        print(f"error: {args.to} is not installed: pip install {args.to}", file=sys.stderr)
        return 2
    except (bus.BusError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2

    if session is None:
        return 0
    with session:
        forward(events, open_run, stopping)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
