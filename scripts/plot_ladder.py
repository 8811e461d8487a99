#!/usr/bin/python3
"""plot_ladder.py DIR [--out FILE]: the picture of an accuracy ladder, from DIR/ladder.csv.

Left each error beside its target on a logarithmic axis, right each observed order with its interval beside the least
order and the theory's; a MISS is a cross. FILE is DIR/ladder.png if not given. Exit status 2 and a message if there is
nothing to draw.
"""

import math
import sys

from pictures import COLOURS, STYLE, draw_table, plain, read_table  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

OK, MISS, KNOWN = COLOURS[0], COLOURS[1], COLOURS[4]
SMALLEST = 1e-16  # an error of 0 is drawn there


def value(line, column):
    """The number of a column, None if there is none."""
    try:
        found = float(line[column])
    except ValueError:
        return None
    return found if math.isfinite(found) else None


def look_of(line):
    if line["ok"] == "ok":
        return {"color": OK, "marker": "o"}
    return {"color": KNOWN if line["known_miss"] else MISS, "marker": "X"}


def name_of(line):
    return plain(f"{line['case']}: {line['quantity']}")


def rows_on(axis, lines):
    axis.set_yticks(range(len(lines)), [name_of(line) for line in lines], fontsize=6)
    axis.set_ylim(max(len(lines), 1) - 0.5, -0.5)
    axis.grid(axis="y", color="0.94")
    axis.set_axisbelow(True)


def draw_errors(axis, lines):
    rows_on(axis, lines)
    for y, line in enumerate(lines):
        target, error = value(line, "target"), value(line, "error")
        if target is not None:
            axis.plot(target, y, marker="|", color="0.3", markersize=8)
        if error is None:
            axis.text(0.99, y, "no value" if line["ok"] != "ok" else "", transform=axis.get_yaxis_transform(),
                      ha="right", va="center", fontsize=6, color=MISS)  # fmt: skip
        else:
            axis.plot(max(error, SMALLEST), y, markersize=5, **look_of(line))
    axis.set(xscale="log", xlabel="relative error, and its target")


def draw_orders(axis, lines):
    rows_on(axis, lines)
    for y, line in enumerate(lines):
        target, order, theory = (value(line, name) for name in ("target", "order", "exact"))
        low, high = value(line, "low"), value(line, "high")
        if low is not None and high is not None:
            axis.plot([low, high], [y, y], color="0.7", linewidth=2)
        for place, marker in ((target, "|"), (theory, "*")):
            if place is not None:
                axis.plot(place, y, marker=marker, color="0.3", markersize=8 if marker == "|" else 5, linestyle="")
        if order is not None:
            axis.plot(order, y, markersize=5, **look_of(line))
    axis.set(xlim=(-2, 9), xlabel="observed order with its interval (95 %)")


def draw(lines, file):
    orders = [line for line in lines if value(line, "order") is not None]
    errors = [line for line in lines if value(line, "order") is None]
    plt.rcParams.update(STYLE)
    height = 1.8 + 0.15 * max(len(errors), len(orders), 4)
    figure, (left, right) = plt.subplots(1, 2, figsize=(15, height))
    draw_errors(left, errors)
    draw_orders(right, orders)
    marks = [({"color": OK, "marker": "o"}, "ok"), ({"color": MISS, "marker": "X"}, "MISS"),
             ({"color": KNOWN, "marker": "X"}, "a known miss"), ({"color": "0.3", "marker": "|"}, "target, or least order"),
             ({"color": "0.3", "marker": "*"}, "theory's order")]  # fmt: skip
    handles = [Line2D([], [], linestyle="", label=label, **look) for look, label in marks]
    figure.legend(handles=handles, loc="lower center", ncol=len(marks), frameon=False, fontsize="small")
    good = sum(line["ok"] == "ok" for line in lines)
    figure.suptitle(f"Accuracy ladder: {good} of {len(lines)} rows meet their targets", fontsize="medium")
    figure.tight_layout(rect=(0, 0.6 / height / 2, 1, 1 - 0.4 / height))
    figure.savefig(file, dpi=100)
    plt.close(figure)


def read(file):
    return read_table(file, "an accuracy ladder")


if __name__ == "__main__":
    sys.exit(draw_table("ladder", __doc__, read, draw))
