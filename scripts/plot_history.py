#!/usr/bin/python3
"""plot_history.py DIR [DIR…] [--out FILE]: draws the histories of runs, from each DIR/history.csv.

First the load against the displacement that drives it, where there is one; then, against time, the probes, the forces of
walls, supports and rigid bodies, the residual, and the energies. What never changes has no panel. A panel a field, a colour
a run, a line style a probe or a component of it; where the panels differ in their lines, each has a key of its own. Units
are those of the SI. A DIR whose subfolders hold runs too (the variants of its scene) is not drawn itself: its variants are,
and where its run ended in equilibrium, that is a grey line. FILE is DIR/history.png if not given. Exit status 2 and a
message where there is nothing to draw.
"""

import argparse
import csv
import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from pictures import COLOURS, STYLE, Refused, finish, plain, read_summary, title_of  # before pyplot: sets the backend
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

STYLES = ["-", "--", ":", "-."]
PROBES = {  # in this order; the names that a user's law has given come after them
    "u": "displacement $u$ [m]",
    "v": "velocity $v$ [m/s]",
    "strain": "strain",
    "stress": "stress [Pa]",
    "effective_stress": "effective stress [Pa]",
    "pore_pressure": "pore pressure [Pa]",
    "plastic_strain": "plastic strain",
    "pc": "$p_c$ [Pa]",
    "slope_angle": "slope angle [°]",
    "volume": "volume [m³]",
    "momentum": "momentum [kg m/s]",
    "angular_momentum": "angular momentum [kg m²/s]",
}
FORCES = {
    "force": "force [N]",
    "reaction": "reaction [N]",
    "moment": "moment [N m]",
    "displacement": "displacement of the rigid body [m]",
    "contact_area": "contact area [m²]",
    "penetration": "penetration [cells]",
    "slipping": "share of the contact that slips",
}
OWN = {  # of the run itself
    "residual": "residual $‖F − R‖/‖F‖$",
    "distance": "distance from equilibrium $‖u − u^*‖/‖u‖$",
    "energy": "energy [J]",  # kinetic, and the work of external forces
    "kinetic_over_work": "kinetic energy / external work",
}
TOGETHER = {"normal": "force", "shear": "force"}  # fields of one panel: those of a wall
ENERGIES = {"kinetic_energy": "kinetic energy", "inertia.external_work": "external work"}
COUNTERS = {"t", "steps", "rhs_evaluations"}
STEPS = {"x": "steps", "x_label": "steps of the solver"}  # of a static one, whose time stands still
# toe.u.x, and base.reaction_y of a support, punch.force_y of a rigid body
COLUMN = re.compile(
    r"(?P<probe>.+?)\.(?P<field>(?:force|reaction|moment|displacement|motion)(?=_[xyz]$)|[^.]+)"
    r"(?:[._](?P<component>[xyz]{1,2}))?"
)
FORCE_OF = {"normal", "force", "reaction"}  # of what moves as `motion` prescribes


@dataclass
class Run:
    folder: Path
    label: str
    title: str
    in_equilibrium: bool
    columns: dict[str, list[float]]  # by the header's names: t, …, <probe>.<field>


@dataclass
class Panel:
    """Lines in one pair of axes."""

    label: str
    lines: list[tuple[Run, str, str]]  # (run, name of the line, column)
    x: str = "t"
    x_label: str = "time $t$ [s]"
    log: bool = False

    def names(self):
        return list(dict.fromkeys(line for _, line, _ in self.lines if line))

    def leave_out_what_no_logarithm_shows(self):
        if self.log:
            shown = [line for line in self.lines if any(value > 0 for value in line[0].columns[line[2]])]
            self.lines = shown or self.lines

    def varies(self):
        return any(is_varying(run.columns[name]) for run, _, name in self.lines)


