"""Material laws of one's own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _core


def add_history_law(
    name: str,
    answer: Callable[..., Any],
    *,
    elastic: Callable[..., Any],
    moduli: Callable[..., Any] | None = None,
    parameters: Mapping[str, float | None] = {},
    history: Sequence[str] = (),
    equation: str = "",
    source: str = "",
) -> None:
    """From now on a material may have law = name, in plane strain, axisymmetric and in space, at large strain.

    The functions are given many points at once, P of them, with n = 4 components xx, yy, zz, xy (axisymmetric rr, zz,
    theta-theta, rz), in space n = 6, xx, yy, zz, xy, yz, zx. The material does not turn as they see it.

        answer(stress, strain, history, dt, parameters) -> (stress, history)
            stress: Cauchy's before the increment (P x n) [Pa], positive in tension; strain: the increment (P x n), with
            engineering shears; history (P x len(history)): 0 at the start; dt: of the increment [s]; parameters: a
            dictionary with the scene's values. Returns both after the increment. It may be asked for the same increment
            again, and for others from the same state: what is to be kept belongs into history.
        elastic(stress, history, parameters) -> (K, G)
            the bulk and the shear modulus under a stress [Pa], for the critical step.
        moduli(stress, strain, history, dt, parameters) -> C
            d stress / d strain of answer() (P x n x n), for Newton's method; None: by differences of answer().

    parameters: the keys that a material has beside rho, with their defaults; None: a scene has to give it. history: names
    of the numbers that a point remembers, which are fields and probes; "" is not shown. NaN as a stress makes the solver
    take a smaller step; what a function raises ends the run and reaches the caller. Python is asked by one thread at a
    time. ValueError if the name is no word of lower-case letters, digits and hyphens, or one of this library's.
    """
    _core.add_history_law(
        name,
        answer,
        elastic,
        moduli,
        parameters=dict(parameters),
        history=list(history),
        equation=equation,
        source=source,
    )
