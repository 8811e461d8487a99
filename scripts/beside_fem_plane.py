"""The cases of scripts/beside_fem in plane strain."""

import kirsch_plate
import numpy as np
from beside_fem_case import Case, Law, Support, referred, same, walls

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
        residual=1e-8 if nu > 0.49 else 1e-9,  # of forces that all but cancel
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

# --- a beam that is bent to an elastica ----------------------------------------------------------------

# As in problems/ladder/elastica.toml with load = 5: E I = h³, so that P = 5 h³/L².
BEAM_LENGTH, BEAM_DEPTH = 10.0, 0.2
BEAM_LOAD = 5 * BEAM_DEPTH**3 / BEAM_LENGTH**2

ELASTICA = Case(
    "elastica",
    "A slender beam bent to an elastica by a load of 5 E I/L²",
    "ladder/elastica.toml",
    Law(12.0, 0.0, large_strain=True),
    2,
    place=lambda s: s * [BEAM_LENGTH, BEAM_DEPTH],
    even=same,
    supports=(Support(0, 0.0, (0, 1)),),
    u=lambda x: referred("elastica")["u"],
    gradient=lambda x: referred("elastica")["gradient"],
    aspect=(1, 0.04),
    steps=10,
    grid=(25.0, 1.0),
    residual=1e-8,
    settings=("constants.load=5", "material.beam.law=neo-hookean"),
    reference=True,
    read=((1.0, 0.5), 1),
)
