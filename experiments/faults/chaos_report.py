"""Result of a chaos run: what was lost or repeated, how long each recovery took, and what grew."""

import collections
import json
import statistics

from experiments.faults.chaos_faults import ENDS_PROCESSES
from experiments.faults.chaos_fleet import FRAGMENT, LEARNERS, NAMES
from experiments.faults.soak import slope

# An update may be on its way to the store when a fault begins.
SETTLED_S = 0.3
SAMPLES_MIN, SPAN_MIN_H = 5, 0.1
LINE_MAX = 90


def result_of(fleet, chaos, begun, ended):
    """Returns the measurements of a run, with the list of failures."""
    manifests = [one for one in fleet.manifests if one.get("epoch")]
    terms = terms_of(manifests)
    logged = {name: logged_updates(fleet.disk(name) / "run" / "metrics.jsonl") for name in LEARNERS}
    takeovers = [takeover(fleet, before, after, logged) for before, after in zip(terms, terms[1:], strict=False)]
    for record in chaos.records:
        record["is_leader_fault"] = record["resolved"] == record["leader"] and record["kind"] != "clock"
        record["progress_after_s"] = progress_after(record, manifests)
    repeats = repeated(terms, logged)
    for each, count in zip(takeovers, repeats, strict=True):
        each["updates_repeated"] = count
    account = fleet.account()
    result = {"takeovers": len(takeovers), "takeover_list": takeovers, "faults": chaos.records, "account": account}
    result["env_steps_lost"], result["env_steps_twice"] = account["lost"] * FRAGMENT, account["twice"] * FRAGMENT
    result["longest_pause_s"] = longest_pause(manifests, begun, ended)
    result["observers"] = observed(fleet.folder)
    result["growth"] = growth(chaos.samples)
    result["injected"] = dict(collections.Counter(record["kind"] for record in chaos.records if record["seen"]))
    result["not_injected"] = [record for record in chaos.records if not record["seen"]]
    ends = collections.Counter(unexpected_end(fleet, end) for end in fleet.ends if not end["by_fault"])
    result["unexpected_ends"] = [{"count": count, "end": end} for end, count in ends.most_common()]
    result["restarts"], result["events"] = len(fleet.ends), fleet.events
    result["samples"] = chaos.samples
    result["panics"] = [str(each.err) for each in fleet.processes if b"panicked" in each.err.read_bytes()]
    return result


def terms_of(manifests):
    """Returns first and last manifest of each learner's term."""
    terms = []
    for one in manifests:
        if terms and terms[-1][1]["writer"] == one["writer"]:
            terms[-1] = (terms[-1][0], one)
        else:
            terms.append((one, one))
    return terms


def logged_updates(file):
    """Returns time, environment steps and number of each update in a metrics.jsonl."""
    found = []
    if file.exists():
        with file.open(encoding="utf-8", errors="replace") as lines:
            for line in lines:
                if '"time/iterations"' in line:
                    try:
                        metric = json.loads(line)
                    except ValueError:
                        continue
                    found.append((metric["time_unix_s"], metric["step"], int(metric["value"])))
    return found


def takeover(fleet, before, after, logged):
    """Compares the last manifest of a term with the next term's log."""
    last, first = before[1], after[0]
    begins = [event for event in fleet.events if "resuming at" in event["line"] and event["pid"] == first["pid"]]
    # A busy machine may read the line some time after the manifest.
    begin = min(begins, key=lambda event: abs(event["at"] - first["at"]), default=None)
    of_line = begin and begin["line"].split("resuming at")[1].split(" env")[0]
    resumed = int("".join(filter(str.isdigit, of_line))) if of_line else None
    name = next((process.name for process in fleet.processes if process.child.pid == first["pid"]), None)
    # When the new leader had learnt from its first batch, unless its clock is wrong. Its first manifest repeats the last state.
    times = [at for at, _, number in logged.get(name, []) if number > first["updates"] and abs(at - first["at"]) < 60]
    return {
        "at": first["at"], "from": last["pid"], "to": first["pid"], "by": name, "epoch": first["epoch"], "resumed_at": resumed,
        "pause_s": first["at"] - last["at"], "first_update_s": times[0] - last["at"] if times else None,
        "env_steps_lost": None if resumed is None else max(0, last["env_steps"] - resumed),
    }  # fmt: skip


