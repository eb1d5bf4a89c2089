"""Runs the command line."""

import os
import sys

# MuJoCo chooses its way to draw when it is imported.
films = any(argument.split("=")[0] == "--film" for argument in sys.argv)
if films and sys.platform == "linux" and not {"DISPLAY", "WAYLAND_DISPLAY", "MUJOCO_GL"} & set(os.environ):
    os.environ["MUJOCO_GL"] = "egl"
try:
    from .cli import main
except AttributeError as why:
    # OpenGL's library is missing.
    used = os.environ.get("MUJOCO_GL")
    print(f"error: MuJoCo cannot draw with MUJOCO_GL={used} ({why}); install libegl1, or leave --film out", file=sys.stderr)
    raise SystemExit(2) from None

raise SystemExit(main())
