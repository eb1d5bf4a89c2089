#!/usr/bin/env bash
# One would guess: `promtool check metrics` accepts every page that Prometheus scrapes, such as one of OpenMetrics, which it prefers.
#
# Seen: promtool reads only Prometheus's older text format. There the description of a counter has the suffix `_total`, in
# OpenMetrics it has not; so each counter of a valid OpenMetrics page has "no help text", and the exit code is 3. A page to be
# linted must be asked for without `Accept: application/openmetrics-text`.
#
# promtool comes from Debian 12 (amd64), so this script needs apt-get.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=2.42.0+ds-5+deb12u1
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check prometheus_client==0.23.1
(cd "$work" && apt-get download -q "prometheus=$version" >/dev/null && dpkg -x prometheus_*.deb prometheus)
promtool=$work/prometheus/usr/bin/promtool
echo "promtool of Debian's prometheus $version, prometheus_client 0.23.1, $(python3 --version)"

cat >"$work/page.py" <<'END'
import sys

from prometheus_client import CollectorRegistry, Counter, generate_latest
from prometheus_client.openmetrics import exposition, parser

registry = CollectorRegistry()
Counter("steps", "Steps learnt from.", registry=registry).inc(3)
if sys.argv[1] == "text":
    page = generate_latest(registry)
else:
    page = exposition.generate_latest(registry)
    # The reference parser of OpenMetrics accepts the page.
    assert [family.name for family in parser.text_string_to_metric_families(page.decode())] == ["steps"]
sys.stdout.buffer.write(page)
END

check() {
    "$work/venv/bin/python" "$work/page.py" "$1" >"$work/$1.page"
    code=0
    "$promtool" check metrics <"$work/$1.page" >"$work/$1.out" 2>&1 || code=$?
    echo "$1: exit code $code"
    sed 's/^/    /' "$work/$1.out"
}
check text
[ "$code" = 0 ] || { echo 'CHANGED: the older text format is refused'; exit 1; }
check openmetrics
[ "$code" = 3 ] && grep -q 'steps_total no help text' "$work/openmetrics.out" || { echo 'CHANGED: see above'; exit 1; }
echo 'as described: the same counter passes in one format and not in the other'
