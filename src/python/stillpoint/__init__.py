"""Stillpoint: quasi-static equilibrium by dynamic relaxation in the material point method.

    import stillpoint

    simulation = stillpoint.Simulation("bar.toml")
    while simulation.step():
        ...
    print(simulation.summary.status, simulation.points.stress)
    simulation.plot().savefig("history.png")

Scenes are files or dictionaries with the same keys; `stillpoint list keys` has them. Units are SI, or none.
"""

from __future__ import annotations

from . import numpy_first  # isort: skip
from . import errors
from ._core import Motion, Points, Scene, Unknowns, __version__
from .errors import Problem, SceneError, StateError
from .figures import Figures
from .laws import add_history_law
from .point_fields import PointFields
from .progress import ProgressBar
from .run_folders import RunFolder, read_run
from .scenes import load
from .simulations import Simulation, resume, run
from .strategies import add_damping, add_load, add_relaxation
from .studies import compare, converge, safety, spectrum
from .study_figures import Comparison, Convergence, Safety, read_study

__all__ = [
    "Comparison",
    "Convergence",
    "Figures",
    "Motion",
    "PointFields",
    "Points",
    "Problem",
    "ProgressBar",
    "RunFolder",
    "Safety",
    "Scene",
    "SceneError",
    "Simulation",
    "StateError",
    "Unknowns",
    "__version__",
    "add_damping",
    "add_history_law",
    "add_load",
    "add_relaxation",
    "compare",
    "converge",
    "errors",
    "load",
    "read_run",
    "read_study",
    "resume",
    "run",
    "safety",
    "spectrum",
]
