"""The scene of a square bar in torsion that scripts/beside_fem gives Stillpoint."""

from beside_fem_space import HALF_SIDE, LENGTH, TORSION, TWIST

SCENE = """# A quarter of a square bar in torsion [Saint-Venant 1855; Timoshenko and Goodier 1970, art. 109]: both ends are turned, one
# against the other, and warp freely. On the planes y = 0 and z = 0 u_x and what lies in the plane are 0. Written by
# scripts/beside_fem; problems/torsion.toml is the whole bar.
title = "A quarter of a square bar in torsion"
dim = 3

[constants]
L = {length}
b = {half_side}          # half the side
twist = {twist}

[grid]
min = [0.0, 0.0, 0.0]
max = ["L", "b", "b"]
cells = [{cells}, {cells}, {cells}]

[body]
material = "steel"
placement = "gauss"

[material.steel]
law = "linear-elastic"
E = {E}
nu = {nu}
rho = 1.0
"""
SUPPORT = """
[[support]]
face = "{face}"
component = "{component}"
"""
HELD = {"left": "yz", "right": "yz", "bottom": "xz", "back": "xy"}
TURNED = {"y": "-twist*L*z", "z": "twist*L*y"}  # on the right end


def torsion_scene(cells):
    law = TORSION.law
    text = SCENE.format(length=LENGTH, half_side=HALF_SIDE, twist=TWIST, cells=cells, E=law.E, nu=law.nu)
    for face, components in HELD.items():
        for component in components:
            text += SUPPORT.format(face=face, component=component)
            if face == "right":
                text += f'u = "{TURNED[component]}"\n'
    return text
