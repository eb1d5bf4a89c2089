"""Measures Treadmill's humanoid against MuJoCo's and writes the tables.

Needs: pip install "gymnasium[mujoco]" numpy
       cargo build --release && cargo build --release -p treadmill-humanoid --example open_loop

Usage: measure.py [--json OUT.json] [--compare BASELINE.json] [--csv FILE.csv]

All simulators get the same states and actions. The reference is Gymnasium's Humanoid-v5 file in MuJoCo by RK4, 5 steps of 3 ms.
Beside each step size of Treadmill stands MuJoCo's Euler integrator with the same steps.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import numpy as np

from experiments import report
from experiments.fidelity import body, cases

SEED = 1
STEPS = {0.15: 10, 0.3: 20, 0.5: 33}
SUBSTEPS = (2, 3, 4, 5)
REFERENCE = "MuJoCo, RK4, 5 × 3 ms"
# Name in the tables, integrator, time step (s).
OTHERS = [("MuJoCo, RK4, 30 × 0.5 ms", "RK4", 0.0005), ("MuJoCo, implicitfast, 5 × 3 ms", "implicitfast", 0.003)]
PERTURBED = "MuJoCo, RK4, 5 × 3 ms, start changed by up to 1e-4"


class OpenLoop:
    """Runs the example `open_loop`, which plays cases."""

    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder

    def __call__(self, given, config=None, contact=True, **changes):
        """Plays cases. Returns for each qpos [T, 24] and qvel [T, 23]."""
        path = self.folder / "model.xml"
        path.write_text(body.variant_xml(body.TREADMILL_XML, **changes), encoding="utf-8")
        config = (config or {}) | ({} if contact else {"self_collision": False})
        extra = {"model_file": str(path), "config": config}
        text = json.dumps([{key: value.tolist() for key, value in case.items()} | extra for case in given])
        run = subprocess.run([self.binary], input=text, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{self.binary} failed: {run.stderr.strip()}")
        played = json.loads(run.stdout)
        for case, states in zip(given, played):
            if len(states) != len(case["actions"]):
                sys.exit(f"{self.binary}: not finite after {len(states)} of {len(case['actions'])} steps, with {config}")
        return [tuple(np.array([state[key] for state in states]) for key in ("qpos", "qvel")) for states in played]


def mujoco(integrator, timestep_s):
    """Returns a function that plays cases in MuJoCo, with OpenLoop's arguments and result."""

    def play(given, contact=True, **changes):
        model = body.load(contact=contact, **changes)
        return [body.simulate(model, case, integrator, timestep_s) for case in given]

    return play


def step_name(substeps):
    """Returns a step size as in "2 × 7.5 ms"."""
    return f"{substeps} × {1000 * body.CONTROL_STEP_S / substeps:g} ms"


def euler_name(substeps):
    """Returns the name of MuJoCo's row with this many steps."""
    return f"MuJoCo, Euler, {step_name(substeps)}"


def euler(substeps):
    """Returns a function that plays cases by MuJoCo's Euler integrator."""
    return mujoco("Euler", body.CONTROL_STEP_S / substeps)


class Candidates:
    """Rows of the tables: name → function that plays cases. The first row is Treadmill's default."""

    def __init__(self, treadmill, default_substeps):
        self.treadmill = treadmill
        self.default = f"Treadmill, {step_name(default_substeps)} (default)"
        self.rows, self.pairs = {}, {}
        for substeps in (default_substeps, *(number for number in SUBSTEPS if number != default_substeps)):
            is_default = substeps == default_substeps
            name = self.default if is_default else f"Treadmill, {step_name(substeps)}"
            self.rows[name] = self.ours({} if is_default else {"substeps": substeps})
            self.rows[euler_name(substeps)] = euler(substeps)
            self.pairs[step_name(substeps)] = (name, euler_name(substeps))
        for name, integrator, timestep_s in OTHERS:
            self.rows[name] = mujoco(integrator, timestep_s)

    def keep(self, names):
        """Drops all other rows."""
        self.rows = {name: play for name, play in self.rows.items() if name in names}
        self.pairs = {step: pair for step, pair in self.pairs.items() if set(pair) <= set(names)}

    def ours(self, config):
        """Returns a function that plays cases in Treadmill."""
        return lambda given, **options: self.treadmill(given, config, **options)

    def ratios(self, rows, keys):
        """Returns for each step size Treadmill's errors divided by those of MuJoCo's Euler with the same steps."""
        rows = {row["name"]: row for row in rows}
        return [
            {"name": step, **{key: [a / b for a, b in zip(rows[ours][key], rows[theirs][key])] for key in keys}}
            for step, (ours, theirs) in self.pairs.items()
        ]


