"""The shape of a heap of material points."""

import numpy as np


def front(x, volume, depth, width):
    """How far the heap reaches from x = 0: the first point beyond which a piece of this width is less than `depth` deep.
    volume: of each point, per thickness."""
    x = np.sort(x)
    beyond = np.searchsorted(x, x + width, side="right") - np.arange(1, len(x) + 1)  # points in (x, x + width]
    return float(x[np.argmax(beyond * volume < depth * width)])
