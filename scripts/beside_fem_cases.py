"""The cases of scripts/beside_fem by name, in the order of its page."""

from beside_fem_plane import COOK, COOK_INCOMPRESSIBLE, ELASTICA, PLATE, RING, VORTEX
from beside_fem_space import CUBE, SPHERE, TORSION

CASES = {case.name: case for case in (VORTEX, RING, PLATE, COOK, COOK_INCOMPRESSIBLE, ELASTICA, CUBE, TORSION, SPHERE)}
