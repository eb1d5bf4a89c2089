#!/bin/sh
# Cargo runs this in place of the compiler for the crates of this workspace (RUSTC_WORKSPACE_WRAPPER): libFuzzer then sees
# which code an input reaches, and arithmetic that overflows ends the program. Works with the pinned, stable compiler, and
# everything else stays as it was built.
for argument in "$@"; do
    case $argument in
        # It runs while building, without libFuzzer.
        build_script_build) exec "$@" ;;
    esac
done
exec "$@" --cfg fuzzing -C debug-assertions -C passes=sancov-module \
    -C llvm-args=-sanitizer-coverage-level=4 \
    -C llvm-args=-sanitizer-coverage-inline-8bit-counters \
    -C llvm-args=-sanitizer-coverage-pc-table \
    -C llvm-args=-sanitizer-coverage-trace-compares
