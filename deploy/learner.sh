#!/bin/sh
# Starts the run that the environment describes, or goes on with it where its folder already holds a checkpoint: that
# is what makes a learner's container safe to restart. Arguments go to `treadmill learner` as they are: where to listen,
# with which certificates, where metrics are served.
#
# TREADMILL_PRESET   starting point of the configuration (walk)
# TREADMILL_RUN      name of the run's folder below /runs (the preset's name)
# TREADMILL_STEPS    environment steps in total; a finished run goes on when this is raised
# TREADMILL_SEED     seed of every random stream
# TREADMILL_SET      configuration keys, as in "ppo.batch=4096 learner.threads=2"
set -eu

preset=${TREADMILL_PRESET:-walk}
run=${TREADMILL_RUN:-$preset}
folder=/runs/$run

set -- learner --no-progress "$@"
[ -z "${TREADMILL_STEPS:-}" ] || set -- "$@" --steps "$TREADMILL_STEPS"

if [ -e "$folder/checkpoints/latest.bundle" ]; then
    echo "going on with $folder; its preset, seed and settings are the saved ones" >&2
    exec treadmill "$@" --resume "$folder"
fi

# A start that was killed before its first checkpoint left an empty folder behind, which would be taken for a run.
# Anything else in there is the user's, and then the learner refuses.
rm -f "$folder"/checkpoints/.latest.bundle.*.tmp
rmdir "$folder/checkpoints" 2>/dev/null || true

[ -z "${TREADMILL_SEED:-}" ] || set -- "$@" --seed "$TREADMILL_SEED"
# Split at blanks and nowhere else: brackets in a value are not a file name pattern.
set -f
for pair in ${TREADMILL_SET:-}; do
    set -- "$@" --set "$pair"
done
exec treadmill "$@" --preset "$preset" --run-dir "$folder"
