"""Measures what a learner sends per policy version while its actors are behind routers.

Needs: cargo build --release; Linux with `ss`.

Usage: routers.py [BINARY] [--routers 10] [--actors 10] [--versions 8]

Starts the learner and the played actors of `treadmill-bench bus`, and routers between them. The policy has one megabyte. Prints the
bytes on the learner's connections from the announcement until every actor has the version, and the time until the last one has it.
"""

import argparse
import json
import pathlib
import re
import socket
import statistics
import subprocess
import time


def free_endpoint():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{listener.getsockname()[1]}"


class Process:
    """A process that answers one JSON object for a line."""

    def __init__(self, *command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def send(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def receive(self):
        return self.process.stdout.readline()

    def end(self):
        self.process.kill()
        self.process.wait()


def sent_bytes(endpoint):
    """Returns the bytes sent so far on all connections of a listening endpoint."""
    port = endpoint.rpartition(":")[2]
    sockets = subprocess.run(["ss", "-tinH", f"sport = :{port}"], capture_output=True, text=True, check=True).stdout
    return sum(map(int, re.findall(r"bytes_sent:(\d+)", sockets)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?", default="target/release/treadmill")
    parser.add_argument("--routers", type=int, default=10)
    parser.add_argument("--actors", type=int, default=10, help="actors behind each router")
    parser.add_argument("--versions", type=int, default=8)
    options = parser.parse_args()
    bench = pathlib.Path(options.binary).with_name("treadmill-bench")
    learner = Process(bench, "bus-host", "--listen", "tcp/127.0.0.1:0")
    endpoint = json.loads(learner.receive())["endpoint"]
    processes, loads = [learner], []
    try:
        for number in range(options.routers):
            at = free_endpoint()
            processes.append(Process(options.binary, "router", "--listen", at, "--connect", endpoint))
            processes[-1].receive()
            flags = ["--first", number * options.actors, "--actors", options.actors, "--in-flight", 1]
            flags += ["--fragment-bytes", 20_000, "--pause-ms", 100, "--precision", "f32"]
            loads.append(Process(bench, "bus-load", "--connect", at, *map(str, flags)))
            processes.append(loads[-1])
        for load in loads:
            load.receive()
        megabytes, last_ms = [], []
        for version in range(1, options.versions + 1):
            for load in loads:
                load.send(f"expect {version}")
            before = sent_bytes(endpoint)
            learner.send(f"publish {version}")
            published_s = json.loads(learner.receive())["time_unix_s"]
            times = [when for load in loads for when in json.loads(load.receive())["times_unix_s"]]
            # Time for the last acknowledgements.
            time.sleep(0.3)
            megabytes.append((sent_bytes(endpoint) - before) / 1e6)
            last_ms.append((max(times) - published_s) * 1e3)
            print(f"version {version}: {len(times)} actors, {megabytes[-1]:.2f} MB, the last after {last_ms[-1]:.0f} ms", flush=True)
        print(f"medians: {statistics.median(megabytes):.2f} MB, {statistics.median(last_ms):.0f} ms")
    finally:
        for process in reversed(processes):
            process.end()


if __name__ == "__main__":
    main()
