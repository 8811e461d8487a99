#!/usr/bin/python3
"""plot_map.py DIR [--out FILE]: the picture of a stability map, from DIR/map.csv.

A row a case and an integrator, a column a strategy, and in it a square for each variant of the case: its outcome by the
colour, with the evaluations where there is room. FILE is DIR/map.png if not given. Exit status 2 and a message if there
is nothing to draw.
"""

import math
import sys

from pictures import draw_table, plain, read_table  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.patches import Patch, Rectangle  # noqa: E402

RIGHT, NAMED, FAULT, WRONG = "#9FD3C7", "#D9D9D9", "#F5C396", "#D55E00"
LEGEND = {RIGHT: "right", NAMED: "a named failure, as expected", FAULT: "a known fault", WRONG: "wrong"}
FALSE = "×"  # marks an answer that is wrong at exit status 0
ASPECT = 4  # of a cell: width over height
MOST_TEXTS = 3  # side by side in a cell
SUCCESS = ("equilibrium", "end-time", "limit-load", "noted")


def colour_of(line):
    if line["outcome"] in line["expected"].split(" | "):
        return RIGHT if line["outcome"] in SUCCESS else NAMED
    return FAULT if line["fault"] else WRONG


def short(count):
    """12345 becomes 12k."""
    value = int(count or 0)
    if value == 0:
        return ""
    return str(value) if value < 1000 else f"{value / 1000:.3g}k" if value < 1_000_000 else f"{value / 1e6:.2g}M"


def place_of(line):
    """(row, column) of a line: "case, integrator" and strategy."""
    case = line["case"].partition(" [")[0]
    integrator, _, strategy = line["way"].rpartition("/")
    return f"{case}, {integrator}" if integrator else case, strategy


def draw_cell(axis, x, y, lines):
    """The variants of a case side by side, in rows of squares if they are many."""
    columns = max(1, min(len(lines), math.ceil(math.sqrt(ASPECT * len(lines)))))
    width, height = 1 / columns, 1 / math.ceil(len(lines) / columns)
    for number, line in enumerate(lines):
        left, top = x + width * (number % columns), y + height * (number // columns)
        colour = colour_of(line)
        hatch = "////" if colour == FAULT else None
        square = Rectangle((left, top), width, height, facecolor=colour, hatch=hatch, edgecolor="white", linewidth=0.4)
        axis.add_patch(square)
        text = FALSE if line["outcome"] == "FALSE" else short(line["evaluations"]) if columns <= MOST_TEXTS else ""
        axis.text(left + width / 2, top + height / 2, text, ha="center", va="center", fontsize=5)


def draw(lines, file):
    cells = {}
    for line in lines:
        cells.setdefault(place_of(line), []).append(line)
    cases = list(dict.fromkeys(case for case, _ in cells))
    strategies = sorted({way for _, way in cells}, key=lambda way: -sum(column == way for _, column in cells))
    figure, axis = plt.subplots(figsize=(4 + ASPECT * 0.2 * len(strategies), 1.6 + 0.2 * len(cases)))
    for (case, strategy), variants in cells.items():
        draw_cell(axis, strategies.index(strategy), cases.index(case), variants)
    axis.set(xlim=(0, len(strategies)), ylim=(len(cases), 0))
    axis.set_xticks([k + 0.5 for k in range(len(strategies))], [plain(way) for way in strategies], fontsize=7)
    axis.set_yticks([k + 0.5 for k in range(len(cases))], [plain(case) for case in cases], fontsize=7)
    axis.tick_params(length=0, labeltop=True)
    for side in axis.spines.values():
        side.set_visible(False)
    axis.hlines(range(len(cases) + 1), 0, len(strategies), color="0.9", linewidth=0.4, zorder=0)
    handles = [Patch(facecolor=colour, hatch="////" if colour == FAULT else None, edgecolor="white", label=label)
               for colour, label in LEGEND.items()]  # fmt: skip
    figure.legend(handles=handles, loc="lower center", ncol=4, frameon=False, fontsize="small")
    title = f"Stability map: {len(lines)} runs; force evaluations, {FALSE} a wrong answer at exit status 0"
    axis.set_title(title, fontsize="medium", pad=24)
    figure.tight_layout(rect=(0, 0.02, 1, 1))
    figure.savefig(file, dpi=100)
    plt.close(figure)


def read(file):
    return read_table(file, "a stability map")


if __name__ == "__main__":
    sys.exit(draw_table("map", __doc__, read, draw))
