#!/usr/bin/python3
"""threads_test.py ROOT CLAIM PACKAGE: one claim about the GIL, threads, Ctrl-C and progress of the Python package."""

from modules import BAR, interrupt_after, raised  # first: finds the package

import contextlib
import io
import subprocess
import sys
import threading
import time
import types

import stillpoint
from claims import ROOT, check_the_claim, claim

ENDLESS = {"residual": 0, "distance": 0, "kinetic_energy": 0, "time": 1e12, "steps": 10**12}


def endless(**more):
    return stillpoint.Simulation(stillpoint.load(BAR, stop=ENDLESS, output={"every": 1e9}), **more)


@claim("while steps are taken other threads run")
def _(_folder):
    simulation, counted = endless(), 0
    thread = threading.Thread(target=lambda: simulation.run(2e5))
    thread.start()
    while thread.is_alive():
        counted += "another thread" in told_by(lambda: simulation.t)
    assert simulation.t >= 2e5 and counted > 1000, counted


@claim("a simulation that a thread steps is refused to others, which it does no harm")
def _(_folder):
    simulation = endless()
    thread = threading.Thread(target=lambda: simulation.run(2e5))
    thread.start()
    while "another thread" not in (refused := told_by(lambda: simulation.t)):
        assert thread.is_alive()
    for use in (simulation.step, simulation.run, lambda: simulation.unknowns.u, lambda: simulation.points.stress,
                lambda: simulation.summary, lambda: simulation.save("nowhere.h5"), lambda: simulation.history):  # fmt: skip
        assert "another thread" in told_by(use) or not thread.is_alive()
    thread.join()
    assert refused and simulation.t >= 2e5 and len(simulation.unknowns.u) == 9


def told_by(use):
    try:
        use()
    except RuntimeError as error:
        return str(error)
    return ""


@claim("Ctrl-C in run() is raised between two steps, and the simulation goes on from there")
def _(_folder):
    simulation = endless()
    interrupt_after(0.3)
    begin = time.monotonic()
    raised(KeyboardInterrupt, simulation.run)
    assert time.monotonic() - begin < 5
    steps = simulation.steps
    assert steps > 100 and not simulation.done and simulation.step() and simulation.steps == steps + 1


@claim("Ctrl-C in the set-up is raised")
def _(_folder):
    scene = {
        "dim": 2,
        "grid": {"min": [0, 0], "max": [1, 1], "cells": [600, 600], "basis": "quadratic"},
        "body": {"material": "m", "state": "plane-strain"},
        "material": {"m": {"law": "linear-elastic", "E": 1.0, "nu": 0.3, "rho": 1.0}},
        "support": [{"face": "bottom"}],
        "traction": [{"face": "top", "value": [0, -1e-3]}],
    }
    interrupt_after(1.0)
    begin = time.monotonic()
    raised(KeyboardInterrupt, stillpoint.Simulation, scene)
    assert 0.9 < time.monotonic() - begin < 30, time.monotonic() - begin


@claim("Ctrl-C in a run with files leaves them, and is raised then")
def _(folder):
    scene = stillpoint.load(BAR, stop=ENDLESS)
    interrupt_after(0.5)
    raised(KeyboardInterrupt, stillpoint.run, scene, out=folder)
    assert '"status": "interrupted"' in (folder / "summary.json").read_text(encoding="utf-8")
    assert len((folder / "history.csv").read_text(encoding="utf-8").splitlines()) > 2


@claim("Ctrl-C within a relaxation in Python is raised there")
def _(_folder):
    def slow(h, motion, u_new, v_new):
        time.sleep(30)

    stillpoint.add_relaxation("slow", lambda: slow)
    interrupt_after(0.3)
    simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "slow"}))
    begin = time.monotonic()
    raised(KeyboardInterrupt, simulation.run)
    assert time.monotonic() - begin < 10 and simulation.steps == 0


