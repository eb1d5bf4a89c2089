#!/usr/bin/env bash
# Makes what a release consists of. The binary is for x86-64-v3 (AVX2 and FMA) and uses AVX-512 where it exists.
#
#   wheel     treadmill-rl, the binary with the module treadmill_actor; and treadmill-gym, the Gymnasium environment
#   archive   binary, manual pages, completions and licences as a .tar.gz
#   sbom      everything that the binary is made of, as CycloneDX
#   image     container image with the binary, as `docker load` reads it
#
#   deploy/release.sh --out DIR [--only wheel|archive|sbom|image]
#
# and SHA256SUMS over all files in DIR. Needs a C compiler, rustup and python3 with venv; the image needs docker. With qemu-user,
# the binary is also run on emulated processors. The first run compiles everything: ten minutes on two cores.
set -euo pipefail

usage() {
    echo "release: $1; usage: deploy/release.sh --out DIR [--only wheel|archive|sbom|image]" >&2
    exit 2
}
out= only=
while [ $# -gt 0 ]; do
    [ $# -gt 1 ] || usage "\`$1\` needs a value"
    case $1 in
    --out) out=$2 ;;
    --only) only=$2 ;;
    *) usage "unknown argument \`$1\`" ;;
    esac
    shift 2
done
[ -n "$out" ] || usage '--out DIR is missing'
case $only in '' | wheel | archive | sbom | image) ;; *) usage "\`$only\` is no part of a release" ;; esac
wanted() { [ -z "$only" ] || [ "$only" = "$1" ]; }

fail() {
    echo "release: $*" >&2
    exit 1
}
[ "$(uname -sm)" = 'Linux x86_64' ] || fail 'releases are made on Linux, x86-64'
mkdir -p "$out"
out=$(realpath "$out")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
PATH=$PATH:$HOME/.cargo/bin
command -v cargo >/dev/null || fail 'cargo is missing: install rustup from https://rustup.rs'
command -v cc >/dev/null || fail 'a C compiler is missing: apt-get install gcc libc6-dev'
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A folder of its own: other flags for every crate.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}/release-x86-64-v3
export RUSTFLAGS='-C target-cpu=x86-64-v3'
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
name=treadmill-$version-x86_64-linux

# The wheel contains the binary and its list of parts, so each other part is taken out of it.
python3 -m venv "$work/python" || fail 'python3 cannot make a virtual environment: apt-get install python3-venv'
"$work/python/bin/pip" install --quiet --disable-pip-version-check 'maturin>=1.16,<2'
maturin() { "$work/python/bin/maturin" build --release --locked --out "$work/wheels" "$@"; }
maturin
"$work/python/bin/python" -m zipfile -e "$work"/wheels/treadmill_rl-*.whl "$work/wheel"
binary=$(echo "$work"/wheel/treadmill_rl-*.data/scripts/treadmill)
chmod 755 "$binary"
"$binary" --version

# An old processor is refused in words, and one with AVX2 but without AVX-512 suffices.
if command -v qemu-x86_64 >/dev/null; then
    refusal=$(qemu-x86_64 -cpu Westmere "$binary" --version 2>&1 || true)
    case $refusal in *'this one lacks AVX'*) ;; *) fail "an old processor is not refused: $refusal" ;; esac
    qemu-x86_64 -cpu Haswell "$binary" eval --agent random --episodes 1 >/dev/null 2>"$work/haswell" ||
        { cat "$work/haswell" >&2; fail 'AVX2 does not suffice'; }
    echo 'release: refuses a Westmere, runs on a Haswell'
else
    echo 'release: NOT CHECKED on emulated processors; install qemu-user' >&2
fi

if wanted wheel; then
    # Python cannot refuse a processor before it loads the module, so this wheel runs on all of them.
    RUSTFLAGS= CARGO_TARGET_DIR=${CARGO_TARGET_DIR%/*}/release-x86-64 maturin --manifest-path python/treadmill_gym/Cargo.toml
    cp "$work"/wheels/*.whl "$out"
fi
if wanted archive; then
    deploy/install.sh "$work/$name" "$binary"
    cp LICENSE-APACHE LICENSE-MIT NOTICE README.md "$work/$name"
    tar -C "$work" --owner 0 --group 0 --sort=name -czf "$out/$name.tar.gz" "$name"
fi
if wanted sbom; then
    cp "$work"/wheel/treadmill_rl-*.dist-info/sboms/*.json "$out/treadmill-$version.cdx.json"
fi
if wanted image; then
    if docker info >/dev/null 2>&1; then
        deploy/image.sh "$binary" "treadmill:$version"
        docker save "treadmill:$version" | gzip >"$out/treadmill-$version-image.tar.gz"
    elif [ -n "$only" ]; then
        fail 'no Docker Engine answers: start one, or leave out --only image'
    else
        echo 'release: WITHOUT the container image, because no Docker Engine answers' >&2
    fi
fi
cd "$out"
find . -maxdepth 1 -type f ! -name SHA256SUMS -printf '%f\n' | sort | xargs -d '\n' sha256sum -- | tee "$work/sums"
mv "$work/sums" SHA256SUMS
