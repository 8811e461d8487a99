"""The scene of Lamé's cylinder that scripts/beside_fem gives Stillpoint: a quarter of a ring, cut out of the grid."""

import math

from beside_fem_plane import INNER, OUTER, PRESSURE, RING_LAW

MOST_CHORDS = 480  # of an arc: a polygon has at most 1000 corners
HEAD = """# A quarter of a thick-walled cylinder under inner pressure [Lamé and Clapeyron 1831; Timoshenko and Goodier 1970, art. 28].
# Chords of the areas of the arcs; the load along each is radial, and in all as large as on the arc. Written by scripts/beside_fem.
title = "Lamé's thick cylinder, cut out of the grid"
dim = 2

[grid]
min = [0.0, 0.0]
max = [{size}, {size}]
cells = [{cells}, {cells}]

[body]
material = "steel"
state = "plane-strain"
placement = "gauss"
polygon = [
  {corners},
]

[material.steel]
law = "linear-elastic"
E = {E}
nu = {nu}
rho = 1.0

[[support]]
face = "left"
kind = "roller"

[[support]]
face = "bottom"
kind = "roller"

[solve]
method = "newton"

[stop]
distance = 0
"""
TRACTION = """
[[traction]]
line = [{start}, {end}]
value = ["{pressure!r}*x/sqrt(x^2+y^2)", "{pressure!r}*y/sqrt(x^2+y^2)"]
"""


def arc(radius, chords):
    """Corners of as many chords under which the area is that of the quarter of a circle."""
    step = math.pi / 2 / chords
    reach = radius * math.sqrt(step / math.sin(step))
    return [(reach * math.cos(step * k) if k < chords else 0.0, reach * math.sin(step * k)) for k in range(chords + 1)]


def text(place):
    return f"[{place[0]!r}, {place[1]!r}]"


def ring_scene(cells):
    """With four chords of an arc for each cell along a side of the grid."""
    chords = min(4 * cells, MOST_CHORDS)
    inner, outer = arc(INNER, chords), arc(OUTER, chords)
    corners = ",\n  ".join(map(text, outer + inner[::-1]))
    head = HEAD.format(size=outer[0][0] * (1 + 1e-9), cells=cells, corners=corners, E=RING_LAW.E, nu=RING_LAW.nu)
    pressure = PRESSURE * (math.pi / 2 / chords) * INNER / math.dist(*inner[:2])
    return head + "".join(
        TRACTION.format(start=text(a), end=text(b), pressure=pressure) for a, b in zip(inner, inner[1:])
    )
