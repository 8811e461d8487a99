#!/usr/bin/python3
"""plot_fields.py DIR [DIR…] [--field NAME] [--cut x=VALUE]… [--out FILE] [--stages N]: draws the points of
DIR/fields.h5 by a field.

In the plane a panel a stage: the points at their deformed places, coloured by the field; several runs have a row each.
A bar has a panel a run, with a line a stage. NAME is what fields.h5 has (plastic_strain, stress_xy, …); of a vector its
length (u) or a component (u_x); or `layers`: alternating layers and columns of the undeformed body, to show what
became of them. Without --field: plastic_strain if some point has yielded, or u. N stages are drawn, evenly spread over those
in the file: at most 6, or 3 of each of several runs. A slope angle is told if a probe of the scene asks for it. The last
stage of a run that found a limit load has arrows along the velocity, its mechanism. FILE is DIR/fields.png if not given.
Exit status 2 and a message where there is nothing to draw.

A body in space is seen from where x, y and z are large, y up, with one scale along all three. Its surface is lit: the
top has the colours of the bar, a little paler, what turns away from the light darker ones; points whose value is no
number are grey. --cut x=VALUE (y=, z=) takes away what lies before the plane where x has this value [m], in every stage,
and shows the inside; several cuts, across different axes, take away what lies before all of them, a corner. The arrows
of a mechanism are those of the points that one sees, as they appear along the view: motion straight towards the viewer
has none.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
from pictures import STYLE, Refused, finish, plain  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from field_sheet import DPI, MARGIN, Sheet, add_colour_bar, colours_of, draw_arrows, name_of  # noqa: E402
from field_space import draw_space, read_cuts  # noqa: E402
from field_stages import body, read_runs, spacing_of  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402


def draw_plane(runs, field):
    stages = [stage for run in runs for stage in run.stages]
    bodies = [body(stage.place) for stage in stages]
    low = np.min([place.min(axis=0) for place in bodies], axis=0)
    high = np.max([place.max(axis=0) for place in bodies], axis=0)
    margin = MARGIN * (high - low).max() or 1.0
    (x_low, y_low), (x_high, y_high) = low - margin, high + margin
    shape = (y_high - y_low) / (x_high - x_low)

    sheet = Sheet(runs, shape, bar=field != "layers")
    cmap, norm, extend = colours_of(stages) if field != "layers" else (None, None, None)
    scale = 72 * sheet.panel_width / (x_high - x_low)  # of points, each 1/72 inch
    for panel in sheet.panels():
        axis, stage = panel.axis, panel.stage
        axis.set(xlim=(x_low, x_high), ylim=(y_low, y_high))
        for ticks in (axis.xaxis, axis.yaxis):
            ticks.set_major_locator(MaxNLocator(4 if sheet.small else 5, steps=[1, 2, 5, 10]))
        axis.tick_params(labelbottom=panel.lowest, labelleft=panel.first)
        axis.set(xlabel="$x$ [m]" if panel.lowest else "", ylabel="$y$ [m]" if panel.first else "")
        spacing = scale * spacing_of(stage.place)
        diameter = max(spacing, min(1.4 * spacing, 2.5), 0.9)  # fine ones overlap: gaps as fine as pixels make moirés
        axis.scatter(*stage.place.T, c=stage.values, s=diameter**2, cmap=cmap, norm=norm, linewidths=0, rasterized=True)
        if stage.mechanism is not None:
            draw_arrows(axis, stage.place, stage.mechanism)
    if norm:
        add_colour_bar(sheet.figure, sheet.bar(), cmap, norm, extend, name_of(field, 2))
    return sheet.figure


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
        axis.set(xlabel="position $x$ [m]", ylabel=name_of(field, 1) if axis is axes[0][0] else "")
        axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
        axis.grid(color="0.92")
        axis.set_axisbelow(True)
        axis.legend(frameon=False, fontsize="small")
        if len(runs) > 1:
            axis.set_title(plain(run.label), fontsize="medium")
    figure.suptitle(plain(runs[0].title))
    figure.tight_layout()
    return figure


def figure_of(runs, field, cuts):
    if runs[0].dim == 3:
        return draw_space(runs, field, cuts)
    return (draw_bars if runs[0].dim == 1 else draw_plane)(runs, field)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", type=Path, nargs="+")
    parser.add_argument("--field", metavar="NAME")
    parser.add_argument("--out", metavar="FILE", type=Path)
    parser.add_argument("--cut", metavar="AXIS=VALUE", action="append", default=[])
    parser.add_argument("--stages", metavar="N", type=int)
    options = parser.parse_args()
    if options.stages is not None and options.stages < 1:
        parser.error("--stages: there should be one at least")
    wanted = options.stages or (6 if len(options.folders) == 1 else 3)

    def draw(file):
        cuts = read_cuts(options.cut)
        runs, field = read_runs(options.folders, options.field, wanted)
        if cuts and runs[0].dim < 3:
            raise Refused(f"--cut {options.cut[0]}: only a body in space (dim = 3) is cut, this one has {runs[0].dim}")
        figure_of(runs, field, cuts).savefig(file, dpi=DPI)

    return finish("plot_fields", draw, options.out or options.folders[0] / "fields.png")


if __name__ == "__main__":
    sys.exit(main())
