"""Results of a sweep: a line for each trial, a table, the importance of keys, `sweep.csv`, and `sweep.png`."""

import csv
import json
import os
import statistics
import subprocess
import warnings

from optuna.importance import get_param_importances

from .progress import COLUMNS
from .search import SweepError

WORDS = ("complete", "pruned", "not reached", "failed")


def runs(trial):
    """Returns the results of a trial's runs by name."""
    return {name: row for name, row in trial.user_attrs.items() if name.startswith("trial-")}


def shown(value):
    """Returns a number, a word or the keys of a trial as text."""
    if isinstance(value, dict):
        return ", ".join(f"{key} = {shown(value)}" for key, value in value.items())
    return f"{value:.6g}" if isinstance(value, float) else "–" if value is None else str(value)


def ended(sweep, trial):
    """Prints the line of a trial that has ended, and writes `sweep.csv`."""
    rows, word = runs(trial), trial.user_attrs["state"]
    code = next((f" with exit code {row['exit']}, see {name}.log" for name, row in rows.items() if row["exit"]), "")
    value, seconds = trial.value if word == "complete" else None, max([0.0, *(row["wall_s"] or 0.0 for row in rows.values())])
    print(f"{', '.join(rows)}: {word}{code}, {shown(value)}, {shown(trial.params)}, {seconds:.0f} s", flush=True)
    path, names = f"{sweep.root}/sweep.csv", ["trial", "setting", "seed", "exit", "env_steps", "wall_s", "goal"]
    with open(f"{path}.new", "w", newline="") as file:
        table = csv.DictWriter(file, dict.fromkeys([*names, *COLUMNS, *sweep.plan["keys"], "state"]), lineterminator="\n")
        table.writeheader()
        for trial in sweep.trials():
            own = trial.params | {"setting": trial.number + 1, "state": trial.user_attrs.get("state", "running")}
            table.writerows({"trial": name.removeprefix("trial-")} | row | own for name, row in runs(trial).items())
    os.replace(f"{path}.new", path)


def draw(sweep):
    """Lets the binary draw `sweep.png`. Returns why it is missing, if so."""
    drawn, seeds, trials = [], sweep.plan["seeds"], sweep.trials()
    for run in range(len(trials) * seeds):
        trial = trials[run // seeds]
        keys = [[key, shown(value)] for key, value in trial.params.items()]
        code = runs(trial).get(f"trial-{run + 1}", {}).get("exit")
        setting = {"setting": trial.number + 1, "keys": keys, "parent": None}
        drawn.append({"seed": sweep.plan["seed"] + run % seeds, "exit": code} | setting)
    path = sweep.root / "trials.json"
    path.write_text(json.dumps(sweep.plan | {"trials": drawn}))
    command = [sweep.plan["treadmill"], "sweep", "--draw", path]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as why:
        return str(why)
    return done.returncode and (done.stderr.removeprefix("error: ").strip() or f"exit code {done.returncode}")


def end(sweep, as_json):
    """Prints the trials, the best first, and the importance of each key."""
    states = [trial.user_attrs.get("state") for trial in sweep.trials()]
    best = [trial for trial, state in zip(sweep.trials(), states) if state == "complete"]
    best.sort(key=lambda trial: trial.value, reverse=sweep.goal.direction == "maximize")
    settings, importance = [], {}
    print(f"\nGoal: {sweep.goal.text}\n  setting        mean   deviation  keys")
    for trial in best:
        goals = [row["goal"] for row in runs(trial).values()]
        deviation = statistics.stdev(goals) if len(goals) > 1 else None
        setting = {"setting": trial.number + 1, "keys": trial.params, "trials": [*runs(trial)], "mean": trial.value}
        settings.append(setting | {"deviation": deviation})
        print(f"{trial.number + 1:>9}  {shown(trial.value):>10}  {shown(deviation):>10}  {shown(trial.params)}")
    if len(best) > 1:
        print(f"\nImportance of each key by PED-ANOVA, from {len(best)} complete trials:")
        # Optuna warns of few trials, whose number is in the line above.
        with warnings.catch_warnings(action="ignore"):
            importance = get_param_importances(sweep.study)
        print("".join(f"  {share:>6.1%}  {key}\n" for key, share in importance.items()))
    why = draw(sweep)
    print(f"Written: {sweep.root}/sweep.csv" + (f"; the picture is missing: {why}" if why else f", {sweep.root}/sweep.png"))
    found = {"sweep": str(sweep.root), "goal": sweep.goal.text, "trials": len(states)}
    found |= {word: states.count(word) for word in WORDS}
    if as_json:
        print(json.dumps(found | {"best": [*runs(best[0])][0] if best else None, "settings": settings, "importance": importance}))
    if found["failed"] == found["trials"]:
        raise SweepError(f"all trials failed; `{sweep.root}/trial-1.log` has the output of the first", 1)
