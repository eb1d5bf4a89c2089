"""Formats the results of the suite as a table."""

import json

from experiments.faults.fleet import FRAGMENT
from experiments.faults.injections import FAULTS


def curve(fleet):
    """Returns (environment steps, mean training return) of each update."""
    points = []
    with (fleet.run / "metrics.jsonl").open(encoding="utf-8") as lines:
        for line in lines:
            if '"rollout/ep_rew_mean"' in line:
                metric = json.loads(line)
                points.append((metric["step"], metric["value"]))
    return points


def at_steps(points, steps):
    return next((value for step, value in reversed(points) if step <= steps), None)


def as_row(row, baseline):
    def time_of(value):
        return "–" if value is None else f"{value:.1f} s"

    account = row["account"]
    lost = account["lost"] + account["lost_with_process"]
    returned = ""
    if baseline and row["curve"]:
        steps = min(row["curve"][-1][0], baseline[-1][0])
        returned = f"{at_steps(row['curve'], steps):.0f} / {at_steps(baseline, steps):.0f}"
    repeated = "" if row["updates_repeated"] is None else f"; updates repeated: {row['updates_repeated']}"
    cells = [
        row["title"], time_of(row["detected"]), time_of(row["recovered"]), str(lost * FRAGMENT),
        str(account["twice"] * FRAGMENT) + repeated, f"{account['dropped']} / {account['sent_again']}",
        f"{100 * row['during']:.0f} % / {100 * row['after']:.0f} %", returned,
    ]  # fmt: skip
    return "| " + " | ".join(cells) + " |"


def results(folder):
    """Returns the table's row of each fault that has results, by name."""
    files = {name: folder / f"{name}.json" for name in FAULTS}
    rows = {name: json.loads(file.read_text(encoding="utf-8")) for name, file in files.items() if file.exists()}
    baseline = rows["undisturbed"]["curve"] if "undisturbed" in rows else None
    return {name: as_row(row, baseline) for name, row in rows.items()}


HEAD = """\
| fault | detected after | recovered after | env steps lost | trained twice | fragments dropped by rule / resent | steps/s during \
/ after, relative to before | return / undisturbed |
|---|---|---|---|---|---|---|---|
"""
