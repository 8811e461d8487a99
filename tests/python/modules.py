"""What the tests of the Python package share: FILE_test.py ROOT CLAIM PACKAGE checks one claim; PACKAGE is the folder of
the package."""

import os
import signal
import sys
import threading
import time
import tomllib
from pathlib import Path

ROOT = Path(sys.argv[1])
sys.path.insert(0, str(ROOT / "tests/scripts"))
sys.path.insert(0, sys.argv[3])
os.chdir(ROOT)

BAR = ROOT / "problems/bar.toml"
SLOPE = ROOT / "problems/slope.toml"


def table_of(file):
    return tomllib.loads(Path(file).read_text(encoding="utf-8"))


def raised(kind, function, *arguments, **options):
    """What a call raises, which has to be of that kind."""
    try:
        function(*arguments, **options)
    except kind as error:
        return error
    raise AssertionError(f"{kind.__name__} was not raised")


def interrupt_after(seconds):
    """Ctrl-C comes then."""

    def send():
        time.sleep(seconds)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=send, daemon=True).start()


class HeavyBall:
    """Leapfrog with C = c M, c = 2 omega_1, in its staggered form. At first v is known where u is."""

    def propose(self, h, motion, u_new, v_new):
        k, c = (motion.last_step + h) / 2, 2 * motion.omega_1
        after = c * k / 2 if motion.last_step else 0
        v_new[:] = ((1 - c * k + after) * motion.v + k * motion.a) / (1 + after)
        u_new[:] = motion.u + h * v_new
