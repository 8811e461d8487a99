"""Studies of many runs of one scene, with the figures of `stillpoint compare`, `converge` and `spectrum` as arrays."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from .figures import Figures, figures_in, numbers_of, table_of
from .progress import Told, telling
from .scene_text import override_texts
from .scenes import Source, reading, scene_of


def _study(
    scene: _core.Scene | Source,
    overrides: Mapping[str, Any] | None,
    out: str | os.PathLike[str] | None,
    name: str,
    progress: Told,
    work: Callable[[str, str, list[str], Any], None],
) -> Figures:
    """What work(folder, file, overrides, progress) writes into NAME.json. A scene that is no file becomes one."""
    sets = override_texts(overrides or {})
    bar = telling(progress)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) if out is None else Path(out)
        folder.mkdir(parents=True, exist_ok=True)
        if isinstance(scene, _core.Scene):
            work(str(folder), scene.file, [*scene.overrides, *sets], bar)
        elif isinstance(scene, Mapping):

            def of_text(file: str, text: str) -> None:
                Path(file).write_text(text, encoding="utf-8")
                work(str(folder), file, sets, bar)

            reading(scene, str(Path(temporary) / "scene.toml"), of_text)
        else:
            work(str(folder), os.fspath(scene), sets, bar)
        if bar is not None:
            bar.close()
        return figures_in((folder / f"{name}.json").read_text(encoding="utf-8"))


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
) -> Figures:
    """Many ways to rest side by side: the figures of compare.json.

    strategies: dampings, relaxations and static solvers, also those that were added; empty: all. .runs has one each, with
    .samples as a structured array (evaluations, error, residual, distance). out: a folder for compare.csv and
    compare.json, which scripts/plot_compare.py draws. What a strategy written in Python raises is the .reason of its run.
    """

    def work(folder: str, file: str, sets: list[str], told: Any) -> None:
        _core.compare_into(
            folder, file, sets, list(integrators), list(strategies), list(step_fractions), list(tolerances), goal,
            limit, seconds, repeats, seed, overshoot, threads, told,
        )  # fmt: skip

    study = _study(scene, overrides, out, "compare", progress, work)
    for one in study["runs"]:
        rows = [numbers_of(sample) for sample in one["samples"]]
        one["samples"] = table_of(study["sample"], rows, whole=("evaluations",))
    return study


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
) -> Figures:
    """A scene on ever finer levels: the figures of converge.json.

    refine: "h", "points", "step", "rtol" or "motion". vary: "key=value,value", a series with each: then .series has one
    study each. .quantities[name].values and .errors are arrays, (levels), and so are .sizes, .dofs and .h.
    """

    def work(folder: str, file: str, sets: list[str], told: Any) -> None:
        _core.converge_into(folder, file, sets, list(refine), list(vary), levels, ratio, dominant, threads, told)

    study = _study(scene, overrides, out, "converge", progress, work)
    for one in study.get("series", [study]):
        for quantity in one["quantities"].values():
            quantity.update(values=numbers_of(quantity["values"]), errors=numbers_of(quantity["errors"]))
        one["sizes"] = numbers_of([level["size"] for level in one["levels"]])
        one["h"] = numbers_of([level["h"] for level in one["levels"]])
        one["dofs"] = np.array([level["dofs"] for level in one["levels"]])
    return study


def spectrum(scene: _core.Scene | Source) -> Figures:
    """omega_1 and omega_max [rad/s], kappa, critical_damping 2 omega_1 [1/s] (NaN if the body is not held), and two
    structured arrays: estimates (what, how, omega, iterations, wall_s), each frequency by each method, and critical_steps
    (method, step, evaluations), of each integrator."""
    study = Figures(_core.spectrum_of(scene_of(scene)))
    study["estimates"] = np.array(
        study["estimates"],
        dtype=[("what", "U16"), ("how", "U64"), ("omega", float), ("iterations", int), ("wall_s", float)],
    )
    study["critical_steps"] = np.array(
        study["critical_steps"], dtype=[("method", "U64"), ("step", float), ("evaluations", int)]
    )
    return study