def repeated(terms, logged):
    """Returns how many updates of earlier terms each takeover made again: those that were logged twice."""
    counts = collections.Counter(number for updates in logged.values() for _, _, number in updates)
    again = [number for number, count in counts.items() if count > 1]
    starts = [first["updates"] for first, _ in terms[1:]] + [float("inf")]
    return [sum(start < number <= following for number in again) for start, following in zip(starts, starts[1:], strict=False)]


def progress_after(record, manifests):
    """Returns the seconds from a fault until the store had a newer update; after a leader's end, of the next leader."""
    ends = record["is_leader_fault"] and record["kind"] in ENDS_PROCESSES
    for one in manifests:
        is_late = one["at"] > record["began"] + SETTLED_S
        if is_late and one["updates"] > record["updates"] and not (ends and one["epoch"] == record["epoch"]):
            return round(one["at"] - record["began"], 2)
    return None


def longest_pause(manifests, begun, ended):
    times = [begun, *(one["at"] for one in manifests if begun <= one["at"] <= ended), ended]
    return max(after - before for before, after in zip(times, times[1:], strict=False))


def observed(folder):
    """Sums what observers counted."""
    found = collections.Counter(observers=0)
    for file in folder.glob("bus-*.jsonl"):
        counts = [one for one in map(json.loads, file.read_text(encoding="utf-8").splitlines()) if one["what"] == "counts"]
        if counts:
            found["observers"] += 1
            for key in ("announcements", "late", "statistics", "overtaken_statistics", "acts_on_lower"):
                found[key] += counts[-1][key]
    return dict(found)


