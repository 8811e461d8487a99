"""Studies of many runs of one scene, with the figures of `stillpoint compare`, `converge`, `safety` and `spectrum`."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from .figures import Figures, figures_in
from .progress import Told, close, telling
from .scene_text import override_texts
from .scenes import Source, scene_of
from .study_figures import Comparison, Convergence, Safety


def _folder(out: str | os.PathLike[str] | None) -> str:
    """The folder of that name, which is there from now on; "": there is none."""
    if out is None:
        return ""
    os.makedirs(out, exist_ok=True)
    return os.fspath(out)


def compare(
    scene: _core.Scene | Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    strategies: Sequence[str] = (),
    integrators: Sequence[str] = (),
    step_fractions: Sequence[float] = (0.9,),
    tolerances: Sequence[float] = (1e-3,),
    goal: float = 1e-6,
    limit: float = 50,
    seconds: float = 30,
    repeats: int = 3,
    seed: int = 1,
    overshoot: bool = False,
    threads: int = 0,
    out: str | os.PathLike[str] | None = None,
    progress: Told = None,
) -> Comparison:
    """Many ways to rest side by side: the figures of compare.json, with plot() and to_pandas().

    strategies: dampings, relaxations and static solvers, also those that were added; empty: all. .runs has one each, with
    .samples as a structured array (evaluations, error, residual, distance). out: a folder for compare.csv and
    compare.json, which read_study() reads. What a strategy written in Python raises is the .reason of its run.
    """
    told = telling(progress)
    text = _core.compare(
        scene_of(scene, override_texts(overrides or {})), out=_folder(out), progress=told, strategies=strategies,
        integrators=integrators, step_fractions=step_fractions, tolerances=tolerances, goal=goal, limit=limit,
        seconds=seconds, repeats=repeats, seed=seed, overshoot=overshoot, threads=threads,
    )  # fmt: skip
    close(told)
    return Comparison(figures_in(text))


def converge(
    scene: _core.Scene | Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    refine: Sequence[str] = ("h",),
    vary: Sequence[str] = (),
    levels: int = 4,
    ratio: float = 2,
    dominant: bool = True,
    threads: int = 0,
    out: str | os.PathLike[str] | None = None,
    progress: Told = None,
) -> Convergence:
    """A scene on ever finer levels: the figures of converge.json, with plot() and to_pandas().

    refine: "h", "points", "step", "rtol" or "motion". vary: "key=value,value", a series with each: then .series has one
    study each. .quantities[name].values and .errors are arrays, (levels), and so are .sizes, .dofs and .h.
    """
    told = telling(progress)
    sets = override_texts(overrides or {})
    varied = _core.settings_of_series(vary)
    text = _core.converge(
        [scene_of(scene, [*sets, *one]) for one in varied], varied=varied, out=_folder(out), progress=told,
        refine=refine, levels=levels, ratio=ratio, dominant=dominant, threads=threads,
    )  # fmt: skip
    close(told)
    return Convergence(figures_in(text))


def safety(
    scene: _core.Scene | Source,
    overrides: Mapping[str, Any] | None = None,
    *,
    first: float = 1,
    last: float = 3,
    width: float = 0.01,
    threads: int = 0,
    out: str | os.PathLike[str] | None = None,
    progress: Told = None,
) -> Safety:
    """The factor of safety by strength reduction: the figures of safety.json, with to_pandas().

    It lies between .factor_low, which rests, and .factor_high, which moves; both are looked for between `first`, with
    which the body has to rest, and `last`, until they are no farther apart than `width`: then .found is True. .verdicts
    has one for each factor, with .factor, .verdict, .reason and .displacement [m]; .factors and .displacements are arrays
    in rising order. out: a folder for safety.json, safety.csv and report.html.
    """
    told = telling(progress)
    text = _core.safety(
        scene_of(scene, override_texts(overrides or {})), out=_folder(out), progress=told, first=first, last=last,
        width=width, threads=threads,
    )  # fmt: skip
    close(told)
    return Safety(figures_in(text))


def spectrum(scene: _core.Scene | Source) -> Figures:
    """omega_1 and omega_max [rad/s], kappa, critical_damping 2 omega_1 [1/s] (NaN if the body is not held), and two
    structured arrays: estimates (what, how, omega, iterations, wall_s), each frequency by each method, and critical_steps
    (method, step, evaluations), of each integrator."""
    study = Figures(_core.spectrum(scene_of(scene)))
    study["estimates"] = np.array(
        study["estimates"],
        dtype=[("what", "U16"), ("how", "U64"), ("omega", float), ("iterations", int), ("wall_s", float)],
    )
    study["critical_steps"] = np.array(
        study["critical_steps"], dtype=[("method", "U64"), ("step", float), ("evaluations", int)]
    )
    return study
