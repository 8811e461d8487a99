#!/usr/bin/python3
"""beside_fem_cases_test.py ROOT CLAIM: one claim about the cases of scripts/beside_fem.py of the source tree ROOT."""

import math
import tomllib

from claims import check_the_claim, claim, script_module

np = script_module("numpy")


def cases_with_a_closed_form():
    return [case for case in script_module("beside_fem_cases").CASES.values() if not case.reference]


@claim("the gradient of each case is that of its displacement, by differences")
def _(_folder):
    for case in cases_with_a_closed_form():
        x, h = case.place(case.parameters(50)), 1e-6
        steps = h * np.eye(case.dim)
        slopes = np.stack([(case.u(x + step) - case.u(x - step)) / (2 * h) for step in steps], axis=2)
        assert np.abs(slopes - case.gradient(x)).max() < 1e-7 * max(1, np.abs(slopes).max()), case.name


@claim("the displacement of each case is where its supports hold it what they say")
def _(_folder):
    for case in cases_with_a_closed_form():
        for support in case.supports:
            x = case.place(case.parameters(50))
            x[:, support.axis] = support.at
            held = support.value(x) if support.value else 0
            assert np.abs(case.u(x)[:, support.components] - held).max() < 1e-17, (case.name, support)


@claim("the stress of each case without a load inside is in equilibrium")
def _(_folder):
    for case in cases_with_a_closed_form():
        if case.name in ("vortex", "cube"):
            continue
        x, h, dim = case.place(case.parameters(50)), 1e-4, case.dim
        slopes = np.stack([(case.stress(x + step) - case.stress(x - step)) / (2 * h) for step in h * np.eye(dim)], axis=3)
        pull = np.einsum("nijj->ni", slopes[:, :dim, :dim])
        assert np.abs(pull).max() < 1e-4 * np.abs(slopes).max(), (case.name, np.abs(pull).max(), np.abs(slopes).max())


@claim("a twisted bar has no stress on its sides, and the torque of Saint-Venant")
def _(_folder):
    space = script_module("beside_fem_space")
    a, s = space.HALF_SIDE, np.linspace(0, 0.49, 30)
    side = np.stack([np.full(30, 0.7), np.full(30, a), s], axis=1)
    shear = space.TORSION.stress(side)
    assert np.abs(shear[:, 0, 1]).max() < 1e-2 * np.abs(shear[:, 0, 2]).max()  # of 1000 terms of the series
    at, weight = np.polynomial.legendre.leggauss(24)
    y, z = (m.ravel() for m in np.meshgrid(a / 2 * (at + 1), a / 2 * (at + 1)))
    stress = space.TORSION.stress(np.stack([np.zeros_like(y), y, z], axis=1))
    torque = 4 * (np.outer(weight, weight).ravel() * (a / 2) ** 2) @ (y * stress[:, 0, 2] - z * stress[:, 0, 1])
    law, G = space.TORSION.law, space.TORSION.law.lame[1]
    assert abs(torque / (0.140577 * G * (2 * a) ** 4 * space.TWIST) - 1) < 1e-4, torque
    scene = tomllib.loads(script_module("torsion_scene").torsion_scene(5))
    assert scene["material"]["steel"]["nu"] == law.nu and len(scene["support"]) == 8


@claim("a shell of three blocks is filled evenly, and a place is found again from its parameters")
def _(_folder):
    case = script_module("beside_fem_space").SPHERE
    parameters = case.parameters(1000)
    x = case.place(parameters)
    r = np.linalg.norm(x, axis=1)
    assert r.min() > 1 and r.max() < 2 and x.min() > 0 and abs(np.mean(r**3 < 4.5) - 0.5) < 0.02
    assert all(abs(np.mean(x[:, i] > x[:, i - 1]) - 0.5) < 0.02 for i in range(3))
    assert (np.abs(parameters[:, 1:] - 0.5) < 0.5).all() and (parameters[:, 0] % 2 < 1).all()


