#!/bin/sh
# Makes the two base images of the Dockerfile under their own names, for a machine that reaches a Debian mirror and
# the crate registry but no container registry. Not needed anywhere else: there Docker pulls them.
#
#   sudo deploy/base-images.sh            both
#   sudo deploy/base-images.sh runtime    only what the binary runs on, for an image of a binary that is built already
#
# Needs root (debootstrap makes a whole system), docker, debootstrap, and for both the Rust toolchain that the
# Dockerfile names. What Docker pulls is larger and is what we run elsewhere; these are for trying the files here.
#
# TREADMILL_MIRROR   a Debian mirror to take instead of the usual one
set -eu

here=$(cd "$(dirname "$0")" && pwd)
mirror=${TREADMILL_MIRROR:-http://deb.debian.org/debian}

say() { printf '%s\n' "base-images: $*"; }
fail() {
    say "$*" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || fail "debootstrap needs root; try sudo"
what=${1:-both}
case $what in
both) tools='docker debootstrap rustc' ;;
runtime) tools='docker debootstrap' ;;
*) fail "\`$what\` is neither \`both\` nor \`runtime\`" ;;
esac
for tool in $tools; do
    command -v "$tool" >/dev/null || fail "\`$tool\` is missing; install it first"
done

# The names stand in one place, the Dockerfile.
named() { sed -n "s/^FROM \($1:[^ ]*\).*/\1/p" "$here/Dockerfile" | sort -u; }
runtime_image=$(named debian)
build_image=$(named rust)
release=${runtime_image#*:}
release=${release%-slim}
if [ "$what" = both ]; then
    wanted=${build_image#*:}
    wanted=${wanted%%-*}
    case $(rustc --version) in
    "rustc $wanted"[.\ ]*) ;;
    *) fail "the Dockerfile builds with Rust $wanted, here is $(rustc --version)" ;;
    esac
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# debootstrap hands its folder to the system inside, which is not root's alone.
chmod 755 "$work"

say "$runtime_image from $mirror"
debootstrap --variant=minbase "$release" "$work/runtime" "$mirror" >"$work/log" || { cat "$work/log" >&2; exit 1; }
rm -rf "$work"/runtime/var/cache/apt/archives/*.deb "$work"/runtime/var/lib/apt/lists/*
tar -C "$work/runtime" -c . | docker import --change 'CMD ["bash"]' - "$runtime_image"

if [ "$what" = runtime ]; then
    say "done"
    exit 0
fi

say "$build_image: the same with a C compiler and this machine's Rust"
debootstrap --variant=minbase --include=gcc,libc6-dev,ca-certificates \
    "$release" "$work/build" "$mirror" >"$work/log" || { cat "$work/log" >&2; exit 1; }
rm -rf "$work"/build/var/cache/apt/archives/*.deb "$work"/build/var/lib/apt/lists/*
# The toolchain itself, not rustup's stand-ins, without what a build never reads.
tar -C "$(rustc --print sysroot)" --exclude=./share --exclude='./lib/rustlib/src' --exclude='./lib/rustlib/rustc-src' \
    -c ./bin ./lib | tar -C "$work/build/usr/local" -x
# Where a proxy or a company's own authority stands between this machine and the crate registry, its certificate has
# to be known inside too.
if [ -r /etc/ssl/certs/ca-certificates.crt ]; then
    cp /etc/ssl/certs/ca-certificates.crt "$work/build/etc/ssl/certs/ca-certificates.crt"
fi
tar -C "$work/build" -c . | docker import \
    --change 'ENV PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin' --change 'CMD ["bash"]' \
    - "$build_image"
say "done; now \`docker compose -f deploy/docker-compose.yml build\` finds both"
