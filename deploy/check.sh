#!/usr/bin/env bash
# Checks the files of this folder without starting anything: docker-compose.yml by Compose, Prometheus's files by promtool,
# Grafana's dashboard by Grafana's types, Kubernetes's files by the schemas of several versions. Skips a check with a warning if its
# tool is missing.
#
#   deploy/check.sh
#
# TREADMILL_PROMTOOL              path of promtool
# TREADMILL_PYTHON                Python with grafana-foundation-sdk (PyPI); by default python3
# TREADMILL_KUBERNETES_VALIDATE   path of kubernetes-validate (PyPI)
# TREADMILL_STRICT                not empty: a missing tool is a failure
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

missing() {
    printf '\n!!! %s\n' "$*" >&2
    [ -z "${TREADMILL_STRICT:-}" ] || exit 1
}

if docker compose version >/dev/null 2>&1; then
    docker compose -f docker-compose.yml --profile observability --profile store --profile sweep config -q
    echo 'docker compose reads docker-compose.yml'
elif command -v docker-compose >/dev/null; then
    docker-compose -f docker-compose.yml --profile observability --profile store --profile sweep config -q
    echo 'docker-compose reads docker-compose.yml'
else
    missing 'Compose v2 and docker-compose are missing: docker-compose.yml is NOT CHECKED.'
fi

promtool=${TREADMILL_PROMTOOL:-promtool}
if command -v "$promtool" >/dev/null; then
    "$promtool" check config observability/prometheus.yml
    "$promtool" test rules observability/alarms.test.yml
else
    missing 'promtool is missing: the files of Prometheus are NOT CHECKED.'
fi

python=${TREADMILL_PYTHON:-python3}
if "$python" -c 'import grafana_foundation_sdk' 2>/dev/null; then
    "$python" observability/check_schema.py observability/grafana/dashboards/treadmill.json
else
    missing "$python lacks grafana-foundation-sdk: the dashboard is NOT CHECKED by Grafana's schema."
fi

validate=${TREADMILL_KUBERNETES_VALIDATE:-kubernetes-validate}
if command -v "$validate" >/dev/null; then
    files=
    for folder in kubernetes kubernetes/sweep; do
        # kustomization.yaml must list every manifest.
        listed=$(sed -n "/^resources:/,/^[a-z]*:\$/s|^  - \(.*\.yaml\)\$|$folder/\1|p" "$folder/kustomization.yaml")
        present=$(cd "$folder" && for file in *.yaml; do
            case $file in kustomization.yaml | prometheus-adapter.yaml) ;; *) echo "$folder/$file" ;; esac
        done)
        [ "$(sort <<<"$listed")" = "$(sort <<<"$present")" ] || { echo "$folder: kustomization.yaml does not list every file" >&2; exit 1; }
        files="$files $listed"
    done
    for version in 1.28 1.31 1.34 1.37; do
        # shellcheck disable=SC2086 # one word each
        "$validate" --kubernetes-version "$version" --strict --quiet $files
        echo "Kubernetes $version's schemas accept$(printf ' %s' $files)"
    done
else
    missing 'kubernetes-validate is missing: the manifests are NOT CHECKED.'
fi
