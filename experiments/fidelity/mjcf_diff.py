"""Compares how Treadmill and MuJoCo understand MJCF files: the numbers of a robot, and its motion.

Needs: pip install mujoco==4.0.0 numpy
       cargo build --release

Usage: mjcf_diff.py target/release/treadmill CASES... [--only TEXT] [--verbose] [--csv FILE.csv]
       mjcf_diff.py target/release/treadmill --features --random 200 [--seed 1] [--keep FOLDER]

CASES are MJCF files or folders of them; names that begin with `_` are parts of others. `--features` adds files with one feature
each, `--random` so many random robots, of which at most a twentieth may be refused. `--keep` writes them into a folder.

A file may say what is wanted in its first comment, one key per line:

    want: equal | refused | either   equal: loads, and moves as in MuJoCo (the default). refused: exit code 2.
                                     either: one of these two, but never loaded and different.
    names: WORD…                     what a refusal must contain
    avoid: WORD…                     what a refusal must not contain
    tolerance: NUMBER                of the motion, if not 0.01; with 50 or with 400 physics steps per control step
    cone: pyramidal                  MuJoCo takes pyramidal cones too (a documented difference)

Compared are what `robot --json` prints, and for each keyframe (else the pose of the file) 40 control steps of 2 ms with random
controls: MuJoCo starts each from Treadmill's state and takes 200 steps of 0.01 ms. The error is that of the velocity after the
step, in the norm of the kinetic energy, relative to its change. Exit code 1 if a case is not as wanted.
"""

import argparse
import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import mujoco
import numpy as np

from experiments.fidelity import mjcf_cases, mjcf_robots

CONTROL_STEP_S = 0.002
# Ordinary ones, and those of a second try: an error of the integrator at a hard impact shrinks with its step, a wrong model does not.
SUBSTEPS = (50, 400)
STEPS = 40
REFERENCE_STEPS = 200
STATIC_LIMIT = 2e-6
INERTIA_LIMIT = 1e-5
# Sizes (kg·m², and any unit) below which differences count as if the number were as large.
INERTIA_LEAST, LEAST = 1e-6, 1e-3
REFUSED_SHARE_MAX = 0.05
MOTION_LIMIT = 0.01
TIMEOUT_S = 60
KEYS = ("want", "names", "avoid", "tolerance", "cone")


def wishes(text: str) -> dict[str, str]:
    """Returns what the first comment of a text wants."""
    comment = re.search(r"<!--(.*?)-->", text, re.DOTALL)
    found = {"want": "equal"}
    for line in (comment.group(1) if comment else "").splitlines():
        key, colon, value = line.strip().partition(":")
        if colon and key in KEYS:
            found[key] = value.strip()
    return found


def run(*command) -> tuple[int | str, str, str]:
    """Returns exit code or "timeout", output and errors of a command."""
    try:
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, errors="replace", timeout=TIMEOUT_S)
    except subprocess.TimeoutExpired:
        return "timeout", "", ""
    return done.returncode, done.stdout, done.stderr


def in_mujoco(path: pathlib.Path) -> tuple[mujoco.MjModel | None, str]:
    """Returns MuJoCo's model, with a floor if the file has no ground, or the message of a refusal."""
    try:
        model = mujoco.MjSpec.from_file(str(path)).compile()
        grounds = (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD)
        if not np.isin(model.geom_type, [int(kind) for kind in grounds]).any():
            spec = mujoco.MjSpec.from_file(str(path))
            spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
            model = spec.compile()
    except (ValueError, RuntimeError, mujoco.FatalError) as why:
        return None, " ".join(str(why).split())
    return model, ""


def pairs(model: mujoco.MjModel) -> int:
    """Returns how many pairs of geoms may touch by MuJoCo's rules, those within the world left out."""
    filters_parents = not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_FILTERPARENT
    excluded = {frozenset((int(signature) >> 16, int(signature) & 0xFFFF)) for signature in model.exclude_signature}
    weld, found = model.body_weldid, set()
    for one in range(model.ngeom):
        for two in range(one + 1, model.ngeom):
            a, b = int(model.geom_bodyid[one]), int(model.geom_bodyid[two])
            bits = (model.geom_contype[one] & model.geom_conaffinity[two]) | (model.geom_contype[two] & model.geom_conaffinity[one])
            if not bits or weld[a] == weld[b] or frozenset((a, b)) in excluded:
                continue
            above = [int(weld[model.body_parentid[weld[body]]]) for body in (a, b)]
            if filters_parents and weld[a] and weld[b] and (weld[a] == above[1] or weld[b] == above[0]):
                continue
            found.add(frozenset((one, two)))
    found |= {frozenset((int(one), int(two))) for one, two in zip(model.pair_geom1, model.pair_geom2)}
    return len(found)


