#!/usr/bin/python3
"""plot_scaling.py DIR [--out FILE]: the picture of a scaling study, from DIR/scaling.csv.

Left time, right evaluations against the number of unknowns, a line a way to rest, with the exponents beyond 5000
unknowns below; a ring where a way is as quick as Newton's method with CHOLMOD. FILE is DIR/scaling.png if not given. Exit status 2 and a message if there is nothing to draw.
"""

import sys

from pictures import COLOURS, STYLE, draw_table, plain, read_figures  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402

from scaling_table import by_way, exponent, exponent_text, overtaken, read_csv

MARKERS = "osd^v<>"


def label_of(way, rows, quantity):
    fitted = exponent_text(exponent(rows, quantity))
    return plain(f"{way}: {fitted}" if fitted else way)


def draw_quantity(axis, rows, quantity, name):
    for number, (way, of_way) in enumerate(by_way(rows).items()):
        found = [row for row in of_way if row.found]
        look = {"color": COLOURS[number % len(COLOURS)], "marker": MARKERS[number % len(MARKERS)], "linewidth": 1.4}
        axis.plot([row.unknowns for row in found], [getattr(row, quantity) for row in found],
                  label=label_of(way, of_way, quantity), **look)  # fmt: skip
    for _way, unknowns, value in overtaken(rows) if quantity == "seconds" else ():
        axis.plot(unknowns, value, marker="o", markersize=11, fillstyle="none", color="0.2", zorder=3)
    axis.set(xscale="log", yscale="log", xlabel="unknowns", ylabel=name)
    axis.grid(color="0.92")
    axis.set_axisbelow(True)
    axis.legend(title="exponent (95 %)", frameon=False, fontsize="small", ncol=2, loc="upper center",
                bbox_to_anchor=(0.5, -0.13))  # fmt: skip


def draw(rows, file):
    plt.rcParams.update(STYLE)
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 6))
    draw_quantity(left, rows, "seconds", "wall time [s]")
    draw_quantity(right, rows, "evaluations", "force evaluations")
    figure.suptitle("An elastic block to rest: time and evaluations to a residual of 1e-6", fontsize="medium")
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    plt.close(figure)


def read(file):
    return read_figures(file, read_csv, "a scaling study")


if __name__ == "__main__":
    sys.exit(draw_table("scaling", __doc__, read, draw))
