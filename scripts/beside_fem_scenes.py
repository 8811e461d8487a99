"""The scenes that scripts/beside_fem writes for Stillpoint: those that problems/ does not have."""

from ring_scene import ring_scene
from torsion_scene import torsion_scene

SCENES = {"lame": ring_scene, "torsion": torsion_scene}  # by case: the cells along the first axis -> text
