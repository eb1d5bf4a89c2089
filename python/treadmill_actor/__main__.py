"""`python -m treadmill_actor`: simulates a Gymnasium environment for a run."""

from .cli import main

if __name__ == "__main__":
    raise SystemExit(main())
