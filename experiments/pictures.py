"""Draws the pictures of docs/results from the CSV files beside the scripts.

Needs: pip install matplotlib
Usage: python3 -m experiments.pictures
"""

import csv
import pathlib
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
PICTURES = HERE.parent / "docs/results"
BLUE, GREY = "#2f6fb0", "#9aa4ae"


def rows(name):
    with (HERE / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def first_number(text):
    return float(text.replace(",", "").replace("%", "").replace("s", "").split()[0])


def save(figure, name):
    figure.tight_layout()
    figure.savefig(PICTURES / name, dpi=80)


def learning():
    """Evaluations over wall time, three seeds of each build."""
    figure, both = plt.subplots(1, 2, figsize=(9, 3.4))
    shown = (("walk", "distance (m)", "metres in 15 s"), ("g1", "return", "return of 20 s"))
    for axes, (preset, value, label) in zip(both, shown):
        runs = {}
        for row in rows("learning/curves.csv"):
            if row["preset"] == preset:
                runs.setdefault((row["commit"], row["seed"]), []).append((float(row["seconds"]), float(row[value])))
        commits = list(dict.fromkeys(commit for commit, _ in runs))
        for (commit, _), points in runs.items():
            colour = GREY if commit == commits[0] else BLUE
            axes.plot(*zip(*points), color=colour, linewidth=1.2, label=f"commit {commit}")
        axes.set(title=preset, xlabel="seconds from the start of `train`", ylabel=label, xlim=0, ylim=0)
        handles, labels = axes.get_legend_handles_labels()
        axes.legend(*zip(*{label: (handle, label) for handle, label in zip(handles, labels)}.values()))
    save(figure, "curves.png")


def speed():
    """Ratios of Treadmill's speed to its peers'."""
    shown = [row for row in rows("fidelity/speed.csv") if float(row["ratio"]) > 1.9 and "Rapier" not in row["compared with"]]
    shown.sort(key=lambda row: float(row["ratio"]))
    names = [f"{row['Treadmill'].split(', `')[0]}\n÷ {row['compared with']}" for row in shown]
    figure, axes = plt.subplots(figsize=(9, 4.6))
    bars = axes.barh(names, [float(row["ratio"]) for row in shown], color=BLUE)
    axes.bar_label(bars, fmt="%.3g", padding=3)
    axes.tick_params(axis="y", labelsize=8)
    axes.set(xlabel="steps per second, times those of the peer", xlim=(0, 68))
    save(figure, "speed.png")


def scale():
    """Steps per second by the number of actor processes, and bytes accepted by the number of actors on one bus."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    by_flags = {row["flags of `train`"]: first_number(row["steps/s"].split(", ")[0]) for row in rows("scale/cores.csv")}
    actors = {1: "`--actors 1`", 2: "`--actors 2`", 4: "`--actors 4`", 8: "`--actors 8`", 16: "– (16 actors, 16 threads)"}
    left.plot(list(actors), [by_flags[flags] for flags in actors.values()], "o-", color=BLUE)
    left.set(xlabel="actor processes on 16 cores", ylabel="trained steps per second", ylim=0)
    for transport, colour in (("TCP", BLUE), ("mutual TLS", GREY)):
        points = [row for row in rows("scale/bus.csv") if row["transport"] == transport]
        values = [first_number(row["accepted, MB/s"]) for row in points]
        right.plot([int(row["actors"]) for row in points], values, "o-", color=colour, label=transport)
    right.set(xlabel="actors on one bus, two cores", ylabel="accepted MB per second", ylim=0)
    right.legend()
    save(figure, "scale.png")


def faults():
    """Time until training has recovered from each fault."""
    shown = [row for row in rows("faults/suite.csv") if row["recovered after"] not in ("–", "")]
    shown.sort(key=lambda row: first_number(row["recovered after"]))
    figure, axes = plt.subplots(figsize=(9, 6))
    names = [textwrap.fill(row["fault"].split(" (")[0], 58) for row in shown]
    bars = axes.barh(names, [first_number(row["recovered after"]) for row in shown], color=BLUE)
    axes.bar_label(bars, fmt="%.1f s", padding=3)
    axes.tick_params(axis="y", labelsize=8)
    axes.set(xlabel="seconds from the repair until training has recovered")
    save(figure, "faults.png")


if __name__ == "__main__":
    learning()
    speed()
    scale()
    faults()
