#!/usr/bin/env bash
# Checks the files of this folder without starting anything: Compose's file by whichever Compose is there, Prometheus's by
# promtool, Kubernetes's by the schemas of several versions. What is missing is said, and then nothing is checked by it.
#
#   deploy/check.sh
#
# TREADMILL_PROMTOOL              promtool, where it is not on the path
# TREADMILL_KUBERNETES_VALIDATE   kubernetes-validate (from PyPI), where it is not on the path
# TREADMILL_STRICT                not empty: what is missing is a failure
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

missing() {
    printf '\n!!! %s\n' "$*" >&2
    [ -z "${TREADMILL_STRICT:-}" ] || exit 1
}

if docker compose version >/dev/null 2>&1; then
    docker compose -f docker-compose.yml --profile observability config -q
    echo 'docker compose reads docker-compose.yml'
elif command -v docker-compose >/dev/null; then
    docker-compose -f docker-compose.yml --profile observability config -q
    echo 'docker-compose reads docker-compose.yml'
else
    missing 'Neither Compose v2 nor docker-compose is there: docker-compose.yml is NOT CHECKED.'
fi

promtool=${TREADMILL_PROMTOOL:-promtool}
if command -v "$promtool" >/dev/null; then
    "$promtool" check config observability/prometheus.yml
    "$promtool" test rules observability/alarms.test.yml
else
    missing 'promtool is not there: the files of Prometheus are NOT CHECKED.'
fi

validate=${TREADMILL_KUBERNETES_VALIDATE:-kubernetes-validate}
if command -v "$validate" >/dev/null; then
    # The list of files is kustomization.yaml's, so that a file which is not in it is not taken for applied.
    files=$(sed -n '/^resources:/,/^[a-z]*:$/s/^  - \(.*\.yaml\)$/kubernetes\/\1/p' kubernetes/kustomization.yaml)
    left=$(cd kubernetes && for file in *.yaml; do
        case $file in kustomization.yaml | prometheus-adapter.yaml) ;; *) echo "kubernetes/$file" ;; esac
    done)
    [ "$(sort <<<"$files")" = "$(sort <<<"$left")" ] || { echo 'kustomization.yaml does not list every file' >&2; exit 1; }
    for version in 1.28 1.31 1.34 1.37; do
        # shellcheck disable=SC2086 # one word each
        "$validate" --kubernetes-version "$version" --strict --quiet $files
        echo "Kubernetes $version's schemas accept$(printf ' %s' $files)"
    done
else
    missing 'kubernetes-validate is not there: the manifests are NOT CHECKED.'
fi
