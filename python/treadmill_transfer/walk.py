"""Policies of Gymnasium's tasks: their contract, robot and episodes in MuJoCo."""

from dataclasses import dataclass

import mujoco
import numpy

from .contract import Fields, TransferError
from .robot import DIVERGED, compiled, joint_of, plain_actuator, read_model, replace_floor, substeps
from .trace import largest_difference

KEYS = ("observation", "action", "episode", "qpos", "qvel")


@dataclass
class Motor:
    """Motor of a joint: its torque is gear times gain times control, plus the bias."""

    name: str
    joint: str
    gear: float
    gain: float
    bias: numpy.ndarray
    control: numpy.ndarray
    force: numpy.ndarray | None


@dataclass
class WalkContract:
    """Contract of a policy of Gymnasium's tasks, checked."""

    control_step_s: float
    base_body: str
    bodies: list
    joint_names: list
    motors: list
    observation: list
    start_position: numpy.ndarray
    start_noise: float
    healthy_m: numpy.ndarray
    ends_unhealthy: bool

    @property
    def width(self):
        """Numbers of an observation."""
        return sum(size for _, size, _ in self.observation)

    @property
    def outputs(self):
        """Names of the entries of an action."""
        return [motor.name for motor in self.motors]

    def entry_name(self, index):
        """Returns the name of an entry of the observation, such as `qpos: base z`."""
        for block, size, entries in self.observation:
            if index < size:
                return f"{block}: {entries[index]}"
            index -= size
        raise IndexError(index)


def read_walk_contract(fields):
    """Returns the contract of the fields of a JSON object."""
    joints, terms, motors = fields.names("joint_names"), fields.get("observation"), fields.get("motors")
    if not isinstance(motors, list) or not isinstance(terms, list):
        raise TransferError("`motors` and `observation` are not lists")
    observation = []
    for index, term in enumerate(terms):
        block = Fields(term, f"observation[{index}].")
        entries = [Fields(entry, f"observation[{index}].entries.").get("name") for entry in block.get("entries")]
        observation.append((block.get("name"), int(block.number("size", above=0.0)), entries))
    unknown = [name for name, _, _ in observation if name not in _BLOCKS]
    if unknown:
        raise TransferError(f"the contract has the observation term `{unknown[0]}`, which this program does not know")
    return WalkContract(
        control_step_s=fields.number("control_step_s", above=0.0),
        base_body=fields.get("base_body"),
        bodies=fields.names("bodies"),
        joint_names=joints,
        motors=[_motor(Fields(motor, f"motors[{index}].")) for index, motor in enumerate(motors)],
        observation=observation,
        start_position=fields.numbers("start_position", 7 + len(joints)),
        start_noise=fields.number("start_noise"),
        healthy_m=fields.numbers("healthy_z_range_m", 2),
        ends_unhealthy=bool(fields.get("terminate_when_unhealthy")),
    )


def _motor(fields):
    return Motor(
        fields.get("name"),
        fields.get("joint"),
        fields.number("gear"),
        fields.number("gain"),
        fields.numbers("bias", 3),
        fields.numbers("control", 2),
        None if fields.get("force") is None else fields.numbers("force", 2),
    )


class Walker:
    """Robot in MuJoCo, driven by the contract's motors."""

    def __init__(self, path, contract, timestep_s=None):
        self.contract, self.notes = contract, []
        spec = read_model(path)
        _add_motors(spec, path, contract)
        replace_floor(spec, None, self.notes)
        self.substeps, spec.option.timestep = substeps(contract.control_step_s, spec.option.timestep, timestep_s)
        self.model = compiled(spec, path)
        self.data = mujoco.MjData(self.model)
        bodies = [self.model.body(index).name for index in range(1, self.model.nbody)]
        joints = [self.model.joint(index).name for index in range(1, self.model.njnt)]
        for what, found, wanted in (("bodies", bodies, contract.bodies), ("joints", joints, contract.joint_names)):
            if found != wanted:
                raise TransferError(f"the model `{path}` has the {what} {', '.join(found)}; the policy expects {', '.join(wanted)}")

    def reset(self, random):
        """Begins an episode with the start's noise."""
        mujoco.mj_resetData(self.model, self.data)
        noise = self.contract.start_noise
        self.data.qpos[:] = self.contract.start_position + random.uniform(-noise, noise, self.model.nq)
        self.data.qvel[:] = random.uniform(-noise, noise, self.model.nv)
        mujoco.mj_forward(self.model, self.data)

    def set_state(self, qpos, qvel):
        """Sets a state."""
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:], self.data.qvel[:] = qpos, qvel
        mujoco.mj_forward(self.model, self.data)

    def observe(self):
        """Returns the observation of the present state; forces are those of the last physics step."""
        return numpy.concatenate([_BLOCKS[name](self, size) for name, size, _ in self.contract.observation])

    def step(self, controls):
        """Simulates one control step. Returns whether the state stayed finite."""
        self.data.ctrl[:] = controls
        mujoco.mj_step(self.model, self.data, self.substeps)
        mujoco.mj_rnePostConstraint(self.model, self.data)
        return not any(self.data.warning[kind].number for kind in DIVERGED)

    def is_unhealthy(self):
        """Returns whether the torso's height ends an episode."""
        low_m, high_m = self.contract.healthy_m
        return self.contract.ends_unhealthy and not low_m < self.data.qpos[2] < high_m


