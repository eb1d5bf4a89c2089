"""Disturbs a host: its links, its disk, its clock. Run as a script, it is a relay that delays TCP data."""

import argparse
import asyncio
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

from experiments.faults.fleet import ADDRESSES, PORT

CHUNK_BYTES, CHUNKS_IN_FLIGHT = 1 << 16, 4096
FAKETIME = sorted(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))


def on(prefix, host, *command):
    subprocess.run(["ip", "netns", "exec", f"{prefix}-{host}", *command], check=True)


@contextlib.contextmanager
def dropped(prefix, host, chains, probability=None):
    """Drops packets of a host, all or with the given probability."""
    share = [] if probability is None else ["-m", "statistic", "--mode", "random", "--probability", str(probability)]
    for chain in chains:
        on(prefix, host, "iptables", "-w", "-A", chain, *share, "-j", "DROP")
    try:
        yield
    finally:
        for chain in chains:
            on(prefix, host, "iptables", "-w", "-F", chain)


@contextlib.contextmanager
def narrowed(prefix, host, rate):
    """Limits a host's sending rate."""
    on(prefix, host, *f"tc qdisc add dev eth0 root tbf rate {rate} burst 64kb latency 400ms".split())
    try:
        yield
    finally:
        on(prefix, host, *"tc qdisc delete dev eth0 root".split())


@contextlib.contextmanager
def small_disk(folder, megabytes):
    """Mounts a small file system."""
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", str(folder)], check=True)
    try:
        yield folder
    finally:
        # Keeps a copy for analysing failures.
        shutil.copytree(folder, folder.with_name("disk-copy"), dirs_exist_ok=True)
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill(folder):
    """Fills the disk. Returns the file to remove."""
    filler = folder / "filler"
    with filler.open("wb", buffering=0) as file, contextlib.suppress(OSError):
        for size in (1 << 20, 1 << 12, 1):
            with contextlib.suppress(OSError):
                while file.write(bytes(size)) == size:
                    pass
    return filler


def faked_clock(folder, is_new=True):
    """Returns a command prefix that makes the clock adjustable by `set_clock`; a clock that is not new keeps its offset."""
    if not FAKETIME:
        sys.exit("clock jumps need libfaketime: apt-get install faketime, or skip them with --only")
    if is_new:
        set_clock(folder, "+0")
    settings = {
        "LD_PRELOAD": FAKETIME[0],
        "FAKETIME_TIMESTAMP_FILE": folder / "clock",
        "FAKETIME_CACHE_DURATION": 1,
        # A real monotonic clock never jumps.
        "FAKETIME_DONT_FAKE_MONOTONIC": 1,
        "DONT_FAKE_MONOTONIC": 1,
    }
    return ("env", *(f"{key}={value}" for key, value in settings.items()))


def set_clock(folder, offset):
    (folder / "clock").write_text(offset + "\n", encoding="ascii")


def set_delay(folder, seconds):
    temporary = folder / "delay.new"
    temporary.write_text(str(seconds), encoding="ascii")
    temporary.replace(folder / "delay")


@contextlib.contextmanager
def relays(fleet):
    """Starts a relay to the router on each actor's host, with the delay of `set_delay`. Yields its endpoint."""
    set_delay(fleet.folder, 0)
    started = []
    for host in ("actor1", "actor2"):
        command = [sys.executable, "-m", "experiments.faults.links", str(fleet.folder / "delay"), ADDRESSES["router"], str(PORT)]
        started.append(subprocess.Popen(["ip", "netns", "exec", f"{fleet.prefix}-{host}", *command]))
    try:
        yield f"tls/127.0.0.1:{PORT}"
    finally:
        for child in started:
            child.kill()
            child.wait()


async def forward(reader, writer, delay_of):
    """Forwards data and the end of the stream in order, delayed."""
    loop, chunks = asyncio.get_running_loop(), asyncio.Queue(CHUNKS_IN_FLIGHT)

    async def receive():
        chunk = True
        while chunk:
            try:
                chunk = await reader.read(CHUNK_BYTES)
            except ConnectionError:
                chunk = b""
            await chunks.put((loop.time() + delay_of(), chunk))

    receiving = asyncio.create_task(receive())
    with contextlib.suppress(ConnectionError):
        while True:
            due, chunk = await chunks.get()
            await asyncio.sleep(due - loop.time())
            if not chunk:
                break
            writer.write(chunk)
            await writer.drain()
    receiving.cancel()
    writer.close()


async def relay(file, address, port):
    known = [0, 0.0]

    def delay_of():
        changed = os.stat(file).st_mtime_ns
        if known[0] != changed:
            known[:] = changed, float(pathlib.Path(file).read_text(encoding="ascii"))
        return known[1]

    async def accept(reader, writer):
        try:
            replies, upstream = await asyncio.open_connection(address, port)
        except OSError:
            writer.close()
            return
        await asyncio.gather(forward(reader, upstream, delay_of), forward(replies, writer, delay_of))

    server = await asyncio.start_server(accept, "127.0.0.1", port)
    await server.serve_forever()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Relays TCP with a delay; the suite starts it on each actor's host.")
    parser.add_argument("file", help="file with the delay in seconds")
    parser.add_argument("address")
    parser.add_argument("port", type=int)
    given = parser.parse_args()
    asyncio.run(relay(given.file, given.address, given.port))
