#!/usr/bin/python3
"""plot_fields.py DIR [DIR…] [--field NAME] [--out FILE] [--stages N]: draws the points of DIR/fields.h5 by a field.

In the plane a panel a stage: the points at their deformed places, coloured by the field; several runs have a row each.
A bar has a panel a run, with a line a stage. NAME is what fields.h5 has (plastic_strain, stress_xy, …); of a vector its
length (u) or a component (u_x); or `layers`: alternating layers and columns of the undeformed body, to show what
became of them. Without --field: plastic_strain, or u. N stages are drawn, evenly spread over those in the file: at most
6, or 3 of each of several runs. The last stage of a run that found a limit load has arrows along the velocity, its
mechanism. FILE is DIR/fields.png if not given. Exit status 2 and a message where there is nothing
to draw.
"""

import argparse
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
from pictures import COLOURS, STYLE, Refused, finish, plain, read_summary, title_of  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.colors import BoundaryNorm, ListedColormap, Normalize  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402

SYMBOLS = {"u": ("displacement", "u"), "v": ("velocity", "v"), "stress": ("stress", r"\sigma")}
# Of the layers: the rows alternate in hue, the columns in tone.
LAYERS = np.array([["#0072B2", "#7DC1EA"], ["#D55E00", "#F5B183"]])
MARGIN = 0.04  # around the points, as a share of the larger side


@dataclass
class Stage:
    t: float
    slope_angle: float | None  # [degrees]
    place: np.ndarray  # (points × dim), deformed
    values: np.ndarray  # (points) of the field; colours if that is `layers`
    mechanism: np.ndarray | None = None  # (points × dim), the velocity at a limit load
    factor: float | None = None  # of the loads, there


@dataclass
class Run:
    label: str
    title: str
    dim: int
    stages: list[Stage]


# --- reading ---------------------------------------------------------------------------------------


def fields_on_offer(frame):
    """The names for --field that a frame of fields.h5 can serve."""
    names = []
    for name, dataset in frame.items():
        if name == "place":
            continue
        names.append(name)
        if dataset.ndim == 2:
            names += [f"{name}_{axis}" for axis in "xyz"[: frame.attrs["dim"]]]
    if "u" in names and frame.attrs["dim"] == 2:
        names.append("layers")
    return names


def values_of(frame, field):
    if field in frame:
        values = frame[field][()]
        return np.linalg.norm(values, axis=1) if values.ndim == 2 else values
    vector, _, axis = field.rpartition("_")
    return frame[vector][:, "xyz".index(axis)]


def body(place):
    """Without the few points that flew off: those farther than a quarter of its size from all but 0.2 % of it."""
    low, high = np.percentile(place, [0.1, 99.9], axis=0)
    reach = (high - low).max() / 4
    return place[((place >= low - reach) & (place <= high + reach)).all(axis=1)]


def spacing_of(place):
    """The typical distance of neighbours: √(area/points), the area measured in squares that hold a few points each."""
    place = body(place)
    size = np.ptp(place, axis=0)
    square = 3 * max(np.sqrt(size.prod() / len(place)), size.max() / len(place)) or 1.0
    occupied = len(np.unique(np.floor((place - place.min(axis=0)) / square), axis=0))
    return square * np.sqrt(occupied / len(place))


