#!/usr/bin/python3
"""plot_compare.py DIR [--out FILE]: the work-precision picture of a comparison, from DIR/compare.json.

Error against force evaluations and against wall time, a line a run (a dot if only its end is known), with the Chebyshev
estimate of a polynomial iteration's worst case. FILE is DIR/compare.png if not given. Exit status 2 and a message if
there is nothing to draw.
"""

import math
import sys

from pictures import COLOURS, STYLE, Refused, draw_study, plain, read_study, title_of  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402

LINES = ["-", "--", ":", "-."]
FLOOR = 1e-16


def read(folder):
    return read_study(folder, "compare", "runs")


WAY = ("strategy", "integrator", "step_fraction", "rtol")


def way_of(run, column):
    """[(evaluations, error)] of a run, its end where there is no more."""
    points = [(sample[0], sample[column]) for sample in run["samples"] if sample[column] is not None]
    if not points and run["evaluations"] > 0 and run["error"] is not None:
        points = [(run["evaluations"], run[("", "error", "residual")[column]])]
    drawn = [(evaluations, error) for evaluations, error in points if evaluations > 0 and math.isfinite(error)]
    return [(evaluations, max(error, FLOOR)) for evaluations, error in drawn]


def draw(comparison, file):
    column = 2 if comparison["goal_of"] == "residual" else 1
    ways = [(run, way_of(run, column)) for run in comparison["runs"]]
    ways = [(run, way) for run, way in ways if way]
    if not ways:
        raise Refused("none of the runs got anywhere: nothing to draw")
    plt.rcParams.update(STYLE)
    figure, (by_evaluations, by_time) = plt.subplots(1, 2, figsize=(13, 6), sharey=True)
    numbers = {}  # of ways; with another mass it is the same way, drawn broad
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
    if comparison["lower_bound"] and column == 1:
        root = comparison["kappa"] ** 0.5
        errors = [10 ** (-k / 4) for k in range(1, 45)]
        by_evaluations.plot([0.5 * root * math.log(2 / e) for e in errors], errors, color="0.5", linewidth=4, alpha=0.4,
                            zorder=0, label="Chebyshev estimate ½ √κ ln(2/ε)")
    goal = comparison["goal"]
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
    figure.savefig(file, dpi=100)


if __name__ == "__main__":
    sys.exit(draw_study("compare", __doc__, read, draw))
