"""The picture of fields: in the plane a panel a stage, the points at their deformed places, coloured by the field; of a bar
a panel a run, with a line a stage; of a body in space its lit surface (field_space.py)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.ticker import MaxNLocator  # type: ignore[import]

from .field_sheet import DPI, MARGIN, Sheet, add_colour_bar, colours_of, draw_arrows, name_of
from .field_space import draw_space
from .field_stages import Run, body, spacing_of
from .folders import Refused
from .pictures import drawing, plain


def draw_plane(runs: Sequence[Run], field: str, figure: Figure | None) -> Figure:
    stages = [stage for run in runs for stage in run.stages]
    bodies = [body(stage.place) for stage in stages]
    low = np.min([place.min(axis=0) for place in bodies], axis=0)
    high = np.max([place.max(axis=0) for place in bodies], axis=0)
    margin = MARGIN * (high - low).max() or 1.0
    (x_low, y_low), (x_high, y_high) = low - margin, high + margin
    shape = (y_high - y_low) / (x_high - x_low)

    sheet = Sheet(runs, shape, bar=field != "layers")
    cmap, norm, extend = colours_of(stages) if field != "layers" else (None, None, "neither")
    scale = 72 * sheet.panel_width / (x_high - x_low)  # of points, each 1/72 inch
    with sheet.drawing(figure) as figure:
        for panel in sheet.panels():
            axis, stage = panel.axis, panel.stage
            axis.set(xlim=(x_low, x_high), ylim=(y_low, y_high))
            for ticks in (axis.xaxis, axis.yaxis):
                ticks.set_major_locator(MaxNLocator(4 if sheet.small else 5, steps=[1, 2, 5, 10]))
            axis.tick_params(labelbottom=panel.lowest, labelleft=panel.first)
            axis.set(xlabel="$x$ [m]" if panel.lowest else "", ylabel="$y$ [m]" if panel.first else "")
            spacing = scale * spacing_of(stage.place)
            diameter = max(spacing, min(1.4 * spacing, 2.5), 0.9)  # fine ones overlap: gaps as fine as pixels make moirés
            look = {"c": stage.values, "s": diameter**2, "cmap": cmap, "norm": norm}
            axis.scatter(*stage.place.T, **look, linewidths=0, rasterized=True)
            if stage.mechanism is not None:
                draw_arrows(axis, stage.place, stage.mechanism)
        if norm:
            add_colour_bar(figure, sheet.bar(), cmap, norm, extend, name_of(field, 2))
    return figure


def draw_bars(runs: Sequence[Run], field: str, figure: Figure | None) -> Figure:
    """Field against place, in a panel a run."""
    with drawing(figure, 6 * len(runs), 4.8, font_size=11, dpi=DPI) as figure:
        axes = figure.subplots(1, len(runs), squeeze=False, sharex=True, sharey=True)
        for axis, run in zip(axes[0], runs):
            shades = colormaps["viridis"](np.linspace(0, 0.9, len(run.stages)))
            for stage, shade in zip(run.stages, shades):
                order = np.argsort(stage.place[:, 0])
                x, values = stage.place[order, 0], stage.values[order]
                axis.plot(x, values, ".-", color=shade, linewidth=1.2, markersize=4, label=f"$t$ = {stage.t:.4g}")
            axis.set(xlabel="position $x$ [m]", ylabel=name_of(field, 1) if axis is axes[0][0] else "")
            axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
            axis.grid(color="0.92")
            axis.set_axisbelow(True)
            axis.legend(frameon=False, fontsize="small")
            if len(runs) > 1:
                axis.set_title(plain(run.label), fontsize="medium")
        figure.suptitle(plain(runs[0].title))
        figure.tight_layout()
    return figure


def figure_of(
    runs: Sequence[Run], field: str, cuts: Mapping[int, float] | None = None, figure: Figure | None = None
) -> Figure:
    """The stages of runs, all of the same dimension. cuts: of field_space.read_cuts(). figure: an empty one to draw on."""
    dim = runs[0].dim
    if cuts and dim < 3:
        axis, value = next(iter(cuts.items()))
        raise Refused(f"the cut {'xyz'[axis]}={value:g}: only a body in space (dim = 3) is cut, this one has {dim}")
    if dim == 3:
        return draw_space(runs, field, cuts or {}, figure)
    return (draw_bars if dim == 1 else draw_plane)(runs, field, figure)