@claim("Ctrl-C ends a comparison")
def _(_folder):
    interrupt_after(1.0)
    begin = time.monotonic()
    raised(KeyboardInterrupt, stillpoint.compare, "problems/block.toml", {"grid.cells": [60, 60]}, repeats=20)
    assert time.monotonic() - begin < 60


@claim("Ctrl-C within a relaxation in Python ends a comparison")
def _(_folder):
    def slow(h, motion, u_new, v_new):
        time.sleep(0.05)
        v_new[:] = h / 4 * motion.a
        u_new[:] = motion.u + h * v_new

    stillpoint.add_relaxation("slow", lambda: slow)
    interrupt_after(1.0)
    begin = time.monotonic()
    raised(KeyboardInterrupt, stillpoint.compare, BAR, strategies=["slow", "auto"], integrators=["leapfrog"])
    assert time.monotonic() - begin < 10


@claim("a program ends in good order with simulations, views and strategies of its own still there")
def _(_folder):
    program = """
import sys; sys.path.insert(0, sys.argv[1])
import numpy as np, stillpoint
class Own:
    def propose(self, h, motion, u_new, v_new):
        v_new[:] = 0.9 * motion.v + h * motion.a
        u_new[:] = motion.u + h * v_new
stillpoint.add_relaxation("own", Own)
stillpoint.add_damping("mine", lambda v, Q, alpha: 0 * Q)
s = stillpoint.Simulation(stillpoint.load("problems/bar.toml", {"damping.strategy": "own"}), stop=lambda s: s.t > 5)
s.run()
me = [s, s.unknowns, s.unknowns.u, s.points]
me.append(me)
print(s.status)
"""
    result = subprocess.run(["/usr/bin/python3", "-c", program, sys.argv[3]], capture_output=True, text=True, cwd=ROOT)
    assert (result.returncode, result.stdout, result.stderr) == (0, "stop-test\n", ""), result


@claim("progress is told to a callable, and drawn as a line or as a notebook's bar")
def _(_folder):
    told = []
    simulation = stillpoint.Simulation(stillpoint.load(BAR, stop=ENDLESS, output={"every": 1e9}), progress=told.append)
    begin = time.monotonic()
    while time.monotonic() - begin < 1.0:
        simulation.step()
    assert 2 <= len(told) <= 8 and set(told[0]) == {"t", "end_time", "steps", "residual", "residual_goal", "wall_s"}
    assert told[0]["steps"] < told[-1]["steps"] and told[-1]["end_time"] == 1e12

    errors = io.StringIO()
    with contextlib.redirect_stderr(errors):
        bar = stillpoint.ProgressBar()
        bar({"t": 1, "end_time": 4, "steps": 7, "residual": 0.1, "residual_goal": 0, "wall_s": 2})
        bar.close()
    assert errors.getvalue().startswith("\r 25 %  t = 1 s, 7 steps") and errors.getvalue().endswith("\n")
    assert bar.share({"residual": 1.0, "residual_goal": 1e-6}) is not None
    assert abs(bar.share({"residual": 1e-3, "residual_goal": 1e-6}) - 0.5) < 1e-12
    assert bar.share({"done": 1, "total": 4}) == 0.25

    shown = []
    handle = types.SimpleNamespace(update=lambda html: shown.append(html))
    display = types.ModuleType("IPython.display")
    display.HTML = lambda text: text
    display.display = lambda html, display_id: shown.append(html) or handle
    shell = types.ModuleType("IPython")
    shell.get_ipython = lambda: types.SimpleNamespace(kernel=True)
    sys.modules.update({"IPython": shell, "IPython.display": display})
    simulation = stillpoint.Simulation(stillpoint.load(BAR, stop=ENDLESS, output={"every": 1e9}), progress=True)
    begin = time.monotonic()
    while time.monotonic() - begin < 0.6:
        simulation.step()
    assert len(shown) >= 2 and shown[0].startswith('<progress max="1" value="0.'), shown[:1]


check_the_claim()
