#!/usr/bin/python3
"""python_step.py MODULES SCENE: what Python costs, measured side by side in one process.

MODULES is the folder of the package, build/release/python; SCENE problems/bar.toml. Prints
- the time of a step from a Python loop beyond the same steps taken by run(), on the bar of problems/bar.toml;
- the time of a step of a relaxation written in Python beside the built-in one of the same coefficients, on about 20 000
  points of the plane;
- the same of a local damping;
- the time of a step under a body force that changes all the time, as a formula and in Python.
Medians of several rounds, taken in turn, on one thread.
"""

import statistics
import sys
import time

sys.path.insert(0, sys.argv[1])
import numpy as np  # noqa: E402

import stillpoint  # noqa: E402

ROUNDS = 9
NO_STOP = {"residual": 0, "distance": 0, "kinetic_energy": 0, "time": 1e9}


class HeavyBall:
    """Leapfrog with C = c M, c = 2 omega_1: the built-in damping "viscous"."""

    def propose(self, h, motion, u_new, v_new):
        k, c = (motion.last_step + h) / 2, 2 * motion.omega_1
        beta, gamma = (1 - c * k / 2) / (1 + c * k / 2), 1 / (1 + c * k / 2)
        np.multiply(motion.a, gamma * k, out=v_new)
        np.multiply(motion.v, beta, out=u_new)
        v_new += u_new
        np.multiply(v_new, h, out=u_new)
        u_new += motion.u


def cundall(v, Q, alpha):
    return -alpha * np.abs(Q) * np.sign(v)


def seconds(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def medians(*works):
    """Of each, in turn."""
    taken = [[seconds(work) for work in works] for _ in range(ROUNDS)]
    return [statistics.median(times) for times in zip(*taken)]


def stepping_from_python(steps):
    scene = stillpoint.load(sys.argv[2], stop=NO_STOP, output={"every": 1e9})
    stepped, whole = (stillpoint.Simulation(scene, threads=1) for _ in range(2))
    length = whole.step() and whole.t
    stepped.step()

    def loop():
        step = stepped.step
        for _ in range(steps):
            step()

    by_loop, by_run = medians(loop, lambda: whole.run(whole.t + (steps - 0.5) * length))
    print(f"bar: {1e6 * by_loop / steps:.2f} us a step from a Python loop, {1e6 * by_run / steps:.2f} us by run(): "
          f"{1e6 * (by_loop - by_run) / steps:.2f} us beyond")


def in_the_plane(points, strategies, steps, law):
    side = round((points / 4) ** 0.5)
    scene = {
        "dim": 2,
        "grid": {"min": [0, 0], "max": [1, 1], "cells": [side, side], "basis": "quadratic"},
        "body": {"material": "block", "state": "plane-strain", "points_per_cell": 4},
        "material": {"block": law},
        "mass": {"kind": "lumped"},
        "support": [{"face": "bottom"}],
        "traction": [{"face": "top", "value": [0, -1e-3]}],
        "stop": NO_STOP,
        "output": {"every": 1e9},
    }
    simulations = [
        stillpoint.Simulation(stillpoint.load(scene, damping={"strategy": name}), threads=1) for name in strategies
    ]
    found = medians(*(lambda s=s: [s.step() for _ in range(steps)] for s in simulations))
    told = ", ".join(f"{name} {1e6 * t / steps:.0f} us" for name, t in zip(strategies, found))
    print(f"{len(simulations[0].points)} points, {law['law']}: a step of {told}: {found[1] / found[0]:.2f} times")


def loads(points, steps):
    side = round((points / 4) ** 0.5)
    scene = {
        "dim": 2,
        "grid": {"min": [0, 0], "max": [1, 1], "cells": [side, side], "basis": "quadratic"},
        "body": {"material": "block", "state": "plane-strain", "points_per_cell": 4},
        "material": {"block": {"law": "linear-elastic", "E": 1.0, "nu": 0.3, "rho": 1.0}},
        "mass": {"kind": "lumped"},
        "support": [{"face": "bottom"}],
        "stop": NO_STOP,
        "output": {"every": 1e9},
    }
    stillpoint.add_load("wave", lambda t, x: 1e-3 * np.sin(x - t), settles_at=np.inf)
    forces = {"none": {"value": [0, -1e-3]}, "formulas": {"value": ["1e-3*sin(x-t)", "1e-3*sin(y-t)"]}, "Python": {"own": "wave"}}
    simulations = [stillpoint.Simulation(stillpoint.load(scene, body_force=b), threads=1) for b in forces.values()]
    found = medians(*(lambda s=s: [s.step() for _ in range(steps)] for s in simulations))
    told = ", ".join(f"{name} {1e6 * t / steps:.0f} us" for name, t in zip(forces, found))
    print(f"{len(simulations[0].points)} points, a body force that varies: a step of {told}")


def main():
    stillpoint.add_relaxation("heavy-ball", HeavyBall, needs_omega_1=True)
    stillpoint.add_damping("cundall-in-python", cundall, stiffness_factor=1.7)
    stepping_from_python(20_000)
    elastic = {"law": "linear-elastic", "E": 1.0, "nu": 0.3, "rho": 1.0}
    hencky = {"law": "hencky", "E": 1.0, "nu": 0.3, "rho": 1.0}
    for law in elastic, hencky:
        in_the_plane(20_000, ("viscous", "heavy-ball"), 200, law)
        in_the_plane(20_000, ("adaptive", "heavy-ball"), 200, law)
        in_the_plane(20_000, ("cundall", "cundall-in-python"), 200, law)
    loads(20_000, 200)


main()
