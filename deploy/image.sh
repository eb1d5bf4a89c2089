#!/usr/bin/env bash
# Makes a container image of a built binary: the last stage of the Dockerfile. Without a registry that has the base image,
# base-images.sh makes it from a Debian mirror.
#
#   deploy/image.sh BINARY TAG
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
binary=$(realpath "$1")
tag=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

base=$(sed -n 's/^FROM \(debian:[^ ]*\)$/\1/p' "$here/Dockerfile")
docker image inspect "$base" >/dev/null 2>&1 || docker pull -q "$base" 2>/dev/null || "$here/base-images.sh" runtime
mkdir "$work/deploy"
cp "$binary" "$work/treadmill"
cp -L /etc/ssl/certs/ca-certificates.crt "$work"
cp "$here"/*.sh "$work/deploy"
sed -n '/^FROM debian:/,$p' "$here/Dockerfile" |
    sed -e 's|COPY --from=build /src/target/release/treadmill|COPY treadmill|' \
        -e 's|COPY --from=build /etc/ssl/certs/ca-certificates.crt|COPY ca-certificates.crt|' >"$work/Dockerfile"
DOCKER_BUILDKIT=0 docker build -q -t "$tag" "$work"
docker run --rm --network none "$tag" --version >/dev/null || { echo "$binary does not run on $base; build it there" >&2; exit 1; }
