#!/bin/sh
# Compiler wrapper for the crates of this workspace (RUSTC_WORKSPACE_WRAPPER): adds libFuzzer's coverage counters and overflow
# checks. It works with the pinned, stable compiler; dependencies are not rebuilt.
for argument in "$@"; do
    case $argument in
        # Build scripts run without libFuzzer.
        build_script_build) exec "$@" ;;
    esac
done
exec "$@" --cfg fuzzing -C debug-assertions -C passes=sancov-module \
    -C llvm-args=-sanitizer-coverage-level=4 \
    -C llvm-args=-sanitizer-coverage-inline-8bit-counters \
    -C llvm-args=-sanitizer-coverage-pc-table \
    -C llvm-args=-sanitizer-coverage-trace-compares
