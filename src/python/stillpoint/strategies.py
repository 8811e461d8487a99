"""Dampings, loads and relaxations of one's own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Force = Callable[["NDArray[np.float64]", "NDArray[np.float64]", float], "ArrayLike"]


def add_damping(
    name: str, force: Force, *, stiffness_factor: float = 1.0, equation: str = "", source: str = ""
) -> None:
    """From now on damping.strategy = name is M a = Q + D with D = force(v, Q, alpha), alpha that of the scene.

    v, Q, D: (n), all free degrees of freedom at once, or some oscillators by which the critical step is found; D[i] is of
    v[i] and Q[i] alone. stiffness_factor: the largest |Q + D|/|Q|, at least 1: the critical step sees the stiffness grow
    by it. In the place of one of that name that was added before. What force() raises ends the step and reaches the caller. ValueError if the name is no word of
    lower-case letters, digits and hyphens, or one of this library's.
    """
    _core.add_damping(name, force, stiffness_factor=stiffness_factor, equation=equation, source=source)


def add_load(
    name: str, force: Callable[[float, NDArray[np.float64]], ArrayLike], *, settles_at: float = 0.0
) -> None:
    """From now on body_force.own = name is a force per mass b = force(t, x) [m/s2], beside body_force.value or alone.

    t [s]; x (points x dim): the positions that all points have as a phase begins [m], in any order; b likewise. settles_at:
    from when on it is what it will be at the end [s]: no equilibrium is found before. 0: it depends on position alone, and is
    asked once a phase; math.inf: it may change until stop.time. In the place of one of that name that was added before. What
    force() raises ends the step and reaches the caller. ValueError if the name is no word of lower-case letters, digits and
    hyphens, or settles_at is negative.
    """
    _core.add_load(name, force, settles_at=settles_at)


def add_relaxation(
    name: str, make: Callable[[], Any], *, needs_omega_1: bool = False, equation: str = "", source: str = ""
) -> None:
    """From now on damping.strategy = name is an iteration in the place of leapfrog's step, one force evaluation each.

    make() is called when a phase begins, and returns an object with

        propose(h, motion, u_new, v_new)    writes the state after a step h [s] from motion, (n) each, or returns it as a
                                            pair; asked again with a shorter h if that cannot be evaluated
        moved(h, motion)                    the proposal has become the state; may be left out
        restart(motion)                     a phase begins, or a contact changed v; may be left out

    or a function that is propose() itself. motion: Motion. Attributes of the object that are numbers, strings, None or
    arrays of numbers are saved in checkpoints. What it raises ends the step and reaches the caller, and the state is that
    before the step, or after it if moved() did. ValueError as add_damping().
    """
    _core.add_relaxation(name, make, needs_omega_1=needs_omega_1, equation=equation, source=source)
