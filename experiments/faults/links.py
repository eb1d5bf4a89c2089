"""What can be wrong with a host: its links, its disk, its clock."""

import argparse
import asyncio
import contextlib
import os
import pathlib
import shutil
import subprocess
import sys

from fleet import ADDRESSES, PORT

PIECE_BYTES, PIECES_UNDER_WAY = 1 << 16, 4096
FAKETIME = sorted(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"))


def on(prefix, host, *command):
    subprocess.run(["ip", "netns", "exec", f"{prefix}-{host}", *command], check=True)


@contextlib.contextmanager
def dropped(prefix, host, chains, probability=None):
    """Drops all packets that come to or leave a host, or a share of them."""
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
    """Lets a host send no faster."""
    on(prefix, host, *f"tc qdisc add dev eth0 root tbf rate {rate} burst 64kb latency 400ms".split())
    try:
        yield
    finally:
        on(prefix, host, *"tc qdisc delete dev eth0 root".split())


@contextlib.contextmanager
def small_disk(folder, megabytes):
    """A file system of its own."""
    folder.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}m", "tmpfs", str(folder)], check=True)
    try:
        yield folder
    finally:
        # The rest stays, for the analysis of a run that failed.
        shutil.copytree(folder, folder.with_name("disk-copy"), dirs_exist_ok=True)
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill(folder):
    """Takes all the room that is left; the file to remove."""
    filler = folder / "filler"
    with filler.open("wb", buffering=0) as file, contextlib.suppress(OSError):
        for size in (1 << 20, 1 << 12, 1):
            with contextlib.suppress(OSError):
                while file.write(bytes(size)) == size:
                    pass
    return filler


def faked_clock(folder):
    """The words before a command whose clock can be set."""
    if not FAKETIME:
        sys.exit("clock jumps need libfaketime: apt-get install faketime, or leave them out with --only")
    set_clock(folder, "+0")
    settings = {
        "LD_PRELOAD": FAKETIME[0],
        "FAKETIME_TIMESTAMP_FILE": folder / "clock",
        "FAKETIME_CACHE_DURATION": 1,
        # Kernels do not let the monotonic clock jump.
        "FAKETIME_DONT_FAKE_MONOTONIC": 1,
        "DONT_FAKE_MONOTONIC": 1,
    }
    return ("env", *(f"{key}={value}" for key, value in settings.items()))


def set_clock(folder, offset):
    (folder / "clock").write_text(offset + "\n", encoding="ascii")


def set_delay(folder, seconds):
    beside = folder / "delay.new"
    beside.write_text(str(seconds), encoding="ascii")
    beside.replace(folder / "delay")


@contextlib.contextmanager
def relays(fleet):
    """On each actor's host, a relay to the router that holds everything back for as long as set_delay said; where it
    listens."""
    set_delay(fleet.folder, 0)
    started = []
    for host in ("actor1", "actor2"):
        command = [sys.executable, __file__, str(fleet.folder / "delay"), ADDRESSES["router"], str(PORT)]
        started.append(subprocess.Popen(["ip", "netns", "exec", f"{fleet.prefix}-{host}", *command]))
    try:
        yield f"tls/127.0.0.1:{PORT}"
    finally:
        for child in started:
            child.kill()
            child.wait()


async def pass_on(reader, writer, delay_of):
    """Passes on what arrives in its order, each piece later, and the end of it too."""
    loop, pieces = asyncio.get_running_loop(), asyncio.Queue(PIECES_UNDER_WAY)

    async def take():
        piece = True
        while piece:
            try:
                piece = await reader.read(PIECE_BYTES)
            except ConnectionError:
                piece = b""
            await pieces.put((loop.time() + delay_of(), piece))

    taking = asyncio.create_task(take())
    with contextlib.suppress(ConnectionError):
        while True:
            due, piece = await pieces.get()
            await asyncio.sleep(due - loop.time())
            if not piece:
                break
            writer.write(piece)
            await writer.drain()
    taking.cancel()
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
            there, back = await asyncio.open_connection(address, port)
        except OSError:
            writer.close()
            return
        await asyncio.gather(pass_on(reader, back, delay_of), pass_on(there, writer, delay_of))

    server = await asyncio.start_server(accept, "127.0.0.1", port)
    await server.serve_forever()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="The relay that the suite starts on an actor's host.")
    parser.add_argument("file", help="file with the delay in seconds")
    parser.add_argument("address")
    parser.add_argument("port", type=int)
    given = parser.parse_args()
    asyncio.run(relay(given.file, given.address, given.port))
