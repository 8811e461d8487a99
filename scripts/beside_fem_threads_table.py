"""The figures of scripts/beside_fem_threads.py: a way on one thread and on two, and how much quicker it is on two."""

import math
from dataclasses import dataclass
from statistics import geometric_mean

from beside_fem_table import Row, by


@dataclass(frozen=True)
class Pair:
    """A way of a case, at one size."""

    one: Row
    two: Row | None  # None of a solver that has one thread alone

    @property
    def rows(self):
        return [row for row in (self.one, self.two) if row]

    def ratio(self, quantity):
        """That on one thread over that on two; None unless both have a solution and the figure."""
        if not self.two or not all(map(solved, self.rows)):
            return None
        one, two = (getattr(row, quantity) for row in self.rows)
        return one / two if positive(one) and positive(two) else None


def positive(figure):
    return figure is not None and math.isfinite(figure) and figure > 0


def solved(row):
    return positive(row.whole_s)


def rows_of(pairs):
    return [row for pair in pairs for row in pair.rows]


def ratios(pairs, quantity):
    """Of the pairs that have one."""
    return [ratio for pair in pairs if (ratio := pair.ratio(quantity))]


def quickest(rows, threads):
    """The whole time of the quickest way on at most so many threads; None if nothing has a solution on as many."""
    if not any(solved(row) and row.threads == threads for row in rows):
        return None
    return min(row.whole_s for row in rows if solved(row) and row.threads <= threads)


def quickest_beside(pairs, program, other):
    """(on one thread, on two, cases): the quickest time of one program over that of the other, at about as many unknowns,
    as geometric means over the cases in which both have a time on one and on two; None without such a case."""
    cases = [beside_in_case(of_it, program, other) for of_it in by(rows_of(pairs), "case").values()]
    cases = [of_it for of_it in cases if of_it]
    return (*map(geometric_mean, zip(*cases)), len(cases)) if cases else None


def beside_in_case(rows, program, other):
    times = [[quickest([row for row in rows if row.program == name], count) for name in (program, other)] for count in (1, 2)]
    return None if None in times[0] + times[1] else [one / another for one, another in times]


def apart(pairs, quantity):
    """The largest relative difference of an error on two threads from that on one; None where none is known of both."""
    return max((abs(ratio - 1) for ratio in ratios(pairs, quantity)), default=None)
