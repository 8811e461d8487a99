"""One simulation, step by step or as a whole."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from . import _core
from .figures import Figures, figures_in, table_of
from .histories import Drawable, drawn_run, plot_histories
from .plots.needed import need
from .point_fields import PointFields, frame_of
from .progress import Told, close, telling
from .scenes import Source, scene_of

if TYPE_CHECKING:
    import meshio  # type: ignore[import]
    import pandas  # type: ignore[import]
    from matplotlib.figure import Figure  # type: ignore[import]

    from .plots.history_runs import Run


def _path(path: str | os.PathLike[str] | None) -> str:
    return "" if path is None else os.fspath(path)


class Simulation(_core.Simulation):
    """A simulation of a scene: one object from the set-up to the end, which `stillpoint run` steps as well.

    scene: as of load(), or a path or a dictionary. out: a folder for history.csv, fields and checkpoints; None: no files.
    threads: 0: as many as there are, or one where that is quicker. stop(simulation): a stopping test, asked after every
    step beside those of the scene; it returns whether the simulation ends, or why. progress: called a few times a second
    with a dictionary (t, end_time, steps, residual, residual_goal, wall_s), or True for a bar.

    step(until) takes one accepted step, not past time until [s], and returns whether the simulation goes on; run() takes all.
    .done, .status and .reason say whether and why it has ended; .t [s], .steps, .evaluations and .phases how far it is;
    .residual and .distance (or None) how far from rest. .points has the fields of the points, .unknowns u, v and the forces.

    Steps let go of the GIL. One thread at a time works with a simulation: others get a RuntimeError meanwhile.
    """

    def __init__(
        self,
        scene: _core.Scene | Source,
        *,
        out: str | os.PathLike[str] | None = None,
        threads: int = 0,
        stop: Callable[[Simulation], bool | str] | None = None,
        progress: Told = None,
        _resume: str = "",
    ) -> None:
        self._scene = scene_of(scene)
        self._told = telling(progress)
        super().__init__(self._scene, out=_path(out), resume=_resume, threads=threads, stop=stop, progress=self._told)

    @classmethod
    def resume(
        cls,
        checkpoint: str | os.PathLike[str],
        scene: _core.Scene | Source | None = None,
        *,
        out: str | os.PathLike[str] | None = None,
        threads: int = 0,
        stop: Callable[[Simulation], bool | str] | None = None,
        progress: Told = None,
    ) -> Simulation:
        """Goes on from what save() or `[checkpoint]` has left, with the same bits as if it had never stopped.

        scene: None: that of the checkpoint. Relaxations and dampings of one's own have to be added before. StateError if
        the checkpoint is damaged, or of another scene, body or version.
        """
        path = os.fspath(checkpoint)
        of_what = _core.load_checkpoint(path) if scene is None else scene
        return cls(of_what, out=out, threads=threads, stop=stop, progress=progress, _resume=path)

    @property
    def scene(self) -> _core.Scene:
        """What is simulated."""
        return self._scene

    def run(self, until: float = math.inf) -> Simulation:
        """Steps until time until [s], or until it is done. Ctrl-C is raised between two steps, and the simulation can go
        on from there; a single step that takes more than half a second is broken off and ends it. Returns itself."""
        super().run(until)
        if self.done:
            close(self._told)
        return self

    def save(self, checkpoint: str | os.PathLike[str]) -> None:
        """Saves the state between two steps, to go on from with resume(). OSError if the file cannot be written."""
        super().save(os.fspath(checkpoint))

    @property
    def summary(self) -> Figures:
        """The figures of summary.json, as of now; complete once it is done."""
        return figures_in(self.summary_json())

    @property
    def history(self) -> NDArray[Any]:
        """The rows of history.csv so far, as a structured array: history["t"], history["residual"], … A simulation that
        was resumed has those since then."""
        columns, rows = self.history_rows()
        return table_of(columns, rows, whole=("steps", "rhs_evaluations"))

    def point_fields(self) -> PointFields:
        """The fields of all points as they are now, by the names of fields.h5: arrays of their own."""
        return PointFields(frame_of(self, self._scene.dim))

    def plot(self, *others: Drawable, figure: Figure | None = None) -> Figure:
        """The history so far, with those of other runs beside it, as `stillpoint plot history` draws it.

        others: simulations, folders of runs, or what read_run() returns. figure: an empty one to draw on, such as
        pyplot's, for which pyplot.show() opens a window; None: a new one, to save by .savefig("history.png") or to be
        shown as the value of a notebook's cell. ValueError before the first step, ImportError without matplotlib.
        """
        return plot_histories([self, *others], figure)

    def plot_points(
        self, field: str | None = None, *, cut: Mapping[str, float] | None = None, figure: Figure | None = None
    ) -> Figure:
        """The points as they are now, coloured by a field, as `stillpoint plot fields` draws them.

        field: a name of fields.h5, such as "plastic_strain", "stress_xy", "u" (its length) or "u_x", or "layers"; None:
        plastic_strain if some point has yielded, or else u. cut: {"x": 1.5} takes away what lies before the plane x = 1.5 m
        of a body in space. figure: as of plot(). ValueError if there is no such field, ImportError without matplotlib.
        """
        need("matplotlib")
        from .plots import fields
        from .plots.field_frames import run_of
        from .plots.field_space import cuts_of

        run, chosen = run_of([frame_of(self, self._scene.dim)], field, self._label(), self.summary)
        return fields.figure_of([run], chosen, cuts_of(cut), figure)

    def to_pandas(self) -> pandas.DataFrame:
        """The history so far as a table of pandas', a column a figure. ImportError without pandas."""
        return need("pandas").DataFrame(self.history)

    def to_meshio(self) -> meshio.Mesh:
        """The points as they are now as a mesh of meshio's, with all their fields: point_fields().to_meshio()."""
        return self.point_fields().to_meshio()

    def _label(self) -> str:
        return ", ".join(self._scene.overrides) or self._scene.name

    def _drawn_run(self) -> Run:
        return drawn_run(self._label(), self._scene.title or self._scene.name, self.status, self.history)

    def __repr__(self) -> str:
        return f"<stillpoint.Simulation of '{self._scene.name}': {self.status}, t = {self.t:.6g}, {self.steps} steps>"


def resume(checkpoint: str | os.PathLike[str], scene: _core.Scene | Source | None = None, **options: Any) -> Simulation:
    """Simulation.resume()."""
    return Simulation.resume(checkpoint, scene, **options)


def run(
    scene: _core.Scene | Source,
    *,
    out: str | os.PathLike[str] | None = None,
    threads: int = 0,
    progress: Told = None,
) -> Figures:
    """Simulates a scene until it is done, with the files of `stillpoint run` in the folder out; returns its summary.

    A run that goes wrong says so in .status, .reason and .exit_status. Ctrl-C finishes the step, writes the files, and is
    raised then.
    """
    told = telling(progress)
    text = _core.run(scene_of(scene), out=_path(out), threads=threads, progress=told)
    close(told)
    return figures_in(text)
