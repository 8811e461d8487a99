"""The picture of a convergence study: errors against the size of what is refined, and against wall time: speed against error.

Thin grey lines have the orders that theory knows, or else the whole one (1, 2, 3…) that is nearest to what was measured, each
below the smallest errors of that order. Of several series each is a line, of the quantity that all have an error of.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Optional

from matplotlib.figure import Figure  # type: ignore[import]

from .folders import Refused, read_study, title_of
from .pictures import COLOURS, drawing, plain

MARKERS = "osd^v<>"
MOST_TICKS = 8
SIZES = {"h": "$h$ [m]", "points": "1/points per cell", "step": "step [s]", "rtol": "rtol", "motion": "max_motion [cells]"}
Points = list[tuple[float, float, float]]  # (size, wall time, error) of levels
Order = Optional[Mapping[str, Any]]
Line = tuple[str, Points, Order]  # a name, its levels, and the order that was found


def read(folder: Path) -> dict[str, Any]:
    return read_study(folder, "converge", "quantities", "series")


def points_of(study: Mapping[str, Any], quantity: str) -> Points:
    """The levels that have an error."""
    found = []
    for level, error in zip(study["levels"], study["quantities"][quantity]["errors"]):
        if error is not None and error > 0 and math.isfinite(error) and level["size"]:
            found.append((level["size"], level["wall_s"], error))
    return found


def lines_of(study: Mapping[str, Any]) -> list[Line]:
    """The quantities of a study, or its series by the first quantity that most of them have errors of."""
    if "series" not in study:
        lines = [(name, points_of(study, name), study["orders"].get(name)) for name in study["quantities"]]
        return [line for line in lines if line[1]]
    quantity = quantity_of(study["series"])
    series = [one for one in study["series"] if quantity in one["quantities"]]
    lines = [(", ".join(one["set"]), points_of(one, quantity), one["orders"].get(quantity)) for one in series]
    return [line for line in lines if line[1]]


def quantity_of(series: Sequence[Mapping[str, Any]]) -> str:
    """The first quantity that most of the series have errors of."""
    counts: dict[str, int] = {}
    for one in series:
        for name in one["quantities"]:
            counts[name] = counts.get(name, 0) + bool(points_of(one, name))
    return max(counts, key=lambda name: counts[name], default="")


def label_of(name: str, order: Order) -> str:
    if not order:
        return name
    interval = f" ({order['low']:.2f} to {order['high']:.2f})" if order["low"] is not None else ""
    return f"{name}: {order['order']:.2f}{interval}"


def order_beside(points: Points, order: Order) -> float | None:
    """That of theory, or else the whole one nearest to what was measured; None of a single level."""
    if order and order.get("theory"):
        return float(order["theory"])
    if len(points) < 2:
        return None
    (coarse, _, larger), (size, _, error) = points[-2:]
    slope = float(order["order"]) if order else math.log(larger / error) / math.log(coarse / size)
    return max(1, round(slope))


def lowest_by_order(lines: Sequence[Line]) -> dict[float, Points]:
    """{order that is drawn: the levels of the smallest error beside which it stands}."""
    lowest: dict[float, Points] = {}
    for _, points, order in lines:
        beside = order_beside(points, order)
        if beside and len(points) > 1 and (beside not in lowest or points[-1][2] < lowest[beside][-1][2]):
            lowest[beside] = points
    return lowest


def draw_slope(axis: Any, points: Points, order: float) -> None:
    """A line of the order over all levels, below their errors."""
    below = 0.6 * min(error / size**order for size, _, error in points)
    sizes = [points[-1][0], points[0][0]]
    errors = [below * size**order for size in sizes]
    axis.plot(sizes, errors, color="0.6", linewidth=0.8, zorder=0)
    axis.annotate(f"{order:g}", (sizes[1], errors[1]), color="0.4", textcoords="offset points", xytext=(4, -3),
                  fontsize="small")


def name_sizes(axis: Any, sizes: Sequence[float]) -> None:
    """Ticks at the levels, if there are few enough to be read."""
    if len(sizes) <= MOST_TICKS:
        axis.set_xticks(sizes, [f"{size:.3g}" for size in sizes])
        axis.set_xticks([], minor=True)


def draw_lines(by_size: Any, by_time: Any, lines: Sequence[Line]) -> None:
    for number, (name, points, order) in enumerate(lines):
        look = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)], "linewidth": 1.4}
        sizes, times, errors = zip(*points)
        by_size.plot(sizes, errors, label=plain(label_of(name, order)), **look)
        by_time.plot(times, errors, **look)
    for beside, points in lowest_by_order(lines).items():
        draw_slope(by_size, points, beside)


def figure_of(study: Mapping[str, Any], figure: Figure | None = None) -> Figure:
    """The figures of converge.json. figure: an empty one to draw on."""
    lines = lines_of(study)
    if not lines:
        raise Refused("no level has an error: nothing to draw")
    first = study["series"][0] if "series" in study else study
    with drawing(figure, 12, 5.5) as figure:
        by_size, by_time = figure.subplots(1, 2, sharey=True)
        draw_lines(by_size, by_time, lines)
        for axis, what in ((by_size, SIZES[study["refined"][0]]), (by_time, "wall time [s]")):
            axis.set(xscale="log", yscale="log", xlabel=what)
            axis.grid(color="0.92")
            axis.set_axisbelow(True)
        name_sizes(by_size, sorted({point[0] for _, points, _ in lines for point in points}))
        of = f"{quantity_of(study['series'])}: " if "series" in study else ""
        by_size.set_ylabel(textwrap.fill(plain(f"{of}error against {first['reference']}"), 50))
        by_size.legend(title="order (95 %)", frameon=False, fontsize="small")
        figure.suptitle(plain(title_of(study)))
        figure.tight_layout()
    return figure
