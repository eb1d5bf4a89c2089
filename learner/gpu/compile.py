"""Compiles kernels.cu to kernels.ptx by NVIDIA's runtime compiler, which needs no GPU.

Usage: pip install nvidia-cuda-nvrtc-cu12==12.0.140, then python learner/gpu/compile.py [--check]

With --check it writes nothing, and fails if the file is not what the source gives.
"""

import argparse
import ctypes
import importlib.metadata
import pathlib
import sys

# The text of this version is read by drivers of CUDA 12.0 and later.
VERSION = "12.0.140"
# Turing, the oldest architecture that the drivers of CUDA 13 support.
ARCHITECTURE = b"--gpu-architecture=compute_75"
SOURCES = pathlib.Path(__file__).parent / "src"


def nvrtc():
    """Returns the compiler's library."""
    package = importlib.metadata.distribution("nvidia-cuda-nvrtc-cu12")
    if package.version != VERSION:
        sys.exit(f"nvidia-cuda-nvrtc-cu12 is {package.version}: pip install nvidia-cuda-nvrtc-cu12=={VERSION}")
    library = next(file for file in package.files if file.name == "libnvrtc.so.12")
    return ctypes.CDLL(str(library.locate()))


def text(library, program, kind):
    """Returns the log or the result of a program."""
    size = ctypes.c_size_t()
    getattr(library, f"nvrtcGet{kind}Size")(program, ctypes.byref(size))
    buffer = ctypes.create_string_buffer(size.value)
    getattr(library, f"nvrtcGet{kind}")(program, buffer)
    return buffer.value.decode()


def compiled(source):
    """Returns the assembler's text of a source."""
    library, program = nvrtc(), ctypes.c_void_p()
    library.nvrtcCreateProgram(ctypes.byref(program), source, b"kernels.cu", 0, None, None)
    if library.nvrtcCompileProgram(program, 1, (ctypes.c_char_p * 1)(ARCHITECTURE)) != 0:
        sys.exit(text(library, program, "ProgramLog"))
    return text(library, program, "PTX")


def main():
    """Writes or checks the file."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="write nothing")
    target = SOURCES / "kernels.ptx"
    is_check = parser.parse_args().check
    result = compiled((SOURCES / "kernels.cu").read_bytes())
    if not is_check:
        target.write_text(result)
    elif target.read_text() != result:
        sys.exit("kernels.ptx is not what kernels.cu gives: commit what learner/gpu/compile.py writes")


if __name__ == "__main__":
    main()
