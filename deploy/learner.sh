#!/bin/sh
# Begins or resumes the run that the environment describes, so that a learner's container can restart at any time. Passes its
# arguments to `treadmill learner`, which refuses settings that differ from those of the saved run.
#
# TREADMILL_PRESET   preset; default walk. Give own-task for tasks that are not built in
# TREADMILL_RUN      name of the run's folder below /runs; default: the preset
# TREADMILL_STEPS    environment steps in total; a higher value continues a finished run
# TREADMILL_SEED     seed of every random stream
# TREADMILL_SET      configuration keys, for example "ppo.batch=4096 learner.threads=2"
# TREADMILL_STORE    URL of the store for the run's state; default: the run's folder. AWS_… as docs/operations/failover.md lists
set -eu

preset=${TREADMILL_PRESET:-walk}
set -- learner --preset "$preset" --run-dir "/runs/${TREADMILL_RUN:-$preset}" --resume-or-start "$@"
[ -z "${TREADMILL_STORE:-}" ] || set -- "$@" --store "$TREADMILL_STORE"
# Compose passes unset variables as empty ones, which the client of the store would take for values.
for name in AWS_ENDPOINT AWS_ALLOW_HTTP AWS_REGION AWS_ACCESS_KEY_ID AWS_SECRET_ACCESS_KEY AWS_SESSION_TOKEN; do
    eval "[ -n \"\${$name:-}\" ] || unset $name"
done
[ -z "${TREADMILL_STEPS:-}" ] || set -- "$@" --steps "$TREADMILL_STEPS"
[ -z "${TREADMILL_SEED:-}" ] || set -- "$@" --seed "$TREADMILL_SEED"
# Split at blanks only, without file name patterns: values may contain brackets.
set -f
for pair in ${TREADMILL_SET:-}; do
    set -- "$@" --set "$pair"
done
exec treadmill "$@"