def of_actuators(model: mujoco.MjModel, joint: int) -> tuple[float, np.ndarray]:
    """Returns the armature and the damping, with its powers, that actuators add to a joint."""
    armature, damping = 0.0, np.zeros(3)
    for actuator in range(model.nu):
        if model.actuator_trntype[actuator] == int(mujoco.mjtTrn.mjTRN_JOINT) and model.actuator_trnid[actuator, 0] == joint:
            square = float(model.actuator_gear[actuator, 0]) ** 2
            armature += square * float(model.actuator_armature[actuator])
            damping += square * np.append(model.actuator_damping[actuator], model.actuator_dampingpoly[actuator])
    return armature, damping


def differences(model: mujoco.MjModel, ours: dict) -> list[str]:
    """Returns what `robot --json` says differently."""
    faults = []

    def compare(name: str, theirs, found, limit: float = STATIC_LIMIT, least: float = LEAST) -> None:
        theirs, found = np.asarray(theirs, float), np.asarray(found, float)
        scale = max(least, float(np.abs(theirs).max(initial=0.0)))
        if theirs.shape != found.shape or not np.abs(theirs - found).max(initial=0.0) <= limit * scale:
            faults.append(f"{name}: MuJoCo {np.round(theirs, 6).tolist()}, here {np.round(found, 6).tolist()}")

    data = mujoco.MjData(model)
    data.qpos[:] = 0
    data.qpos[:7] = model.qpos0[:7]
    mujoco.mj_kinematics(model, data)
    hinges = [joint for joint in range(model.njnt) if model.jnt_type[joint] == int(mujoco.mjtJoint.mjJNT_HINGE)]
    moving = [body for body in range(1, model.nbody) if model.body_weldid[body] != 0]
    kinds = [int(kind) for kind in (mujoco.mjtEq.mjEQ_JOINT, mujoco.mjtEq.mjEQ_CONNECT)]
    counts = [int(np.sum((model.eq_type == kind) & (model.eq_active0 != 0))) for kind in kinds]
    for name, theirs, found in (
        ("hinges", len(hinges), len(ours["hinges"])),
        ("bodies", len(moving), len(ours["links"])),
        ("actuators", model.nu, len(ours["motors"])),
        ("pairs that may touch", pairs(model), ours["pairs"]),
        ("keyframes", model.nkey, len(ours["keyframes"])),
        ("equalities of joints", counts[0], ours["couplings"]),
        ("equalities of points", counts[1], ours["connections"]),
    ):
        if theirs != found:
            faults.append(f"{name}: MuJoCo {theirs}, here {found}")
    if len(hinges) != len(ours["hinges"]) or len(moving) != len(ours["links"]):
        return faults
    for joint, hinge in zip(hinges, ours["hinges"]):
        dof, label = model.jnt_dofadr[joint], f"joint {model.joint(joint).name}"
        armature, damping = of_actuators(model, joint)
        damping = damping + np.append(model.dof_damping[dof], model.dof_dampingpoly[dof])
        compare(f"{label} axis", data.xaxis[joint], hinge["axis"])
        compare(f"{label} anchor", data.xanchor[joint], hinge["anchor_m"])
        compare(f"{label} armature", armature + model.dof_armature[dof], hinge["armature_kgm2"])
        compare(f"{label} damping", damping, [hinge["damping_nmsprad"], *hinge["damping_powers"]])
        stiffness = np.append(model.jnt_stiffness[joint], model.jnt_stiffnesspoly[joint])
        compare(f"{label} stiffness", stiffness, [hinge["stiffness_nmprad"], *hinge["stiffness_powers"]])
        compare(f"{label} frictionloss", model.dof_frictionloss[dof], hinge["friction_loss_nm"])
        if bool(model.jnt_limited[joint]) != (hinge["min_rad"] is not None):
            faults.append(f"{label} limited: MuJoCo {bool(model.jnt_limited[joint])}")
        elif model.jnt_limited[joint]:
            compare(f"{label} range", model.jnt_range[joint], [hinge["min_rad"], hinge["max_rad"]])
    by_name = {link["name"]: link for link in ours["links"]}
    for body, in_order in zip(moving, ours["links"]):
        name = model.body(body).name
        link = by_name.get(name, in_order)
        compare(f"body {name} mass", model.body_mass[body], link["mass_kg"])
        if model.body_mass[body] > 0:
            turn = data.ximat[body].reshape(3, 3)
            compare(f"body {name} centre of mass", data.xipos[body], link["centre_of_mass_m"])
            inertia = turn @ np.diag(model.body_inertia[body]) @ turn.T
            compare(f"body {name} inertia", inertia, link["inertia_kgm2"], INERTIA_LIMIT, INERTIA_LEAST)
    return faults