def errors(reference, found, times_s):
    """Returns joint-angle (rad) and torso-height (m) errors: mean and 95th percentile at each time."""
    row = {"angle_mean_rad": [], "angle_p95_rad": [], "height_mean_m": [], "height_p95_m": []}
    for time_s in times_s:
        at = STEPS[time_s] - 1
        difference = np.abs(np.array([mine[at] - theirs[at] for mine, theirs in zip(found, reference)]))
        angles, heights = difference[:, 7:], difference[:, 2]
        row["angle_mean_rad"].append(angles.mean())
        row["angle_p95_rad"].append(np.percentile(angles, 95))
        row["height_mean_m"].append(heights.mean())
        row["height_p95_m"].append(np.percentile(heights, 95))
    return row


def rollouts(candidates, played, times_s, contact, limits):
    """Returns each simulator's open-loop error against MuJoCo's RK4 with 3 ms."""
    options = {"contact": contact, "limits": limits}

    def positions(play, given):
        return [qpos for qpos, _ in play(given, **options)]

    rk4 = mujoco("RK4", 0.003)
    reference = positions(rk4, played)
    rows = [
        {"name": name, **errors(reference, positions(play, played), times_s)} for name, play in candidates.rows.items()
    ]
    perturbed = positions(rk4, cases.perturbed(played, 1e-4, SEED))
    rows.append({"name": PERTURBED, **errors(reference, perturbed, times_s)})
    ratios = candidates.ratios(rows, ("angle_mean_rad", "height_mean_m"))
    return {"cases": len(played), "times_s": list(times_s), "rows": rows, "ratios": ratios}


def energy(candidates):
    """Returns the energy drift of a body under gravity and its own springs only."""
    played = cases.passive_flights(np.random.default_rng(SEED), 20, 134)
    changes = {"limits": False, "damping": False}
    model = body.load(contact=False, **changes)
    steps = {1.0: 67, 2.0: 134}
    start = [body.mechanics(model, case["qpos"], case["qvel"]) for case in played]
    still_j = [body.mechanics(model, case["qpos"], 0 * case["qvel"])[1] for case in played]

    def row(name, found):
        end = {time_s: [body.mechanics(model, q[at - 1], v[at - 1]) for q, v in found] for time_s, at in steps.items()}
        drift = {time_s: [[e[0] - s[0], e[1] - s[1]] for e, s in zip(ends, start)] for time_s, ends in end.items()}
        turn = {
            time_s: [np.linalg.norm(e[2] - s[2]) / np.linalg.norm(s[2]) for e, s in zip(ends, start)]
            for time_s, ends in end.items()
        }
        return {
            "name": name,
            "total_mean_j": [np.mean(drift[t], axis=0)[0] for t in steps],
            "internal_mean_j": [np.mean(drift[t], axis=0)[1] for t in steps],
            "internal_max_j": [np.abs(drift[t]).max(axis=0)[1] for t in steps],
            "angular_momentum_mean": [np.mean(turn[t]) for t in steps],
        }

    plays = {**candidates.rows, REFERENCE: mujoco("RK4", 0.003)}
    rows = [row(name, play(played, contact=False, **changes)) for name, play in plays.items()]
    moving_j = float(np.mean([moving[1] - still for moving, still in zip(start, still_j)]))
    return {"cases": len(played), "times_s": list(steps), "internal_kinetic_start_j": moving_j, "rows": rows}


