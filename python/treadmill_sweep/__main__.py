"""Replaces itself by `treadmill sweep`, which starts this module again, with its Python, to serve a study of Optuna.

    python -m treadmill_sweep search.toml [FLAGS of `treadmill sweep`] [--treadmill PATH of the binary]
"""

import argparse
import os
import sys


def main(words):
    """Returns an exit code if the binary cannot be started."""
    if words == ["--serve"]:
        # What a library prints is no answer.
        answers = os.fdopen(os.dup(1), "w")
        os.dup2(2, 1)
        from .study import serve

        return serve(sys.stdin, answers)
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("--treadmill", default="treadmill")
    own, words = parser.parse_known_args(words)
    os.environ["TREADMILL_PYTHON"] = sys.executable
    try:
        os.execvp(own.treadmill, [own.treadmill, "sweep", *words])
    except OSError as why:
        print(f"error: `{own.treadmill}` cannot be started ({why}); give its path with --treadmill", file=sys.stderr)
        return 2


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