def trace(binary: pathlib.Path, path: pathlib.Path, keyframe: str, substeps: int) -> tuple[list[dict], str]:
    """Returns the lines of a trace from a keyframe, or the message of a failure."""
    settings = {
        "keyframe": keyframe,
        "reset_noise_scale": "0",
        "terminate_when_unhealthy": "false",
        "healthy_z_range": "[-inf,inf]",
        "control_step_s": str(CONTROL_STEP_S),
        "substeps": str(substeps),
        "max_episode_steps": str(STEPS),
    }
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "trace.jsonl"
        command = [binary, "eval", "--agent", "random", "--model", path, "--episodes", "1", "--trace", file, "--print-every", "0"]
        sets = [part for name, value in settings.items() for part in ("--set", f"env.{name}={value}")]
        code, _, errors = run(*command, *sets, "--json")
        if code != 0 or not file.exists():
            return [], f"eval: exit {code}: {errors.strip()[-300:]}"
        return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()], ""


def controls(model: mujoco.MjModel, action: np.ndarray) -> np.ndarray:
    """Returns the controls of an action: -1 and 1 are the ends of a motor's control range."""
    low, high = model.actuator_ctrlrange.T
    return np.where(model.actuator_ctrllimited != 0, low + (np.clip(action, -1, 1) + 1) / 2 * (high - low), action)


def motion(model: mujoco.MjModel, lines: list[dict]) -> tuple[float, str]:
    """Returns the largest error of a control step, and where it is."""
    data, mass_matrix = mujoco.MjData(model), np.zeros((model.nv, model.nv))
    model.opt.timestep = CONTROL_STEP_S / REFERENCE_STEPS
    least = 0.1 * model.body_subtreemass[0] * (9.81 * CONTROL_STEP_S) ** 2
    worst, where = 0.0, ""
    if len(lines[0]["qpos"]) != model.nq or len(lines[0]["action"]) != model.nu:
        return np.inf, "other sizes"
    for number, (line, following) in enumerate(zip(lines, lines[1:]), start=1):
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = line["qpos"], line["qvel"]
        data.ctrl[:] = controls(model, np.array(line["action"]))
        before = data.qvel.copy()
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, mass_matrix)
        mujoco.mj_step(model, data, REFERENCE_STEPS)
        change, error = data.qvel - before, np.array(following["qvel"]) - data.qvel
        share = float(np.sqrt(max(error @ mass_matrix @ error, 0.0) / max(change @ mass_matrix @ change, least)))
        share = share if np.isfinite(share) else np.inf
        if share > worst:
            dof = int(np.argmax(np.abs(error) * np.sqrt(np.maximum(np.diag(mass_matrix), 1e-12))))
            joint = model.joint(int(model.dof_jntid[dof])).name
            worst = share
            where = f"step {number}, most at {joint or 'root'}: {change[dof]:.5g} in MuJoCo, {change[dof] + error[dof]:.5g} here"
    return worst, where


