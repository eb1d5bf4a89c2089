"""Spaces and checks shared by one humanoid and several."""

import numpy as np
from gymnasium.spaces import Box

#: Control steps per second by default, rounded as in Gymnasium.
RENDER_FPS = 67

#: Exclusive upper limit of episode seeds.
SEEDS = 2**63


def observation_space(native):
    """Returns Gymnasium's observation space, so that models fit both: unbounded, 64 bits although 32 are computed."""
    size = sum(size for _, size in native.blocks)
    return Box(-np.inf, np.inf, (size,), np.float64)


def action_space(native):
    """Returns the space of motor controls."""
    low, high = np.array(native.action_ranges, np.float32).reshape(-1, 2).T.copy()
    return Box(low, high, dtype=np.float32)


def render_fps(native):
    """Returns the control steps per second, rounded as in Gymnasium."""
    return round(1 / native.control_step_s)


def observation_structure(native, exclude_current_positions_from_observation=True, **_):
    """Returns the sizes of an observation's blocks, as in Gymnasium's attribute of that name."""
    sizes = dict.fromkeys(("qpos", "qvel", "cinert", "cvel", "qfrc_actuator", "cfrc_ext", "ten_length", "ten_velocity"), 0)
    return {"skipped_qpos": 2 * bool(exclude_current_positions_from_observation)} | sizes | dict(native.blocks)


def check_render_mode(render_mode, modes):
    """Refuses an unknown render mode."""
    if render_mode is not None and render_mode not in modes:
        allowed = ", ".join(repr(mode) for mode in modes)
        raise ValueError(f"render_mode is {render_mode!r}, but must be None or one of {allowed}")


def check_options(options, known=()):
    """Refuses unknown options of `reset`."""
    for name in options or {}:
        if name not in known:
            allowed = ", ".join(known) or "none"
            raise ValueError(f"reset option `{name}` is not known; known options: {allowed}")


def as_actions(actions, shape, name):
    """Returns actions as an array for the native part, which refuses entries that are not finite."""
    try:
        array = np.ascontiguousarray(actions, np.float32)
    except (TypeError, ValueError) as why:
        raise ValueError(f"{name} cannot be read as numbers: {why}") from why
    if array.shape != shape:
        raise ValueError(f"{name} has the shape {np.shape(actions)}, but must have {shape}")
    return array