def mirror(candidates):
    """Returns how far the mirrored case deviates from the mirrored path (rad, over joints and cases)."""
    rng = np.random.default_rng(SEED)
    result = {"cases": 50, "rows": []}
    plays = {candidates.default: candidates.rows[candidates.default], REFERENCE: mujoco("RK4", 0.003)}
    for what, played, contact in [
        ("in flight, 0.15 s", cases.flights(rng, 50, 10, 0.4), False),
        ("standing, random actions, 0.5 s", cases.drops(rng, 50, 33, 0.4), True),
    ]:
        for name, play in plays.items():
            sides = [play(side, contact=contact, symmetric=True) for side in (played, cases.mirrored(played))]
            ends = [(path[-1], image[-1]) for (path, _), (image, _) in zip(*sides)]
            away = np.abs([path - body.mirror_qpos(image) for path, image in ends])[:, 7:]
            row = {"name": name, "what": what, "median_rad": float(np.median(away)), "max_rad": float(away.max())}
            result["rows"].append(row)
    return result


def joints(candidates):
    """Returns the overshoot of joint limits under full torques with random signs."""
    played = cases.thrashing(np.random.default_rng(SEED), 10, 1000)
    model = body.load()
    rows = []
    for name, play in {**candidates.rows, REFERENCE: mujoco("RK4", 0.003)}.items():
        overshoot = np.concatenate([body.overshoot_rad(model, qpos) for qpos, _ in play(played)])
        rows.append({"name": name, "overshoot_rad": quantiles(overshoot)})
    return {"steps": 10_000, "rows": rows}


def quantiles(numbers):
    """Returns the 50 %, 99 % and 99.9 % quantiles and the maximum."""
    return [float(np.percentile(numbers, share)) for share in (50, 99, 99.9, 100)]


def random_cases():
    """Returns the cases of the tables of errors."""
    rng = np.random.default_rng(SEED)
    return {
        "flights": cases.flights(rng, 200, 10, body.CONTROL_LIMIT),
        "drops_zero": cases.drops(rng, 100, 33, 0.0),
        "drops_random": cases.drops(rng, 100, 33, body.CONTROL_LIMIT),
    }


def measure(candidates):
    """Runs all measurements. Returns one JSON object."""
    played, standing_s = random_cases(), (0.15, 0.3, 0.5)
    flights = played["flights"]
    return {
        "made": report.circumstances(),
        "flight_free": rollouts(candidates, flights, (0.15,), contact=False, limits=False),
        "flight_limits": rollouts(candidates, flights, (0.15,), contact=False, limits=True),
        "drop_zero": rollouts(candidates, played["drops_zero"], standing_s, contact=True, limits=True),
        "drop_random": rollouts(candidates, played["drops_random"], standing_s, contact=True, limits=True),
        "energy": energy(candidates),
        "mirror": mirror(candidates),
        "joints": joints(candidates),
    }


def default_substeps(binary):
    """Returns the default of env.substeps."""
    printed = subprocess.run([binary, "config"], capture_output=True, text=True, check=True).stdout
    return tomllib.loads(printed)["env"]["substeps"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    built = body.REPOSITORY / "target/release"
    parser.add_argument("--open-loop", type=pathlib.Path, default=built / "examples/open_loop", help="the built example")
    parser.add_argument("--treadmill", type=pathlib.Path, default=built / "treadmill", help="the built binary")
    parser.add_argument("--json", type=pathlib.Path, help="file for all numbers")
    parser.add_argument("--compare", type=pathlib.Path, help="numbers of an earlier version, shown in rows 'before'")
    parser.add_argument("--csv", type=pathlib.Path, help="file for the table")
    arguments = parser.parse_args()
    for binary in filter(None, (arguments.open_loop, arguments.treadmill)):
        if not binary.exists():
            sys.exit(f"{binary} does not exist; the first lines of --help say how to build it")
    before = json.loads(arguments.compare.read_text(encoding="utf-8")) if arguments.compare else None
    with tempfile.TemporaryDirectory() as folder:
        treadmill = OpenLoop(arguments.open_loop, pathlib.Path(folder))
        result = measure(Candidates(treadmill, default_substeps(arguments.treadmill)))
    if arguments.json:
        report.write_json(arguments.json, result)
    text = report.fidelity(result, before)
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
