"""Stages of a body in space: its surface, or what a cut lays open, seen along a diagonal."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.ticker import MaxNLocator  # type: ignore[import]

from .field_sheet import DPI, MARGIN, Panel, Sheet, add_colour_bar, colours_of, draw_arrows, name_of
from .field_stages import Run, Stage, of_body, spacing_of
from .folders import Refused
from .surface_image import RADIUS, Window, projected, surface_image

Array = Any  # of numpy
UNKNOWN = "0.75"  # the grey of points whose value is no number
FINER = 2  # pixels of an image to one of the picture, across and up, which smooths edges


# --- cuts ------------------------------------------------------------------------------------------


def read_cuts(texts: Iterable[str]) -> dict[int, float]:
    """{axis: value} of the texts x=VALUE, y=VALUE, z=VALUE."""
    cuts: dict[int, float] = {}
    for text in texts:
        name, _, number = text.partition("=")
        try:
            value = float(number)
        except ValueError:
            value = np.nan
        if not re.fullmatch("[xyz]", name) or not np.isfinite(value):
            raise Refused(f"--cut {text}: expected x=VALUE, y=VALUE or z=VALUE, and a number for VALUE")
        axis = "xyz".index(name)
        if axis in cuts:
            raise Refused(f"--cut {text}: there is a cut across {name} already")
        cuts[axis] = value
    return cuts


def cuts_of(cut: Mapping[str, float] | None) -> dict[int, float]:
    """{axis: value} of values by "x", "y" and "z"."""
    if not set(cut or {}) <= set("xyz"):
        raise Refused(f"cut: expected values by 'x', 'y' and 'z', found {', '.join(map(repr, cut or {}))}")
    return {"xyz".index(axis): float(value) for axis, value in (cut or {}).items()}


def cut_away(place: Array, cuts: Mapping[int, float]) -> Array:
    """Which points are before every cut: several cuts take out a corner."""
    before = np.full(len(place), bool(cuts))
    for axis, value in cuts.items():
        before &= place[:, axis] > value
    return before


def check_cuts(cuts: Mapping[int, float], stages: Sequence[Stage]) -> None:
    for axis, value in cuts.items():
        low, high = (end([end(stage.place[:, axis]) for stage in stages]) for end in (np.min, np.max))
        if not low <= value < high:
            name = "xyz"[axis]
            raise Refused(f"the cut {name}={value:.6g}: the points are between {name} = {low:.6g} and {high:.6g}")


# --- the box around a body -------------------------------------------------------------------------


class Box:
    """Its floor, and scales along the three edges that one sees best."""

    def __init__(self, low: Array, high: Array) -> None:
        self.low, self.high = low, high

    def floor(self) -> Array:
        """Its corners, the one at the lower ends of x and z first."""
        (x, y, z), (far_x, _, far_z) = self.low, self.high
        return projected(np.array([[x, y, z], [far_x, y, z], [far_x, y, far_z], [x, y, far_z]]))

    def top_of_y(self) -> Array:
        return projected(np.array([self.low[0], self.high[1], self.high[2]]))

    def draw(self, panel: Panel, inch: float, line: float) -> None:
        """inch: in metres; line: the height of a line of text [inches]."""
        (x, y, z), (far_x, _, far_z) = self.low, self.high
        panel.axis.fill(*self.floor().T, facecolor="0.955", edgecolor="0.8", linewidth=0.6, zorder=0)
        self.draw_scale(panel, inch, line, 0, [x, y, far_z], projected(np.array([0, 0, 1])), panel.lowest)
        self.draw_scale(panel, inch, line, 1, [x, y, far_z], np.array([-1, 0]), panel.first)
        self.draw_scale(panel, inch, line, 2, [far_x, y, z], projected(np.array([1, 0, 0])), panel.lowest)

    def draw_scale(
        self, panel: Panel, inch: float, line: float, axis: int, begin: Array, outwards: Array, labelled: bool
    ) -> None:
        """Along the edge from `begin` in the direction of an axis; ticks and text on the side of `outwards`."""
        low, high, along = self.low[axis], self.high[axis], np.eye(3)[axis]
        length = np.linalg.norm(projected(along)) * (high - low) / inch
        ticks = MaxNLocator(np.clip(int(length / (1.8 * line)), 1, 5), steps=[1, 2, 5, 10]).tick_values(low, high)
        ticks = ticks[(low <= ticks) & (ticks <= high)]
        room = int(length / (1.5 * line)) + 1  # for as many; the locator finds two at least
        ticks = ticks[:: -int(np.ceil(len(ticks) / room))]
        ends, feet = (projected(begin + np.outer(at - low, along)) for at in (np.array([low, high]), ticks))
        outwards = outwards * inch / np.linalg.norm(outwards)
        for stroke in [ends, *(np.stack([foot, foot + 0.05 * outwards]) for foot in feet)]:
            panel.axis.plot(*stroke.T, color="0.35", linewidth=0.8, zorder=1, clip_on=False)
        if not labelled:
            return
        aligned = {"ha": "left" if outwards[0] > 0 else "right", "va": "top" if outwards[1] < 0 else "center"}
        for value, foot in zip(ticks, feet):
            panel.axis.text(*(foot + 0.08 * outwards), f"{value:.6g}".replace("-", "−"), fontsize="small", **aligned)
        panel.axis.text(*(ends.mean(axis=0) + 1.9 * line * outwards), f"${'xyz'[axis]}$ [m]", ha="center", va="center",
                        rotation=90 if axis == 1 else 0)  # fmt: skip


# --- the picture -----------------------------------------------------------------------------------


def extent_of(places: Sequence[Array]) -> tuple[Array, Array]:
    low, high = (end([end(place, axis=0) for place in places], axis=0) for end in (np.min, np.max))
    return low, high


class SpaceSheet(Sheet):
    RIGHT, GAP = 0.5, 0.5  # numbers and the name z stand there
    BELOW = 1.4  # what is written along the lower edges of a box is inside its panel


def kept(stage: Stage, which: Array) -> Stage:
    mechanism = None if stage.mechanism is None else stage.mechanism[which]
    return replace(stage, place=stage.place[which], values=stage.values[which], mechanism=mechanism)


def colours_at(values: Array, cmap: Any, norm: Any) -> Array:
    """(points × 3)"""
    if values.ndim == 2:  # colours already
        return values[:, :3]
    values = np.where(np.isfinite(values), values, np.nan)
    return cmap.with_extremes(bad=UNKNOWN)(norm(values))[:, :3]


def draw_space(runs: Sequence[Run], field: str, cuts: Mapping[int, float], figure: Figure | None = None) -> Figure:
    """cuts: of read_cuts."""
    stages = [stage for run in runs for stage in run.stages]
    cmap, norm, extend = colours_of(stages) if field != "layers" else (None, None, "neither")
    runs = [replace(run, stages=[kept(stage, of_body(stage.place)) for stage in run.stages]) for run in runs]
    whole = [stage for run in runs for stage in run.stages]
    check_cuts(cuts, whole)
    spacing = [spacing_of(stage.place) for stage in whole]
    runs = [replace(run, stages=[kept(one, ~cut_away(one.place, cuts)) for one in run.stages]) for run in runs]

    places = [stage.place for run in runs for stage in run.stages if len(stage.place)]
    low, high = extent_of(places)
    margin = MARGIN / 2 * (high - low).max() + RADIUS * max(spacing)
    box = Box(low - margin, high + margin)
    low, high = extent_of([projected(place) for place in places])
    low, high = extent_of([box.floor(), box.top_of_y()[None], [low - margin, high + margin]])
    width, height = high - low

    sheet = SpaceSheet(runs, height / width, bar=field != "layers")
    inch = width / sheet.panel_width
    scale = FINER * DPI / inch
    window = Window(low, scale, int(np.ceil(width * scale)), int(np.ceil(height * scale)))
    extent = (low[0], low[0] + window.width / scale, low[1], low[1] + window.height / scale)
    with sheet.drawing(figure) as figure:
        for panel, distance in zip(sheet.panels(), spacing):
            axis, stage = panel.axis, panel.stage
            box.draw(panel, inch, sheet.line)
            if len(stage.place):
                image, seen = surface_image(stage.place, colours_at(stage.values, cmap, norm), distance, window)
                axis.imshow(image, extent=extent, origin="lower", aspect="auto", interpolation="antialiased", zorder=2)
                if stage.mechanism is not None:
                    draw_arrows(axis, projected(stage.place[seen]), projected(stage.mechanism[seen]))
            axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
            axis.axis("off")
        if norm:
            add_colour_bar(figure, sheet.bar(), cmap, norm, extend, name_of(field, 3))
    return figure
