#!/usr/bin/env python3
"""Measures the page in the browser: time to the first robot, time from a pose to its picture, bytes, and what it costs.

Usage: measure.py target/release/treadmill [--turns 3] [--csv FILE.csv]

Each turn trains `walk` three times for a while: without a page, with an unopened one, and with one that is open in a headless
Chromium (TREADMILL_CHROMIUM, or `chromium` on the PATH) which draws on a GPU only where there is one. A client that draws
nothing stands for a browser on another machine in the cost. Needs the PyPI packages playwright and websockets.
"""

import argparse
import asyncio
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import threading
import time

import websockets
from playwright.sync_api import sync_playwright

from experiments import report

POLICY = pathlib.Path(__file__).parents[2] / "docs" / "results" / "g1.safetensors"
STEPS = 600_000


class Training:
    """A run of `walk` with a page at `address`, or without one."""

    def __init__(self, binary, folder, flags):
        command = [binary, "train", "--preset", "walk", "--steps", str(STEPS), "--seed", "1", "--run-dir", str(folder)]
        self.begun_s = time.monotonic()
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL, "text": True}
        self.process = subprocess.Popen([*command, "--no-progress", "--json", *flags], **pipes)
        self.address = None
        if "--no-page" not in flags:
            line = next(line for line in self.process.stdout if line.startswith("  page "))
            self.address = re.search(r"http://\S+", line).group().rstrip("/")

    def steps_per_s(self):
        """Waits for the end and returns the environment steps per second."""
        summary = json.loads(self.process.stdout.read().splitlines()[-1])
        if self.process.wait() != 0:
            sys.exit("the training failed")
        return summary["env_steps_per_s"]


def browser(play):
    chromium = os.environ.get("TREADMILL_CHROMIUM") or shutil.which("chromium")
    flags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage"]
    return play.chromium.launch(executable_path=chromium, args=flags)


def wait_for(page, expression):
    """Polls, as the page's content policy forbids what Playwright would inject."""
    while not page.evaluate(expression):
        time.sleep(0.02)


def first_robot_s(binary, folder, play):
    """Returns the seconds from the start of `train` until a robot was drawn, in a browser that runs already."""
    with browser(play) as chromium:
        page = chromium.new_page(viewport={"width": 960, "height": 600})
        training = Training(binary, folder, ["--page-listen", "127.0.0.1:0"])
        page.goto(training.address)
        wait_for(page, "window.treadmill?.shown() !== undefined")
        seconds = time.monotonic() - training.begun_s
        training.process.terminate()
        training.process.wait()
    return seconds


def drawing(binary, policies, play):
    """Returns medians: from a pose to its picture (ms), and from a picture to the next (ms)."""
    command = [binary, "watch", *[str(POLICY)] * policies, "--page-listen", "127.0.0.1:0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as watching:
        address = re.search(r"http://\S+", watching.stdout.readline()).group()
        with browser(play) as chromium:
            page = chromium.new_page(viewport={"width": 960, "height": 600})
            page.goto(address)
            wait_for(page, "window.treadmill?.shown()?.shown_s > 20")
            times = [page.evaluate(f"window.treadmill.{kind}()") for kind in ("latencies", "frameTimes")]
        watching.terminate()
    return [statistics.median(one) for one in times]


async def receive(address, until):
    """Returns kB per second of frames that come from the page's socket, until `until` is set."""
    origin = address
    size, begun_s = 0, time.monotonic()
    async with websockets.connect(address.replace("http", "ws") + "/socket", origin=origin, max_size=None) as socket:
        while not until.is_set():
            try:
                message = await asyncio.wait_for(socket.recv(), 0.5)
            except (TimeoutError, websockets.ConnectionClosed):
                continue
            # Field 2 of ToPage is a frame.
            size += len(message) if message[0] >> 3 == 2 else 0
    return size / 1000 / (time.monotonic() - begun_s)


def with_client(binary, folder):
    """Trains while a client takes all frames. Returns steps per second and kB per second."""
    training, ended, rates = Training(binary, folder, ["--page-listen", "127.0.0.1:0"]), threading.Event(), []
    client = threading.Thread(target=lambda: rates.append(asyncio.run(receive(training.address, ended))))
    client.start()
    speed = training.steps_per_s()
    ended.set()
    client.join()
    return speed, rates[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory() as place, sync_playwright() as play:
        place = pathlib.Path(place)
        for turn in range(arguments.turns):
            folder = lambda kind: place / f"{kind}-{turn}"
            without = Training(arguments.binary, folder("without"), ["--no-page"]).steps_per_s()
            unopened = Training(arguments.binary, folder("unopened"), ["--page-listen", "127.0.0.1:0"]).steps_per_s()
            opened, kilobytes = with_client(arguments.binary, folder("opened"))
            first_s = first_robot_s(arguments.binary, folder("first"), play)
            age_ms, frame_ms = drawing(arguments.binary, 1, play)
            _, four_ms = drawing(arguments.binary, 4, play)
            figures = [without, unopened, opened, kilobytes, first_s, age_ms, frame_ms, four_ms]
            rows.append([str(turn + 1), *[f"{figure:.4g}" for figure in figures]])
            print(rows[-1], file=sys.stderr)
    header = ["turn", "steps/s without a page", "with one that is not open", "with an open one", "kB/s of its robot"]
    header += ["robot seen after (s)", "pose to picture (ms)", "picture to picture (ms)", "the same with four robots (ms)"]
    text = report.table(header, rows)
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
