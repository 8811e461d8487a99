#!/usr/bin/python3
"""plot_history.py DIR [DIR…] [--out FILE]: draws the probes of runs against time, from each DIR/history.csv.

A panel a field, a colour a run, a line style a probe or a component of it; where the panels differ in their lines, each
has a key of its own. A DIR whose subfolders hold runs too (the variants of its scene) is not drawn itself: its variants
are, and where its run ended in equilibrium, that is a grey line. FILE is DIR/history.png if not given. Exit status 2 and
a message where there is nothing to draw.
"""

import argparse
import csv
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from pictures import COLOURS, STYLE, Refused, finish, plain, read_summary, title_of  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

STYLES = ["-", "--", ":", "-."]
FIELDS = {  # in this order
    "u": "displacement $u$",
    "v": "velocity $v$",
    "strain": "strain",
    "stress": "stress",
    "plastic_strain": "plastic strain",
    "slope_angle": "slope angle [°]",
    "force": "force",
    "external_work": "external work",
    "kinetic_over_work": "kinetic energy / external work",
}
TOGETHER = {"normal": "force", "shear": "force"}  # fields of one panel: those of a wall
COUNTERS = {"t", "steps", "rhs_evaluations"}
COLUMN = re.compile(r"(?P<probe>.+?)\.(?P<field>[^.]+)(?:\.(?P<component>[xyz]{1,2}))?")


@dataclass
class Run:
    folder: Path
    label: str
    title: str
    in_equilibrium: bool
    columns: dict[str, list[float]]  # by the header's names: t, …, <probe>.<field>


def read_columns(file):
    """history.csv → {name: values}. An empty cell is a figure that was not computed."""
    try:
        with open(file, newline="", encoding="utf-8") as text:
            rows = [row for row in csv.reader(text) if row]
    except FileNotFoundError:
        raise Refused(f"{file.parent}: no history.csv; is this the folder of a run?") from None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Refused(f"{file}: {error}") from None
    if not rows or "t" not in rows[0]:
        raise Refused(f"{file}: the first line should name the columns, one of them t")
    names = rows[0]
    if len(rows) == 1:
        raise Refused(f"{file}: no rows, so nothing to draw")
    for number, row in enumerate(rows[1:], start=2):
        if len(row) != len(names):
            raise Refused(f"{file}: row {number} has {len(row)} cells, expected {len(names)}")
    try:
        return {name: [float(cell or "nan") for cell in cells] for name, *cells in zip(*rows)}
    except ValueError as error:
        raise Refused(f"{file}: {error}") from None


def read_run(folder):
    columns = read_columns(folder / "history.csv")
    summary, label = read_summary(folder)
    return Run(folder, label, title_of(summary), summary.get("status") == "equilibrium", columns)


def find_runs(folders):
    """The runs to draw, and the base run whose variants they are, if they are."""
    if len(folders) == 1:
        folders = folders + sorted(path.parent for path in folders[0].glob("*/history.csv"))
    parents = {folder.resolve().parent for folder in folders}
    base = [folder for folder in folders if folder.resolve() in parents]
    runs = [read_run(folder) for folder in folders if folder not in base]
    return runs, read_run(base[0]) if base else runs[0]


def place_of(name):
    """Column → (panel, line in it): toe.u.x is the line 'toe x' of u; a figure of the run is a line without a name."""
    parts = COLUMN.fullmatch(name)
    if not parts:
        return name, ""
    probe, field, component = parts.group("probe", "field", "component")
    if field in TOGETHER:
        return TOGETHER[field], f"{probe} {field}"
    return field, f"{probe} {component}" if component else probe


