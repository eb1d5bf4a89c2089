#!/usr/bin/env python3
"""Sends every query of a Grafana dashboard to Prometheus and waits until each returns data.

Usage: check_dashboard.py http://127.0.0.1:9090 grafana/dashboards/treadmill.json
"""

import json
import sys
import time
import urllib.error
import urllib.parse
import urllib.request

TIMEOUT_S = 90


def has_data(address, expression):
    query = urllib.parse.urlencode({"query": expression})
    try:
        with urllib.request.urlopen(f"{address}/api/v1/query?{query}", timeout=5) as reply:
            return bool(json.load(reply)["data"]["result"])
    except urllib.error.HTTPError as why:
        if why.code == 503:
            return False  # Prometheus is still reading its storage.
        sys.exit(f"{expression}: {why.read().decode()}")
    except OSError:
        return False  # Prometheus is still starting.


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        sys.exit(0 if sys.argv[1:] == ["--help"] else 2)
    address = sys.argv[1]
    with open(sys.argv[2], encoding="utf-8") as file:
        panels = json.load(file)["panels"]
    pending = {target["expr"].replace("$run", ".*") for panel in panels for target in panel.get("targets", [])}
    count, until = len(pending), time.monotonic() + TIMEOUT_S
    while pending := {expression for expression in pending if not has_data(address, expression)}:
        if time.monotonic() > until:
            sys.exit("no data for:\n" + "\n".join(sorted(pending)))
        time.sleep(1)
    print(f"{count} queries returned data")


if __name__ == "__main__":
    main()
