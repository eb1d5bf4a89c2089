#!/usr/bin/env bash
# Fuzzes decoders with coverage, on the pinned toolchain:  fuzz/run.sh SECONDS [TARGET ...]
# New inputs go to fuzz/corpus/TARGET, of these the few that cover more lines to fuzz/seeds/TARGET.tar.gz, which is committed, and
# inputs that crash to fuzz/artifacts/TARGET/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:?usage: fuzz/run.sh SECONDS [TARGET ...]}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(basename -s .tar.gz fuzz/seeds/*.tar.gz)

# Default members and `fuzz`, so that other builds share dependencies.
build=(cargo build --release --workspace --exclude treadmill-gym)
RUSTC_WORKSPACE_WRAPPER=$PWD/fuzz/instrument.sh "${build[@]}" --features treadmill-fuzz/libfuzzer --bin fuzz_target
"${build[@]}" --example seeds
target/release/examples/seeds fuzz/corpus

seeds=$(mktemp -d)
trap 'rm -rf "$seeds"' EXIT
limits=(-max_len=65536 -rss_limit_mb=1024 -malloc_limit_mb=512 -timeout=20)
for target in "${targets[@]}"; do
    corpus=(fuzz/corpus/"$target" "$seeds/$target")
    mkdir -p "${corpus[@]}" "fuzz/artifacts/$target"
    tar -xzf "fuzz/seeds/$target.tar.gz" -C "$seeds/$target"
    echo "=== $target"
    export TREADMILL_FUZZ_TARGET=$target
    target/release/fuzz_target "${corpus[@]}" "${limits[@]}" -max_total_time="$seconds" \
        -artifact_prefix="fuzz/artifacts/$target/" -print_final_stats=1 2>&1 |
        grep -v '^#[0-9]*[[:space:]]*\(NEW\|REDUCE\|pulse\|RELOAD\)'
    target/release/fuzz_target -set_cover_merge=1 -use_counters=0 "${limits[@]}" \
        "$seeds/$target" fuzz/corpus/"$target" 2>&1 | tail -n 1
    # The same inputs give the same archive.
    tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -C "$seeds/$target" -cf - . |
        gzip -9n >"fuzz/seeds/$target.tar.gz"
done
