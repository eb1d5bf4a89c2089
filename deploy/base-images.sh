#!/bin/sh
# Builds the Dockerfile's two base images on a machine that reaches a Debian mirror and the crate registry but no container
# registry. Elsewhere, Docker pulls them.
#
#   sudo deploy/base-images.sh            both images
#   sudo deploy/base-images.sh runtime    only the runtime image, for a binary that is already built
#
# Needs root, docker and debootstrap; the build image also needs the Rust version that the Dockerfile names.
#
# TREADMILL_MIRROR   Debian mirror; default http://deb.debian.org/debian
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
*) fail "unknown argument \`$what\`; allowed: both, runtime" ;;
esac
for tool in $tools; do
    command -v "$tool" >/dev/null || fail "\`$tool\` is missing; install it"
done

# The Dockerfile names the images.
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
    *) fail "the Dockerfile needs Rust $wanted; found $(rustc --version)" ;;
    esac
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The new system needs access to this folder as other users than root.
chmod 755 "$work"

say "$runtime_image from $mirror"
debootstrap --variant=minbase "$release" "$work/runtime" "$mirror" >"$work/log" || { cat "$work/log" >&2; exit 1; }
rm -rf "$work"/runtime/var/cache/apt/archives/*.deb "$work"/runtime/var/lib/apt/lists/*
tar -C "$work/runtime" -c . | docker import --change 'CMD ["bash"]' - "$runtime_image"

if [ "$what" = runtime ]; then
    say "done"
    exit 0
fi

say "$build_image: the runtime image with a C compiler and this machine's Rust"
debootstrap --variant=minbase --include=gcc,libc6-dev,ca-certificates \
    "$release" "$work/build" "$mirror" >"$work/log" || { cat "$work/log" >&2; exit 1; }
rm -rf "$work"/build/var/cache/apt/archives/*.deb "$work"/build/var/lib/apt/lists/*
# The toolchain itself instead of rustup's proxies, without files that builds do not read.
tar -C "$(rustc --print sysroot)" --exclude=./share --exclude='./lib/rustlib/src' --exclude='./lib/rustlib/rustc-src' \
    -c ./bin ./lib | tar -C "$work/build/usr/local" -x
# A proxy between this machine and the crate registry may use its own certificate authority.
if [ -r /etc/ssl/certs/ca-certificates.crt ]; then
    cp /etc/ssl/certs/ca-certificates.crt "$work/build/etc/ssl/certs/ca-certificates.crt"
fi
tar -C "$work/build" -c . | docker import \
    --change 'ENV PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin' --change 'CMD ["bash"]' \
    - "$build_image"
say "done; \`docker compose -f deploy/docker-compose.yml build\` now finds both images"
