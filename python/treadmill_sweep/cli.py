"""Command line of `python -m treadmill_sweep`."""

import argparse
import fcntl
import itertools
import json
import os
import shlex
import signal
import sys
from pathlib import Path

try:
    import optuna
except ImportError:
    raise SystemExit("error: Optuna is missing; install it: pip install 'optuna>=5,<6'") from None

from . import report, search
from .sweep import Sweep

PLAN = "optuna.json"
USAGE = """python -m treadmill_sweep search.toml [FLAGS], or --resume DIR

Searches keys of `treadmill train` with Optuna. Flags of `treadmill sweep` and `treadmill train` hold for every trial: --steps,
--preset, --set, and --seeds and --seed, which is also that of the sampler.
To watch it: pip install optuna-dashboard; optuna-dashboard sqlite:///runs/sweep-1/study.db"""


def parser():
    """Returns the argument parser."""
    flags = argparse.ArgumentParser("python -m treadmill_sweep", usage=USAGE, allow_abbrev=False)
    flags.add_argument("--trials", type=int, metavar="N", help="settings to try; default 8. With --resume, more than before")
    flags.add_argument("--parallel", type=int, metavar="N", help="runs at once; default one per core")
    flags.add_argument("--run-dir", type=Path, metavar="DIR", help="folder of the sweep; default runs/sweep-N, the first free N")
    flags.add_argument("--storage", metavar="URL", help="database of Optuna; default sqlite:///DIR/study.db")
    flags.add_argument("--resume", type=Path, metavar="DIR", help="go on with this sweep; finished trials are kept")
    flags.add_argument("--treadmill", metavar="PATH", help="binary; default: the one on PATH")
    flags.add_argument("--json", action="store_true", help="print one JSON object as the last line of standard output")
    return flags


def opened(args, file, flags):
    """Returns folder and plan of a sweep."""
    numbers = {name: value for name in ("trials", "parallel") if (value := getattr(args, name)) is not None}
    for name, value in numbers.items():
        if value < 1:
            raise search.SweepError(f"--{name} is {value}; allowed: a whole number from 1 on")
    if args.resume:
        if file or flags or args.run_dir or args.storage:
            raise search.SweepError("--resume: a sweep keeps its flags; give only --trials, --parallel, --treadmill and --json")
        if not (args.resume / PLAN).is_file():
            raise search.SweepError(f"there is no sweep at `{args.resume}`; name the folder that has the file {PLAN}")
        return args.resume.resolve(), json.loads((args.resume / PLAN).read_text()) | numbers
    try:
        text = Path(file or "").read_text()
    except (OSError, UnicodeError) as why:
        raise search.SweepError(f"cannot read the search file `{file}`, the first argument: {why}") from None
    flags += [f"--{name}={value}" for name, value in numbers.items()]
    numbered = (Path(f"runs/sweep-{number}") for number in itertools.count(1))
    root = (args.run_dir or next(root for root in numbered if not root.exists())).resolve()
    plan = search.read(file, text, args.treadmill or "treadmill", [*flags, f"--run-dir={root}"])
    if any((root / name).exists() for name in (PLAN, "sweep.json", "trial-1", "checkpoints")):
        raise search.SweepError(f"`{root}` already holds a sweep or a run; go on with --resume, or choose another --run-dir")
    root.mkdir(parents=True, exist_ok=True)
    return root, plan | {"name": root.name, "storage": args.storage, "treadmill": "treadmill"}


def begun(args, root, plan, lock):
    """Returns a sweep that no other process runs."""
    url = plan["storage"] or f"sqlite:///{root}/study.db"
    if args.treadmill:
        plan["treadmill"] = os.path.abspath(args.treadmill) if "/" in args.treadmill else args.treadmill
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        study = search.study(plan, url, not args.resume)
    except BlockingIOError:
        raise search.SweepError(f"`{root}` is in use by another sweep; stop that first") from None
    except Exception as why:  # noqa: BLE001: each database has errors of its own
        raise search.SweepError(f"the study `{plan['name']}` cannot be opened at `{url}`: {why}") from None
    new = root / f"{PLAN}.new"
    new.write_text(json.dumps(plan, indent=2))
    new.replace(root / PLAN)
    return Sweep(root, plan, study)


def main(arguments=None):
    """Runs a sweep. Returns the exit code: 1 if it failed, 2 for wrong usage."""
    words = [*(sys.argv[1:] if arguments is None else arguments)]
    file = words.pop(0) if words and not words[0].startswith("-") else None
    args, flags = parser().parse_known_args(words)
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    try:
        root, plan = opened(args, file, flags)
        with open(root / "sweep.lock", "w") as lock:
            sweep = begun(args, root, plan, lock)
            for number in (signal.SIGINT, signal.SIGTERM):
                signal.signal(number, sweep.interrupt)
            print(f"{root}: {plan['trials']} trials; the output of their runs is in {root}/trial-N.log", flush=True)
            left = sweep.run(report.ended)
        if sweep.stops:
            print(f"stopped; go on with: python -m treadmill_sweep --resume {shlex.quote(str(root))}")
            return 0
        if left:
            raise search.SweepError(f"the disk of `{root}` is full, so no trial begins; free some space, then use --resume", 1)
        report.end(sweep, args.json)
    except search.SweepError as why:
        print(f"error: {why.args[0]}", file=sys.stderr)
        return [*why.args, 2][1]
    except (optuna.exceptions.StorageInternalError, OSError) as why:
        print(f"error: {why}; the sweep goes on with --resume", file=sys.stderr)
        return 1
    return 0
