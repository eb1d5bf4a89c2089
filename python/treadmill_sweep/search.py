"""Search file: what it says, and what Optuna makes of it."""

import importlib.util
import json
import os
import re
import subprocess
import tempfile
import tomllib
from pathlib import Path

from optuna import create_study, pruners, samplers, storages

from .progress import Goal

STRATEGIES = {"tpe": samplers.TPESampler, "cmaes": samplers.CmaEsSampler, "random": samplers.RandomSampler}
PRUNERS = {"none": pruners.NopPruner, "median": pruners.MedianPruner, "hyperband": pruners.HyperbandPruner}
#: Pruners wait for this part of the steps, before which curves say little. Hyperband then has three brackets.
PRUNES_FROM = 9


class SweepError(Exception):
    """Wrong usage, with its remedy, or a failure with the exit code 1."""


def read(name, text, treadmill, flags):
    """Returns the plan of a sweep. The binary checks the file and the flags as for its own sweeps, and fills in defaults."""
    try:
        entries = {"strategy": "tpe", "pruner": "none"} | tomllib.loads(text)
    except tomllib.TOMLDecodeError as why:
        raise SweepError(f"`{name}` is not valid TOML: {why}") from None
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "search.toml")
        # Lines stay where they are, because errors name them.
        file.write_text(re.sub(r"(?m)^[ \t\"']*(strategy|pruner)[\"']?[ \t]*=.*$", "", text))
        try:
            done = subprocess.run([treadmill, "sweep", file, *flags, "--plan"], capture_output=True, text=True, timeout=60)
        except (OSError, subprocess.TimeoutExpired) as why:
            raise SweepError(f"`{treadmill}` cannot be started ({why}); give its path with --treadmill") from None
    if done.returncode:
        raise SweepError(done.stderr.removeprefix("error: ").strip().replace(str(file), name))
    plan = json.loads(done.stdout)
    if entries["strategy"] in ("grid", "seeds", "population"):
        raise SweepError(f"`{name}`: `strategy` is \"{entries['strategy']}\"; the binary does this: treadmill sweep {name}")
    for entry, allowed in (("strategy", STRATEGIES), ("pruner", PRUNERS)):
        if entries[entry] not in [*allowed]:
            words = ", ".join(map(json.dumps, allowed))
            raise SweepError(f"`{name}`: `{entry}` is {json.dumps(entries[entry])}; allowed: {words}")
        plan[entry] = entries[entry]
    if plan["strategy"] == "cmaes" and not importlib.util.find_spec("cmaes"):
        raise SweepError(f'`{name}`: `strategy` "cmaes" needs another package: pip install cmaes')
    runs, settings, cores = len(plan["trials"]), plan["trials"][-1]["setting"], len(os.sched_getaffinity(0))
    has_own = plan["parallel"] > 1 and not plan["deterministic"] and not plan["connect"]
    if has_own and not any(flag.startswith("--actors") for flag in plan["flags"]):
        plan["flags"].append(f"--actors={max(1, cores // plan['parallel'])}")
    return plan | {"trials": settings, "seeds": runs // settings, "keys": dict(ranges("", entries["keys"]))}


def ranges(section, entries):
    """Returns each key with kind and values of its range; keys have a section."""
    for name, value in entries.items():
        if "." in section + name:
            yield section + name, next(pair for pair in value.items() if pair[0] != "points")
        else:
            yield from ranges(f"{section}{name}.", value)


def propose(trial, keys):
    """Lets Optuna propose the values of a trial, in TOML notation; those of one that has begun stay."""
    for key, (kind, given) in keys.items():
        if kind == "choices":
            # Lists are no values of Optuna.
            yield key, trial.suggest_categorical(key, [json.dumps(choice) for choice in given])
        elif kind == "integers":
            yield key, trial.suggest_int(key, *given)
        else:
            yield key, trial.suggest_float(key, *given, log=kind == "log_uniform")


def study(plan, url, is_new):
    """Creates or opens the study of a sweep."""
    # Readers such as a dashboard lock a file for a moment.
    options = {"connect_args": {"timeout": 60}} if url.startswith("sqlite") else {}
    place = {"storage": storages.RDBStorage(url, options), "study_name": plan["name"], "direction": Goal(plan["goal"]).direction}
    begun = len(create_study(**place, load_if_exists=not is_new).get_trials(deepcopy=False))
    # After a resume, the same seed would draw the first settings again.
    sampler = STRATEGIES[plan["strategy"]](seed=(plan["seed"] + begun) % 2**32)
    least, most = max(1, plan["steps"] // PRUNES_FROM), plan["steps"]
    limits = {"none": {}, "median": {"n_warmup_steps": least}, "hyperband": {"min_resource": least, "max_resource": most}}
    pruner = PRUNERS[plan["pruner"]](**limits[plan["pruner"]])
    return create_study(**place, load_if_exists=True, sampler=sampler, pruner=pruner)
