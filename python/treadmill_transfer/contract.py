"""What an exported policy says of the robot, its observation and its task."""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy
import onnxruntime

ENTRY = "treadmill.contract"
FORMAT = 1
EXPORT = "export it with `treadmill export RUN --onnx FILE`"


class TransferError(Exception):
    """Input that cannot be used. The message is one line that names it."""


@dataclass
class Joints:
    """Servos of joints, in one order."""

    names: list
    default_rad: numpy.ndarray
    kp: numpy.ndarray
    kd: numpy.ndarray
    effort_nm: numpy.ndarray
    armature_kgm2: numpy.ndarray


@dataclass
class ServoContract:
    """What a contract says of a robot with servos."""

    control_step_s: float
    joints: Joints
    action_scale: numpy.ndarray
    action_limit: float
    held: Joints
    base_body: str
    base_turn_wxyz: numpy.ndarray
    excluded_bodies: list
    feet_bodies: list
    base_height_m: float
    base_orientation_wxyz: numpy.ndarray
    observation: list

    @property
    def outputs(self):
        """Names of the entries of an action."""
        return self.joints.names


@dataclass
class Contract(ServoContract):
    """Contract of a policy of the velocity task, of format 1, checked."""

    history: int
    gait_period_s: float
    gait_rests_below: float
    gait_rests_after_s: float
    gait_rests_rate_radps: float
    gait_rests_settled_s: float
    gait_rests_settled_rate_radps: float
    ranges: numpy.ndarray
    resampling_s: tuple
    standing_share: float
    heading_share: float
    heading_gain_per_s: float
    scan_points: tuple
    scan_spacing_m: float
    scan_limit_m: float
    fall_height_m: float
    fall_tilt_rad: float
    push_interval_s: tuple
    push_mps: tuple

    @property
    def width(self):
        """Numbers of one observation, all frames together."""
        return self.history * sum(size for _, size in self.observation)


class Policy:
    """Network of an ONNX file, and its contract."""

    def __init__(self, path):
        if not Path(path).is_file():
            raise TransferError(f"cannot read the policy `{path}`: there is no such file; {EXPORT}")
        try:
            options = onnxruntime.SessionOptions()
            # The networks are small: threads would only wait for each other.
            options.intra_op_num_threads = 1
            self._session = onnxruntime.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
            metadata = self._session.get_modelmeta().custom_metadata_map
        except Exception as why:  # noqa: BLE001: onnxruntime's errors have no common class
            raise TransferError(f"`{path}` is not an ONNX model ({one_line(why)}); {EXPORT}") from why
        if ENTRY not in metadata:
            why = f"its metadata lacks `{ENTRY}`: it is not a policy of a task that this program knows"
            raise TransferError(f"`{path}` has no contract, {why}; {EXPORT}")
        try:
            self.contract = read_contract(metadata[ENTRY])
        except TransferError as why:
            raise TransferError(f"the contract of `{path}` cannot be used: {why}; {EXPORT}") from why
        inputs, outputs = self._session.get_inputs(), self._session.get_outputs()
        found = [inputs[0].shape[-1], outputs[0].shape[-1]]
        wanted = [self.contract.width, len(self.contract.outputs)]
        if found != wanted:
            raise TransferError(
                f"`{path}` has {found[0]} inputs and {found[1]} outputs, its contract {wanted[0]} and {wanted[1]}; {EXPORT}"
            )
        self._input, self._output = inputs[0].name, outputs[0].name

    def act(self, observation):
        """Returns the action of a whole observation, in units of the action."""
        batch = numpy.asarray(observation, dtype=numpy.float32)[None]
        (action,) = self._session.run([self._output], {self._input: batch, **self._row(0)})
        return action[0].astype(float)

    def _row(self, row):
        """Returns the input that chooses the row of a motion, if there is one."""
        has_row = len(self._session.get_inputs()) > 1
        return {self._session.get_inputs()[1].name: numpy.array([[row]], dtype=numpy.float32)} if has_row else {}

    def tables(self, rows, names):
        """Returns the tables of a motion that the model gives out, by their names."""
        known = [output.name for output in self._session.get_outputs()]
        if missing := [name for name in names if name not in known]:
            raise TransferError(f"the model has no output `{missing[0]}`; {EXPORT}")
        batch = numpy.zeros((1, self.contract.width), dtype=numpy.float32)
        found = [self._session.run(list(names), {self._input: batch, **self._row(row)}) for row in range(rows)]
        return {name: numpy.concatenate([of_row[index] for of_row in found]).astype(float) for index, name in enumerate(names)}


def one_line(why):
    """Returns the first line of an error's text."""
    return (str(why).strip().splitlines() or [type(why).__name__])[0]