def extent(values):
    """(least, largest) of those that are numbers, None without any."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else None


def is_varying(values):
    """By more than rounding does."""
    low, high = extent(values) or (0, 0)
    return high - low > 1e-9 * max(-low, high)


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
    if name in ENERGIES:
        return "energy", ENERGIES[name]
    parts = COLUMN.fullmatch(name)
    if not parts:
        return name, ""
    probe, field, component = parts.group("probe", "field", "component")
    if field in OWN:
        return field, ""
    words = [probe] + [field] * (field in TOGETHER) + [component] * bool(component)
    return TOGETHER.get(field, field), " ".join(words)


def load_panel(runs):
    """The factor of the loads against the displacement that drives them."""
    driven = [run for run in runs if {"load.factor", "load.displacement"} <= run.columns.keys()]
    lines = [(run, "", "load.factor") for run in driven]
    return Panel("load factor $\\lambda$", lines, "load.displacement", "mean displacement along the loads [m]")


def driven_panels(runs):
    """{name: the force of what moves as it is told against how far that is}, along the axis of its longest way."""
    ways = {}  # {name: {component: length}}
    for run in runs:
        for column, values in run.columns.items():
            parts = COLUMN.fullmatch(column)
            if parts and parts["field"] == "motion" and is_varying(values):
                way = ways.setdefault(parts["probe"], {})
                low, high = extent(values)
                way[parts["component"]] = max(way.get(parts["component"], 0), high - low)
    panels = {}
    for name, way in ways.items():
        component = max(way, key=way.get)
        end = f"_{component}" if component else ""
        motion = f"{name}.motion{end}"
        forces = [f"{name}.{field}{'' if field == 'normal' else end}" for field in sorted(FORCE_OF)]
        lines = [(run, "", force) for run in runs if motion in run.columns for force in forces if force in run.columns]
        along = f" along {component}" if component else ""
        panels[name] = Panel(f"force of {plain(name)}{along} [N]", lines, motion, f"its displacement{along} [m]")
    return panels


def rank(field):
    """Where a panel stands: of two that are not known the first column comes first."""
    for number, fields in enumerate((PROBES, FORCES, OWN)):
        if field in fields:
            return number, list(fields).index(field)
    return 0, len(PROBES)


def panels_of(runs):
    """{field: its panel}, in the order in which a reader asks."""
    names = dict.fromkeys(name for run in runs for name in run.columns)
    x = {} if any(is_varying(run.columns["t"]) for run in runs) else STEPS
    fields = {}
    for name in names:
        field, line = place_of(name)
        if name in COUNTERS or name.startswith("load.") or field == "motion":
            continue
        label = next((of[field] for of in (PROBES, FORCES, OWN) if field in of), plain(field.replace("_", " ")))
        panel = fields.setdefault(field, Panel(label, [], **x, log=field in OWN))
        panel.lines += [(run, line, name) for run in runs if name in run.columns]
    panels = {"load": load_panel(runs), **driven_panels(runs)}
    panels |= {field: fields[field] for field in sorted(fields, key=rank)}
    for panel in fields.values():
        panel.leave_out_what_no_logarithm_shows()
    panels = {field: panel for field, panel in panels.items() if panel.lines}
    if not panels:
        raise Refused(f"{runs[0].folder / 'history.csv'}: no column to draw against t")
    return {field: panel for field, panel in panels.items() if panel.varies()} or panels


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


def draw_lines(axis, panel, colour_and_style):
    log = panel.log and any(value > 0 for run, _, name in panel.lines for value in run.columns[name])
    for run, line, name in panel.lines:
        colour, style = colour_and_style(run, line)
        values = [value if value > 0 or not log else math.nan for value in run.columns[name]]
        axis.plot(run.columns[panel.x], values, style, color=colour, linewidth=1.6)
    if log:
        axis.set_yscale("log")
    else:
        axis.ticklabel_format(axis="y", scilimits=(-2, 4), useMathText=True)
    axis.set(xlabel=panel.x_label, ylabel=panel.label)
    axis.margins(x=0)
    low, high = extent([x for run, _, _ in panel.lines for x in run.columns[panel.x]])
    begin = panel.lines[0][0].columns[panel.x][0]
    if low < high:  # where a figure is not known, too; what is driven backwards begins at the left as well
        axis.set_xlim(*((high, low) if high - begin < begin - low else (low, high)))
    if max(-low, high) < 0.01:
        axis.ticklabel_format(axis="x", scilimits=(-2, 4), useMathText=True)
    axis.grid(color="0.92")
    axis.set_axisbelow(True)


def draw(runs, base, file):
    panels = panels_of(runs)
    asked = [panel for field, panel in panels.items() if field not in OWN and panel.names()]
    lines = asked[0].names() if asked else []
    alike = len(asked) > 1 and all(panel.names() == lines for panel in asked)  # then one key serves all of these

    plt.rcParams.update(STYLE | {"font.size": 11})
    columns = min(len(panels), 2 if len(panels) == 4 else 3)
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(6 * columns, 4.8 * rows), squeeze=False)
    for axis in axes.flat[len(panels) :]:
        axis.set_visible(False)
    has_ends = False  # of a base run, as grey lines
    for axis, (field, panel) in zip(axes.flat, panels.items()):
        has_key = panel.names() and not (alike and panel.names() == lines)
        numbers = {line: number for number, line in enumerate(panel.names())} | {"": 0}
        by_line = has_key and len(runs) == 1

        def colour_and_style(run, line, numbers=numbers, by_line=by_line):
            number = numbers[line] if by_line else runs.index(run)
            return COLOURS[number % len(COLOURS)], STYLES[numbers[line] % len(STYLES)]

        draw_lines(axis, panel, colour_and_style)
        if base.in_equilibrium and panel.x == "t" and field not in OWN:
            for last in {base.columns[name][-1] for _, _, name in panel.lines if name in base.columns}:
                axis.axhline(last, color="0.6", linewidth=0.9, zorder=0)
                has_ends = True
        if has_key:
            axis.legend(handles=keys_of(numbers, by_line), frameon=False, fontsize="small")

    keys = []
    if len(runs) > 1:
        keys += [
            Line2D([], [], color=COLOURS[number % len(COLOURS)], linewidth=2.4, label=plain(run.label))
            for number, run in enumerate(runs)
        ]
    if alike:
        keys += keys_of({line: number for number, line in enumerate(lines)}, False)
    if has_ends:
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
