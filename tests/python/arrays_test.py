#!/usr/bin/python3
"""arrays_test.py ROOT CLAIM PACKAGE: one claim about the arrays of the Python package."""

from modules import BAR, SLOPE, raised  # first: finds the package

import gc

import numpy as np
import stillpoint
from claims import check_the_claim, claim


def address(array):
    return array.__array_interface__["data"][0]


@claim("u and v are views of the state itself, which steps change")
def _(_folder):
    simulation = stillpoint.Simulation(BAR)
    u, v = simulation.unknowns.u, simulation.unknowns.v
    assert address(v) == address(u) + 8 * len(u), "u and v are not the halves of y"
    simulation.step()
    before = u.copy()
    simulation.step()
    assert address(simulation.unknowns.u) == address(u) and address(simulation.unknowns.v) == address(v)
    assert np.any(u != before) and np.array_equal(u, simulation.unknowns.u)


@claim("a view of the unknowns cannot be written to")
def _(_folder):
    simulation = stillpoint.Simulation(BAR)
    for view in simulation.unknowns.u, simulation.unknowns.v[1:]:
        raised(ValueError, view.__setitem__, 0, 1.0)
    raised(ValueError, simulation.unknowns.u.setflags, write=True)


@claim("a view of the unknowns stays when its simulation is gone")
def _(_folder):
    simulation = stillpoint.Simulation(BAR).run()
    u, tail = simulation.unknowns.u, simulation.unknowns.v[-3:]
    kept = u.copy(), tail.copy()
    del simulation
    gc.collect()
    others = [np.full(2 * len(u), 7.0) for _ in range(1000)]  # into what would be free
    assert np.array_equal(u, kept[0]) and np.array_equal(tail, kept[1]) and others


@claim("a view of the unknowns stays as it was when the phase has changed")
def _(_folder):
    simulation = stillpoint.Simulation(stillpoint.load(SLOPE, {"grid.cells": [24, 12]}))
    while simulation.step() and simulation.phases == 1:
        u = simulation.unknowns.u
        last = u.copy()
    assert simulation.phases == 2
    assert address(simulation.unknowns.u) != address(u) and not np.any(simulation.unknowns.u)
    others = [np.full(2 * len(u), 7.0) for _ in range(1000)]
    assert len(u) == len(last) and np.max(np.abs(u)) >= np.max(np.abs(last)) and others
    assert np.max(np.abs(u)) < 1, u


@claim("the points' fields are those of the summary, in their shapes")
def _(_folder):
    simulation = stillpoint.Simulation(BAR).run()
    points, probes = simulation.points, simulation.summary.probes
    assert points.stress.shape == points.displacement.shape == (12,) == (len(points),)
    assert points.displacement[11] == probes.p12.u and points.stress[5] == probes.p6.stress
    assert np.allclose(points.position, points.initial_position + points.displacement, rtol=1e-15)
    assert np.isclose(points.mass.sum(), 10) and np.isclose(points.volume.sum(), 10)
    plane = stillpoint.Simulation(stillpoint.load(SLOPE, {"grid.cells": [8, 4]})).points
    number = len(plane)
    shapes = {"position": (number, 2), "velocity": (number, 2), "strain": (number, 4), "stress": (number, 4)}
    for name, shape in shapes.items():
        assert getattr(plane, name).shape == shape, (name, getattr(plane, name).shape)
    assert plane.plastic_strain.shape == (number,)


@claim("a field that the points do not have is an AttributeError that names those there are")
def _(_folder):
    points = stillpoint.Simulation(BAR).points
    error = raised(AttributeError, getattr, points, "plastic_strain")
    assert "stress" in str(error) and set(dir(points)) >= {"stress", "displacement"}


@claim("the history is the table of history.csv, column by column")
def _(folder):
    simulation = stillpoint.Simulation(BAR, out=folder).run()
    with open(folder / "history.csv", encoding="utf-8") as file:
        columns = file.readline().strip().split(",")
    rows = np.loadtxt(folder / "history.csv", delimiter=",", skiprows=1)
    history = simulation.history
    assert list(history.dtype.names) == columns and len(history) == len(rows) > 10
    assert history["steps"].dtype == np.int64
    for number, name in enumerate(columns):
        assert np.array_equal(history[name], rows[:, number], equal_nan=True), name


@claim("the out-of-balance force vanishes at equilibrium and is refused for what cannot be evaluated")
def _(_folder):
    simulation = stillpoint.Simulation(BAR)
    unknowns = simulation.unknowns
    load = np.linalg.norm(unknowns.residual())
    simulation.run()
    before = simulation.t, simulation.evaluations, simulation.unknowns.u.copy()
    assert np.linalg.norm(unknowns.residual()) < 1e-9 * load
    assert np.array_equal(unknowns.external_force() - unknowns.internal_force(), unknowns.residual())
    assert np.linalg.norm(unknowns.residual(2 * unknowns.u)) > 0.5 * load
    assert (simulation.t, simulation.evaluations) == before[:2] and np.array_equal(unknowns.u, before[2])
    assert np.allclose(unknowns.mass_solve(unknowns.mass_product(np.arange(9.0))), np.arange(9.0))
    raised(ValueError, unknowns.residual, np.zeros(3))
    bent = stillpoint.Simulation(stillpoint.load("problems/neo_hookean_bar.toml"))
    assert "det f" in str(raised(ValueError, bent.unknowns.residual, -1e3 * np.arange(len(bent.unknowns))))


@claim("the tangent is the derivative of the internal force and the mass that of mass_product, as SciPy's sparse matrices")
def _(_folder):
    simulation = stillpoint.Simulation("problems/neo_hookean_bar.toml").run()
    unknowns, n = simulation.unknowns, len(simulation.unknowns)
    K, M = unknowns.tangent(), unknowns.mass_matrix()
    assert K.shape == M.shape == (n, n) and K.nnz < n**2
    du = np.sin(np.arange(n) + 1.0)
    step = 1e-6 * np.max(np.abs(unknowns.u))
    change = (unknowns.internal_force(unknowns.u + step * du) - unknowns.internal_force(unknowns.u - step * du)) / (2 * step)
    assert np.max(np.abs(K @ du - change)) < 1e-6 * np.max(np.abs(change)), (K @ du, change)
    assert np.max(np.abs(M @ du - unknowns.mass_product(du))) < 1e-14 * np.max(np.abs(M @ du))
    assert abs(K - unknowns.tangent(0 * unknowns.u)).max() > 0.01 * abs(K).max(), "K does not depend on u"
    assert abs(unknowns.tangent(elastic=True) - K).max() == 0, "an elastic bar has another elastic tangent"
    raised(ValueError, unknowns.tangent, np.zeros(3))


@claim("SciPy's newton_krylov solves R(u) = F through the package")
def _(_folder):
    from scipy.optimize import newton_krylov

    simulation = stillpoint.Simulation("problems/neo_hookean_bar.toml")
    unknowns = simulation.unknowns
    scale = np.max(np.abs(unknowns.external_force()))
    u = newton_krylov(lambda x: unknowns.residual(x) / scale, np.zeros(len(unknowns)), f_tol=1e-10)
    simulation.run()
    assert simulation.status == "equilibrium", simulation.reason
    assert np.max(np.abs(u - unknowns.u)) < 1e-6 * np.max(np.abs(u)), (u, unknowns.u)
    assert np.max(np.abs(u)) > 0.01


check_the_claim()
