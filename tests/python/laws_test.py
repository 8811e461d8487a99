#!/usr/bin/python3
"""laws_test.py ROOT CLAIM PACKAGE: one claim about material laws with a history written in Python."""

from modules import raised  # first: finds the package

import numpy as np
import stillpoint
from claims import check_the_claim, claim

BLOCK = {
    "dim": 2,
    "grid": {"min": [0, 0], "max": [1.5, 1.5], "cells": [6, 6]},
    "body": {"max": [1, 1], "material": "m", "state": "plane-strain"},
    "material": {"m": {"law": "drucker-prager", "E": 1e4, "nu": 0.3, "c": 2.5, "rho": 1.0}},
    "body_force": {"value": [4.0, -12.0]},
    "support": [{"face": "bottom"}],
    "damping": {"c": 3.0},
    "stop": {"residual": 0, "steps": 60},
}


def moduli_of(parameters):
    E, nu = parameters["E"], parameters["nu"]
    return E / (3 * (1 - 2 * nu)), E / (2 * (1 + nu))


def mises(stress, strain, history, _dt, parameters):
    """Radial return to sqrt(J2) = c."""
    K, G = moduli_of(parameters)
    volume = strain[:, :3].sum(axis=1, keepdims=True)
    stress = stress + G * strain
    stress[:, :3] += G * strain[:, :3] + (K - 2 * G / 3) * volume
    p = stress[:, :3].mean(axis=1, keepdims=True)
    s = stress.copy()
    s[:, :3] -= p
    root_J2 = np.sqrt((s[:, :3] ** 2).sum(axis=1) / 2 + (s[:, 3:] ** 2).sum(axis=1))
    beyond = np.maximum(root_J2 - parameters["c"], 0)
    s *= ((root_J2 - beyond) / np.where(root_J2 > 0, root_J2, 1))[:, None]
    s[:, :3] += p
    return s, history + (beyond / G)[:, None]


def add_mises(answer=mises, **more):
    options = {"elastic": lambda _stress, _history, parameters: moduli_of(parameters)} | more
    stillpoint.add_history_law(
        "mises", answer, parameters={"E": None, "nu": 0.3, "c": None}, history=["plastic_strain"], **options
    )


def block(law):
    return stillpoint.load(BLOCK, {"material.m.law": law})


@claim("a law with a history in Python moves a body as the built-in one of its formula, in phases and in space")
def _(_folder):
    add_mises()
    space = {"grid": {"min": [0, 0, 0], "max": [1.5, 1.5, 1.5], "cells": [6, 6, 6]}, "dim": 3,
             "body": {"max": [1, 1, 1], "material": "m"}, "body_force": {"value": [4.0, -12.0, 1.0]}}  # fmt: skip
    for scene in BLOCK, BLOCK | space:
        runs = [stillpoint.Simulation(stillpoint.load(scene, {"material.m.law": law})).run()
                for law in ("drucker-prager", "mises")]  # fmt: skip
        built_in, own = (run.points for run in runs)
        for field in "position", "stress", "plastic_strain":
            expected = getattr(built_in, field)
            assert np.abs(expected).max() > 0, field
            assert np.abs(getattr(own, field) - expected).max() < 1e-10 * np.abs(expected).max(), field
        assert own.plastic_strain.max() > 1e-4


@claim("Newton's method takes the moduli of a law in Python, its own or those by differences")
def _(_folder):
    solve = {"solve": {"method": "newton", "load_steps": 4}, "stop": {"residual": 1e-9}, "body_force.value": [0.5, -3.0]}
    scene = {key: value for key, value in BLOCK.items() if key not in ("damping", "stop")}

    def own_moduli(stress, strain, history, dt, parameters):
        points, n = strain.shape
        C = np.empty((points, n, n))
        for k in range(n):
            by = np.zeros(n)
            by[k] = 1e-7
            above, below = (mises(stress, strain + sign * by, history, dt, parameters)[0] for sign in (1, -1))
            C[:, :, k] = (above - below) / 2e-7
        return C

    found = []
    for law, options in ("drucker-prager", {}), ("mises", {}), ("mises", {"moduli": own_moduli}):
        add_mises(**options)
        run = stillpoint.Simulation(stillpoint.load(scene, {"material.m.law": law} | solve)).run()
        assert run.status == "equilibrium", run.reason
        found.append((run.points.position, run.evaluations))
    for position, evaluations in found[1:]:
        assert np.abs(position - found[0][0]).max() < 1e-8
        assert evaluations <= found[0][1] + 3


@claim("what a law in Python raises reaches the caller, and so does an array of another shape")
def _(_folder):
    def broken(stress, strain, history, dt, parameters):
        if np.abs(strain).max() > 1e-6:
            raise RuntimeError("this soil is bedrock")
        return mises(stress, strain, history, dt, parameters)

    add_mises(broken)
    assert "bedrock" in str(raised(RuntimeError, stillpoint.Simulation(block("mises")).run))
    add_mises(lambda stress, strain, history, dt, parameters: (stress[:, :2], history))
    assert "shape" in str(raised(ValueError, lambda: stillpoint.Simulation(block("mises")).run()))
    add_mises(elastic=lambda *_: 1 / 0)
    raised(ZeroDivisionError, stillpoint.Simulation, block("mises"))
    raised(ValueError, stillpoint.add_history_law, "umat", mises, elastic=moduli_of)
    raised(ValueError, stillpoint.add_history_law, "No word", mises, elastic=moduli_of)


@claim("a law in Python has the same bits with one and with two threads")
def _(_folder):
    add_mises()
    runs = []
    for threads in 1, 2:
        scene = stillpoint.load(BLOCK, {"material.m.law": "mises", "grid.cells": [96, 96], "stop.steps": 5})
        runs.append(stillpoint.Simulation(scene, threads=threads).run().points.stress)
    assert np.array_equal(*runs) and np.abs(runs[0]).max() > 0


if __name__ == "__main__":
    check_the_claim()
