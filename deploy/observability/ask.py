#!/usr/bin/env python3
"""Puts every question of a Grafana dashboard to a Prometheus, and waits until each has an answer.

    python3 ask.py http://127.0.0.1:9090 grafana/dashboards/treadmill.json
"""

import json
import sys
import time
import urllib.error
import urllib.parse
import urllib.request

PATIENCE_S = 90
address, dashboard = sys.argv[1], json.load(open(sys.argv[2], encoding="utf-8"))
open_questions = {
    target["expr"].replace("$run", ".*") for panel in dashboard["panels"] for target in panel.get("targets", [])
}
asked = len(open_questions)


def answered(question):
    query = urllib.parse.urlencode({"query": question})
    try:
        with urllib.request.urlopen(f"{address}/api/v1/query?{query}", timeout=5) as reply:
            return bool(json.load(reply)["data"]["result"])
    except urllib.error.HTTPError as why:
        if why.code == 503:
            return False  # It reads its own store first.
        sys.exit(f"{question}: {why.read().decode()}")
    except OSError:
        return False  # It is only just starting.


until = time.monotonic() + PATIENCE_S
while open_questions := {question for question in open_questions if not answered(question)}:
    if time.monotonic() > until:
        sys.exit("no answer to:\n" + "\n".join(sorted(open_questions)))
    time.sleep(1)
print(f"{asked} questions answered")
