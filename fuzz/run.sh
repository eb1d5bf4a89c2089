#!/usr/bin/env bash
# Fuzzes decoders with coverage, on the pinned toolchain:  fuzz/run.sh SECONDS [TARGET ...]
# New inputs go to fuzz/corpus/TARGET, inputs that crash to fuzz/artifacts/TARGET/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:?usage: fuzz/run.sh SECONDS [TARGET ...]}
shift
all=$(sed -n 's/^name = "\([a-z_]*\)"$/\1/p' fuzz/Cargo.toml)
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets <<<"$all"

# Default members and `fuzz`, so that other builds share dependencies.
build=(cargo build --release --workspace --exclude treadmill-watch --exclude treadmill-gym)
coverage=("${build[@]}" --features treadmill-fuzz/libfuzzer)
for target in "${targets[@]}"; do coverage+=(--bin "$target"); done
RUSTC_WORKSPACE_WRAPPER=$PWD/fuzz/instrument.sh "${coverage[@]}"
"${build[@]}" --example seeds
target/release/examples/seeds fuzz/corpus

for target in "${targets[@]}"; do
    mkdir -p "fuzz/artifacts/$target"
    echo "=== $target"
    "target/release/$target" "fuzz/corpus/$target" -max_total_time="$seconds" -max_len=65536 -rss_limit_mb=1024 \
        -malloc_limit_mb=512 -timeout=20 -artifact_prefix="fuzz/artifacts/$target/" -print_final_stats=1 2>&1 |
        grep -v '^#[0-9]*[[:space:]]*\(NEW\|REDUCE\|pulse\|RELOAD\)'
done
