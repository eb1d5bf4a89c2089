"""Forwards the metrics of a run to MLflow while it trains: forward_mlflow.py [ENDPOINT] [RUN] [--tracking-uri URI] [--tls DIR]

Keeps each metric's name, environment step and time. Ends with Ctrl-C, or after --idle-s seconds without a metric. For Weights &
Biases, replace MLflow's client by `wandb.init(name=...)` and `wandb.log({tag: value}, step=step)`.
"""

import argparse
import json
import queue

import zenoh
from mlflow import MlflowClient
from mlflow.entities import Metric


def open_session(endpoint, tls):
    """Opens a session with the observer role."""
    config = zenoh.Config()
    files = {"root_ca_certificate": "ca.crt", "connect_certificate": "observer.crt", "connect_private_key": "observer.key"}
    encrypted = {"enable_mtls": True, **{key: f"{tls}/{file}" for key, file in files.items()}} if tls else {}
    for key, value in [("mode", "client"), ("connect/endpoints", [endpoint]), ("transport/link/tls", encrypted)]:
        config.insert_json5(key, json.dumps(value))
    return zenoh.open(config)


def main():
    flags = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    flags.add_argument("endpoint", nargs="?", default="tcp/127.0.0.1:7447")
    flags.add_argument("run", nargs="?", default="*")
    flags.add_argument("--tracking-uri", help="for example sqlite:///mlflow.db, or a server's address")
    flags.add_argument("--experiment", default="treadmill")
    flags.add_argument("--idle-s", type=float, help="end after this many seconds without a metric")
    flags.add_argument("--tls", help="folder with ca.crt, observer.crt and observer.key")
    args, metrics = flags.parse_args(), queue.Queue()
    client = MlflowClient(args.tracking_uri)
    known = client.get_experiment_by_name(args.experiment)
    experiment = known.experiment_id if known else client.create_experiment(args.experiment)
    key = f"treadmill/{args.run}/metrics/**"
    with open_session(args.endpoint, args.tls) as session:
        session.declare_subscriber(key, lambda sample: metrics.put(json.loads(sample.payload.to_string())))
        forward(metrics, args.idle_s, client, experiment)


def forward(metrics, idle_s, client, experiment):
    """Logs waiting metrics, one call per run."""
    runs = {}
    while batch := take_batch(metrics, idle_s):
        for name in {metric["run"] for metric in batch}:
            if name not in runs:
                runs[name] = client.create_run(experiment, run_name=name).info.run_id
            of_run = [metric for metric in batch if metric["run"] == name]
            points = [Metric(m["tag"], m["value"], int(m["time_unix_s"] * 1000), m["step"]) for m in of_run]
            client.log_batch(runs[name], metrics=points)
    for run in runs.values():
        client.set_terminated(run)


def take_batch(metrics, idle_s, limit=1000):
    """Waits for a metric and returns all waiting ones; empty after `idle_s` or Ctrl-C."""
    try:
        batch = [metrics.get(timeout=idle_s)]
    except (queue.Empty, KeyboardInterrupt):
        return []
    while len(batch) < limit and not metrics.empty():
        batch.append(metrics.get())
    return batch


if __name__ == "__main__":
    main()
