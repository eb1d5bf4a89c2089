#!/usr/bin/env bash
# A matching listener cannot be undeclared after its publisher.
#
# One would guess: a listener that reports whether a publisher has subscribers may be undeclared before or after the
# publisher, as a publisher may be before or after the session's other entities; the session goes on.
# Seen: undeclared after its publisher, the listener raises an error that names a source line of the library. A Rust
# structure that holds the publisher before the listener logs an ERROR whenever it is dropped. In the other order
# nothing is raised.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet eclipse-zenoh==1.10.2
"$folder/python/bin/python" - <<'PYTHON'
import importlib.metadata

import zenoh

config = zenoh.Config()
config.insert_json5("scouting/multicast/enabled", "false")
config.insert_json5("listen/endpoints", "[]")


def undeclared(session, publisher_first):
    """Declares a publisher with a listener, and undeclares both. Returns the error, if there is one."""
    publisher = session.declare_publisher("robot/pose")
    listener = publisher.declare_matching_listener(lambda status: None)
    try:
        for entity in (publisher, listener) if publisher_first else (listener, publisher):
            entity.undeclare()
    except zenoh.ZError as error:
        return str(error)
    return None


with zenoh.open(config) as session:
    found = {first: undeclared(session, first) for first in (False, True)}
print("eclipse-zenoh", importlib.metadata.version("eclipse-zenoh"))
print("listener first: ", found[False])
print("publisher first:", found[True])
assert found[False] is None, "the usual order fails, too"
assert found[True] and "MatchingListener" in found[True], "the order does not matter any more"
PYTHON
