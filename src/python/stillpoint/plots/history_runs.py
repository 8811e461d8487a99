"""What a picture of histories shows: the columns of runs, read from their history.csv."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from .folders import Refused, read_summary, title_of


@dataclass(eq=False)
class Run:
    label: str
    title: str
    in_equilibrium: bool
    columns: dict[str, list[float]]  # by the header's names: t, …, <probe>.<field>


def extent(values: Iterable[float]) -> tuple[float, float] | None:
    """(least, largest) of those that are numbers, None without any."""
    known = [value for value in values if math.isfinite(value)]
    return (min(known), max(known)) if known else None


def is_varying(values: Iterable[float]) -> bool:
    """By more than rounding does."""
    low, high = extent(values) or (0, 0)
    return high - low > 1e-9 * max(-low, high)


def read_columns(file: Path) -> dict[str, list[float]]:
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


def read_run(folder: Path) -> Run:
    columns = read_columns(folder / "history.csv")
    summary, label = read_summary(folder)
    return Run(label, title_of(summary), summary.get("status") == "equilibrium", columns)


def find_runs(folders: list[Path]) -> tuple[list[Run], Run]:
    """The runs to draw, and the base run whose variants they are, if they are, or else the first."""
    if len(folders) == 1:
        folders = folders + sorted(path.parent for path in folders[0].glob("*/history.csv"))
    parents = {folder.resolve().parent for folder in folders}
    base = [folder for folder in folders if folder.resolve() in parents]
    runs = [read_run(folder) for folder in folders if folder not in base]
    return runs, read_run(base[0]) if base else runs[0]
