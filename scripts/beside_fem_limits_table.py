"""The rows of scripts/beside_fem_limits.py and the paths of its runs: as CSV and back, and what is read of them."""

import math
from dataclasses import dataclass, replace

import numpy as np
from beside_fem_table import by, time_to
from row_files import read_rows, write_rows

FOOTING, BLOCK = "footing", "block"
LIMIT = 2 + math.pi  # N_c [Prandtl 1920]
ERRORS = (0.01, 0.003, 0.001)  # of N_c, to which times are compared


@dataclass
class Row:
    """What a way takes of one size, and where it ends; without figures where it comes nowhere."""

    problem: str
    program: str
    functions: str  # of the footing Q1-1 … as of fem_plastic.py; of the block "Q2, stick" …; linear, …
    cells: str  # along the ground, or along a side of the block
    unknowns: int | None = None
    iterations: int | None = None
    reached: float | None = None  # N_c; or the compression
    whole_s: float | None = None
    processor_s: float | None = None
    megabytes: float | None = None
    least_det: float | None = None  # of F, at the end
    passes: float | None = None  # the compression at which the block has come through a plate
    ended: str = ""  # why, before the end that was asked for
    reason: str = ""  # why there are no figures
    command: str = ""  # that computes it

    @property
    def found(self):
        return self.reached is not None

    @property
    def seconds(self):
        return self.whole_s

    @property
    def way(self):
        return f"{self.program} {self.functions}"

    @property
    def error(self):
        """Of N_c, relative, with its sign."""
        return self.reached / LIMIT - 1

    @property
    def off(self):
        return abs(self.error)

    def missing(self, reason):
        return replace(self, reason=reason or "no solution")


@dataclass
class Place:
    """A place on a run's path: settlement [m] and factor, or compression and force of the plate over E."""

    problem: str
    program: str
    functions: str
    cells: str
    along: float
    load: float


def path_of(row, pairs):
    return [Place(row.problem, row.program, row.functions, row.cells, along, load) for along, load in pairs]


def places_of(row, paths):
    """(along, load) of a row, two arrays."""
    key = (row.problem, row.program, row.functions, row.cells)
    own = [place for place in paths if (place.problem, place.program, place.functions, place.cells) == key]
    return np.array([place.along for place in own]), np.array([place.load for place in own])


def load_at(row, paths, along):
    """None where the path does not come so far."""
    x, y = places_of(row, paths)
    return float(np.interp(along, x, y)) if len(x) and along <= x[-1] * (1 + 1e-9) else None


def write_csv(folder, rows, paths):
    write_rows(folder / "beside_fem_limits.csv", Row, rows)
    write_rows(folder / "beside_fem_limits_paths.csv", Place, paths)


def read_csv(folder):
    """(rows, paths); ValueError or TypeError if the files are not of scripts/beside_fem_limits.py."""
    return read_rows(folder / "beside_fem_limits.csv", Row), read_rows(folder / "beside_fem_limits_paths.csv", Place)


# --- what is read of them ------------------------------------------------------------------------------


def settled(rows, error):
    """The coarsest row of a way, in order of size, that is within this error together with all finer ones; or None."""
    best = None
    for row in reversed([row for row in rows if row.found]):
        if row.off > error:
            break
        best = row
    return best


def time_within(rows, error):
    """The wall time from which a way is settled within this error, straight between its sizes on logarithmic axes."""
    rows = [row for row in rows if row.found]
    first = settled(rows, error)
    if first is None:
        return None
    number = rows.index(first)
    return time_to(rows[max(number - 1, 0) : number + 1], error, "off")


def quickest(rows, error):
    """(seconds, functions) of the way that settles within the error in the least time; or None."""
    times = [(seconds, name) for name, of_it in by(rows, "functions").items() if (seconds := time_within(of_it, error))]
    return min(times, default=None)


def reference(rows, paths):
    """The block's path to compare with: that of the finite elements with the most unknowns whose sides stick and that came
    furthest; or None."""
    sticking = [row for row in rows if row.found and row.functions.endswith(", stick")]
    return max(sticking, key=lambda row: (round(row.reached, 2), row.functions.startswith("Q2"), row.unknowns), default=None)
