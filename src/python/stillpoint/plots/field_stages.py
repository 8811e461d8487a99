"""What a picture of fields shows: the stages of runs, with the values that colour their points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.colors import to_rgba_array  # type: ignore[import]

Array = Any  # of numpy
# Of the layers: the rows alternate in hue, the columns in tone.
LAYERS = to_rgba_array(["#0072B2", "#7DC1EA", "#D55E00", "#F5B183"]).reshape(2, 2, 4)


@dataclass
class Stage:
    t: float
    slope_angle: float | None  # [degrees]
    place: Array  # (points × dim), deformed
    values: Array  # (points) of the field; colours if that is `layers`
    mechanism: Array | None = None  # (points × dim), the velocity at a limit load
    factor: float | None = None  # of the loads, there


@dataclass
class Run:
    label: str
    title: str
    dim: int
    stages: list[Stage]


def of_body(place: Array) -> Array:
    """Which points have not flown off: none that is farther than a quarter of its size from all but 0.2 % of it."""
    low, high = np.percentile(place, [0.1, 99.9], axis=0)
    reach = (high - low).max() / 4
    return ((place >= low - reach) & (place <= high + reach)).all(axis=1)


def body(place: Array) -> Array:
    return place[of_body(place)]


def spacing_of(place: Array) -> float:
    """The typical distance of neighbours: √(area/points), in space ∛(volume/points). The area is measured in squares
    that hold a few points each, the volume in cubes, of a size that suits a line or a sheet of points, too."""
    place = body(place)
    size, dim = np.ptp(place, axis=0), place.shape[1]
    largest = np.cumprod(np.sort(size)[::-1])
    cell: float = 3 * max((largest[k] / len(place)) ** (1 / (k + 1)) for k in range(dim)) or 1.0
    numbers = np.floor((place - place.min(axis=0)) / cell).astype(np.int64)
    occupied = len(np.unique(np.ravel_multi_index(numbers.T, numbers.max(axis=0) + 1)))
    return float(cell * (occupied / len(place)) ** (1 / dim))


class Layers:
    """Squares, or cubes, of the undeformed body, about 8 to its shortest side, whole rows of points in each."""

    def __init__(self, undeformed: Array) -> None:
        self.origin, self.spacing = undeformed.min(axis=0), self.distance_of_neighbours(undeformed)
        self.rows = max(2, round(np.ptp(undeformed, axis=0).min() / 8 / self.spacing))

    @staticmethod
    def distance_of_neighbours(place: Array) -> float:
        """The median over some points."""
        if len(place) == 1:
            return 1.0
        some = place[:: -(-len(place) // 100)]
        nearest = [np.sqrt(np.partition(((place - each) ** 2).sum(axis=1), 1)[1]) for each in some]
        return float(np.median(nearest)) or 1.0

    def colours(self, undeformed: Array) -> Array:
        numbers = np.floor((undeformed - self.origin) / self.spacing + 0.5) // self.rows
        row, column = numbers[:, 1], numbers.sum(axis=1) - numbers[:, 1]  # in space columns alternate along x and z
        return LAYERS[(row % 2).astype(int), (column % 2).astype(int)]
