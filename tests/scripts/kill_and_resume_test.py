"""Runs that are killed at random moments, again and again, and resumed each time: what they leave is what the run
leaves that nobody killed. KILLS=50 in the environment asks for more of them than a test takes the time for."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

from claims import ROOT, check_the_claim, claim

STILLPOINT = Path(sys.argv[3]).parent / "stillpoint"
RUNS = int(os.environ.get("KILLS", "2"))


def start(*arguments):
    return subprocess.Popen(
        [str(word) for word in (STILLPOINT, "run", *arguments, "--quiet", "--threads", "1")],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )


def end(process, after):
    """Whether the process ended by itself within so many seconds; it is killed otherwise."""
    try:
        messages = process.communicate(timeout=after)[1]
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        process.communicate()
        return False
    assert process.returncode in (0, 3), messages
    return True


def left_in(folder):
    summary = json.loads((folder / "summary.json").read_text())
    for on_the_clock in ("wall_s", "ns_per_point_step"):
        del summary[on_the_clock]
    files = [folder / "history.csv", *folder.glob("fields*.*"), *folder.glob("grid.pvd"), *folder.glob("fields_vtu/*")]
    return summary, {str(file.relative_to(folder)): file.read_bytes() for file in files}


def check_kills(folder, scene, *overrides):
    arguments = [ROOT / "problems" / scene]
    for override in (*overrides, "checkpoint.every_steps=40"):
        arguments += ["--set", override]
    begun = time.monotonic()
    assert end(start(*arguments, "--out", folder / "whole"), after=300)
    wall = time.monotonic() - begun
    whole = left_in(folder / "whole")
    moments = random.Random(1)
    for run in range(RUNS):
        out = folder / f"{run}"
        done = end(start(*arguments, "--out", out), moments.uniform(0.05, 0.9) * wall)
        while not done:
            begins_anew = not (out / "checkpoint.h5").exists()
            process = start(*arguments, "--out", out) if begins_anew else start("--resume", out)
            done = end(process, moments.uniform(0.3, 1.5) * wall)
        assert left_in(out) == whole, f"run {run} differs"


@claim("an elastic bar by ARKODE that is killed and resumed ends in the bits of the unbroken run")
def _(folder):
    check_kills(folder, "bar.toml", "integrator.method=erk:rk4", "damping.c=0.3")


@claim("a slope in phases that is killed and resumed ends in the bits of the unbroken run, its fields as well")
def _(folder):
    check_kills(folder, "slope.toml", "grid.cells=[40, 16]", "stop.time=0.06", "output.stages=[]",
                "output.fields_every=0.01", 'output.format=["xdmf", "vtu"]')


@claim("a block between walls that is killed and resumed ends in the bits of the unbroken run")
def _(folder):
    check_kills(folder, "block_on_wall.toml", "grid.cells=[16, 16]")


@claim("a relaxation by Chebyshev that is killed and resumed ends in the bits of the unbroken run")
def _(folder):
    check_kills(folder, "cantilever.toml", "damping.strategy=chebyshev", "stop.steps=400")


@claim("a relaxation by auto that is killed and resumed ends in the bits of the unbroken run")
def _(folder):
    check_kills(folder, "cantilever.toml", "damping.strategy=auto", "stop.steps=400")


@claim("Newton's method that is killed and resumed ends in the bits of the unbroken run")
def _(folder):
    check_kills(folder, "cantilever.toml", "solve.method=newton")


if __name__ == "__main__":
    check_the_claim()
