"""The figures of scripts/scaling: as lines, as scaling.csv and back, and as a table with exponents."""

import math
from dataclasses import dataclass

from fitted_line import fitted_slope
from row_files import columns_of, read_rows, write_rows

LEAST = 5000  # unknowns: below, what a run costs whatever its size is seen most


@dataclass
class Figure:
    """What a way to rest takes of one size; without figures where it does not come to rest."""

    way: str
    cells: str
    unknowns: int | None
    status: str
    evaluations: int | None = None
    seconds: float | None = None
    megabytes: float | None = None
    reason: str = ""  # of one that is missing

    @property
    def found(self):
        return self.status == "equilibrium"


COLUMNS = columns_of(Figure)


def write_csv(file, rows):
    write_rows(file, Figure, rows)


def read_csv(file):
    """ValueError or TypeError if the file is not of scripts/scaling."""
    return read_rows(file, Figure)


# --- exponents -----------------------------------------------------------------------------------------


def exponent(rows, quantity):
    """(exponent, low, high) of one way's quantity in the unknowns, by least squares of the logarithms over sizes beyond
    LEAST, with 95 %; None of fewer than two sizes, and no interval of two."""
    points = [(row.unknowns, getattr(row, quantity)) for row in rows if row.found and row.unknowns > LEAST]
    if len(points) < 2 or any(value <= 0 for _, value in points):
        return None
    return fitted_slope(*([math.log(value) for value in values] for values in zip(*points)))


def exponent_text(fitted):
    if fitted is None:
        return ""
    slope, low, high = (None if value is None else round(value, 2) + 0.0 for value in fitted)  # + 0.0: no -0.00
    return f"{slope:.2f}" + ("" if low is None else f" ({low:.2f} to {high:.2f})")


# --- crossings -----------------------------------------------------------------------------------------


def crossings(one, other, quantity):
    """[(unknowns, quantity)] where the lines of two ways cross, straight between their sizes on logarithmic axes."""
    sizes = sorted({row.unknowns for row in one if row.found} & {row.unknowns for row in other if row.found})
    value = [{row.unknowns: math.log(getattr(row, quantity)) for row in rows if row.found} for rows in (one, other)]
    found = []
    for low, high in zip(sizes, sizes[1:]):
        apart = [value[0][size] - value[1][size] for size in (low, high)]
        if (apart[0] > 0) != (apart[1] > 0):
            share = apart[0] / (apart[0] - apart[1])
            between = [a + share * (b - a) for a, b in (map(math.log, (low, high)), (value[0][low], value[0][high]))]
            found.append(tuple(map(math.exp, between)))
    return found


def overtaken(rows, quantity="seconds", of="Newton, CHOLMOD"):
    """[(way, unknowns, quantity)] where the line of each other way crosses that of the way `of`."""
    ways = by_way(rows)
    others = [(way, of_way) for way, of_way in ways.items() if way != of and of in ways]
    return [(way, *point) for way, of_way in others for point in crossings(of_way, ways[of], quantity)]


# --- text ----------------------------------------------------------------------------------------------


def by_way(rows):
    """{way: its rows}"""
    return {way: [row for row in rows if row.way == way] for way in dict.fromkeys(row.way for row in rows)}


def with_spaces(count):
    """12 345"""
    return f"{count:,}".replace(",", " ")


def seconds_text(seconds):
    return f"{seconds:.2f} s" if seconds < 10 else f"{seconds:.1f} s"


def line(row):
    size = f"{row.way:<21} {row.unknowns or row.cells:>8}"
    if not row.found:
        return f"{size}  missing: {row.status}: {row.reason}"
    return f"{size} {row.evaluations:>8} evaluations {row.seconds:>9.3f} s {row.megabytes:>8.1f} MB"


def figures_text(row):
    if not row.found:
        return "missing"
    return f"{with_spaces(row.evaluations)}, {seconds_text(row.seconds)}, {row.megabytes:.0f} MB"


def heading_of(rows, cells):
    """Of a column: how many unknowns a size has, or its cells if no run says."""
    unknowns = [row.unknowns for row in rows if row.cells == cells and row.unknowns]
    return with_spaces(unknowns[0]) if unknowns else f"{cells} cells"


def markdown(rows, about):
    sizes = [heading_of(rows, cells) for cells in dict.fromkeys(row.cells for row in rows)]
    headings = ["unknowns", *sizes, "exponent of evaluations", "exponent of time"]
    lines = ["| " + " | ".join(headings) + " |", "|---" + "|---:" * (len(headings) - 1) + "|"]
    for way, of_way in by_way(rows).items():
        exponents = [exponent_text(exponent(of_way, quantity)) for quantity in ("evaluations", "seconds")]
        lines.append("| " + " | ".join([way, *map(figures_text, of_way), *exponents]) + " |")
    fits = f"Evaluations, time, memory; exponents in the unknowns beyond {with_spaces(LEAST)}, with 95 % (Student's t)."
    crossing = [f"{way} at {with_spaces(round(unknowns))} unknowns" for way, unknowns, _ in overtaken(rows)]
    lines += ["", "As quick as Newton's method with CHOLMOD: " + ("; ".join(crossing) or "none, at any size") + "."]
    return f"{about}\n{fits}\n\n" + "\n".join(lines) + "\n"
