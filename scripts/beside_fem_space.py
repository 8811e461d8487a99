"""The cases of scripts/beside_fem in space."""

import numpy as np
from beside_fem_case import Case, Law, Support, same, walls

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

# --- a square bar in torsion ---------------------------------------------------------------------------

HALF_SIDE, LENGTH, TWIST = 0.5, 2.0, 1e-3  # a quarter of the section; the angle by length
TERMS = 1000


def warping(x):
    """ψ, ψ_y and ψ_z of a square section with the side a [Timoshenko and Goodier 1970, art. 109]:
    ψ = y z − 8 a²/π³ Σ_{n odd} (−1)^((n−1)/2) sin(nπ y/a) sinh(nπ z/a)/(n³ cosh(nπ/2))"""
    a, n = 2 * HALF_SIDE, 2 * np.arange(TERMS) + 1
    y, z = x[:, 1], x[:, 2]
    k, sign = n * np.pi / a, (-1.0) ** np.arange(TERMS)
    up, down = np.exp(np.outer(z - a / 2, k)), np.exp(-np.outer(z + a / 2, k))
    sinh, cosh = (up - down) / (1 + np.exp(-k * a)), (up + down) / (1 + np.exp(-k * a))  # over cosh(nπ/2)
    factor, phase = 8 * a**2 / np.pi**3 * sign / n**3, np.outer(y, k)
    return (
        y * z - (np.sin(phase) * sinh) @ factor,
        z - (np.cos(phase) * sinh) @ (factor * k),
        y - (np.sin(phase) * cosh) @ (factor * k),
    )


def torsion_u(x):
    """(α ψ, −α x z, α x y) [Saint-Venant 1855]"""
    return TWIST * np.stack([warping(x)[0], -x[:, 0] * x[:, 2], x[:, 0] * x[:, 1]], axis=1)


def torsion_gradient(x):
    H = np.zeros((len(x), 3, 3))
    _, H[:, 0, 1], H[:, 0, 2] = warping(x)
    H[:, 1, 0], H[:, 1, 2] = -x[:, 2], -x[:, 0]
    H[:, 2, 0], H[:, 2, 1] = x[:, 1], x[:, 0]
    return TWIST * H


def turned_end(x):
    return TWIST * x[:, :1] * np.stack([-x[:, 2], x[:, 1]], axis=1)


TORSION = Case(
    "torsion",
    "A square bar in torsion: a quarter of it, whose ends are turned and warp freely",
    "",
    Law(1.0, 0.3),
    3,
    place=lambda s: s * [LENGTH, HALF_SIDE, HALF_SIDE],
    even=same,
    supports=(
        Support(0, 0.0, (1, 2)),
        Support(0, LENGTH, (1, 2), turned_end),
        Support(1, 0.0, (0, 2)),
        Support(2, 0.0, (0, 1)),
    ),
    u=torsion_u,
    gradient=torsion_gradient,
    aspect=(1, 1, 1),
    grid=(1.0, 1.0, 1.0),
    residual=1e-6,
    fem_residual=1e-10,
)

# --- Lamé's sphere -------------------------------------------------------------------------------------

# Small, since Stillpoint's pressure follows the wall.
SPHERE_PRESSURE, SPHERE_INNER, SPHERE_OUTER = 1e-9, 1.0, 2.0
SPHERE_LAW = Law(1.0, 0.3)


def sphere_place(parameters):
    """An eighth of a shell in three blocks: in the k-th x_k is the largest coordinate, and the angles to its axis in the
    two planes beside it are even."""
    block = np.minimum(parameters[:, 0] // 2, 2).astype(int)
    r = SPHERE_INNER + (SPHERE_OUTER - SPHERE_INNER) * (parameters[:, 0] - 2 * block)
    sides = np.tan(np.pi / 4 * parameters[:, 1:])
    direction, every = np.ones((len(parameters), 3)), np.arange(len(parameters))
    direction[every, block - 2], direction[every, block - 1] = sides[:, 0], sides[:, 1]
    return r[:, None] * direction / np.linalg.norm(direction, axis=1)[:, None]


def sphere_even(s):
    """Directions evenly over an eighth of a sphere, radii evenly by volume."""
    r = np.cbrt(SPHERE_INNER**3 + (SPHERE_OUTER**3 - SPHERE_INNER**3) * s[:, 0])
    angle, across, every = np.pi / 2 * s[:, 1], np.sqrt(1 - s[:, 2] ** 2), np.arange(len(s))
    direction = np.stack([across * np.cos(angle), across * np.sin(angle), s[:, 2]], axis=1)
    block = direction.argmax(axis=1)
    sides = np.stack([direction[every, block - 2], direction[every, block - 1]], axis=1) / direction[every, block][:, None]
    along = 2 * block + (r - SPHERE_INNER) / (SPHERE_OUTER - SPHERE_INNER)
    return np.concatenate([along[:, None], 4 / np.pi * np.arctan(sides)], axis=1)


def sphere_factors():
    """u = (A + B/r³) x, by Lamé [Timoshenko and Goodier 1970, art. 136]:
    K = p a³/(b³ − a³),   A = K (1 − 2ν)/E,   B = K (1 + ν) b³/(2 E)"""
    K = SPHERE_PRESSURE * SPHERE_INNER**3 / (SPHERE_OUTER**3 - SPHERE_INNER**3)
    return K * (1 - 2 * SPHERE_LAW.nu) / SPHERE_LAW.E, K * (1 + SPHERE_LAW.nu) * SPHERE_OUTER**3 / (2 * SPHERE_LAW.E)


def sphere_u(x):
    A, B = sphere_factors()
    return (A + B / (x**2).sum(axis=1) ** 1.5)[:, None] * x


def sphere_gradient(x):
    A, B = sphere_factors()
    r = np.sqrt((x**2).sum(axis=1))[:, None, None]
    return (A + B / r**3) * np.eye(3) - 3 * B / r**5 * np.einsum("ni,nj->nij", x, x)


SPHERE = Case(
    "sphere",
    "Lamé's thick sphere, an eighth of it, cut out of the grid",
    "thick_sphere.toml",
    SPHERE_LAW,
    3,
    place=sphere_place,
    even=sphere_even,
    supports=tuple(Support(axis, 0.0, (axis,)) for axis in range(3)),
    u=sphere_u,
    gradient=sphere_gradient,
    aspect=(1, 1, 1),
    blocks=3,
    curved=True,
    fitted=False,
    filled=np.pi / 6 * (1 - SPHERE_INNER**3 / SPHERE_OUTER**3),
    grid=(1.0, 1.0, 1.0),
    residual=1e-6,
)
