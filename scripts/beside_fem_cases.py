"""The cases of scripts/beside_fem: bodies, places at which both programs are read, exact answers.

Everything that both programs have to agree on stands here once: the body as the image of a unit square or cube, its
material, its supports, and the exact u and σ. What FEniCSx is given besides, loads as forms, is in fem_forms.py; what
Stillpoint is given is a scene of problems/, or of ring_scene.py.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

import kirsch_plate
import numpy as np

PLACES = {2: 1000, 3: 200}  # at which both programs are read, by dimension
REFERENCES = Path(__file__).resolve().parent.parent / "build/beside_fem"  # of fem_reference.py


@dataclass(frozen=True)
class Support:
    """The plane x_axis = at, on which these components of u are 0."""

    axis: int
    at: float
    components: tuple[int, ...]


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
    scene: str  # below problems/; "" of ring_scene.py
    law: Law
    dim: int
    place: Callable  # (n, dim) parameters in the unit square or cube -> (n, dim) positions
    even: Callable  # (n, dim) of the unit square or cube -> parameters, evenly over the body
    supports: tuple[Support, ...]
    u: Callable  # positions (n, dim) -> (n, dim)
    gradient: Callable  # positions (n, dim) -> ∂u/∂x (n, dim, dim)
    aspect: tuple[float, ...]  # how many cells of the finite elements along each parameter, relative
    residual: float = 1e-9  # ‖F − R‖/‖F‖ at which iterations of both programs end
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


# --- a vortex at large strain --------------------------------------------------------------------------


def vortex_angle(R2, A=1.0, w=1.5, n=4):
    """α and dα/d(R²) of problems/ladder/vortex_disc.toml: α = A (1 − R²/w²)ⁿ inside, 0 beyond."""
    q = np.maximum(1 - R2 / w**2, 0)
    return A * q**n, -n * A / w**2 * q ** (n - 1)


def turned(angle, x):
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1]], axis=1)


def vortex_u(x):
    return turned(vortex_angle((x**2).sum(axis=1))[0], x) - x


def vortex_gradient(x):
    """F = Q + dQ/dα X ⊗ ∇α,   ∇α = 2 X dα/d(R²)"""
    angle, slope = vortex_angle((x**2).sum(axis=1))
    c, s = np.cos(angle), np.sin(angle)
    Q = np.stack([np.stack([c, -s], axis=1), np.stack([s, c], axis=1)], axis=1)
    across = turned(angle + np.pi / 2, x)  # dQ/dα X
    return Q + np.einsum("ni,nj->nij", across, 2 * slope[:, None] * x) - np.eye(2)


VORTEX = Case(
    "vortex",
    "A vortex at large strain on a fitted grid",
    "ladder/vortex_disc.toml",
    Law(1000.0, 0.3, large_strain=True),
    2,
    place=lambda s: 3 * s - 1.5,
    even=same,
    supports=walls(2, -1.5, 1.5, lambda axis: (0, 1)),
    u=vortex_u,
    gradient=vortex_gradient,
    aspect=(1, 1),
)


# --- Lamé's cylinder -----------------------------------------------------------------------------------

PRESSURE, INNER, OUTER = 1e-3, 1.0, 2.0
RING_LAW = Law(1.0, 0.3)


def ring_place(s):
    r, angle = INNER + (OUTER - INNER) * s[:, 0], np.pi / 2 * s[:, 1]
    return np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)


def ring_even(s):
    r = np.sqrt(INNER**2 + (OUTER**2 - INNER**2) * s[:, 0])
    return np.stack([(r - INNER) / (OUTER - INNER), s[:, 1]], axis=1)


def ring_factors():
    """u = (A + B/r²) x, by Lamé [Timoshenko and Goodier 1970, art. 28]:
    A = k (1 + ν)(1 − 2ν)/E, B = k (1 + ν) b²/E, k = p a²/(b² − a²)"""
    k = PRESSURE * INNER**2 / (OUTER**2 - INNER**2) * (1 + RING_LAW.nu) / RING_LAW.E
    return k * (1 - 2 * RING_LAW.nu), k * OUTER**2


def ring_u(x):
    A, B = ring_factors()
    return (A + B / (x**2).sum(axis=1))[:, None] * x


def ring_gradient(x):
    A, B = ring_factors()
    r2 = (x**2).sum(axis=1)[:, None, None]
    return (A + B / r2) * np.eye(2) - 2 * B / r2**2 * np.einsum("ni,nj->nij", x, x)


RING = Case(
    "lame",
    "Lamé's thick cylinder in plane strain, cut out of the grid",
    "",
    RING_LAW,
    2,
    place=ring_place,
    even=ring_even,
    supports=(Support(0, 0.0, (0,)), Support(1, 0.0, (1,))),
    u=ring_u,
    gradient=ring_gradient,
    aspect=(1, 2.36),
    curved=True,
    fitted=False,
    filled=np.pi * 3 / 16,
)


# --- a plate with a hole -------------------------------------------------------------------------------

PLATE_LAW = Law(1.0, 0.3)
PLATE = Case(
    "kirsch",
    "A plate with a round hole under tension, cut out of the grid",
    "ladder/kirsch.toml",
    PLATE_LAW,
    2,
    place=kirsch_plate.place,
    even=kirsch_plate.even,
    supports=(Support(0, 0.0, (0,)), Support(1, 0.0, (1,))),
    u=lambda x: kirsch_plate.displacement(x, PLATE_LAW),
    gradient=lambda x: kirsch_plate.gradient(x, PLATE_LAW),
    aspect=(1, 2),  # a line of the mesh runs to the corner
    curved=True,
    fitted=False,
    filled=1 - np.pi / 64,
)

# --- a cube --------------------------------------------------------------------------------------------

CUBE_AMPLITUDES = np.array([0.01, -0.004, 0.007])


def cube_u(x):
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    return CUBE_AMPLITUDES * np.stack([s[:, i] * c[:, i - 2] * c[:, i - 1] for i in range(3)], axis=1)


def cube_gradient(x):
    s, c = np.sin(np.pi * x), np.cos(np.pi * x)
    H = np.empty((len(x), 3, 3))
    for i in range(3):
        for j in range(3):
            # u_i = A_i s_i c_j c_k
            k = 3 - i - j
            slope = c[:, 0] * c[:, 1] * c[:, 2] if i == j else -s[:, i] * s[:, j] * c[:, k]
            H[:, i, j] = np.pi * CUBE_AMPLITUDES[i] * slope
    return H


CUBE = Case(
    "cube",
    "A block in space under a smooth load",
    "ladder/mms_cube.toml",
    Law(1.0, 0.3),
    3,
    place=same,
    even=same,
    supports=walls(3, 0.0, 1.0, lambda axis: (axis,)),
    u=cube_u,
    gradient=cube_gradient,
    aspect=(1, 1, 1),
    grid=(1.0, 1.0, 1.0),
    residual=1e-6,
)

# --- Cook's membrane -----------------------------------------------------------------------------------

COOK_LOAD = 1 / 16  # F/16 along y on the right side


def cook_place(s):
    low, high = 44 * s[:, 0], 44 + 16 * s[:, 0]
    return np.stack([48 * s[:, 0], low + (high - low) * s[:, 1]], axis=1)


def cook_even(s):
    """The height is 44 − 28 ξ: as many places on each side of a line if ξ solves (44 ξ − 14 ξ²)/30 = s. Those closer than 4
    to the clamped corners, where the stress has no bound, are moved along the line of their height to x = 4."""
    along = (44 - np.sqrt(44**2 - 4 * 14 * 30 * s[:, 0])) / 28
    x = cook_place(np.stack([along, s[:, 1]], axis=1))
    close = np.minimum(np.hypot(x[:, 0], x[:, 1]), np.hypot(x[:, 0], x[:, 1] - 44)) < 4
    return np.stack([np.where(close, 4 / 48, along), s[:, 1]], axis=1)


@cache
def referred(name):
    """What fem_reference.py found for a case without a closed form."""
    with np.load(REFERENCES / f"{name}.npz") as found:
        return {key: found[key] for key in found.files}


def cook(name, title, nu, settings=()):
    return Case(
        name,
        title,
        "ladder/cook.toml",
        Law(1.0, nu),
        2,
        place=cook_place,
        even=cook_even,
        supports=(Support(0, 0.0, (0, 1)),),
        u=lambda x: referred(name)["u"],
        gradient=lambda x: referred(name)["gradient"],
        aspect=(1, 1),
        fitted=False,
        filled=0.5,
        grid=(4.0, 5.0),
        settings=(f"constants.nu={nu}", "body.placement=gauss", *settings),
        dilatation=nu > 0.49,
        reference=True,
        read=((1.0, 0.5), 1),
    )


COOK = cook("cook", "Cook's membrane, ν = 0.3, cut out of the grid", 0.3)
COOK_INCOMPRESSIBLE = cook("cook_incompressible", "Cook's membrane, ν = 0.4999, cut out of the grid", 0.4999)

CASES = {case.name: case for case in (VORTEX, RING, PLATE, COOK, COOK_INCOMPRESSIBLE, CUBE)}
