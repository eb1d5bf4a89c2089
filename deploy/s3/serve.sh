#!/bin/sh
# Serves S3 on port 8333 for the one key that the environment names.
#
# AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY   the key
set -eu

if [ -z "${AWS_ACCESS_KEY_ID:-}" ] || [ -z "${AWS_SECRET_ACCESS_KEY:-}" ]; then
    echo 'set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY for the S3 server and the learners' >&2
    exit 2
fi
# Only S3 is reachable from other containers.
exec /opt/seaweedfs/bin/weed server -s3 -dir=/data -ip=127.0.0.1 -ip.bind=127.0.0.1 -s3.ip.bind=0.0.0.0 -s3.port=8333 \
    -s3.port.iceberg=0 -s3.port.lance=0 -master.volumeSizeLimitMB=1024 -volume.max=0
