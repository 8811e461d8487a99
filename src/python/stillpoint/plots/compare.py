"""The work-precision picture of a comparison: error against force evaluations and against wall time, a line a run (a dot if
only its end is known), with the Chebyshev estimate of a polynomial iteration's worst case."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure  # type: ignore[import]

from .folders import Refused, read_study, title_of
from .pictures import COLOURS, drawing, plain

LINES = ["-", "--", ":", "-."]
FLOOR = 1e-16
WAY = ("strategy", "integrator", "step_fraction", "rtol")
Way = list[tuple[float, float]]  # (evaluations, error)


def read(folder: Path) -> dict[str, Any]:
    return read_study(folder, "compare", "runs")


def is_known(value: float | None) -> bool:
    return value is not None and math.isfinite(value)


def way_of(run: Mapping[str, Any], column: int) -> Way:
    """That of a run, its end where there is no more. What was not computed is None in a file, NaN in an array."""
    points = [(sample[0], sample[column]) for sample in run["samples"] if is_known(sample[column])]
    if not points and run["evaluations"] > 0 and run["error"] is not None:
        points = [(run["evaluations"], run[("", "error", "residual")[column]])]
    drawn = [(evaluations, error) for evaluations, error in points if evaluations > 0 and is_known(error)]
    return [(evaluations, max(error, FLOOR)) for evaluations, error in drawn]


def ways_of(comparison: Mapping[str, Any], column: int) -> list[tuple[Mapping[str, Any], Way]]:
    """The runs that got anywhere, with their ways."""
    ways = [(run, way_of(run, column)) for run in comparison["runs"]]
    ways = [(run, way) for run, way in ways if way]
    if not ways:
        raise Refused("none of the runs got anywhere: nothing to draw")
    return ways


def draw_ways(by_evaluations: Any, by_time: Any, ways: Sequence[tuple[Mapping[str, Any], Way]]) -> None:
    numbers: dict[tuple[Any, ...], int] = {}  # of ways; with another mass it is the same way, drawn broad
    for run, way in ways:
        number = numbers.setdefault(tuple(run.get(key) for key in WAY), len(numbers))
        look = {
            "color": COLOURS[number % len(COLOURS)],
            "linestyle": LINES[number // len(COLOURS) % len(LINES)],
            "linewidth": 3.0 if run.get("mass") else 1.4,
            "alpha": 0.6 if run.get("mass") else 1,
            "marker": "o" if len(way) == 1 else None,
        }
        label = run["label"] + ("" if run["status"] == "converged" else f" ({run['status']})")
        by_evaluations.plot(*zip(*way), label=plain(label), **look)
        if run["wall_s"] and run["evaluations"] > 0:
            each = run["wall_s"]["median"] / run["evaluations"]
            by_time.plot(*zip(*((each * evaluations, error) for evaluations, error in way)), **look)


def draw_estimate(axis: Any, kappa: float) -> None:
    errors = [10 ** (-k / 4) for k in range(1, 45)]
    evaluations = [0.5 * kappa**0.5 * math.log(2 / error) for error in errors]
    label = "Chebyshev estimate ½ √κ ln(2/ε)"
    axis.plot(evaluations, errors, color="0.5", linewidth=4, alpha=0.4, zorder=0, label=label)


def figure_of(comparison: Mapping[str, Any], figure: Figure | None = None) -> Figure:
    """The figures of compare.json. figure: an empty one to draw on."""
    column = 2 if comparison["goal_of"] == "residual" else 1
    ways, goal = ways_of(comparison, column), comparison["goal"]
    with drawing(figure, 13, 6) as figure:
        by_evaluations, by_time = figure.subplots(1, 2, sharey=True)
        draw_ways(by_evaluations, by_time, ways)
        if comparison["lower_bound"] and column == 1:
            draw_estimate(by_evaluations, comparison["kappa"])
        for axis, what in ((by_evaluations, "force evaluations"), (by_time, "wall time [s]")):
            axis.axhline(goal, color="0.7", linewidth=0.8)
            axis.set(xscale="log", yscale="log", xlabel=what)
            axis.grid(color="0.92")
            axis.set_axisbelow(True)
        lowest = min(error for _, way in ways for _, error in way)
        by_evaluations.set(ylim=(max(lowest, 1e-3 * goal) / 2, 3), ylabel=("", "relative error", "residual")[column])
        columns = 4
        figure.legend(loc="lower center", ncol=columns, frameon=False, fontsize="small")
        figure.suptitle(plain(title_of(comparison)))
        rows = -(-(len(ways) + 1) // columns)
        figure.tight_layout(rect=(0, 0.02 + 0.032 * rows, 1, 1))
    return figure
