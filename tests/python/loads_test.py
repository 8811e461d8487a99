#!/usr/bin/python3
"""loads_test.py ROOT CLAIM PACKAGE: one claim about loads written in Python."""

from modules import raised  # first: finds the package

import numpy as np
import stillpoint
from claims import check_the_claim, claim


@claim("a load in Python is the body force of the same formula, bit for bit, and no step asks it again if it stays")
def _(_folder):
    asked = []

    def weight(t, x):
        asked.append(t)
        assert x.ndim == 2 and not np.shares_memory(x, weight.last)
        weight.last = x
        b = np.zeros_like(x)
        b[:, -1] = -10 * (1 + x[:, -1])
        return b

    weight.last = np.zeros(0)
    stillpoint.add_load("weight", weight)
    scene = {"grid": {"min": [0, 0], "max": [1, 2], "cells": [4, 8], "basis": "quadratic"}, "dim": 2,
             "body": {"material": "soil", "state": "plane-strain", "points_per_cell": 4},
             "material": {"soil": {"law": "linear-elastic", "E": 1e5, "nu": 0.3, "rho": 1000}},
             "support": [{"face": "bottom"}], "stop": {"steps": 50, "distance": 0}}
    simulation = stillpoint.Simulation(stillpoint.load(scene, body_force={"own": "weight"}))
    in_set_up = list(asked)
    assert in_set_up[0] == 0
    own = simulation.run()
    assert asked == in_set_up
    formula = stillpoint.Simulation(stillpoint.load(scene, body_force={"value": [0, "-10*(1+y)"]})).run()
    assert own.steps == formula.steps == 50
    assert np.array_equal(own.unknowns.u, formula.unknowns.u) and own.unknowns.u.any()


@claim("what a load in Python raises reaches the caller, and one of a wrong shape or an unknown name is refused")
def _(_folder):
    scene = {"grid": {"min": 0, "max": 1, "cells": 4}, "body": {"material": "bar"},
             "material": {"bar": {"law": "linear-elastic", "E": 1, "rho": 1}}, "support": [{"at": 0}]}

    def broken(t, x):
        if broken.tears:
            raise KeyError("no wind")
        return np.ones_like(x)

    broken.tears = False

    stillpoint.add_load("broken", broken, settles_at=np.inf)
    simulation = stillpoint.Simulation(stillpoint.load(scene, body_force={"own": "broken"}, stop={"time": 10}))
    simulation.step()
    broken.tears = True
    assert "no wind" in str(raised(KeyError, simulation.step))
    broken.tears = False
    stillpoint.add_load("flat", lambda t, x: np.ones(3))
    assert "shape" in str(raised(ValueError, stillpoint.Simulation, stillpoint.load(scene, body_force={"own": "flat"})))
    error = raised(stillpoint.SceneError, stillpoint.load, scene, body_force={"own": "borken"})
    assert "did you mean 'broken'" in str(error)
    raised(ValueError, stillpoint.add_load, "Wind!", broken)
    raised(ValueError, stillpoint.add_load, "wind", broken, settles_at=-1)


@claim("a load in Python that grows although it is said to stay is refused, and accepted if it says so")
def _(_folder):
    scene = {"grid": {"min": 0, "max": 1, "cells": 4}, "body": {"material": "bar"},
             "material": {"bar": {"law": "linear-elastic", "E": 1, "rho": 1}}, "support": [{"at": 0}],
             "body_force": {"own": "growing"}}
    stillpoint.add_load("growing", lambda t, x: 1e-3 * (1 + t) * np.ones_like(x))
    error = raised(stillpoint.SceneError, stillpoint.Simulation, stillpoint.load(scene))
    assert "'growing' is said to settle at t = 0" in str(error)
    stillpoint.add_load("growing", lambda t, x: 1e-3 * (1 + t) * np.ones_like(x), settles_at=np.inf)
    stillpoint.Simulation(stillpoint.load(scene, stop={"time": 1})).step()


check_the_claim()
