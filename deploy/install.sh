#!/usr/bin/env bash
# Builds and installs the binary, its manual pages and its completions for bash, zsh and fish.
#
#   deploy/install.sh [PREFIX] [BINARY]     PREFIX defaults to /usr/local; with BINARY, nothing is built
set -euo pipefail
prefix=${1:-/usr/local}
binary=${2:-}
if [ -z "$binary" ]; then
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    cargo build --release --locked --bin treadmill
    binary=target/release/treadmill
fi

install -D -m 755 "$binary" "$prefix/bin/treadmill"
binary=$prefix/bin/treadmill
"$binary" man "$prefix/share/man/man1"
completions() {
    mkdir -p "$(dirname "$prefix/share/$2")"
    "$binary" completions "$1" >"$prefix/share/$2"
}
completions bash bash-completion/completions/treadmill
completions zsh zsh/site-functions/_treadmill
completions fish fish/vendor_completions.d/treadmill.fish
echo "installed $binary, $(find "$prefix/share/man/man1" -name 'treadmill*.1' | wc -l) manual pages, completions for bash, zsh and fish"
