"""A straight line by least squares, and how far its slope is known."""

import numpy as np

STUDENT = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447}  # 97.5 % of t by degrees of freedom


def fitted_slope(x, y):
    """(slope, low, high) of y over x, with 95 % by Student's t; of two points there is no interval, but None."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    slope, start = np.polyfit(x, y, 1)
    degrees = len(x) - 2
    if degrees < 1:
        return slope, None, None
    spread = np.sqrt(np.sum((y - start - slope * x) ** 2) / degrees / np.sum((x - x.mean()) ** 2))
    half = STUDENT[degrees] * spread
    return slope, slope - half, slope + half
