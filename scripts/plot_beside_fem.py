#!/usr/bin/python3
"""plot_beside_fem.py DIR: the pictures of scripts/beside_fem, DIR/beside_fem/CASE.png, from DIR/beside_fem.csv.

Above the errors of u and of the stress (the better of a program's two) against unknowns, with the orders in h; below
against the wall time of the whole program, of each size by the quickest solver. Lines with circles are
Stillpoint's, broken ones with squares FEniCSx's. Exit status 2 and a message if there is nothing to draw.
"""

import argparse
import sys
from pathlib import Path

from pictures import COLOURS, STYLE, Refused, read_figures  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402

from beside_fem_cases import CASES
from beside_fem_runs import OURS
from beside_fem_table import by, order, read_csv, seconds_for
from beside_fem_verdict import one_solver
from scaling_table import exponent_text

QUANTITIES = {"u_l2": "relative error of u (L2)", "stress_l2": "relative error of σ (L2)"}


def look_of(number, program):
    ours = program == OURS
    look = {"marker": "o", "linestyle": "-"} if ours else {"marker": "s", "linestyle": "--", "markerfacecolor": "white"}
    return look | {"color": COLOURS[number % len(COLOURS)], "linewidth": 1.4, "markersize": 5}


def draw_errors(axis, rows, quantity, dim):
    """Against unknowns; whatever the solver, the errors are the same."""
    for number, (functions, of_it) in enumerate(one_solver(rows).items()):
        found = [row for row in of_it if row.found]
        if not found:
            continue
        label = f"{functions}: {exponent_text(order(found, dim, quantity))}"
        axis.plot([row.unknowns for row in found], [getattr(row, quantity) for row in found], label=label,
                  **look_of(number, found[0].program))  # fmt: skip
    axis.set(xscale="log", yscale="log", xlabel="unknowns", ylabel=QUANTITIES[quantity])
    axis.legend(title="order in h (95 %)", frameon=False, fontsize="small")


def quickest(rows, quantity):
    """{functions: of each size the row of the quickest solver}"""
    found = {}
    for functions, of_it in by([row for row in rows if row.found], "functions").items():
        found[functions] = [min(of_size, key=lambda row: seconds_for(row, quantity)) for of_size in by(of_it, "cells").values()]
    return found


def draw_times(axis, rows, quantity):
    for number, (functions, of_it) in enumerate(quickest(rows, quantity).items()):
        axis.plot([seconds_for(row, quantity) for row in of_it], [getattr(row, quantity) for row in of_it],
                  label=functions, **look_of(number, of_it[0].program))  # fmt: skip
    axis.set(xscale="log", yscale="log", xlabel="wall time of the whole program, of each size by the quickest solver [s]",
             ylabel=QUANTITIES[quantity])  # fmt: skip
    axis.legend(frameon=False, fontsize="small")


def draw(case, rows, file):
    plt.rcParams.update(STYLE)
    figure, axes = plt.subplots(2, 2, figsize=(12, 10))
    for column, quantity in enumerate(QUANTITIES):
        draw_errors(axes[0, column], rows, quantity, case.dim)
        draw_times(axes[1, column], rows, quantity)
    for axis in axes.flat:
        axis.grid(color="0.92")
        axis.set_axisbelow(True)
    figure.suptitle(f"{case.title}: circles Stillpoint, squares FEniCSx", fontsize="medium")
    figure.tight_layout()
    figure.savefig(file, dpi=100)
    plt.close(figure)


def draw_all(rows, folder):
    """The files that were drawn."""
    files, pictures = [], folder / "beside_fem"
    pictures.mkdir(exist_ok=True)
    for name, of_it in by(rows, "case").items():
        if any(row.found for row in of_it):
            files.append(pictures / f"{name}.png")
            draw(CASES[name], of_it, files[-1])
    return files


def read(file):
    return read_figures(file, read_csv, "scripts/beside_fem")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", type=Path)
    folder = parser.parse_args().folder
    try:
        files = draw_all(read(folder / "beside_fem.csv"), folder)
    except (Refused, OSError) as error:
        print(f"plot_beside_fem: {error}", file=sys.stderr)
        return 2
    print(f"Pictures: {', '.join(map(str, files))}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
