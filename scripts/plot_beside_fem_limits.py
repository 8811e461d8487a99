#!/usr/bin/python3
"""plot_beside_fem_limits.py DIR: the pictures of scripts/beside_fem_limits.py, DIR/beside_fem/PROBLEM.png.

Of the footing the error of the limit load against unknowns and against time, and the factor on the way to it; of the block the
force of the plate against the compression, and how far it is off that of the finest finite elements whose sides stick. Lines
with circles are Stillpoint's, broken ones with squares FEniCSx's. Exit status 2 and a message if there is nothing to draw.
"""

import argparse
import sys
from pathlib import Path

from pictures import STYLE, Refused  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402

from beside_fem_limits_table import BLOCK, FOOTING, LIMIT, load_at, places_of, read_csv, reference
from beside_fem_table import by
from plot_beside_fem import look_of


def draw_errors(axis, ways, over, label):
    for number, rows in enumerate(ways):
        axis.plot([getattr(row, over) for row in rows], [abs(row.error) for row in rows], label=rows[0].way,
                  **look_of(number, rows[0].program))  # fmt: skip
    axis.set(xscale="log", yscale="log", xlabel=label, ylabel="relative error of N_c")


def line_of(number, row):
    """A path's look: no markers, of which it has too many."""
    look = look_of(number, row.program)
    return {key: look[key] for key in ("color", "linestyle", "linewidth")}


def draw_footing(rows, paths, file):
    ways = [found for of_it in by(rows, "way").values() if (found := [row for row in of_it if row.found])]
    if not ways:
        return []
    figure, (by_unknowns, by_time, on_the_way) = plt.subplots(1, 3, figsize=(17, 5.5))
    draw_errors(by_unknowns, ways, "unknowns", "unknowns")
    draw_errors(by_time, ways, "whole_s", "wall time [s]")
    by_unknowns.legend(frameon=False, fontsize="small")
    for number, rows in enumerate(ways):
        x, y = places_of(rows[-1], paths)
        on_the_way.plot(1e3 * x, y, label=f"{rows[-1].way}, {rows[-1].cells} cells", **line_of(number, rows[-1]))
    on_the_way.axhline(LIMIT, color="0.6", linewidth=0.8)
    on_the_way.set(xlabel="mean settlement [mm]", ylabel="λ; the thin line is 2 + π", ylim=(3.5, 5.4))
    on_the_way.legend(frameon=False, fontsize="small", loc="lower right")
    return finish(figure, (by_unknowns, by_time, on_the_way), "The limit load of a strip footing on clay", file)


def draw_block(rows, paths, file):
    ways = [found[-1] for of_it in by(rows, "way").values() if (found := [row for row in of_it if row.found])]
    if not ways:
        return []
    figure, (forces, apart) = plt.subplots(1, 2, figsize=(14, 5.5))
    to = reference(rows, paths)
    for number, row in enumerate(ways):
        x, y = places_of(row, paths)
        look = line_of(number, row)
        forces.plot(100 * x, y, label=f"{row.way}, {row.cells} cells a side", **look)
        if row.ended:
            forces.plot(100 * x[-1], y[-1], "x", color=look["color"])
        theirs = [load_at(to, paths, along) if to else None for along in x]
        shown = [k for k, load in enumerate(theirs) if load and x[k] >= 0.05]
        apart.plot(100 * x[shown], [100 * (y[k] / theirs[k] - 1) for k in shown], **look)
    forces.set(yscale="log", ylim=(0.05, None), xlabel="compression [%]; a cross where a run ends", ylabel="force of the plate/E")
    apart.set(ylim=(-10, 10), xlabel="compression [%]", ylabel="force, off that of the finest elements whose sides stick [%]")
    forces.legend(frameon=False, fontsize="small")
    return finish(figure, (forces, apart), "A block pressed between rough plates", file)


def finish(figure, axes, title, file):
    for axis in axes:
        axis.grid(color="0.92")
        axis.set_axisbelow(True)
    figure.suptitle(f"{title}: whole lines Stillpoint, broken ones FEniCSx", fontsize="medium")
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    plt.close(figure)
    return [file]


def draw_all(rows, paths, folder):
    """The files that were drawn."""
    plt.rcParams.update(STYLE)
    pictures = folder / "beside_fem"
    pictures.mkdir(exist_ok=True)
    drawn = {FOOTING: draw_footing, BLOCK: draw_block}
    return sum((drawn[problem](of_it, paths, pictures / f"{problem}.png")
                for problem, of_it in by(rows, "problem").items()), [])  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", type=Path)
    folder = parser.parse_args().folder
    try:
        files = draw_all(*read_csv(folder), folder)
        if not files:
            raise Refused(f"{folder}: no figures")
    except (Refused, OSError, ValueError, TypeError) as error:
        print(f"plot_beside_fem_limits: {error}", file=sys.stderr)
        return 2
    print(f"Pictures: {', '.join(map(str, files))}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