# One function of (walker, size) for each block, as Gymnasium's Humanoid computes it. v4 has rows of the world and the base, too.
_BLOCKS = {
    "qpos": lambda walker, size: walker.data.qpos[walker.model.nq - size :],
    "qvel": lambda walker, _: walker.data.qvel,
    "cinert": lambda walker, size: walker.data.cinert.ravel()[-size:],
    "cvel": lambda walker, size: walker.data.cvel.ravel()[-size:],
    "qfrc_actuator": lambda walker, size: walker.data.qfrc_actuator[-size:],
    "cfrc_ext": lambda walker, size: walker.data.cfrc_ext.ravel()[-size:],
}


def _add_motors(spec, path, contract):
    plain = plain_actuator()
    for motor in contract.motors:
        added = spec.add_actuator(name=motor.name, target=joint_of(spec, path, motor.joint).name)
        for key, value in plain.items():
            setattr(added, key, value)
        added.trntype = mujoco.mjtTrn.mjTRN_JOINT
        added.gaintype, added.biastype = mujoco.mjtGain.mjGAIN_FIXED, mujoco.mjtBias.mjBIAS_AFFINE
        added.gear[0], added.gainprm[0], added.biasprm[:3] = motor.gear, motor.gain, motor.bias
        added.ctrllimited, added.ctrlrange = mujoco.mjtLimited.mjLIMITED_TRUE, motor.control
        if motor.force is not None:
            added.forcelimited, added.forcerange = mujoco.mjtLimited.mjLIMITED_TRUE, motor.force


def play_episode(walker, policy, steps, seed, index, shown=None):
    """Plays one episode of at most `steps` control steps. Returns its length, distance and whether it ended with a fall."""
    walker.reset(numpy.random.default_rng([seed, index]))
    start_x, length, fell = walker.data.qpos[0], 0, False
    while length < steps and not fell:
        observation = walker.observe()
        broken = numpy.flatnonzero(~numpy.isfinite(observation))
        if len(broken):
            entry = walker.contract.entry_name(int(broken[0]))
            raise TransferError(f"{entry} of the observation is not finite in step {length + 1}: a model that diverged")
        is_finite = walker.step(policy.act(observation))
        length += 1
        fell = walker.is_unhealthy() or not is_finite
        if shown and not shown():
            break
    return {"length": length, "distance_m": float(walker.data.qpos[0] - start_x), "fell": fell}


def summary(episodes, control_step_s):
    """Returns the means of episodes."""
    lengths, distances = ([episode[key] for episode in episodes] for key in ("length", "distance_m"))
    return {
        "episodes": len(episodes),
        "falls": sum(episode["fell"] for episode in episodes),
        "distance_mean_m": float(numpy.mean(distances)),
        "velocity_mean_mps": float(sum(distances) / (sum(lengths) * control_step_s)),
        "length_mean": float(numpy.mean(lengths)),
    }


def compare(walker, policy, lines, tolerances):
    """Compares observation and action of each line of a trace; forces are left out, which each simulator has its own of. Returns the
    first difference, or None, and the largest of each boundary."""
    contract, first, largest = walker.contract, None, dict.fromkeys(("observation", "action"), 0.0)
    known = numpy.concatenate([numpy.full(size, name in ("qpos", "qvel")) for name, size, _ in contract.observation])
    # Half of the range of each control.
    middle, half = (numpy.array([weights @ motor.control / 2.0 for motor in contract.motors]) for weights in ([1.0, 1.0], [-1.0, 1.0]))
    episode, step = None, 0
    for line in lines:
        step = step + 1 if line["episode"] == episode else 1
        episode = line["episode"]
        walker.set_state(line["qpos"], line["qvel"])
        seen = line["observation"][: contract.width]
        action = (policy.act(seen) - middle) / half
        for boundary, found, expected, name_of in (
            ("observation", numpy.where(known, walker.observe(), seen), seen, contract.entry_name),
            ("action", action, numpy.clip(line["action"], -1.0, 1.0), contract.outputs.__getitem__),
        ):
            entry, off = largest_difference(found, expected)
            largest[boundary] = max(largest[boundary], off)
            if first is None and not off <= tolerances[boundary]:
                values = {"here": float(found[entry]), "trace": float(expected[entry]), "tolerance": tolerances[boundary]}
                first = {"boundary": boundary, "episode": int(episode), "step": step, "entry": name_of(entry), **values}
    return first, largest
