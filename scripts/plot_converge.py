#!/usr/bin/python3
"""plot_converge.py DIR [--out FILE]: the picture of a convergence study, from DIR/converge.json.

Errors against the size of what is refined, with slopes of the orders that theory knows beside the finest level, and the
same errors against wall time: speed against error. Of several series each is a line, of the quantity that all have an
error of. FILE is DIR/converge.png if not given. Exit status 2 and a message if there is nothing to
draw.
"""

import math
import sys

from pictures import COLOURS, STYLE, Refused, draw_study, plain, read_study, title_of  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402

MARKERS = "osd^v<>"
SIZES = {"h": "h [m]", "points": "1/points per cell", "step": "step [s]", "rtol": "rtol", "motion": "max_motion [cells]"}


def read(folder):
    return read_study(folder, "converge", "quantities", "series")


def points_of(study, quantity):
    """[(size, wall time, error)] of the levels that have one."""
    found = []
    for level, error in zip(study["levels"], study["quantities"][quantity]["errors"]):
        if error is not None and error > 0 and math.isfinite(error) and level["size"]:
            found.append((level["size"], level["wall_s"], error))
    return found


def lines_of(study):
    """[(name, [(size, wall time, error)], order or None)]: the quantities of a study, or its series by the first
    quantity that most of them have errors of."""
    if "series" not in study:
        lines = [(name, points_of(study, name), study["orders"].get(name)) for name in study["quantities"]]
        return [line for line in lines if line[1]]
    quantity = quantity_of(study["series"])
    return [(", ".join(one["set"]), points, one["orders"].get(quantity))
            for one in study["series"] if quantity in one["quantities"] and (points := points_of(one, quantity))]


def quantity_of(series):
    """The first quantity that most of the series have errors of."""
    counts = {}
    for one in series:
        for name in one["quantities"]:
            counts[name] = counts.get(name, 0) + bool(points_of(one, name))
    return max(counts, key=counts.get, default=None)


def label_of(name, order):
    if not order:
        return name
    interval = f" ({order['low']:.2f} to {order['high']:.2f})" if order["low"] is not None else ""
    return f"{name}: {order['order']:.2f}{interval}"


def lowest_by_theory(lines):
    """{order that theory knows: the levels of the smallest error that has it}."""
    lowest = {}
    for _, points, order in lines:
        theory = (order or {}).get("theory")
        if theory and len(points) > 1 and (theory not in lowest or points[-1][2] < lowest[theory][-1][2]):
            lowest[theory] = points
    return lowest


def draw_slope(axis, points, order):
    """A line of the order below the two finest levels."""
    size, _, error = points[-1]
    coarse = points[-2][0]
    below = 0.6
    ends = [size, coarse], [below * error, below * error * (coarse / size) ** order]
    axis.plot(*ends, color="0.6", linewidth=1, zorder=0)
    axis.annotate(f"{order:g}", (math.sqrt(size * coarse), math.sqrt(ends[1][0] * ends[1][1])), color="0.5",
                  textcoords="offset points", xytext=(4, -10), fontsize="small")


def draw(study, file):
    lines = lines_of(study)
    if not lines:
        raise Refused("no level has an error: nothing to draw")
    first = study["series"][0] if "series" in study else study
    plt.rcParams.update(STYLE)
    figure, (by_size, by_time) = plt.subplots(1, 2, figsize=(12, 5.5), sharey=True)
    for number, (name, points, order) in enumerate(lines):
        look = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)], "linewidth": 1.4}
        sizes, times, errors = zip(*points)
        by_size.plot(sizes, errors, label=plain(label_of(name, order)), **look)
        by_time.plot(times, errors, **look)
    for theory, points in lowest_by_theory(lines).items():
        draw_slope(by_size, points, theory)
    for axis, what in ((by_size, SIZES[study["refined"][0]]), (by_time, "wall time [s]")):
        axis.set(xscale="log", yscale="log", xlabel=what)
        axis.grid(color="0.92")
        axis.set_axisbelow(True)
    of = f"{quantity_of(study['series'])}: " if "series" in study else ""
    by_size.set_ylabel(plain(f"{of}error against {first['reference']}"))
    by_size.legend(title="order (95 %)", frameon=False, fontsize="small")
    figure.suptitle(plain(title_of(study)))
    figure.tight_layout()
    figure.savefig(file, dpi=100)


if __name__ == "__main__":
    sys.exit(draw_study("converge", __doc__, read, draw))
