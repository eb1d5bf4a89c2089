"""Forwards the metrics of a run to MLflow while it trains: forward_mlflow.py [ENDPOINT] [RUN] [--tracking-uri URI] [--tls DIR]

Every metric keeps its name, its environment step and its time. Ends with Ctrl-C, or after --idle-s seconds without a metric. For
Weights & Biases put `wandb.init(name=...)` and `wandb.log({tag: value}, step=step)` in the place of MLflow's client.
"""

import argparse
import json
import queue

import zenoh
from mlflow import MlflowClient
from mlflow.entities import Metric


def opened(endpoint, tls):
    """A session of an observer."""
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
    flags.add_argument("--tracking-uri", help="as in sqlite:///mlflow.db, or the address of a server")
    flags.add_argument("--experiment", default="treadmill")
    flags.add_argument("--idle-s", type=float, help="end when nothing came for so long")
    flags.add_argument("--tls", help="folder with ca.crt, observer.crt and observer.key")
    args, metrics = flags.parse_args(), queue.Queue()
    client = MlflowClient(args.tracking_uri)
    known = client.get_experiment_by_name(args.experiment)
    experiment = known.experiment_id if known else client.create_experiment(args.experiment)
    key = f"treadmill/{args.run}/metrics/**"
    with opened(args.endpoint, args.tls) as session:
        session.declare_subscriber(key, lambda sample: metrics.put(json.loads(sample.payload.to_string())))
        forward(metrics, args.idle_s, client, experiment)


def forward(metrics, idle_s, client, experiment):
    """Whatever waits is handed over in one call for each run."""
    runs = {}
    while batch := taken(metrics, idle_s):
        for name in {metric["run"] for metric in batch}:
            if name not in runs:
                runs[name] = client.create_run(experiment, run_name=name).info.run_id
            of_run = [metric for metric in batch if metric["run"] == name]
            told = [Metric(m["tag"], m["value"], int(m["time_unix_s"] * 1000), m["step"]) for m in of_run]
            client.log_batch(runs[name], metrics=told)
    for run in runs.values():
        client.set_terminated(run)


def taken(metrics, idle_s, most=1000):
    """All waiting metrics, at least one; none after a long silence or a request to stop."""
    try:
        batch = [metrics.get(timeout=idle_s)]
    except (queue.Empty, KeyboardInterrupt):
        return []
    while len(batch) < most and not metrics.empty():
        batch.append(metrics.get())
    return batch


if __name__ == "__main__":
    main()
