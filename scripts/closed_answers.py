"""Closed answers of scenes, by the scene's [constants]; x: the coordinates along the column.

A confined column x = 0 … l under its own weight, fixed at x = 0:
    P(F(x)) = −ρ g (l − x),   u(x) = ∫₀ˣ (F − 1) dx,   P of the law, in uniaxial strain
"""

import functools
import math

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


def small_strain_column(x, E, nu, rho, g, l, **_):
    """P = M (F − 1)"""
    lam, mu = lame(E, nu)
    return -rho * g / (lam + 2 * mu) * (l * x - x**2 / 2)


def resting_column(x, E, nu, rho, g, l, gap=0.0, w=0.0, **_):
    """P = M (F − 1) of a column that began at x = gap and has come to rest on a floor at x = w."""
    return w - gap + small_strain_column(x - gap, E, nu, rho, g, l)


def column_stress(x, rho, g, l, **_):
    """The Cauchy stress −ρ g (l − x) of any law in uniaxial strain, at ν = 0 and where A stays as it is."""
    return -rho * g * (l - x)


# --- beams -------------------------------------------------------------------------------------------


@functools.cache
def beam_axis(load, stretch, shear, steps=400):
    """[(x, y, θ)] at s = 0 … 1 of a cantilever of length 1 under a load at its end that keeps its direction [Reissner
    1972, J. Appl. Math. Phys. 23:795-804], θ downwards:
        θ'' = −load ((1 + ε) cos θ − γ sin θ),   x' = (1 + ε) cos θ − γ sin θ,   y' = −(1 + ε) sin θ − γ cos θ,
        ε = stretch · load sin θ,   γ = shear · load cos θ,   θ(0) = 0,   θ'(1) = 0
    load = P L²/(EI), stretch = EI/(EA L²), shear = EI/(k G A L²). By the classical Runge–Kutta method, and bisection
    for θ'(0)."""

    def rate(state):
        theta, curvature = state[:2]
        along, across = 1 + stretch * load * math.sin(theta), shear * load * math.cos(theta)
        x = along * math.cos(theta) - across * math.sin(theta)
        return np.array([curvature, -load * x, x, -along * math.sin(theta) - across * math.cos(theta)])

    def shoot(curvature):
        state, h = np.array([0, curvature, 0, 0], dtype=float), 1 / steps
        states = [state]
        for _ in range(steps):
            k1 = rate(state)
            k2 = rate(state + h / 2 * k1)
            k3 = rate(state + h / 2 * k2)
            k4 = rate(state + h * k3)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            states.append(state)
        return np.array(states)

    low, high = 0.0, 1.5 * load + 1
    for _ in range(50):
        middle = (low + high) / 2
        states = shoot(middle)
        low, high = (low, middle) if states[-1, 1] > 0 else (middle, high)
    return states[:, [2, 3, 0]]


def beam(load, s, eta=0.0, stretch=0.0, shear=0.0):
    """(u_x, u_y) of the point at s along the axis, s = 0 … 1, and at eta above it."""
    axis = beam_axis(load, stretch, shear)
    x, y, theta = (np.interp(s, np.linspace(0, 1, len(axis)), column) for column in axis.T)
    return x + eta * math.sin(theta) - s, y + eta * (math.cos(theta) - 1)


OF_A_COLUMN = {
    function.__name__: function
    for function in (small_strain_column, hencky_column, neo_hookean_column, pulled, column_stress)
}
