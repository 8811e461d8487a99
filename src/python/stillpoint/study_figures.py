"""The figures of studies, with what can be made of them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .figures import Figures, figures_of, numbers_of, table_of
from .plots.folders import Refused, read_study as read_json
from .plots.needed import need

if TYPE_CHECKING:
    import pandas  # type: ignore[import]
    from matplotlib.figure import Figure  # type: ignore[import]


def _row(figures: Mapping[str, Any]) -> dict[str, Any]:
    """A row of a table: what is one number or one word; NaN for what was not computed."""
    plain = {key: value for key, value in figures.items() if not isinstance(value, (Mapping, list, np.ndarray))}
    return {key: np.nan if value is None else value for key, value in plain.items()}


class Comparison(Figures):
    """The figures of compare.json. .runs has one each, with .samples as a structured array (evaluations, error, residual,
    distance)."""

    def __init__(self, figures: Mapping[str, Any]) -> None:
        super().__init__(figures_of(figures))
        for one in self["runs"]:
            rows = [numbers_of(sample) for sample in one["samples"]]
            one["samples"] = table_of(self["sample"], rows, whole=("evaluations",))

    def plot(self, *, figure: Figure | None = None) -> Figure:
        """Error against force evaluations and against wall time, a line a run, as `stillpoint plot compare` draws it.

        figure: as of Simulation.plot(). ValueError if no run got anywhere, ImportError without matplotlib.
        """
        need("matplotlib")
        from .plots import compare

        return compare.figure_of(self, figure)

    def to_pandas(self) -> pandas.DataFrame:
        """A table of pandas', a row a run, with the columns of compare.csv. ImportError without pandas."""
        rows = []
        for one in self["runs"]:
            wall = one["wall_s"] or {}
            walls = {"wall_s": wall.get("median"), "wall_least_s": wall.get("least"), "wall_most_s": wall.get("most")}
            rows.append(_row({**one, **walls}))
        return need("pandas").DataFrame(rows)


class Convergence(Figures):
    """The figures of converge.json, or with .series of each of several. .quantities[name].values and .errors are arrays,
    (levels), and so are .sizes, .dofs and .h."""

    def __init__(self, figures: Mapping[str, Any]) -> None:
        super().__init__(figures_of(figures))
        for one in self._each():
            for quantity in one["quantities"].values():
                quantity.update(values=numbers_of(quantity["values"]), errors=numbers_of(quantity["errors"]))
            one["sizes"] = numbers_of([level["size"] for level in one["levels"]])
            one["h"] = numbers_of([level["h"] for level in one["levels"]])
            one["dofs"] = np.array([level["dofs"] for level in one["levels"]])

    def _each(self) -> list[Any]:
        return list(self.get("series", [self]))

    def plot(self, *, figure: Figure | None = None) -> Figure:
        """Errors against size and against wall time, a line a quantity or a series, as `stillpoint plot converge` draws it.

        figure: as of Simulation.plot(). ValueError if no level has an error, ImportError without matplotlib.
        """
        need("matplotlib")
        from .plots import converge

        return converge.figure_of(self, figure)

    def to_pandas(self) -> pandas.DataFrame:
        """A table of pandas', a row a level: the columns of converge.csv, and of each quantity NAME its error as NAME.error.
        ImportError without pandas."""
        rows = []
        for one in self._each():
            varied = dict(setting.split("=", 1) for setting in one.get("set", []))
            for k, level in enumerate(one["levels"]):
                row = {**varied, "level": k + 1, **_row(level)}
                for name, quantity in one["quantities"].items():
                    row |= {name: quantity["values"][k], f"{name}.error": quantity["errors"][k]}
                rows.append(row)
        return need("pandas").DataFrame(rows)


class Safety(Figures):
    """The figures of safety.json. .verdicts has one for each factor; .factors and .displacements [m] are arrays in rising
    order."""

    def __init__(self, figures: Mapping[str, Any]) -> None:
        super().__init__(figures_of(figures))
        rising = sorted(self["verdicts"], key=lambda one: float(one["factor"]))
        self["factors"] = np.array([one["factor"] for one in rising])
        self["displacements"] = numbers_of([one["displacement"] for one in rising])

    def to_pandas(self) -> pandas.DataFrame:
        """A table of pandas', a row a verdict in the order in which they were sought. ImportError without pandas."""
        return need("pandas").DataFrame([_row(one) for one in self["verdicts"]])


Study = Union[Comparison, Convergence, Safety]
_KINDS: dict[str, tuple[Any, tuple[str, ...]]] = {
    "compare": (Comparison, ("runs",)),
    "converge": (Convergence, ("quantities", "series")),
    "safety": (Safety, ("verdicts",)),
}


def read_study(folder: str | os.PathLike[str]) -> Study:
    """What compare(), converge() or safety(), or the command of that name, has left in a folder, as they return it.
    ValueError if that is none."""
    for name, (kind, keys) in _KINDS.items():
        if (Path(folder) / f"{name}.json").exists():
            study: Study = kind(read_json(Path(folder), name, *keys))
            return study
    raise Refused(f"{folder}: expected one of {', '.join(f'{name}.json' for name in _KINDS)}")
