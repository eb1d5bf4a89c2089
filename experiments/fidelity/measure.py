"""Measures Treadmill's humanoid against MuJoCo's and writes the tables of docs/results/fidelity.md.

Needs: pip install "gymnasium[mujoco]" numpy
       cargo build --release -p treadmill-humanoid --example open_loop

Usage: measure.py [--json OUT.json] [--compare BASELINE.json] [--doc docs/results/fidelity.md]

Both simulators get the same states and actions. MuJoCo simulates Gymnasium's Humanoid-v5 file by RK4, 5 steps of 3 ms.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import body
import cases
import report

SEED = 1
STEPS = {0.15: 10, 0.3: 20, 0.5: 33}

# Name in the tables, settings of the environment. The first row is the default: 2 physics steps of 7.5 ms per control step, each
# with one iteration of Rapier's solver.
TREADMILL = [
    ("Treadmill, defaults", {}),
    ("Treadmill, 3 × 5 ms", {"substeps": 3}),
    ("Treadmill, 5 × 3 ms", {"substeps": 5}),
]
# Name in the tables, integrator, time step (s).
REFERENCES = [
    ("MuJoCo, RK4, 30 × 0.5 ms", "RK4", 0.0005),
    ("MuJoCo, Euler, 5 × 3 ms", "Euler", 0.003),
    ("MuJoCo, Euler, 3 × 5 ms", "Euler", 0.005),
    ("MuJoCo, implicitfast, 5 × 3 ms", "implicitfast", 0.003),
    ("MuJoCo, implicitfast, 3 × 5 ms", "implicitfast", 0.005),
    ("MuJoCo, implicitfast, 2 × 7.5 ms", "implicitfast", 0.0075),
]
PERTURBED = "MuJoCo, RK4, 5 × 3 ms, start changed by up to 1e-4"


class Treadmill:
    """Runs the example `open_loop`."""

    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder

    def __call__(self, given, config=None, **changes):
        """Plays cases. Returns for each a dictionary of arrays [T, …]."""
        path = self.folder / "model.xml"
        path.write_text(body.variant_xml(body.TREADMILL_XML, **changes), encoding="utf-8")
        extra = {"model_file": str(path), "config": config or {}}
        text = json.dumps([{key: value.tolist() for key, value in case.items()} | extra for case in given])
        run = subprocess.run([self.binary], input=text, capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"{self.binary} failed: {run.stderr.strip()}")
        played = json.loads(run.stdout)
        for case, states in zip(given, played):
            if len(states) != len(case["actions"]):
                sys.exit(f"Treadmill's state was not finite after {len(states)} of {len(case['actions'])} steps")
        return [{key: np.array([state[key] for state in states]) for key in states[0]} for states in played]


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


def rollouts(treadmill, played, times_s, contact, limits):
    """Returns each simulator's open-loop error against MuJoCo's RK4 with 3 ms."""
    model = body.load(contact=contact, limits=limits)
    reference = [body.simulate(model, case)[0] for case in played]
    rows = []
    for name, config in TREADMILL:
        config = config | ({} if contact else {"self_collision": False})
        found = [states["qpos"] for states in treadmill(played, config, limits=limits)]
        rows.append({"name": name, **errors(reference, found, times_s)})
    for name, integrator, timestep_s in REFERENCES:
        found = [body.simulate(model, case, integrator, timestep_s)[0] for case in played]
        rows.append({"name": name, **errors(reference, found, times_s)})
    found = [body.simulate(model, case)[0] for case in cases.perturbed(played, 1e-4, SEED)]
    rows.append({"name": PERTURBED, **errors(reference, found, times_s)})
    return {"cases": len(played), "times_s": list(times_s), "rows": rows}


def energy(treadmill):
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

    rows = []
    for name, config in TREADMILL:
        states = treadmill(played, config | {"self_collision": False}, **changes)
        rows.append(row(name, [(s["qpos"], s["qvel"]) for s in states]))
    for name, integrator, timestep_s in [("MuJoCo, RK4, 5 × 3 ms", "RK4", 0.003), *REFERENCES[1:]]:
        rows.append(row(name, [body.simulate(model, case, integrator, timestep_s) for case in played]))
    moving_j = float(np.mean([moving[1] - still for moving, still in zip(start, still_j)]))
    return {"cases": len(played), "times_s": list(steps), "internal_kinetic_start_j": moving_j, "rows": rows}


def mirror(treadmill):
    """Returns how far the mirrored case deviates from the mirrored path (rad, over joints and cases)."""
    rng = np.random.default_rng(SEED)
    result = {"cases": 50, "rows": []}
    for what, played, contact in [
        ("in flight, 0.15 s", cases.flights(rng, 50, 10, 0.4), False),
        ("standing, random actions, 0.5 s", cases.drops(rng, 50, 33, 0.4), True),
    ]:
        mirrored = cases.mirrored(played)
        model = body.load(contact=contact, symmetric=True)
        config = {} if contact else {"self_collision": False}
        ours = [[s["qpos"] for s in treadmill(side, config, symmetric=True)] for side in (played, mirrored)]
        theirs = [[body.simulate(model, case)[0] for case in side] for side in (played, mirrored)]
        for name, (paths, images) in [("Treadmill, defaults", ours), ("MuJoCo, RK4, 5 × 3 ms", theirs)]:
            away = np.abs([path[-1] - body.mirror_qpos(image[-1]) for path, image in zip(paths, images)])[:, 7:]
            row = {"name": name, "what": what, "median_rad": float(np.median(away)), "max_rad": float(away.max())}
            result["rows"].append(row)
    return result


def joints(treadmill):
    """Returns the overshoot of joint limits under full torques with random signs."""
    played = cases.thrashing(np.random.default_rng(SEED), 10, 1000)
    model = body.load()
    rows = []
    for name, config in TREADMILL:
        states = treadmill(played, config)
        overshoot = np.concatenate([s["limit_overshoot_rad"] for s in states])
        rows.append({"name": name, "overshoot_rad": quantiles(overshoot)})
    overshoot = np.concatenate([body.overshoot_rad(model, body.simulate(model, case)[0]) for case in played])
    rows.append({"name": "MuJoCo, RK4, 5 × 3 ms", "overshoot_rad": quantiles(overshoot)})
    return {"steps": 10_000, "rows": rows}


def quantiles(numbers):
    """Returns the 50 %, 99 % and 99.9 % quantiles and the maximum."""
    return [float(np.percentile(numbers, share)) for share in (50, 99, 99.9, 100)]


def measure(treadmill):
    """Runs all measurements. Returns one JSON object."""
    rng = np.random.default_rng(SEED)
    flights = cases.flights(rng, 200, 10, body.CONTROL_LIMIT)
    drops_zero = cases.drops(rng, 100, 33, 0.0)
    drops_random = cases.drops(rng, 100, 33, body.CONTROL_LIMIT)
    standing_s = (0.15, 0.3, 0.5)
    return {
        "made": report.circumstances(body.REPOSITORY),
        "flight_free": rollouts(treadmill, flights, (0.15,), contact=False, limits=False),
        "flight_limits": rollouts(treadmill, flights, (0.15,), contact=False, limits=True),
        "drop_zero": rollouts(treadmill, drops_zero, standing_s, contact=True, limits=True),
        "drop_random": rollouts(treadmill, drops_random, standing_s, contact=True, limits=True),
        "energy": energy(treadmill),
        "mirror": mirror(treadmill),
        "joints": joints(treadmill),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    binary = body.REPOSITORY / "target/release/examples/open_loop"
    parser.add_argument("--open-loop", type=pathlib.Path, default=binary, help="the built example")
    parser.add_argument("--json", type=pathlib.Path, help="file for all numbers")
    parser.add_argument("--compare", type=pathlib.Path, help="numbers of an earlier version, shown in rows 'before'")
    parser.add_argument("--doc", type=pathlib.Path, help="page whose generated part is replaced")
    arguments = parser.parse_args()
    if not arguments.open_loop.exists():
        sys.exit(f"{arguments.open_loop} does not exist; run: cargo build --release -p treadmill-humanoid --example open_loop")
    before = json.loads(arguments.compare.read_text(encoding="utf-8")) if arguments.compare else None
    with tempfile.TemporaryDirectory() as folder:
        result = measure(Treadmill(arguments.open_loop, pathlib.Path(folder)))
    if arguments.json:
        report.write_json(arguments.json, result)
    text = report.fidelity(result, before)
    print(text)
    if arguments.doc:
        report.replace(arguments.doc, "measure.py", text)


if __name__ == "__main__":
    main()
