"""Formats results as Markdown tables, and writes them as CSV files beside the scripts that measured them."""

import csv
import importlib.metadata
import json
import pathlib
import platform
import subprocess

PACKAGES = ("mujoco", "gymnasium", "numpy")
SOURCES = ("actor/humanoid/src", "actor/humanoid/assets")


def commit(sources=SOURCES):
    """Returns the commit of this repository; marks it if files in `sources` have changed since."""

    def git(*arguments):
        folder = pathlib.Path(__file__).resolve().parent.parent
        return subprocess.run(["git", *arguments], cwd=folder, capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", *sources)
    return git("rev-parse", "--short=7", "HEAD") + (" with changes" if changed else "")


def circumstances(packages=PACKAGES, sources=SOURCES):
    """Returns commit, machine and versions."""
    versions = {name: importlib.metadata.version(name) for name in packages}
    return {
        "commit": commit(sources),
        "cpu": cpu_model(),
        "python": platform.python_version(),
        **versions,
    }


def cpu_model():
    """Returns the processor's name."""
    with open("/proc/cpuinfo", encoding="utf-8") as lines:
        names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{names[0]}, {len(names)} cores" if names else platform.processor()


def made_by(made, packages=PACKAGES):
    """Formats the circumstances as one line."""
    keys = (*packages, "python")
    return f"Treadmill {made['commit']}; " + ", ".join(f"{key} {made[key]}" for key in keys) + f"; {made['cpu']}."


def append_row(path, columns, cells, sources):
    """Appends a row with commit and machine to a table, which begins with the names of its columns."""
    is_new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        if is_new:
            table.writerow([*columns, "commit", "machine"])
        table.writerow([*cells, commit(sources), cpu_model()])


def write_json(path, result):
    """Writes JSON with five significant digits, one entry per line."""

    def shorten(value):
        if isinstance(value, dict):
            return {key: shorten(entry) for key, entry in value.items()}
        if isinstance(value, (list, tuple)):
            return [shorten(entry) for entry in value]
        return float(f"{value:.5g}") if isinstance(value, float) else value

    path.write_text(json.dumps(shorten(result), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def tables(text):
    """Returns the tables of a Markdown text as (title, header, rows); the title is the heading before a table, or nothing."""
    found, title, lines = [], "", []
    for line in [*text.splitlines(), ""]:
        if line.startswith("#"):
            title = line.lstrip("# ")
        if line.startswith("|"):
            lines.append([cell.strip() for cell in line.strip("|").split("|")])
        elif lines:
            found.append((title, lines[0], lines[2:]))
            lines = []
    return found


def write_csv(path, text, commit, machine):
    """Writes the tables of a Markdown text. One table, or several with the same columns, become rows with these columns; others
    become a row for each cell. The last columns are the commit and the machine."""
    found = tables(text)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        if all(header == found[0][1] for _, header, _ in found):
            titles = len(found) > 1
            writer.writerow([*(["table"] if titles else []), *found[0][1], "commit", "machine"])
            for title, _, rows in found:
                writer.writerows([*([title] if titles else []), *row, commit, machine] for row in rows)
        else:
            writer.writerow(["table", "row", "column", "value", "commit", "machine"])
            for title, header, rows in found:
                for row in rows:
                    writer.writerows([title, row[0], *cell, commit, machine] for cell in zip(header[1:], row[1:], strict=True))


def by_step(folder):
    """Returns the metrics of a run folder: step → tag → value."""
    found = {}
    with open(folder / "metrics.jsonl", encoding="utf-8") as lines:
        for line in lines:
            metric = json.loads(line)
            found.setdefault(metric["step"], {})[metric["tag"]] = metric["value"]
    return found


def table(header, rows):
    """Formats strings as a Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def number(value, digits=2):
    """Formats a number with this many significant digits, without an exponent from 1e-4 on."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    if abs(value) < 1e-4:
        return f"{value:.{digits - 1}e}".replace("e-0", "e-")
    text = f"{float(f'{value:.{digits}g}'):.10f}".rstrip("0").rstrip(".")
    return text


def _pair(mean, high):
    return f"{number(mean)} / {number(high)}"


def _rollouts(title, result, before, key):
    header = ["", *_columns(result["times_s"])]
    rows = []
    for row in _with_before(result, before, key):
        angles = zip(row["angle_mean_rad"], row["angle_p95_rad"])
        heights = zip(row["height_mean_m"], row["height_p95_m"])
        rows.append([row["name"], *(_pair(*a) for a in angles), *(_pair(*h) for h in heights)])
    text = f"### {title}\n\n{result['cases']} cases; mean / 95th percentile of the error.\n\n" + table(header, rows)
    return text + "\n" + _ratios(result)


def _columns(times_s):
    return [*(f"joint angles (rad), {t:g} s" for t in times_s), *(f"torso height (m), {t:g} s" for t in times_s)]


def _ratios(result):
    rows = []
    for row in result["ratios"]:
        rows.append([row["name"], *(number(ratio) for ratio in (*row["angle_mean_rad"], *row["height_mean_m"]))])
    columns = [column.replace(" (rad)", "").replace(" (m)", "") for column in _columns(result["times_s"])]
    lead = "Treadmill's mean error, divided by that of MuJoCo's Euler integrator with the same steps:"
    return f"{lead}\n\n" + table(["", *columns], rows)


def _with_before(result, before, key):
    """Returns the rows, with the earlier version's default row inserted after the first one, which is the default."""
    rows = list(result["rows"])
    if before:
        old = before[key]["rows"][0]
        rows.insert(1, {**old, "name": _name_before(before)})
    return rows


def _name_before(before):
    return f"before: Treadmill {before['made']['commit']}, its defaults"


def _energy(result, before):
    header = ["", "energy without the centre of mass's (J): mean", "the same: maximum", "total energy (J): mean"]
    header.append("angular momentum: mean relative change")
    rows = []
    for row in _with_before(result, before, "energy"):
        columns = [row[name] for name in ("internal_mean_j", "internal_max_j", "total_mean_j", "angular_momentum_mean")]
        rows.append([row["name"], *(" · ".join(number(value) for value in column) for column in columns)])
    times = " · ".join(f"{time:g} s" for time in result["times_s"])
    start = number(result["internal_kinetic_start_j"], 3)
    return (
        f"### Energy of a passive body in flight\n\n{result['cases']} cases; change after {times}. At the start, the motion about "
        f"the centre of mass has {start} J on average.\n\n" + table(header, rows)
    )


def _mirror(result, before):
    rows = [[row["name"], row["what"], number(row["median_rad"]), number(row["max_rad"])] for row in result["rows"]]
    if before:
        old = [row for row in before["mirror"]["rows"] if row["name"].startswith("Treadmill")]
        name = _name_before(before)
        rows += [[name, row["what"], number(row["median_rad"]), number(row["max_rad"])] for row in old]
    header = ["", "", "median (rad)", "maximum (rad)"]
    return f"### Mirror symmetry\n\n{result['cases']} cases each.\n\n" + table(header, rows)


def _joints(result, before):
    header = ["", "limit overshoot (rad): 50 % · 99 % · 99.9 % · maximum"]
    rows = []
    for row in _with_before(result, before, "joints"):
        rows.append([row["name"], " · ".join(number(value) for value in row["overshoot_rad"])])
    return f"### Joint limits under full torques\n\n{result['steps']} control steps.\n\n" + table(header, rows)


def fidelity(result, before):
    """Formats the results of measure.py as Markdown."""
    titles = {
        "flight_free": "In flight, random actions, no joint limits",
        "flight_limits": "In flight, random actions",
        "drop_zero": "From the start of an episode, no action",
        "drop_random": "From the start of an episode, random actions",
    }
    parts = [made_by(result["made"])]
    parts += [_rollouts(title, result[key], before, key) for key, title in titles.items()]
    parts += [_energy(result["energy"], before), _mirror(result["mirror"], before), _joints(result["joints"], before)]
    return "\n\n".join(part.strip() for part in parts) + "\n"
