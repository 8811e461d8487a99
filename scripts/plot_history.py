#!/usr/bin/python3
"""plot_history.py DIR [DIR…] [--out FILE]: draws the probes of runs against time, from each DIR/history.csv.

A panel a field, a colour a run, a line style a probe. A DIR whose subfolders hold runs too (the variants of its scene)
is not drawn itself: its variants are, and where its run ended in equilibrium, that is a grey line. FILE is
DIR/history.png if not given. Exit status 2 and a message where there is nothing to draw.
"""

import argparse
import csv
import json
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]  # Okabe and Ito
STYLES = ["-", "--", ":", "-."]
FIELDS = {"u": "displacement $u$", "v": "velocity $v$", "strain": "strain", "stress": "stress"}  # in this order
COUNTERS = {"t", "steps", "rhs_evaluations"}


class Refused(Exception):
    """What is wrong with the input."""


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
    summary, label = {}, folder.resolve().name
    try:
        if (folder / "summary.json").exists():
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if (folder / "label").exists():
            label = (folder / "label").read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        raise Refused(f"{folder}: {error}") from None
    if not isinstance(summary, dict):
        raise Refused(f"{folder / 'summary.json'}: expected an object")
    title = summary.get("title") or summary.get("scene")
    return Run(folder, label, str(title or ""), summary.get("status") == "equilibrium", columns)


def find_runs(folders):
    """The runs to draw, and the base run whose variants they are, if they are."""
    if len(folders) == 1:
        folders = folders + sorted(path.parent for path in folders[0].glob("*/history.csv"))
    parents = {folder.resolve().parent for folder in folders}
    base = [folder for folder in folders if folder.resolve() in parents]
    runs = [read_run(folder) for folder in folders if folder not in base]
    return runs, read_run(base[0]) if base else runs[0]


def curves(runs):
    """{field: [(run, probe, column)…]}, in the order of the panels; without probes the run's own figures."""
    names = list(dict.fromkeys(name for run in runs for name in run.columns if name not in COUNTERS))
    probed = [name for name in names if "." in name]
    panels = {}
    for name in probed or names:
        probe, _, field = name.rpartition(".")
        panels.setdefault(field, []).extend((run, probe, name) for run in runs if name in run.columns)
    if not panels:
        raise Refused(f"{runs[0].folder / 'history.csv'}: no column to draw against t")
    order = list(FIELDS)
    return dict(sorted(panels.items(), key=lambda panel: order.index(panel[0]) if panel[0] in order else len(order)))


def plain(text):
    """Text of a file as it stands: no formula for matplotlib to set, but π by its letter."""
    return re.sub(r"\bpi\b", "π", text).replace("$", r"\$")


def draw(runs, base, file):
    panels = curves(runs)
    probes = list(dict.fromkeys(probe for panel in panels.values() for _, probe, _ in panel if probe))
    style = {"": "-"} | {probe: STYLES[number % len(STYLES)] for number, probe in enumerate(probes)}
    colour = {run.folder: COLOURS[number % len(COLOURS)] for number, run in enumerate(runs)}

    plt.rcParams.update({"font.size": 11, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(1, len(panels), figsize=(6 * len(panels), 4.8), squeeze=False)
    for axis, (field, panel) in zip(axes[0], panels.items()):
        for run, probe, name in panel:
            axis.plot(run.columns["t"], run.columns[name], style[probe], color=colour[run.folder], linewidth=1.6)
        if base.in_equilibrium:
            for last in {base.columns[name][-1] for _, probe, name in panel if probe and name in base.columns}:
                axis.axhline(last, color="0.6", linewidth=0.9, zorder=0)
        if not probes and any(value > 0 for run, _, name in panel for value in run.columns[name]):
            axis.set_yscale("log")  # the residual and the kinetic energy
        else:
            axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
        axis.set(xlabel="time $t$", ylabel=FIELDS.get(field, plain(field.replace("_", " "))))
        axis.margins(x=0)
        axis.grid(color="0.92")
        axis.set_axisbelow(True)

    keys = []
    if len(runs) > 1:
        keys += [Line2D([], [], color=colour[run.folder], linewidth=2.4, label=plain(run.label)) for run in runs]
    keys += [Line2D([], [], color="0.2", linestyle=style[probe], label=plain(probe)) for probe in probes]
    if base.in_equilibrium and probes:
        keys.append(Line2D([], [], color="0.6", linewidth=0.9, label="equilibrium"))
    keys_a_row = min(3 * len(panels), 7)
    rows = -(-len(keys) // keys_a_row)
    if keys:
        figure.legend(handles=keys, loc="lower center", ncol=keys_a_row, frameon=False)
    figure.suptitle(plain(base.title))
    figure.tight_layout(rect=(0, 0.02 + 0.055 * rows, 1, 1))
    figure.savefig(file, dpi=100)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", metavar="DIR", type=Path, nargs="+")
    parser.add_argument("--out", metavar="FILE", type=Path)
    options = parser.parse_args()
    file = options.out or options.folders[0] / "history.png"
    try:
        draw(*find_runs(options.folders), file)
    except (Refused, OSError) as error:
        print(f"plot_history: {error}", file=sys.stderr)
        return 2
    print(f"Picture: {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