class Layers:
    """Squares of the undeformed body, about 8 to its shorter side, whole rows of points in each."""

    def __init__(self, undeformed):
        self.origin, self.spacing = undeformed.min(axis=0), self.distance_of_neighbours(undeformed)
        self.rows = max(2, round(np.ptp(undeformed, axis=0).min() / 8 / self.spacing))

    @staticmethod
    def distance_of_neighbours(place):
        """The median over some points."""
        if len(place) == 1:
            return 1.0
        some = place[:: -(-len(place) // 100)]
        return np.median([np.sqrt(np.partition(((place - each) ** 2).sum(axis=1), 1)[1]) for each in some]) or 1.0

    def colours(self, undeformed):
        numbers = np.floor((undeformed - self.origin) / self.spacing + 0.5) // self.rows
        column, row = (numbers % 2).astype(int).T
        return LAYERS[row, column]


def evenly_spread(count, wanted):
    if count <= wanted:
        return list(range(count))
    return [round(k * (count - 1) / (wanted - 1)) for k in range(wanted)] if wanted > 1 else [count - 1]


def slope_angles(summary, folder):
    """{t: angle} of the stages in summary.json."""
    try:
        stages = [(float(stage["t"]), stage["slope_angle"]) for stage in summary.get("stages") or []]
        return {t: float(angle) for t, angle in stages if angle is not None}
    except (TypeError, KeyError, ValueError):
        raise Refused(f"{folder / 'summary.json'}: expected stages of numbers t and slope_angle") from None


def read_stages(frames, field, angles):
    layers, stages = None, []
    for frame in frames:
        t, place = float(frame.attrs["t"]), frame["place"][:, : frame.attrs["dim"]]
        known = np.isfinite(place).all(axis=1)
        if not known.any():
            raise Refused(f"{frame.file.filename}: at t = {t:.4g} no point has a place")
        place = place[known]
        if field == "layers":
            undeformed = place - frame["u"][known, :2]
            layers = layers or Layers(undeformed)
            values = layers.colours(undeformed)
        else:
            values = values_of(frame, field)[known]
        angle = next((angle for at, angle in angles.items() if np.isclose(at, t, rtol=1e-6, atol=0)), None)
        stages.append(Stage(t, angle, place, values))
    return stages


def add_mechanism(stage, frame, summary):
    """To the last stage of a run that ended at the limit load."""
    load = summary.get("load")
    if summary.get("status") != "limit-load" or not isinstance(load, dict) or "v" not in frame:
        return
    known = np.isfinite(frame["place"][:, : frame.attrs["dim"]]).all(axis=1)
    stage.mechanism, stage.factor = frame["v"][known, : frame.attrs["dim"]], load.get("factor")


def read_run(folder, field, wanted):
    """The run, and the field that was chosen for it."""
    summary, label = read_summary(folder)
    file = folder / "fields.h5"
    if not file.exists():
        raise Refused(f"{folder}: no fields.h5; does the scene ask for fields?")
    try:
        with h5py.File(file) as content:
            names = sorted((name for name in content if name.startswith("frame_")), key=lambda name: int(name[6:]))
            if not names:
                raise Refused(f"{file}: no frames, so nothing to draw")
            frames = [content[names[k]] for k in evenly_spread(len(names), wanted)]
            dim = int(frames[0].attrs["dim"])
            if dim > 2:
                raise Refused(f"{file}: only bars and the plane are drawn; fields.xdmf opens in ParaView")
            offers = [fields_on_offer(frame) for frame in frames]
            common = [name for name in offers[0] if all(name in offer for offer in offers)]
            if not common:
                raise Refused(f"{file}: no fields, so nothing to draw")
            field = field or next(name for name in ("plastic_strain", "u", *common) if name in common)
            if field not in common:
                raise Refused(f"{file}: no field '{field}'; there are {', '.join(common)}")
            stages = read_stages(frames, field, slope_angles(summary, folder))
            add_mechanism(stages[-1], frames[-1], summary)
    except (OSError, KeyError, ValueError) as error:
        raise Refused(f"{file}: {error}") from None
    return Run(label, title_of(summary), dim, stages), field


def read_runs(folders, field, wanted):
    runs = []
    for folder in folders:
        run, field = read_run(folder, field, wanted)
        runs.append(run)
    if len({run.dim for run in runs}) > 1:
        raise Refused("a bar and a body in the plane do not go into one picture")
    return runs, field


# --- drawing ---------------------------------------------------------------------------------------


def name_of(field, dim):
    """plastic_strain → plastic strain, u → displacement |u|, stress_xy → stress σ with its indices."""
    name, _, index = field.partition("_")
    if name in SYMBOLS and re.fullmatch("[xyz]{0,2}", index):
        word, symbol = SYMBOLS[name]
        if index:
            return f"{word} ${symbol}_{{{index}}}$"
        return f"{word} ${symbol}$" if dim == 1 else f"{word} $|{symbol}|$"
    return plain(field.replace("_", " "))


def colours_of(stages):
    """(colour map, its range, on which side values lie outside of it). A few extreme points do not set the range."""
    values = np.concatenate([stage.values for stage in stages])
    if values.dtype.kind in "iu":  # a material: a colour a number
        numbers = np.unique(values)
        edges = np.append(numbers - 0.5, numbers[-1] + 0.5)
        colours = [COLOURS[k % len(COLOURS)] for k in range(len(numbers))]
        return ListedColormap(colours), BoundaryNorm(edges, len(numbers)), "neither"
    values = values[np.isfinite(values)]
    if len(values) == 0:
        return plt.get_cmap("viridis"), Normalize(0, 1), "neither"
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
    return plt.get_cmap(cmap), Normalize(low, high), extend


def heading(run, stage, many_runs):
    parts = [plain(run.label)] * many_runs + [f"$t$ = {stage.t:.4g}"]
    if stage.slope_angle is not None:
        parts.append(f"slope {stage.slope_angle:.1f}°")
    if stage.factor is not None:
        parts.append(rf"limit load $\lambda$ = {stage.factor:.4g}")
    return ",  ".join(parts)


class Sheet:
    """The figure, and where its panels are in it, all in inches. 7 wide: legible at half a page's width, too."""

    LEFT, RIGHT, GAP, LARGEST = 0.78, 0.15, 0.2, 6

    def __init__(self, rows, columns, shape, title, bar):
        """shape: height/width of a panel."""
        self.small = columns > 2
        plt.rcParams.update(STYLE | {"font.size": 9.5 if self.small else 13})
        self.line = 0.22 if self.small else 0.28  # the height of a line of text
        self.panel_width = min((7 - self.LEFT - self.RIGHT - (columns - 1) * self.GAP) / columns, self.LARGEST / shape)
        self.panel_height = self.panel_width * shape
        self.top = self.line * (2.4 if title else 1.3)
        self.pitch = self.panel_height + 1.6 * self.line  # from row to row
        bottom = self.line * (5.3 if bar else 2.4)
        self.width = self.LEFT + columns * self.panel_width + (columns - 1) * self.GAP + self.RIGHT
        self.height = self.top + (rows - 1) * self.pitch + self.panel_height + bottom
        self.figure = plt.figure(figsize=(self.width, self.height))
        if title:
            self.figure.suptitle(title, y=1 - 0.4 * self.line / self.height, va="top", fontsize="medium")

    def panel(self, row, column):
        x = self.LEFT + column * (self.panel_width + self.GAP)
        y = self.height - self.top - row * self.pitch - self.panel_height
        return self.axes(x, y, self.panel_width, self.panel_height)

    def bar(self):
        length = min(4, 0.7 * self.width)
        middle = (self.LEFT + self.width - self.RIGHT) / 2
        return self.axes(middle - length / 2, 2 * self.line, length, 0.5 * self.line)

    def axes(self, x, y, width, height):
        return self.figure.add_axes((x / self.width, y / self.height, width / self.width, height / self.height))


def draw_arrows(axis, place, vectors):
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
                edgecolor="black", linewidth=0.5)  # fmt: skip


def draw_plane(runs, field):
    stages = [stage for run in runs for stage in run.stages]
    bodies = [body(stage.place) for stage in stages]
    low = np.min([place.min(axis=0) for place in bodies], axis=0)
    high = np.max([place.max(axis=0) for place in bodies], axis=0)
    margin = MARGIN * (high - low).max() or 1.0
    (x_low, y_low), (x_high, y_high) = low - margin, high + margin
    shape = (y_high - y_low) / (x_high - x_low)

    if len(runs) > 1:
        places = [(row, column) for row, run in enumerate(runs) for column in range(len(run.stages))]
        columns = max(len(run.stages) for run in runs)
    else:
        columns = min(len(stages), 2 if shape < 1 or len(stages) == 4 else 3)
        places = [divmod(k, columns) for k in range(len(stages))]
    sheet = Sheet(places[-1][0] + 1, columns, shape, plain(runs[0].title), bar=field != "layers")
    cmap, norm, extend = colours_of(stages) if field != "layers" else (None, None, None)
    scale = 72 * sheet.panel_width / (x_high - x_low)  # of points, each 1/72 inch
    for (row, column), (run, stage) in zip(places, [(run, stage) for run in runs for stage in run.stages]):
        axis, lowest = sheet.panel(row, column), (row + 1, column) not in places
        axis.set(xlim=(x_low, x_high), ylim=(y_low, y_high))
        axis.set_title(heading(run, stage, len(runs) > 1), fontsize="medium", pad=3)
        for ticks in (axis.xaxis, axis.yaxis):
            ticks.set_major_locator(MaxNLocator(4 if sheet.small else 5, steps=[1, 2, 5, 10]))
        axis.tick_params(labelbottom=lowest, labelleft=column == 0)
        axis.set(xlabel="$x$" if lowest else "", ylabel="$y$" if column == 0 else "")
        spacing = scale * spacing_of(stage.place)
        diameter = max(spacing, min(1.4 * spacing, 2.5), 0.9)  # fine ones overlap: gaps as fine as pixels make moirés
        axis.scatter(*stage.place.T, c=stage.values, s=diameter**2, cmap=cmap, norm=norm, linewidths=0, rasterized=True)
        if stage.mechanism is not None:
            draw_arrows(axis, stage.place, stage.mechanism)
    if norm:
        add_colour_bar(sheet.figure, sheet.bar(), cmap, norm, extend, name_of(field, 2))
    return sheet.figure


def add_colour_bar(figure, axis, cmap, norm, extend, label):
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


def draw_bars(runs, field):
    """Field against place, in a panel a run."""
    plt.rcParams.update(STYLE | {"font.size": 11})
    figure, axes = plt.subplots(1, len(runs), figsize=(6 * len(runs), 4.8), squeeze=False, sharex=True, sharey=True)
    for axis, run in zip(axes[0], runs):
        shades = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(run.stages)))
        for stage, shade in zip(run.stages, shades):
            order = np.argsort(stage.place[:, 0])
            x, values = stage.place[order, 0], stage.values[order]
            axis.plot(x, values, ".-", color=shade, linewidth=1.2, markersize=4, label=f"$t$ = {stage.t:.4g}")
        axis.set(xlabel="place $x$", ylabel=name_of(field, 1) if axis is axes[0][0] else "")
        axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
        axis.grid(color="0.92")
        axis.set_axisbelow(True)
        axis.legend(frameon=False, fontsize="small")
        if len(runs) > 1:
            axis.set_title(plain(run.label), fontsize="medium")
    figure.suptitle(plain(runs[0].title))
    figure.tight_layout()
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", type=Path, nargs="+")
    parser.add_argument("--field", metavar="NAME")
    parser.add_argument("--out", metavar="FILE", type=Path)
    parser.add_argument("--stages", metavar="N", type=int)
    options = parser.parse_args()
    if options.stages is not None and options.stages < 1:
        parser.error("--stages: there should be one at least")
    wanted = options.stages or (6 if len(options.folders) == 1 else 3)

    def draw(file):
        runs, field = read_runs(options.folders, options.field, wanted)
        figure = (draw_bars if runs[0].dim == 1 else draw_plane)(runs, field)
        figure.savefig(file, dpi=150)

    return finish("plot_fields", draw, options.out or options.folders[0] / "fields.png")


if __name__ == "__main__":
    sys.exit(main())