def curves(runs):
    """{field: [(run, line, column)…]}, in the order of the panels; without probes the run's own figures."""
    names = list(dict.fromkeys(name for run in runs for name in run.columns if name not in COUNTERS))
    probed = [name for name in names if "." in name]
    panels = {}
    for name in probed or names:
        field, line = place_of(name)
        panels.setdefault(field, []).extend((run, line, name) for run in runs if name in run.columns)
    if not panels:
        raise Refused(f"{runs[0].folder / 'history.csv'}: no column to draw against t")
    order = list(FIELDS)
    return dict(sorted(panels.items(), key=lambda panel: order.index(panel[0]) if panel[0] in order else len(order)))


def lines_of(panel):
    return list(dict.fromkeys(line for _, line, _ in panel if line))


def keys_of(numbers, by_line):
    return [
        Line2D(
            [],
            [],
            color=COLOURS[number % len(COLOURS)] if by_line else "0.2",
            linestyle=STYLES[number % len(STYLES)],
            label=plain(line),
        )
        for line, number in numbers.items()
        if line
    ]


def draw(runs, base, file):
    panels = curves(runs)
    lines = list(dict.fromkeys(line for panel in panels.values() for line in lines_of(panel)))
    alike = all(lines_of(panel) == lines for panel in panels.values())  # then one key serves all panels

    plt.rcParams.update(STYLE | {"font.size": 11})
    columns = min(len(panels), 3)
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(6 * columns, 4.8 * rows), squeeze=False)
    for axis in axes.flat[len(panels) :]:
        axis.set_visible(False)
    for axis, (field, panel) in zip(axes.flat, panels.items()):
        numbers = {line: number for number, line in enumerate(lines if alike else lines_of(panel))} | {"": 0}
        by_line = not alike and len(runs) == 1
        for run, line, name in panel:
            colour = COLOURS[(numbers[line] if by_line else runs.index(run)) % len(COLOURS)]
            style = STYLES[numbers[line] % len(STYLES)]
            axis.plot(run.columns["t"], run.columns[name], style, color=colour, linewidth=1.6)
        if base.in_equilibrium:
            for last in {base.columns[name][-1] for _, line, name in panel if line and name in base.columns}:
                axis.axhline(last, color="0.6", linewidth=0.9, zorder=0)
        orders_of_magnitude = not lines or field == "kinetic_over_work"  # the residual and the kinetic energy
        if orders_of_magnitude and any(value > 0 for run, _, name in panel for value in run.columns[name]):
            axis.set_yscale("log")
        else:
            axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
        if not alike:
            axis.legend(handles=keys_of(numbers, by_line), frameon=False, fontsize="small")
        axis.set(xlabel="time $t$", ylabel=FIELDS.get(field, plain(field.replace("_", " "))))
        axis.margins(x=0)
        times = [t for run, _, _ in panel for t in (run.columns["t"][0], run.columns["t"][-1])]
        if min(times) < max(times):
            axis.set_xlim(min(times), max(times))  # where a figure is not known, too
        axis.grid(color="0.92")
        axis.set_axisbelow(True)

    keys = []
    if len(runs) > 1:
        keys += [
            Line2D([], [], color=COLOURS[number % len(COLOURS)], linewidth=2.4, label=plain(run.label))
            for number, run in enumerate(runs)
        ]
    if alike:
        keys += keys_of({line: number for number, line in enumerate(lines)}, False)
    if base.in_equilibrium and lines:
        keys.append(Line2D([], [], color="0.6", linewidth=0.9, label="equilibrium"))
    keys_a_row = min(3 * columns, 7)
    key_rows = -(-len(keys) // keys_a_row)
    if keys:
        figure.legend(handles=keys, loc="lower center", ncol=keys_a_row, frameon=False)
    figure.suptitle(plain(base.title))
    figure.tight_layout(rect=(0, (0.02 + 0.055 * key_rows) / rows, 1, 1))
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", type=Path, nargs="+")
    parser.add_argument("--out", metavar="FILE", type=Path)
    options = parser.parse_args()
    file = options.out or options.folders[0] / "history.png"
    return finish("plot_history", lambda out: draw(*find_runs(options.folders), out), file)


if __name__ == "__main__":
    sys.exit(main())
