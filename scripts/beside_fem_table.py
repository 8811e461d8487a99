"""The rows of scripts/beside_fem: as CSV and back, curves of them, where two cross, and orders."""

import math
from dataclasses import dataclass, replace

import numpy as np
from fitted_line import fitted_slope
from row_files import read_rows, write_rows


@dataclass
class Row:
    """What a way takes of one size, and how far off it is; without figures where it has no solution."""

    case: str
    program: str
    functions: str
    solver: str
    cells: str
    unknowns: int | None = None
    iterations: int | None = None
    u_l2: float | None = None
    raw_l2: float | None = None  # σ of the functions' gradient: relative error in L2, and the largest over the largest stress
    raw_max: float | None = None
    recovered_l2: float | None = None  # σ as projected, or as fitted to the points around the place
    recovered_max: float | None = None
    value: float | None = None  # of u where the case reads it, a relative error
    whole_s: float | None = None
    processor_s: float | None = None  # of the whole
    solution_s: float | None = None
    recovery_s: float | None = None
    megabytes: float | None = None
    reason: str = ""  # why there are no figures
    command: str = ""  # that computes it
    threads: int | None = 1

    @property
    def found(self):
        return self.whole_s is not None

    @property
    def seconds(self):
        return self.whole_s

    @property
    def way(self):
        return f"{self.program} {self.functions}, {self.solver}"

    @property
    def stress_l2(self):
        """The better of the two stresses' errors."""
        return self.raw_l2 if self.recovered_l2 is None else min(self.raw_l2, self.recovered_l2)

    @property
    def stress_max(self):
        return self.raw_max if self.recovered_max is None else min(self.raw_max, self.recovered_max)

    def missing(self, reason):
        """Of a row that has no figures yet."""
        return replace(self, reason=reason or "no solution")

    def without_figures(self, reason):
        known = ("case", "program", "functions", "solver", "cells", "command", "threads")
        return Row(**{name: getattr(self, name) for name in known}, reason=reason)

    def with_figures(self, **figures):
        return replace(self, **figures)


def write_csv(file, rows):
    write_rows(file, Row, rows)


def read_csv(file):
    """ValueError or TypeError if the file is not of scripts/beside_fem."""
    return read_rows(file, Row)


# --- curves --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Curve:
    """A quantity over another on logarithmic axes, straight between the sizes."""

    x: tuple[float, ...]
    y: tuple[float, ...]

    def at(self, x):
        """None outside of the sizes."""
        if not self.x or not self.x[0] * (1 - 1e-12) <= x <= self.x[-1] * (1 + 1e-12):
            return None
        return math.exp(np.interp(math.log(x), np.log(self.x), np.log(self.y)))


def curve(rows, over, quantity):
    pairs = sorted((getattr(row, over), getattr(row, quantity)) for row in having(rows, quantity))
    return Curve(tuple(x for x, _ in pairs), tuple(y for _, y in pairs))


def having(rows, quantity):
    """Those that have a figure of it."""
    return [row for row in rows if row.found and getattr(row, quantity) is not None]


def ratio_at_end(one, other):
    """(x, one/other) at the largest x that both curves have; None if they have none in common."""
    if not one.x or not other.x:
        return None
    x = min(one.x[-1], other.x[-1])
    values = one.at(x), other.at(x)
    return None if None in values else (x, values[0] / values[1])


def crossings(one, other):
    """[(x, y)] where the lines of two curves cross."""
    places = sorted(set(one.x) | set(other.x))
    places = [x for x in places if one.at(x) is not None and other.at(x) is not None]
    found = []
    for low, high in zip(places, places[1:]):
        apart = [math.log(one.at(x) / other.at(x)) for x in (low, high)]
        if (apart[0] > 0) != (apart[1] > 0):
            share = apart[0] / (apart[0] - apart[1])
            x = math.exp(math.log(low) + share * (math.log(high) - math.log(low)))
            found.append((x, one.at(x)))
    return found


def time_to(rows, error, quantity="stress_l2"):
    """The wall time at which one way's error has fallen to this, straight between its sizes on logarithmic axes: of the
    smallest size if that is as good. None if no size is."""
    path = [(row.unknowns, getattr(row, quantity), seconds_for(row, quantity)) for row in having(rows, quantity)]
    before = None
    for _, now, seconds in sorted(path):
        if now <= error:
            if before is None:
                return seconds
            share = math.log(before[0] / error) / math.log(before[0] / now)
            return math.exp(math.log(before[1]) + share * math.log(seconds / before[1]))
        before = now, seconds
    return None


def seconds_for(row, quantity):
    """The whole, with the projection where the error is that of the projected stress."""
    recovered = quantity.startswith("recovered") or (quantity == "stress_l2" and row.stress_l2 < row.raw_l2)
    return row.whole_s + (row.recovery_s or 0 if recovered else 0)


def best_time_to(rows, error, quantity="stress_l2"):
    """(seconds, way) of the quickest of these ways; None if none gets there."""
    times = [(seconds, way) for way, of_way in by(rows, "way").items() if (seconds := time_to(of_way, error, quantity))]
    return min(times, default=None)


def order(rows, dim, quantity):
    """(order, low, high) in h, which falls as unknowns to the power −1/dim; None of fewer than two sizes."""
    points = [(-math.log(row.unknowns) / dim, math.log(getattr(row, quantity))) for row in having(rows, quantity)]
    return fitted_slope(*zip(*points)) if len(points) > 1 else None


def by(rows, attribute):
    """{value: the rows that have it}"""
    values = dict.fromkeys(getattr(row, attribute) for row in rows)
    return {value: [row for row in rows if getattr(row, attribute) == value] for value in values}