@claim("the stress of Lamé's cylinder is in equilibrium, is the pressure inside, and nothing outside")
def _(_folder):
    cases = script_module("beside_fem_plane")
    case, h = cases.RING, 1e-4
    x = case.place(case.parameters(50))
    for i in range(2):
        pull = sum(
            (case.stress(x + step)[:, i, j] - case.stress(x - step)[:, i, j]) / (2 * h)
            for j, step in enumerate(h * np.eye(2))
        )
        assert np.abs(pull).max() < 1e-5 * cases.PRESSURE, np.abs(pull).max()
    for radius, traction in ((cases.INNER, -cases.PRESSURE), (cases.OUTER, 0.0)):
        stress = case.stress(np.array([[0.6 * radius, 0.8 * radius]]))[0, :2, :2]
        assert np.abs(stress @ [0.6, 0.8] - traction * np.array([0.6, 0.8])).max() < 1e-12, (radius, stress)


@claim("the neo-Hookean law is the linear one at small strain, and a turn has no stress")
def _(_folder):
    cases = script_module("beside_fem_case")
    linear, rubber = cases.Law(3.0, 0.3), cases.Law(3.0, 0.3, large_strain=True)
    gradient = 1e-6 * np.array([[[0.3, 0.7], [-0.2, 0.5]]])
    assert np.abs(linear.stress(gradient) - rubber.stress(gradient)).max() < 1e-5 * np.abs(linear.stress(gradient)).max()
    turn = np.array([[[math.cos(1) - 1, -math.sin(1)], [math.sin(1), math.cos(1) - 1]]])
    assert np.abs(rubber.stress(turn)).max() < 1e-15
    through = linear.stress(gradient)[0]
    assert abs(through[2, 2] - 0.3 * (through[0, 0] + through[1, 1])) < 1e-18, through  # plane strain


@claim("places lie evenly in the body: of a ring as many on each side of the circle that halves its area")
def _(_folder):
    case = script_module("beside_fem_plane").RING
    x = case.place(case.parameters())
    r2 = (x**2).sum(axis=1)
    assert r2.min() > 1 and r2.max() < 4 and x.min() > 0, (r2.min(), r2.max())
    assert abs(np.mean(r2 < 2.5) - 0.5) < 0.01 and abs(np.mean(x[:, 0] > x[:, 1]) - 0.5) < 0.01


@claim("the scene of Lamé's cylinder has the area of the quarter ring, and the load of the pressure on it")
def _(_folder):
    ring, cases = script_module("ring_scene"), script_module("beside_fem_plane")
    for cells in (8, 400):
        scene = tomllib.loads(ring.ring_scene(cells))
        corners = np.array(scene["body"]["polygon"])
        after = np.roll(corners, -1, axis=0)
        area = abs((corners[:, 0] * after[:, 1] - corners[:, 1] * after[:, 0]).sum()) / 2
        assert abs(area - np.pi * 3 / 4) < 1e-12 and len(corners) <= 1000, (cells, area)
        size = sum(
            math.dist(*traction["line"]) * float(traction["value"][0].partition("*")[0]) for traction in scene["traction"]
        )
        assert abs(size - cases.PRESSURE * math.pi / 2) < 1e-12 * size, (cells, size)


@claim("the places in Cook's membrane lie in it, evenly but for its clamped corners")
def _(_folder):
    case = script_module("beside_fem_plane").COOK
    x = case.place(case.parameters())
    below, above = x[:, 1] - 44 * x[:, 0] / 48, x[:, 1] - 44 - 16 * x[:, 0] / 48
    assert x.min() > 0 and x[:, 0].max() < 48 and below.min() > 0 and above.max() < 0
    assert min(np.hypot(x[:, 0], x[:, 1]).min(), np.hypot(x[:, 0], x[:, 1] - 44).min()) >= 3.9
    left = (44 * 24 - 14 / 48 * 24**2) / 1440  # of the area
    assert abs(np.mean(x[:, 0] < 24) - left) < 0.01, (np.mean(x[:, 0] < 24), left)


if __name__ == "__main__":
    check_the_claim()
