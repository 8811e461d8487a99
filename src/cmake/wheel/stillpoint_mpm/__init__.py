"""The command `stillpoint` of a Python environment. The program lies in bin/ beside this file, and in a wheel that carries
them its libraries in lib/: it finds them wherever the two are put, as the script in the environment's bin/ could not."""

import os
import sys
from pathlib import Path


def main() -> None:
    os.environ.setdefault("STILLPOINT_PYTHON", sys.executable)  # by which `stillpoint plot` draws
    program = str(Path(__file__).parent / "bin" / "stillpoint")
    os.execv(program, [program, *sys.argv[1:]])
