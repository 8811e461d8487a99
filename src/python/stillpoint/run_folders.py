"""What a run has left in its folder."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .figures import Figures, figures_of, table_of
from .histories import Drawable, drawn_run, plot_histories
from .plots.folders import read_summary, title_of
from .plots.frames import open_frames
from .plots.history_runs import read_columns
from .plots.needed import need
from .point_fields import PointFields

if TYPE_CHECKING:
    import meshio  # type: ignore[import]
    import pandas  # type: ignore[import]
    from matplotlib.figure import Figure  # type: ignore[import]

    from .plots.history_runs import Run


class RunFolder:
    """The files of `stillpoint run`, or of a Simulation with out, read when they are asked for.

    ValueError says what is wrong with a file, or that there is none.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise FileNotFoundError(f"there is no folder {self.folder}")

    @property
    def summary(self) -> Figures:
        """The figures of summary.json; none if it is not there yet."""
        figures, _ = read_summary(self.folder)
        return Figures(figures_of(figures))

    @property
    def history(self) -> NDArray[Any]:
        """The rows of history.csv as a structured array: history["t"], history["residual"], …"""
        columns = read_columns(self.folder / "history.csv")
        return table_of(list(columns), list(zip(*columns.values())), whole=("steps", "rhs_evaluations"))

    @property
    def times(self) -> NDArray[np.float64]:
        """Those of fields.h5, rising [s]."""
        with open_frames(self.folder) as frames:
            return np.array([frame.t for frame in frames])

    def point_fields(self, time: float | None = None) -> PointFields:
        """The fields of all points at the one of .times that is nearest to this time [s]; None: at the last."""
        with open_frames(self.folder) as frames:
            at = frames[-1].t if time is None else time
            return PointFields(min(frames, key=lambda frame: abs(frame.t - at)))

    def plot(self, *others: Drawable, figure: Figure | None = None) -> Figure:
        """The history, with those of other runs beside it, as `stillpoint plot history` draws it.

        others: simulations, folders, or what read_run() returns. Without any the runs in the subfolders are drawn, if there
        are some. figure: as of Simulation.plot(). ImportError without matplotlib.
        """
        if others:
            return plot_histories([self, *others], figure)
        need("matplotlib")
        from .plots import history, history_runs

        return history.figure_of(*history_runs.find_runs([self.folder]), figure)

    def plot_points(
        self,
        field: str | None = None,
        *,
        cut: Mapping[str, float] | None = None,
        stages: int = 6,
        figure: Figure | None = None,
    ) -> Figure:
        """The points at some of .times, evenly spread, as `stillpoint plot fields` draws them.

        field, cut, figure: as of Simulation.plot_points(). ImportError without matplotlib or h5py.
        """
        need("matplotlib")
        from .plots import field_files, fields
        from .plots.field_space import cuts_of

        return fields.figure_of(*field_files.read_runs([self.folder], field, stages), cuts_of(cut), figure)

    def to_pandas(self) -> pandas.DataFrame:
        """The history as a table of pandas', a column a figure. ImportError without pandas."""
        return need("pandas").DataFrame(self.history)

    def to_meshio(self, time: float | None = None) -> meshio.Mesh:
        """point_fields(time).to_meshio()"""
        return self.point_fields(time).to_meshio()

    def _drawn_run(self) -> Run:
        summary, label = read_summary(self.folder)
        return drawn_run(label, title_of(summary), str(summary.get("status", "")), self.history)

    def __repr__(self) -> str:
        return f"<stillpoint.RunFolder '{self.folder}'>"


def read_run(folder: str | os.PathLike[str]) -> RunFolder:
    """What a run has left in a folder: its summary, its history, and the fields of its points. FileNotFoundError if there is
    no such folder."""
    return RunFolder(folder)