def read_contract(text):
    """Returns the contract of a JSON text."""
    try:
        whole = json.loads(text)
    except ValueError as why:
        raise TransferError(f"it is not JSON ({why})") from why
    fields = Fields(whole, "")
    if fields.get("format") != FORMAT:
        raise TransferError(f"`format` is {whole['format']}, but this program reads {FORMAT}")
    if "motors" in whole:
        # After this module, which it needs.
        from .walk import read_walk_contract

        return read_walk_contract(fields)
    if "motion" in whole:
        from .motion import read_motion_contract

        return read_motion_contract(fields, _servos(fields))
    # Files of older versions have bases that face along x, and exclude nothing.
    whole.setdefault("base_turn_wxyz", [1.0, 0.0, 0.0, 0.0])
    whole.setdefault("excluded_bodies", [])
    commands, history, fall = fields.part("commands"), fields.part("history"), fields.part("fall")
    scan = fields.part("height_scan")

    # Files of older versions have a gait that never rests.
    def of_rest(name, without):
        key = f"gait_rests_{name}"
        return fields.number(key) if key in whole else without

    return Contract(
        **_servos(fields),
        history=int(history.number("frames", above=0.0)),
        gait_period_s=fields.number("gait_period_s", above=0.0),
        gait_rests_below=of_rest("below", 0.0),
        gait_rests_after_s=of_rest("after_s", 0.0),
        gait_rests_rate_radps=of_rest("rate_radps", math.inf),
        gait_rests_settled_s=of_rest("settled_s", math.inf),
        gait_rests_settled_rate_radps=of_rest("settled_rate_radps", math.inf),
        ranges=numpy.array([commands.numbers(name, 2) for name in ("lin_vel_x_mps", "lin_vel_y_mps", "ang_vel_z_radps")]),
        resampling_s=tuple(commands.numbers("resampling_s", 2)),
        standing_share=commands.number("standing_share"),
        heading_share=commands.number("heading_share"),
        heading_gain_per_s=commands.number("heading_gain_per_s"),
        scan_points=tuple(int(count) for count in scan.numbers("points", 2)),
        scan_spacing_m=scan.number("spacing_m", above=0.0),
        scan_limit_m=scan.number("limit_m", above=0.0),
        fall_height_m=fall.number("height_m"),
        fall_tilt_rad=fall.number("tilt_rad"),
        push_interval_s=tuple(fields.numbers("push_interval_s", 2)),
        push_mps=tuple(fields.numbers("push_mps", 2)),
    )


def _servos(fields):
    """Returns what a robot with servos needs, by its names in a contract."""
    joints, terms = _joints(fields), fields.get("observation")
    if not isinstance(terms, list) or not all(isinstance(term, dict) and {"name", "size"} <= set(term) for term in terms):
        raise TransferError("`observation` is not a list of terms with `name` and `size`")
    return {
        "control_step_s": fields.number("control_step_s", above=0.0),
        "joints": joints,
        "action_scale": fields.numbers("action_scale", len(joints.names)),
        "action_limit": fields.number("action_limit", above=0.0),
        "held": _joints(fields.part("held_joints")),
        "base_body": fields.get("base_body"),
        "base_turn_wxyz": fields.numbers("base_turn_wxyz", 4),
        "excluded_bodies": _pairs(fields.get("excluded_bodies")),
        "feet_bodies": fields.names("feet_bodies"),
        "base_height_m": fields.number("default_base_height_m", above=0.0),
        "base_orientation_wxyz": fields.numbers("default_base_orientation_wxyz", 4),
        "observation": [(term["name"], term["size"]) for term in terms],
    }


def _pairs(found):
    """Returns pairs of names, checked."""
    is_pair = lambda pair: isinstance(pair, list) and len(pair) == 2 and all(isinstance(name, str) for name in pair)
    if not isinstance(found, list) or not all(map(is_pair, found)):
        raise TransferError("`excluded_bodies` is not a list of pairs of names")
    return found


def _joints(fields):
    names = fields.names("joint_names")
    keys = ("default_joint_pos", "joint_stiffness", "joint_damping", "joint_effort", "joint_armature")
    return Joints(names, *(fields.numbers(key, len(names)) for key in keys))


class Fields:
    """Fields of a JSON object, by whose path errors name them."""

    def __init__(self, of, path):
        if not isinstance(of, dict):
            raise TransferError(f"`{path or 'contract'}` is not an object")
        self._of, self.path = of, path

    def get(self, key):
        if key not in self._of:
            raise TransferError(f"`{self.path}{key}` is missing")
        return self._of[key]

    def part(self, key):
        return Fields(self.get(key), f"{self.path}{key}.")

    def names(self, key):
        value = self.get(key)
        if not isinstance(value, list) or not all(isinstance(name, str) for name in value):
            raise TransferError(f"`{self.path}{key}` is not a list of names")
        return value

    def number(self, key, above=None):
        value = self.get(key)
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)
        if not is_number or (above is not None and value <= above):
            wanted = "a finite number" if above is None else f"a number above {above:g}"
            raise TransferError(f"`{self.path}{key}` is {value!r}, not {wanted}")
        return float(value)

    def numbers(self, key, count):
        value = self.get(key)
        try:
            array = numpy.array(value, dtype=float)
        except (TypeError, ValueError):
            array = numpy.empty(0)
        if array.shape != (count,) or not numpy.isfinite(array).all():
            raise TransferError(f"`{self.path}{key}` is not a list of {count} finite numbers")
        return array
