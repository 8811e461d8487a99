#!/usr/bin/python3
"""terminal_test.py ROOT CLAIM PROGRAM: one claim about what the command prints on a terminal."""

import fcntl
import os
import struct
import subprocess
import sys
import termios
import unicodedata
from pathlib import Path

from claims import ROOT, check_the_claim, claim

STILLPOINT = Path(sys.argv[3]).parent / "stillpoint"


def printed(folder, columns):
    """The lines of a run whose standard output is a terminal of so many columns; of none, if that is 0."""
    words = [STILLPOINT, "run", ROOT / "problems/block.toml", "--set", "output.stages=[1, 500]", "--set", "stop.time=20"]
    words += ["--set", "body_force.value=[0, 9.81]", "--set", "stop.steps=5", "--out", folder / "out"]
    reading, writing = os.openpty() if columns else os.pipe()
    if columns:
        fcntl.ioctl(writing, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    with subprocess.Popen(words, stdout=writing, stderr=subprocess.DEVNULL) as run:
        os.close(writing)
        text = b""
        while True:
            try:
                part = os.read(reading, 65536)
            except OSError:  # as a terminal ends
                break
            if not part:
                break
            text += part
        run.wait()
    return text.decode().replace("\r\n", "\n").splitlines()


@claim("the table of a run is as wide as the terminal, and says the same on a narrow one as in one line")
def _(folder):
    narrow, whole = printed(folder, 64), printed(folder, 0)
    assert max(map(len, whole)) > 64, whole  # else there is nothing to break
    assert max(map(len, narrow)) <= 64 or any(" " not in line[20:] for line in narrow if len(line) > 64), narrow
    told = [" ".join(" ".join(lines).split()) for lines in (narrow, whole)]
    untimed = [text[text.index("note") :] for text in told]
    assert untimed[0] == untimed[1], told
    assert not any(unicodedata.category(letter) == "Cc" for letter in told[0]), told[0]


if __name__ == "__main__":
    check_the_claim()
