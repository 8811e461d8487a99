"""Histories of simulations and of folders: as a table, and drawn side by side."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Union

from numpy.typing import NDArray

from .plots.folders import Refused
from .plots.needed import need

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import]

    from .plots.history_runs import Run


class HasHistory(Protocol):
    """A simulation, or what read_run() returns."""

    def _drawn_run(self) -> Run: ...


Drawable = Union[HasHistory, str, "os.PathLike[str]"]


def drawn_run(label: str, title: str, status: str, history: NDArray[Any]) -> Run:
    """A history as it is drawn. ValueError if it has no row yet."""
    from .plots.history_runs import Run

    if len(history) == 0:
        raise Refused(f"the history of {label} has no row yet: take a step first")
    columns = {name: history[name].astype(float).tolist() for name in history.dtype.names or ()}
    return Run(label, title, status == "equilibrium", columns)


def plot_histories(runs: Sequence[Drawable], figure: Figure | None) -> Figure:
    """One picture of all of them, as `stillpoint plot history` draws it."""
    need("matplotlib")
    from .plots import history, history_runs

    drawn = [
        history_runs.read_run(Path(run)) if isinstance(run, (str, os.PathLike)) else run._drawn_run() for run in runs
    ]
    return history.figure_of(drawn, figure=figure)
