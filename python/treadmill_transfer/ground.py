"""Height field in place of the model's floor.

A JSON file, as `treadmill export RUN --ground FILE` writes it:

    {"x_m": [min, max], "y_m": [min, max], "heights_m": [[…], …], "starts": [[x, y, z, yaw], …]}

`heights_m` has a row for each y, from the smallest, and in it a column for each x. `z` of a start is the ground's height there.
An `.npz` file holds arrays of the same names.
"""

import json
from dataclasses import dataclass

import numpy

from .contract import TransferError

# Depth of the field below its lowest point (m).
BASE_M = 1.0


@dataclass
class Ground:
    """Height field, and where episodes start."""

    x_m: numpy.ndarray
    y_m: numpy.ndarray
    heights_m: numpy.ndarray
    starts: numpy.ndarray


def read_ground(path):
    """Returns the ground of a file."""
    try:
        if str(path).endswith(".npz"):
            with numpy.load(path) as file:
                fields = {key: file[key] for key in file.files}
        else:
            with open(path, encoding="utf-8") as file:
                fields = json.load(file)
        ground = Ground(*(numpy.array(fields[key], dtype=float) for key in ("x_m", "y_m", "heights_m", "starts")))
    except OSError as why:
        raise TransferError(f"cannot read the ground `{path}`: {why.strerror or why}") from why
    except KeyError as why:
        raise TransferError(f"the ground `{path}` lacks {why}; it needs x_m, y_m, heights_m and starts") from why
    except (TypeError, ValueError) as why:
        raise TransferError(f"the ground `{path}` cannot be used ({why})") from why
    wrong = None
    for name, limits in (("x_m", ground.x_m), ("y_m", ground.y_m)):
        if limits.shape != (2,) or not limits[0] < limits[1]:
            wrong = f"`{name}` is not [min, max]"
    if ground.heights_m.ndim != 2 or min(ground.heights_m.shape) < 2:
        wrong = "`heights_m` is not a table of at least two rows and two columns"
    elif ground.starts.ndim != 2 or ground.starts.shape[1] != 4 or not len(ground.starts):
        wrong = "`starts` is not a list of [x, y, z, yaw]"
    elif not all(numpy.isfinite(part).all() for part in (ground.x_m, ground.y_m, ground.heights_m, ground.starts)):
        wrong = "it has numbers that are not finite"
    if wrong:
        raise TransferError(f"the ground `{path}` cannot be used: {wrong}")
    return ground
