"""Closed answers of scenes with large strain, by the scene's [constants]; x: the coordinates along the column.

A confined column x = 0 … l under its own weight, fixed at x = 0:
    P(F(x)) = −ρ g (l − x),   u(x) = ∫₀ˣ (F − 1) dx,   P of the law, in uniaxial strain
"""

import numpy as np

GAUSS = np.polynomial.legendre.leggauss(12)
PANELS = 32


def lame(E, nu):
    return E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))


def stretch(P, slope, load):
    """F with P(F) = load, load ≤ 0, by Newton's method from 1, halved where it would leave 0 < F ≤ 1."""
    F = np.ones_like(load)
    for _ in range(200):
        step = (P(F) - load) / slope(F)
        while np.any(outside := (F - step <= 0) | (F - step > 1)):
            step = np.where(outside, step / 2, step)
            if np.abs(step[outside]).max() < 1e-14:
                break
        F = F - step
        if np.abs(step).max() < 1e-15:
            break
    return F


def column(x, P, slope, weight, l):
    """u at x; weight = ρ g."""
    edges = x[:, None] * np.linspace(0, 1, PANELS + 1)
    middle, half = (edges[:, 1:] + edges[:, :-1]) / 2, (edges[:, 1:] - edges[:, :-1]) / 2
    Y = middle[..., None] + half[..., None] * GAUSS[0]
    return ((stretch(P, slope, -weight * (l - Y)) - 1) @ GAUSS[1] * half).sum(axis=1)


def hencky_column(x, E, nu, rho, g, l, **_):
    """P = M ln F/F with M = λ + 2 μ: F = −W(s)/s with s = ρ g (l − x)/M, a branch that has no end."""
    lam, mu = lame(E, nu)
    M = lam + 2 * mu
    return column(x, lambda F: M * np.log(F) / F, lambda F: M * (1 - np.log(F)) / F**2, rho * g, l)


def neo_hookean_column(x, E, nu, rho, g, l, **_):
    """P = μ (F − 1/F) + λ ln F/F"""
    lam, mu = lame(E, nu)
    return column(
        x,
        lambda F: mu * (F - 1 / F) + lam * np.log(F) / F,
        lambda F: mu * (1 + 1 / F**2) + lam * (1 - np.log(F)) / F**2,
        rho * g,
        l,
    )


def pulled(x, F, **_):
    """Stretched by F along x."""
    return (F - 1) * x