def growth(samples):
    """Returns for each kind of process the largest growth of memory and descriptors per hour, of processes that lived long, and
    of memory in the last half of their lives."""
    series = collections.defaultdict(list)
    for at, name, pid, memory, files in samples:
        series[name, pid].append((at / 3600, memory, files))
    found = {}
    for (name, _), points in series.items():
        # The first samples are of a process that begins.
        points = points[2:]
        if len(points) < SAMPLES_MIN or points[-1][0] - points[0][0] < SPAN_MIN_H:
            continue
        row = found.setdefault(name.partition("-")[0], collections.defaultdict(list))
        row["mb_per_h"].append(slope([(hour, memory) for hour, memory, _ in points]))
        late = [(hour, 100 * memory / points[-1][1]) for hour, memory, _ in points[len(points) // 2 :]]
        row["late_percent_per_h"].append(slope(late))
        row["descriptors_per_h"].append(slope([(hour, files) for hour, _, files in points]))
        row["mb"].append(points[-1][1])
    return {role: {key: round(max(values), 1) for key, values in row.items()} for role, row in found.items()}


def unexpected_end(fleet, end):
    """Returns name, exit code and the begin of the last line of a process that no fault ended."""
    ended = [process for process in fleet.processes if process.name == end["name"] and process.begun < end["at"]]
    lines = ended[-1].err.read_text(encoding="utf-8", errors="replace").splitlines()
    return f"{end['name']}: code {end['code']}: {lines[-1][:LINE_MAX] if lines else ''}"


def failures(result, expected_observers):
    """Returns what must not happen."""
    found = list(result["account"]["mistakes"])
    for key in ("env_steps_lost", "env_steps_twice"):
        found += [f"{key}: {result[key]}"] * bool(result[key])
    lost = [each for each in result["takeover_list"] if each["env_steps_lost"]]
    found += [f"a takeover lost {each['env_steps_lost']} durable env steps" for each in lost]
    found += ["training did not recover"] * (result["recovered_after_s"] is None)
    seen = result["observers"]
    found += [f"{seen['observers']} of {expected_observers} observers reported"] * (seen["observers"] < expected_observers)
    found += [f"{seen['late']} announcements of an overtaken learner"] * bool(seen.get("late"))
    found += [f"{seen['acts_on_lower']} times an actor acted on a lower epoch"] * bool(seen.get("acts_on_lower"))
    found += [f"{name} did not stop after SIGTERM" for name in result["stuck"]]
    found += [f"a panic in {file}" for file in result["panics"]]
    never = [each for each in result["faults"] if each.get("was_overtaken") is False]
    found += [f"partition {each['number']} led to no takeover" for each in never]
    alone = [each for each in result["faults"] if each.get("followed") is False]
    return found + [f"the learner overtaken in partition {each['number']} did not follow" for each in alone]


def steps_at(file, at):
    """Returns the environment steps of the newest manifest at this time in a file of manifests, or None."""
    if not file.exists():
        return None
    # The last line may be in the middle of being written.
    lines = file.read_text(encoding="utf-8").split("\n")[:-1]
    steps = [one["env_steps"] for one in map(json.loads, lines) if one["at"] <= at and "env_steps" in one]
    return steps[-1] if steps else None


def kept(result, beside):
    """Returns the speed of the fleet beside, whose manifests are in this file, and the share of its steps that this one made."""
    ended = result["began"] + 60 * result["minutes"]
    beside_steps = steps_at(beside, ended) - steps_at(beside, result["began"])
    speed = beside_steps / (60 * result["minutes"])
    return {"beside_env_steps_per_s": speed, "kept_share": result["env_steps_per_s"] / speed}


def leader_recoveries(result):
    return [each["progress_after_s"] for each in result["faults"] if each["is_leader_fault"] and each["progress_after_s"]]


def summary(result):
    """Returns the numbers of a result that fit on a screen."""
    keys = ("seed", "minutes", "cpu_undisturbed", "cpu", "env_steps", "env_steps_per_s", "takeovers", "longest_pause_s")
    keys += ("recovered_after_s", "env_steps_lost", "env_steps_twice", "observers", "growth", "injected", "unexpected_ends")
    keys += ("failures",)
    times = leader_recoveries(result)
    found = {key: round(value, 3) if isinstance(value := result[key], float) else value for key in keys}
    found |= {key: round(result[key], 3) for key in ("beside_env_steps_per_s", "kept_share") if key in result}
    found["leader_fault_to_progress_s"] = [round(statistics.median(times), 2), max(times)] if times else None
    partitions = [each for each in result["faults"] if "overtaken_after_s" in each]
    found["overtaken_after_s"] = [round(each["overtaken_after_s"], 1) for each in partitions]
    found["updates_repeated"] = [each["updates_repeated"] for each in result["takeover_list"]]
    found["not_injected"] = [f"{each['kind']} {each['resolved']}: {each.get('error')}" for each in result["not_injected"]]
    return found


def table(files):
    """Returns Markdown rows: median and worst of several results."""
    results = [json.loads(file.read_text(encoding="utf-8")) for file in files]

    def row(title, values, worst=max, form="{:.1f}"):
        values = [value for value in values if value is not None]
        if not values:
            return f"| {title} | – | – |"
        return f"| {title} | {form.format(statistics.median(values))} | {form.format(worst(values))} |"

    def each(key):
        return [result[key] for result in results]

    takeovers = [one for result in results for one in result["takeover_list"]]
    rows = [
        f"| of {len(results)} runs | median | worst |\n|---|---|---|",
        row("environment steps per second", each("env_steps_per_s"), min, "{:.0f}"),
        row("share of the steps kept (%)", [100 * result["kept_share"] for result in results if "kept_share" in result], min, "{:.0f}"),
        row("cores in use, undisturbed (%)", [100 * value for value in each("cpu_undisturbed")], form="{:.0f}"),
        row("takeovers", each("takeovers"), form="{:.0f}"),
        row("a fault of the leader until the next durable update (s)", sum(map(leader_recoveries, results), [])),
        row("pause of a takeover (s)", [one["pause_s"] for one in takeovers]),
        row("updates repeated per takeover", [one["updates_repeated"] for one in takeovers], form="{:.0f}"),
        row("durable environment steps lost per takeover", [one["env_steps_lost"] for one in takeovers], form="{:.0f}"),
        row("longest time without a durable update (s)", each("longest_pause_s")),
        row("environment steps lost silently", each("env_steps_lost"), form="{:.0f}"),
        row("environment steps learnt from twice", each("env_steps_twice"), form="{:.0f}"),
        row("announcements of overtaken learners", [result["observers"].get("late") for result in results], form="{:.0f}"),
        row("actors acting on a lower epoch", [result["observers"].get("acts_on_lower") for result in results], form="{:.0f}"),
    ]  # fmt: skip
    for role in sorted({name.partition("-")[0] for name in NAMES}):
        found = [result["growth"][role] for result in results if role in result["growth"]]
        rows.append(row(f"memory growth, {role} (MB/h)", [one["mb_per_h"] for one in found]))
        rows.append(row(f"the same in the last half of a life, {role} (%/h)", [one["late_percent_per_h"] for one in found]))
        rows.append(row(f"descriptor growth, {role} (1/h)", [one["descriptors_per_h"] for one in found]))
    return "\n".join(rows)