def examine(binary: pathlib.Path, path: pathlib.Path, wish: dict[str, str]) -> tuple[str, list[str], float]:
    """Returns what happened ("equal", "different", "refused", "both refuse" or "crashed"), details, and the motion's error."""
    model, refusal = in_mujoco(path)
    code, output, errors = run(binary, "robot", path, "--json")
    if code == 2:
        message = re.sub(r"^error: (model file `[^`]*`: )?", "", errors.strip())[:400]
        return ("refused", [message], 0.0) if model is not None else ("both refuse", [message, refusal], 0.0)
    if code != 0:
        return "crashed", [f"exit {code}: {errors.strip()[-300:]}"], 0.0
    ours = json.loads(output.strip().splitlines()[-1])
    if model is None:
        is_noted = any("MuJoCo" in note for note in ours["simplified"])
        return ("noted" if is_noted else "different"), [f"MuJoCo refuses: {refusal[:200]}"], 0.0
    if wish.get("cone") == "pyramidal":
        model.opt.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    faults, worst = differences(model, ours), 0.0
    for keyframe in ours["keyframes"] or [""] if model.nu else []:
        start = model.key(keyframe).qpos if keyframe and model.nkey else model.qpos0
        for substeps in SUBSTEPS:
            lines, fault = trace(binary, path, keyframe, substeps)
            if not lines:
                break
            if len(start) == len(lines[0]["qpos"]) and np.abs(start - lines[0]["qpos"]).max() > 1e-5:
                fault = "another start"
                break
            error, where = motion(model, lines)
            fault = ""
            if error <= float(wish.get("tolerance", MOTION_LIMIT)):
                worst = max(worst, error)
                break
            fault = f"error {error:.3g} in {where}"
        if fault:
            faults.append(f"motion from `{keyframe or 'start'}`: {fault}")
    return ("different" if faults else "equal"), faults, worst


def is_as_wanted(result: str, details: list[str], wish: dict[str, str]) -> bool:
    text, want = " ".join(details), wish["want"]
    if result in ("refused", "both refuse"):
        is_clear = all(word in text for word in wish.get("names", "").split())
        return want in ("refused", "either") and is_clear and not any(word in text for word in wish.get("avoid", "").split())
    if result == "noted":
        return want == "refused"
    return result == "equal" and want in ("equal", "either")


def write_cases(folder: pathlib.Path, arguments: argparse.Namespace) -> list[pathlib.Path]:
    """Writes the generated cases into a folder, and returns their paths."""
    cases = dict(mjcf_cases.features()) if arguments.features else {}
    cases |= {f"random_{index:04}": mjcf_robots.robot(arguments.seed, index) for index in range(arguments.random)}
    names = sorted(cases)
    for name, text in mjcf_cases.parts().items():
        (folder / name).write_text(text, encoding="utf-8")
    for name in names:
        (folder / f"{name}.xml").write_text(cases[name], encoding="utf-8")
    return [folder / f"{name}.xml" for name in names]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=pathlib.Path)
    parser.add_argument("cases", type=pathlib.Path, nargs="*")
    parser.add_argument("--features", action="store_true")
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--csv", type=pathlib.Path)
    arguments = parser.parse_args()
    files = [file for path in arguments.cases for file in ([path] if path.is_file() else sorted(path.rglob("*.xml")))]
    wrong, rows = 0, []
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        files += write_cases(folder, arguments)
        files = [file for file in files if not file.name.startswith("_") and arguments.only in str(file)]
        for file in files:
            wish = wishes(file.read_text(encoding="utf-8", errors="replace"))
            result, details, error = examine(arguments.binary.resolve(), file, wish)
            is_wanted = is_as_wanted(result, details, wish)
            wrong += not is_wanted
            print(f"{'ok  ' if is_wanted else 'FAIL'} {file.stem}: {result}, wanted {wish['want']}, motion {error:.1e}", flush=True)
            for detail in details if arguments.verbose or not is_wanted else []:
                print(f"       {detail[:300]}")
            rows.append((file.stem, wish["want"], result, f"{error:.2e}", is_wanted))
    if arguments.csv:
        with arguments.csv.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([("case", "wanted", "found", "motion_error", "is_as_wanted"), *rows])
    refused = sum(name.startswith("random_") and "refuse" in found for name, _, found, *_ in rows)
    if refused > REFUSED_SHARE_MAX * arguments.random:
        print(f"{refused} of {arguments.random} random robots are refused, which is too many")
        wrong += 1
    print(f"{len(files) - wrong} of {len(files)} cases are as wanted")
    return 1 if wrong or not files else 0


if __name__ == "__main__":
    sys.exit(main())
