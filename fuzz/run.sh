#!/usr/bin/env bash
# Fuzzes decoders with coverage, on the pinned toolchain:  fuzz/run.sh SECONDS [TARGET ...]
# Inputs that reach new code are kept in fuzz/corpus/TARGET; crashing inputs are written to fuzz/artifacts/TARGET/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
seconds=${1:?seconds per decoder}
shift
all=$(sed -n 's/^name = "\([a-z_]*\)"$/\1/p' fuzz/Cargo.toml)
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets <<<"$all"

build=(cargo build --release --features treadmill-fuzz/libfuzzer)
for target in "${targets[@]}"; do build+=(--bin "$target"); done
# Without `-p treadmill-fuzz`, dependencies keep the features of other builds and are not rebuilt.
RUSTC_WORKSPACE_WRAPPER=$PWD/fuzz/instrument.sh "${build[@]}"
cargo build --release --example seeds
target/release/examples/seeds fuzz/corpus

for target in "${targets[@]}"; do
    mkdir -p "fuzz/artifacts/$target"
    echo "=== $target"
    "target/release/$target" "fuzz/corpus/$target" -max_total_time="$seconds" -max_len=65536 -rss_limit_mb=1024 \
        -malloc_limit_mb=512 -timeout=20 -artifact_prefix="fuzz/artifacts/$target/" -print_final_stats=1 2>&1 |
        grep -v '^#[0-9]*[[:space:]]*\(NEW\|REDUCE\|pulse\|RELOAD\)'
done
