"""Installs the packages that Treadmill is compared with into a virtual environment, and runs a script there."""

import os
import pathlib
import subprocess
import sys
import venv

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]
FOLDER = REPOSITORY / "target/peers"
SIMULATORS = ["numpy", "mujoco", "gymnasium[mujoco]", "envpool"]
TRAINERS = ["stable-baselines3"]
# PyTorch without several gigabytes for GPUs; where this index is out of reach, pip takes the usual one.
CPU_ONLY = ["--retries", "1", "--index-url", "https://download.pytorch.org/whl/cpu"]


def enter(folder=FOLDER, training=False):
    """Restarts the script in a virtual environment that has the peers. Creates the environment if needed.

    Returns at once in the restarted script."""
    folder = pathlib.Path(folder).absolute()
    if pathlib.Path(sys.prefix).resolve() == folder.resolve():
        return
    python = folder / "bin/python"
    if not python.exists():
        print(f"creating {folder}", file=sys.stderr)
        venv.create(folder, with_pip=True)
    pip = [python, "-m", "pip", "install", "--quiet"]
    for wanted in [SIMULATORS, *([["torch"], TRAINERS] if training else [])]:
        done = folder / f"installed-{wanted[0]}"
        if done.exists():
            continue
        print(f"installing {' '.join(wanted)}", file=sys.stderr)
        is_small = wanted == ["torch"] and subprocess.run([*pip, *CPU_ONLY, *wanted]).returncode == 0
        if not is_small:
            subprocess.run([*pip, *wanted], check=True)
        done.touch()
    module = sys.modules["__main__"].__spec__.name
    os.execv(python, [str(python), "-m", module, *sys.argv[1:]])
