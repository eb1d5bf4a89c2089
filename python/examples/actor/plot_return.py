"""Plots the mean return of a run while it trains: plot_return.py [--connect ENDPOINT] [--run NAME] [--png FILE] [--tls DIR]"""
import argparse, json, time  # noqa: E401
import matplotlib.pyplot as plt
import zenoh
flags = argparse.ArgumentParser()
flags.add_argument("--connect", action="append", metavar="ENDPOINT", help="default: port 7447 on loopback")
flags.add_argument("--run", default="*", metavar="NAME")
flags.add_argument("--png", help="write an image every second instead of opening a window")
flags.add_argument("--tls", help="folder with ca.crt, observer.crt and observer.key")
args, points, config = flags.parse_args(), [], zenoh.Config()
default = ("tls" if args.tls else "tcp") + "/127.0.0.1:7447"
files = {"root_ca_certificate": "ca.crt", "connect_certificate": "observer.crt", "connect_private_key": "observer.key"}
tls = {"enable_mtls": True, **{key: f"{args.tls}/{file}" for key, file in files.items()}} if args.tls else {}
for key, value in [("mode", "client"), ("connect/endpoints", args.connect or [default]), ("transport/link/tls", tls)]:
    config.insert_json5(key, json.dumps(value))
with zenoh.open(config) as session:
    key = f"treadmill/{args.run}/metrics/rollout/ep_rew_mean"
    session.declare_subscriber(key, lambda sample: points.append(json.loads(sample.payload.to_string())))
    while True:
        plt.cla()
        plt.gca().set(xlabel="environment steps", ylabel="mean return", title=key)
        plt.plot([point["step"] for point in points], [point["value"] for point in points])
        (plt.savefig(args.png), time.sleep(1)) if args.png else plt.pause(1)
