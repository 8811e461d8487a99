"""The infinite plate with a round hole under tension, as scripts/beside_fem cuts a quarter out of it."""

import numpy as np

TENSION, HOLE, SIDE = 1e-3, 1.0, 4.0  # as in problems/ladder/kirsch.toml


def outer_radius(angle):
    """From the origin to the square's border."""
    return SIDE / np.maximum(np.cos(angle), np.sin(angle))


def place(s):
    """Along rays from the hole (s_0 = 0) to the square's sides (s_0 = 1), the corner at s_1 = 1/2."""
    angle = np.pi / 2 * s[:, 1]
    r = HOLE + (outer_radius(angle) - HOLE) * s[:, 0]
    return r[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def even(s):
    """As many places in each part of the area: below the angle θ ≤ π/4 it is (SIDE² tan θ − HOLE² θ)/2, and the other half
    of the plate is the image of this one."""
    half = np.abs(2 * s[:, 1] - 1)  # of the area from the diagonal on
    share = 1 - half
    whole = SIDE**2 - HOLE**2 * np.pi / 4
    angle = np.pi / 4 * share
    for _ in range(20):  # Newton's method: convex and increasing
        angle -= (SIDE**2 * np.tan(angle) - HOLE**2 * angle - share * whole) / (SIDE**2 / np.cos(angle) ** 2 - HOLE**2)
    outer = SIDE / np.cos(angle)
    r = np.sqrt(HOLE**2 + (outer**2 - HOLE**2) * s[:, 0])
    angle = np.where(s[:, 1] > 0.5, np.pi / 2 - angle, angle)
    return np.stack([(r - HOLE) / (outer - HOLE), angle / (np.pi / 2)], axis=1)


def potentials(x):
    """z, φ, φ', φ'', ψ, ψ' of Kirsch's plate [Muskhelishvili 1953, art. 56a]:
    φ = S/4 (z + 2 a²/z),   ψ = −S/2 (z + a²/z − a⁴/z³)"""
    z = x[:, 0] + 1j * x[:, 1]
    q = HOLE**2
    phi = TENSION / 4 * (z + 2 * q / z), TENSION / 4 * (1 - 2 * q / z**2), TENSION * q / z**3
    psi = -TENSION / 2 * (z + q / z - q**2 / z**3), -TENSION / 2 * (1 - q / z**2 + 3 * q**2 / z**4)
    return z, *phi, *psi


def displacement(x, law):
    """2 μ (u + i v) = κ φ − z conj(φ') − conj(ψ), κ = 3 − 4 ν in plane strain"""
    z, phi, slope, _, psi, _ = potentials(x)
    w = ((3 - 4 * law.nu) * phi - z * slope.conj() - psi.conj()) / (2 * law.lame[1])
    return np.stack([w.real, w.imag], axis=1)


def gradient(x, law):
    z, _, slope, bend, _, of_psi = potentials(x)
    kappa = 3 - 4 * law.nu
    along = (kappa * slope - slope.conj() - z * bend.conj() - of_psi.conj()) / (2 * law.lame[1])
    up = 1j * (kappa * slope - slope.conj() + z * bend.conj() + of_psi.conj()) / (2 * law.lame[1])
    return np.stack([np.stack([along.real, up.real], axis=1), np.stack([along.imag, up.imag], axis=1)], axis=1)
