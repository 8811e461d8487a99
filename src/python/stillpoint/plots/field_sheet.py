"""What pictures of fields have in common: names, colours, headings, the sheet and its panels."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps  # type: ignore[import]
from matplotlib.cm import ScalarMappable  # type: ignore[import]
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.ticker import MaxNLocator  # type: ignore[import]

from .field_stages import Run, Stage, body
from .pictures import COLOURS, drawing, plain

Array = Any  # of numpy
DPI = 150
SYMBOLS = {
    "u": ("displacement", "u", "m"),
    "v": ("velocity", "v", "m/s"),
    "stress": ("stress", r"\sigma", "Pa"),
    "strain": ("strain", r"\varepsilon", ""),
}
UNITS = {"volume": "m³", "pore_pressure": "Pa", "pc": "Pa"}
MARGIN = 0.04  # around the points, as a share of the larger side


def name_of(field: str, dim: int) -> str:
    """plastic_strain → plastic strain, u → displacement |u| [m], stress_xy → stress σ with its indices [Pa]."""
    name, _, index = field.partition("_")
    if name in SYMBOLS and re.fullmatch("[xyz]{0,2}", index):
        word, symbol, unit = SYMBOLS[name]
        symbol = f"{symbol}_{{{index}}}" if index else symbol if dim == 1 else f"|{symbol}|"
        return f"{word} ${symbol}$" + (f" [{unit}]" if unit else "")
    return plain(field.replace("_", " ")) + (f" [{UNITS[field]}]" if field in UNITS else "")


def colours_of(stages: Sequence[Stage]) -> tuple[Any, Any, str]:
    """(colour map, its range, on which side values lie outside of it). A few extreme points do not set the range."""
    values = np.concatenate([stage.values for stage in stages])
    if values.dtype.kind in "iu":  # a material: a colour a number
        numbers = np.unique(values)
        edges = np.append(numbers - 0.5, numbers[-1] + 0.5)
        colours = [COLOURS[k % len(COLOURS)] for k in range(len(numbers))]
        return ListedColormap(colours), BoundaryNorm(edges, len(numbers)), "neither"
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return colormaps["viridis"], Normalize(0, 1), "neither"
    low, high = np.percentile(values, [0.2, 99.8])
    if low == high or np.ptp(values) <= 10 * (high - low):  # nothing that is extreme
        low, high = values.min(), values.max()
    cmap = "viridis"
    if low < 0 < high and min(-low, high) > 0.2 * max(-low, high):
        cmap, high = "coolwarm", max(-low, high)
        low = -high
    elif 0 < low < 0.5 * high:
        low = 0
    if low == high:
        low, high = (0, 1) if low == 0 else (low - abs(low) / 2, low + abs(low) / 2)
    below, above = values.min() < low, values.max() > high
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[int(below), int(above)]
    return colormaps[cmap], Normalize(low, high), extend


def heading(run: Run, stage: Stage, many_runs: bool) -> str:
    parts = [plain(run.label)] * many_runs + [f"$t$ = {stage.t:.4g}"]
    if stage.slope_angle is not None:
        parts.append(f"slope {stage.slope_angle:.1f}°")
    if stage.factor is not None:
        parts.append(rf"limit load $\lambda$ = {stage.factor:.4g}")
    return ",  ".join(parts)


@dataclass
class Panel:
    axis: Any  # of matplotlib
    run: Run
    stage: Stage
    first: bool  # of its row
    lowest: bool  # of its column


class Sheet:
    """A figure's size, and where its panels are in it, all in inches. 7 wide: legible at half a page's width, too."""

    LEFT, RIGHT, GAP, LARGEST = 0.78, 0.15, 0.2, 6
    BELOW = 2.4  # lines of text below the lowest panels

    def __init__(self, runs: Sequence[Run], shape: float, bar: bool) -> None:
        """shape: height/width of a panel."""
        count = max(len(run.stages) for run in runs)
        columns = count if len(runs) > 1 else min(count, 2 if shape < 1 or count == 4 else 3)
        self.cells = [divmod(k, columns) for k in range(count)]
        if len(runs) > 1:  # a row each
            self.cells = [(row, column) for row, run in enumerate(runs) for column in range(len(run.stages))]
        self.runs, rows, self.title = runs, self.cells[-1][0] + 1, plain(runs[0].title)
        self.small = columns > 2
        self.font_size = 9.5 if self.small else 13
        self.line = 0.22 if self.small else 0.28  # the height of a line of text
        self.panel_width = min((7 - self.LEFT - self.RIGHT - (columns - 1) * self.GAP) / columns, self.LARGEST / shape)
        self.panel_height = self.panel_width * shape
        self.top = self.line * (2.4 if self.title else 1.3)
        self.pitch = self.panel_height + 1.6 * self.line  # from row to row
        bottom = self.line * (self.BELOW + 2.9 * bar)
        self.width = self.LEFT + columns * self.panel_width + (columns - 1) * self.GAP + self.RIGHT
        self.height = self.top + (rows - 1) * self.pitch + self.panel_height + bottom

    @contextmanager
    def drawing(self, figure: Figure | None) -> Iterator[Figure]:
        """Where it is drawn, with its title."""
        with drawing(figure, self.width, self.height, self.font_size, DPI) as self.figure:
            if self.title:
                self.figure.suptitle(self.title, y=1 - 0.4 * self.line / self.height, va="top", fontsize="medium")
            yield self.figure

    def panels(self) -> Iterator[Panel]:
        """One a stage, with its heading."""
        stages = [(run, stage) for run in self.runs for stage in run.stages]
        for (row, column), (run, stage) in zip(self.cells, stages):
            x = self.LEFT + column * (self.panel_width + self.GAP)
            y = self.height - self.top - row * self.pitch - self.panel_height
            axis = self.axes(x, y, self.panel_width, self.panel_height)
            axis.set_title(heading(run, stage, len(self.runs) > 1), fontsize="medium", pad=3)
            yield Panel(axis, run, stage, column == 0, (row + 1, column) not in self.cells)

    def bar(self) -> Any:
        length = min(4, 0.7 * self.width)
        middle = (self.LEFT + self.width - self.RIGHT) / 2
        return self.axes(middle - length / 2, 2 * self.line, length, 0.5 * self.line)

    def axes(self, x: float, y: float, width: float, height: float) -> Any:
        return self.figure.add_axes((x / self.width, y / self.height, width / self.width, height / self.height))


def draw_arrows(axis: Any, place: Array, vectors: Array) -> None:
    """The mean vector of each square of about 18 to the longer side; what hardly moves has none."""
    length = np.ptp(body(place), axis=0).max() / 18 or 1.0
    _, square = np.unique(np.floor(place / length), axis=0, return_inverse=True)
    count = np.bincount(square)
    mean = [np.bincount(square, values) / count for values in (*place.T, *vectors.T)]
    size = np.hypot(mean[2], mean[3])
    if not size.max() > 0:
        return
    x, y, along_x, along_y = (values[size > 0.05 * size.max()] for values in mean)
    scale = size.max() / (1.3 * length)
    axis.quiver(x, y, along_x, along_y, angles="xy", scale_units="xy", scale=scale, width=0.004, color="white",
                edgecolor="black", linewidth=0.5, zorder=3)  # fmt: skip


def add_colour_bar(figure: Figure, axis: Any, cmap: Any, norm: Any, extend: str, label: str) -> None:
    bar = figure.colorbar(ScalarMappable(norm, cmap), cax=axis, orientation="horizontal", extend=extend)
    bar.outline.set_visible(False)
    if isinstance(norm, BoundaryNorm):
        bar.set_ticks([(a + b) / 2 for a, b in zip(norm.boundaries, norm.boundaries[1:])])
        bar.set_ticklabels([f"{edge + 0.5:.0f}" for edge in norm.boundaries[:-1]])
        bar.ax.tick_params(length=0)
    else:
        bar.locator = MaxNLocator(5, steps=[1, 2, 5, 10])
        bar.formatter.set_powerlimits((-2, 4))
        bar.formatter.set_useMathText(True)
        bar.update_ticks()
    bar.set_label(label)
