"""The picture of histories: a panel a field, a colour a run, a line style a probe or a component of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure  # type: ignore[import]
from matplotlib.lines import Line2D  # type: ignore[import]

from .history_panels import OWN, TIME, Panel, panels_of
from .history_runs import Run, extent
from .pictures import COLOURS, drawing, plain

STYLES = ["-", "--", ":", "-."]
END = "0.6"  # the grey of a base run's equilibrium


def keys_of(numbers: Mapping[str, int], by_line: bool) -> list[Line2D]:
    """The key of lines by their names: by_line: each with a colour of its own, else with a style."""
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


def draw_lines(axis: Any, panel: Panel, colour_and_style: Callable[[Run, str], tuple[str, str]]) -> None:
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
    low, high = extent(x for run, _, _ in panel.lines for x in run.columns[panel.x]) or (0, 0)
    begin = panel.lines[0][0].columns[panel.x][0]
    if low < high:  # where a figure is not known, too; what is driven backwards begins at the left as well
        axis.set_xlim(*((high, low) if high - begin < begin - low else (low, high)))
    if max(-low, high) < 0.01:
        axis.ticklabel_format(axis="x", scilimits=(-2, 4), useMathText=True)
    axis.grid(color="0.92")
    axis.set_axisbelow(True)


def draw_panel(axis: Any, panel: Panel, runs: Sequence[Run], has_key: bool) -> None:
    numbers = {line: number for number, line in enumerate(panel.names())} | {"": 0}
    by_line = has_key and len(runs) == 1

    def colour_and_style(run: Run, line: str) -> tuple[str, str]:
        number = numbers[line] if by_line else runs.index(run)
        return COLOURS[number % len(COLOURS)], STYLES[numbers[line] % len(STYLES)]

    draw_lines(axis, panel, colour_and_style)
    if has_key:
        axis.legend(handles=keys_of(numbers, by_line), frameon=False, fontsize="small")


def draw_ends(axis: Any, panel: Panel, base: Run) -> bool:
    """A grey line where the base run came to rest. Returns whether there is one."""
    ends = {base.columns[name][-1] for _, _, name in panel.lines if name in base.columns}
    for last in ends:
        axis.axhline(last, color=END, linewidth=0.9, zorder=0)
    return bool(ends)


def keys_of_all(runs: Sequence[Run], lines: Sequence[str], has_ends: bool) -> list[Line2D]:
    """The key below the panels; lines: those that all panels share."""
    keys = []
    if len(runs) > 1:
        keys += [
            Line2D([], [], color=COLOURS[number % len(COLOURS)], linewidth=2.4, label=plain(run.label))
            for number, run in enumerate(runs)
        ]
    keys += keys_of({line: number for number, line in enumerate(lines)}, False)
    if has_ends:
        keys.append(Line2D([], [], color=END, linewidth=0.9, label="equilibrium"))
    return keys


def figure_of(runs: Sequence[Run], base: Run | None = None, figure: Figure | None = None) -> Figure:
    """The histories of runs. base: whose variants they are; None: the first. figure: an empty one to draw on."""
    base = base or runs[0]
    panels = panels_of(runs)
    asked = [panel for field, panel in panels.items() if field not in OWN and panel.names()]
    lines = asked[0].names() if asked else []
    alike = len(asked) > 1 and all(panel.names() == lines for panel in asked)  # then one key serves all of these

    columns = min(len(panels), 2 if len(panels) == 4 else 3)
    rows = -(-len(panels) // columns)
    with drawing(figure, 6 * columns, 4.8 * rows, font_size=11) as figure:
        axes = figure.subplots(rows, columns, squeeze=False)
        for axis in axes.flat[len(panels) :]:
            axis.set_visible(False)
        has_ends = False
        for axis, (field, panel) in zip(axes.flat, panels.items()):
            has_key = bool(panel.names()) and not (alike and panel.names() == lines)
            draw_panel(axis, panel, runs, has_key)
            if base.in_equilibrium and panel.x == TIME[0] and field not in OWN:
                has_ends |= draw_ends(axis, panel, base)
        keys = keys_of_all(runs, lines if alike else [], has_ends)
        keys_a_row = min(3 * columns, 7)
        key_rows = -(-len(keys) // keys_a_row)
        if keys:
            figure.legend(handles=keys, loc="lower center", ncol=keys_a_row, frameon=False)
        figure.suptitle(plain(base.title))
        figure.tight_layout(rect=(0, (0.02 + 0.055 * key_rows) / rows, 1, 1))
    return figure
