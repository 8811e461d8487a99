"""A scene unlike those of the stability map, with what is known of its answer; and what such scenes have in common."""

import copy
import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

BASES = ["linear", "quadratic", "cubic"]
IN_TIME = [
    "viscous", "one-sided", "cundall", "combined", "kinetic", "adaptive", "papadrakakis", "fire", "fire2", "chebyshev",
    "nesterov", "auto", "erk:rk4/viscous", "symplectic-euler/viscous", "erk:bogacki-shampine-4-2-3:adaptive/viscous",
]  # fmt: skip
STATIC = ["newton", "newton-cg", "cg", "lbfgs"]


@dataclass
class Unlike:
    """A scene, the ways to rest that have to find the same equilibrium, and how that is known."""

    scene: dict
    ways: list[str]
    never: str = ""  # why there is no equilibrium at all
    answer: dict | None = None  # a scene with the same equilibrium, for Newton's method
    exact: Callable | None = None  # u (n, 3) of the points by their places X (n, 3) at the start
    tolerance: float = 1e-6  # of u against the answer, over what it is beside `moved`
    unique: float = 1e-6  # of u among the ways; 0: they need not agree
    of_cell: float = 0.0  # what u may be off by whatever it is, as a root of the mean square, over the cell's width
    components: tuple[int, ...] = (0, 1, 2)  # of u that are judged
    moved: float = 0.0  # along the last coordinate: a rigid motion that is none of the displacement that is judged
    cell: float = 1.0  # along it
    touching: dict[str, float] = field(default_factory=dict)  # u along it, by the names of probes on a wall
    above: dict[str, tuple[int, float]] = field(default_factory=dict)  # probe: component, the least that it may be
    factor: float | None = None  # the limit load of [load]
    strong: bool = False  # no point may bear more than its law allows: f ≤ 0
    squeezed: bool = False  # an equilibrium at large strain in a single phase says so where it says that it is one
    notes: str = ""  # what a note has to say that excuses a wrong answer
    says: str = ""  # what a refusal has to say
    needed: bool = False  # it has an answer that the program has to be able to find: no refusal is right


# --- text ----------------------------------------------------------------------------------------------


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {text_of(part)}" for key, part in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(text_of, value)) + "]"
    return f"{value:.10g}"


def toml(scene, path=""):
    """Plain values before tables, as TOML asks for."""
    lines, tables = [], []
    for key, value in scene.items():
        name = f"{path}{key}"
        if isinstance(value, dict):
            only_tables = value and all(isinstance(part, dict) for part in value.values())
            tables.append(("" if only_tables else f"[{name}]\n", value, name))
        elif isinstance(value, list) and value and all(isinstance(part, dict) for part in value):
            tables += [(f"[[{name}]]\n", part, name) for part in value]
        else:
            lines.append(f"{key} = {text_of(value)}\n")
    return "".join(lines) + "".join(f"\n{head}{toml(part, f'{name}.')}" for head, part, name in tables)


# --- pieces --------------------------------------------------------------------------------------------


def rounded(value, digits=4):
    """What a scene's text will say."""
    return float(f"{value:.{digits}g}")


def log_uniform(r, low, high):
    return rounded(low * (high / low) ** r.random())


def uniform(r, low, high):
    return rounded(r.uniform(low, high))


def material(r, law, nu=None, E=None):
    nu = r.choice([0.0, 0.2, 0.3, 0.45]) if nu is None else nu
    return {"law": law, "E": E or log_uniform(r, 1, 1e8), "nu": nu, "rho": log_uniform(r, 0.1, 1e4)}


def confined_modulus(m):
    return m["E"] * (1 - m["nu"]) / ((1 + m["nu"]) * (1 - 2 * m["nu"]))


def wave_time(m, length):
    """What a wave takes along it; the lowest period is about four times as long."""
    return length * math.sqrt(m["rho"] / confined_modulus(m))


def points_of(r, basis, dim):
    """A cell's, as many as the basis asks for or more."""
    least = {"linear": 2, "quadratic": 2, "cubic": 3}[basis]
    return [least + r.choice([0, 0, 1])] * dim if dim < 3 else [least] * dim


def grid(size, cells, basis):
    return {"min": [0.0] * len(size), "max": list(size), "cells": list(cells), "basis": basis}


def base_scene(dim, size, cells, basis, body, m, state):
    """A body of one material, without what holds and loads it. Lines have plain numbers in the place of arrays."""
    scene = {
        "dim": dim,
        "grid": grid(size, cells, basis),
        "body": {"material": "m", "state": state} | body,
        "material": {"m": dict(m)},
        "mass": {"kind": "lumped"},
        "phase": {"max_motion": "none"},
        "damping": {"strategy": "viscous"},
        "stop": {"residual": 1e-10, "steps": 15000},
    }
    if dim == 1:
        for table, keys in (("grid", ("min", "max", "cells")), ("body", ("min", "max", "points_per_cell"))):
            for key in keys:
                if key in scene[table]:
                    scene[table][key] = scene[table][key][0]
    return scene


def changed(scene, **tables):
    """A copy with these tables in the place of its own; None takes one away."""
    other = copy.deepcopy(scene)
    for key, value in tables.items():
        if value is None:
            other.pop(key, None)
        else:
            other[key] = value
    return other


def settled(height, m, g, base=0.0, up=0.0, axis=1):
    """u of a confined column of small strain under its own weight, whose base comes to rest `up` from where it was."""

    def u(X):
        y, field_ = X[:, axis] - base, np.zeros_like(X)
        field_[:, axis] = up - m["rho"] * g / confined_modulus(m) * (height * y - y**2 / 2)
        return field_

    return u


def some(r, ways, count):
    """In their order."""
    taken = set(r.sample(ways, min(count, len(ways))))
    return [way for way in ways if way in taken]


def ways_of(r, ways, all_ways, count=3):
    return ways if all_ways else some(r, ways, count)
