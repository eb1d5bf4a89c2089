#!/bin/sh
# Starts or resumes the run that the environment describes, so that a learner's container can restart at any time. Passes its
# arguments to `treadmill learner`.
#
# TREADMILL_PRESET   preset; default walk
# TREADMILL_RUN      name of the run's folder below /runs; default: the preset
# TREADMILL_STEPS    environment steps in total; a higher value continues a finished run
# TREADMILL_SEED     seed of every random stream
# TREADMILL_SET      configuration keys, for example "ppo.batch=4096 learner.threads=2"
set -eu

preset=${TREADMILL_PRESET:-walk}
run=${TREADMILL_RUN:-$preset}
folder=/runs/$run

set -- learner --no-progress "$@"
[ -z "${TREADMILL_STEPS:-}" ] || set -- "$@" --steps "$TREADMILL_STEPS"

if [ -e "$folder/checkpoints/latest.bundle" ]; then
    echo "resuming $folder with its saved preset, seed and settings" >&2
    exec treadmill "$@" --resume "$folder"
fi

# A start that was killed before its first checkpoint leaves an empty folder, which the learner would take for a run. The learner
# refuses a folder with any other file.
rm -f "$folder"/checkpoints/.latest.bundle.*.tmp
rmdir "$folder/checkpoints" 2>/dev/null || true

[ -z "${TREADMILL_SEED:-}" ] || set -- "$@" --seed "$TREADMILL_SEED"
# Split at blanks only, without file name patterns: values may contain brackets.
set -f
for pair in ${TREADMILL_SET:-}; do
    set -- "$@" --set "$pair"
done
exec treadmill "$@" --preset "$preset" --run-dir "$folder"
