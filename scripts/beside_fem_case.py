"""What a case of scripts/beside_fem is: a body, the places at which both programs are read, an exact answer.

Everything that both programs have to agree on stands here once: the body as the image of a unit square or cube, its
material, its supports, and the exact u and σ. What FEniCSx is given besides, loads as forms, is in fem_forms.py; what
Stillpoint is given is a scene of problems/, or one that beside_fem_scenes.py writes.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import numpy as np

PLACES = {2: 1000, 3: 200}  # at which both programs are read, by dimension
REFERENCES = Path(__file__).resolve().parent.parent / "build/beside_fem"  # of fem_reference.py


@dataclass(frozen=True)
class Support:
    """The plane x_axis = at, on which these components of u are 0, or value."""

    axis: int
    at: float
    components: tuple[int, ...]
    value: Callable | None = None  # positions (n, dim) -> (n, len(components))


@dataclass(frozen=True)
class Law:
    E: float
    nu: float
    large_strain: bool = False  # neo-Hookean, P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ; or linear elastic

    @property
    def lame(self):
        return self.E * self.nu / ((1 + self.nu) * (1 - 2 * self.nu)), self.E / (2 * (1 + self.nu))

    def stress(self, gradient):
        """The Cauchy stress (n, 3, 3) of displacement gradients (n, dim, dim); plane strain if dim is 2."""
        H = np.zeros((len(gradient), 3, 3))
        dim = gradient.shape[1]
        H[:, :dim, :dim] = gradient
        lam, mu = self.lame
        eye = np.eye(3)
        if not self.large_strain:
            return lam * np.trace(H, axis1=1, axis2=2)[:, None, None] * eye + mu * (H + H.transpose(0, 2, 1))
        F = eye + H
        J = np.linalg.det(F)[:, None, None]
        return (mu * (F @ F.transpose(0, 2, 1) - eye) + lam * np.log(J) * eye) / J


@dataclass(frozen=True)
class Case:
    name: str
    title: str
    scene: str  # below problems/; "" of beside_fem_scenes.py
    law: Law
    dim: int
    place: Callable  # (n, dim) parameters in the unit square or cube -> (n, dim) positions; of blocks see below
    even: Callable  # (n, dim) of the unit square or cube -> parameters, evenly over the body
    supports: tuple[Support, ...]
    u: Callable  # positions (n, dim) -> (n, dim)
    gradient: Callable  # positions (n, dim) -> ∂u/∂x (n, dim, dim)
    aspect: tuple[float, ...]  # how many cells of the finite elements along each parameter, relative
    blocks: int = 1  # images of the unit cube; of the k-th the first parameter lies between 2 k and 2 k + 1
    steps: int = 1  # of the load, by Newton's method of finite elements
    residual: float = 1e-9  # ‖F − R‖/‖F‖ at which iterations of both programs end
    # Of finite elements where the loads are displacements: their right side is K times these, far larger than the reactions.
    fem_residual: float | None = None
    curved: bool = False  # whether elements of order 2 follow a curved border
    fitted: bool = True  # whether cells of the grid end where the body does
    filled: float = 1.0  # share of the grid that the body fills
    grid: tuple[float, ...] = (1.0, 1.0)  # cells of the grid along each axis, relative
    settings: tuple[str, ...] = field(default=())  # of the scene in each run
    dilatation: bool = False  # whether Stillpoint's cells, or splines, share their change of volume
    reference: bool = False  # no closed form: u and its gradient are those of fem_reference.py
    read: tuple[tuple[float, ...], int] | None = None  # parameters of a place, and the component of u that is read there

    def parameters(self, count=None):
        """Those of the places at which both programs are read, or of as many as are asked for."""
        return self.even(spread(count or PLACES[self.dim], self.dim))

    def stress(self, x):
        return self.law.stress(self.gradient(x))

    def value_error(self, value):
        """Of what the case reads of u, relative."""
        return {"value": abs(value / float(referred(self.name)["read"]) - 1)}


def spread(count, dim):
    """Places (count, dim) that fill the unit square or cube evenly, on no grid [Roberts 2018, the R sequence]:
    x_k = (½ + k/φ, ½ + k/φ², …) mod 1 with φ^(dim+1) = φ + 1."""
    phi = 1.5
    for _ in range(100):
        phi = (1 + phi) ** (1 / (dim + 1))
    return (0.5 + np.outer(np.arange(1, count + 1), phi ** -np.arange(1.0, dim + 1))) % 1


def same(s):
    return s


def walls(dim, low, high, components):
    """Supports on all sides of a box; components(axis): which of u are 0 there."""
    return tuple(Support(axis, at, components(axis)) for axis in range(dim) for at in (low, high))


@cache
def referred(name):
    """What fem_reference.py found for a case without a closed form."""
    with np.load(REFERENCES / f"{name}.npz") as found:
        return {key: found[key] for key in found.files}
