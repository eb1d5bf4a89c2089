#!/usr/bin/env python3
"""Reads a Grafana dashboard with the types that Grafana generates from its schema, and checks that nothing is lost on the way.

Usage: check_schema.py grafana/dashboards/treadmill.json

Needs grafana-foundation-sdk (PyPI). Prints the fields that the schema lacks, and exits with 1 if there are any. It does not check
their types.
"""

import json
import sys

from grafana_foundation_sdk.cog.encoder import JSONEncoder
from grafana_foundation_sdk.cog.plugins import register_default_plugins
from grafana_foundation_sdk.models.dashboard import Dashboard


def differences(given, kept, place):
    if type(given) is not type(kept):
        yield f"{place}: {given!r} became {kept!r}"
    elif isinstance(given, dict):
        for key in given:
            if key in kept:
                yield from differences(given[key], kept[key], f"{place}.{key}")
            else:
                yield f"{place}.{key}: unknown"
    elif isinstance(given, list):
        if len(given) != len(kept):
            yield f"{place}: {len(given)} entries became {len(kept)}"
        for index, pair in enumerate(zip(given, kept)):
            yield from differences(*pair, f"{place}[{index}]")
    elif given != kept:
        yield f"{place}: {given!r} became {kept!r}"


def main():
    if len(sys.argv) != 2 or sys.argv[1] == "--help":
        print(__doc__)
        sys.exit(0 if sys.argv[1:] == ["--help"] else 2)
    register_default_plugins()
    with open(sys.argv[1], encoding="utf-8") as file:
        dashboard = json.load(file)
    kept = json.loads(JSONEncoder().encode(Dashboard.from_json(dashboard)))
    if found := list(differences(dashboard, kept, "dashboard")):
        sys.exit("\n".join(found))
    print(f"Grafana's schema has every field of {len(dashboard['panels'])} panels")


main()
