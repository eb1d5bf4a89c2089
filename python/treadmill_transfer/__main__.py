"""`python -m treadmill_transfer`: plays an exported policy in MuJoCo."""

from .cli import main

if __name__ == "__main__":
    raise SystemExit(main())
