#!/bin/sh
# Begins the sweep that the environment describes, or goes on with it, so that its container can restart at any time. Passes its
# arguments to `treadmill sweep`. The variables of learner.sh hold for every trial; besides:
#
# TREADMILL_SWEEP   name of the sweep's folder below /runs
# TREADMILL_SEEDS   seeds to train
set -eu

set -- sweep --preset "${TREADMILL_PRESET:-walk}" --seeds "${TREADMILL_SEEDS:-3}" \
    --run-dir "/runs/${TREADMILL_SWEEP:-sweep}" --resume-or-start "$@"
[ -z "${TREADMILL_STEPS:-}" ] || set -- "$@" --steps "$TREADMILL_STEPS"
[ -z "${TREADMILL_SEED:-}" ] || set -- "$@" --seed "$TREADMILL_SEED"
# Split at blanks only, without file name patterns: values may contain brackets.
set -f
for pair in ${TREADMILL_SET:-}; do
    set -- "$@" --set "$pair"
done
exec treadmill "$@"
