"""The image of a body of points in space: spheres that hide what is behind them, lit as one surface."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

Array = Any  # of numpy

# Isometric, y up: x runs to the right and z to the left, towards the viewer; a metre of each is as long in the picture.
ACROSS, UP, NEAR = np.array([[1, 0, -1], [-1, 2, -1], [1, 1, 1]]) / np.sqrt([[2], [6], [3]])
LIGHT = np.array([0.29, 0.81, 0.52])  # the top is the brightest of the three faces that one sees, then z, then x
SHADOW, SHEEN = 0.5, 0.15  # how bright a colour is in the shadow, and how far full light takes it towards white
FACING = 0.3  # the cosine between normal and view, at least: what turns away would be a dark rim
RADIUS = 0.85  # of a sphere, in spacings: more than √½, for neighbours of a square to leave no gap
VOXELS = 1e7  # at most


@dataclass
class Window:
    """The part of the plane across the view that an image shows."""

    low: Array  # (2) its lower left corner
    scale: float  # pixels a metre
    width: int  # pixels
    height: int


def projected(place: Array) -> Array:
    """(… × 2): to the right, and up."""
    return place @ np.stack([ACROSS, UP]).T


def in_front(view: Array, near: Array, spacing: float) -> Array:
    """Which points are not far behind others: of those in each square of half a spacing, which one sphere covers, three
    spacings are left. view: (points × 2)."""
    square = np.floor(2 * (view - view.min(axis=0)) / spacing).astype(np.int64)
    _, square = np.unique(square @ [2**31, 1], return_inverse=True)
    order = np.argsort(near, kind="stable")
    nearest = np.empty(square.max() + 1)
    nearest[square[order]] = near[order]  # the last one counts
    return near > nearest[square] - 3 * spacing


def smoothed(density: Array) -> Array:
    """The mean with the neighbours, weighted 1 : 2 : 1, along each axis."""
    for axis in range(3):
        at = np.moveaxis(density, axis, 0)
        mean = at / 2
        mean[1:] += at[:-1] / 4
        mean[:-1] += at[1:] / 4
        density = np.moveaxis(mean, 0, axis)
    return density


def normals(place: Array, some: Array, spacing: float) -> Array:
    """Unit normals, outwards, at some of the points: down the density of points, counted in voxels of a spacing."""
    low, size = place.min(axis=0), np.ptp(place, axis=0)
    voxel = max(spacing, (size.prod() / VOXELS) ** (1 / 3))
    at = (place - low) / voxel + 3
    corner, shape = at.astype(int), (size / voxel).astype(int) + 8
    share, density = at - corner, np.zeros(shape.prod())
    for offset in np.ndindex(2, 2, 2):  # a point counts in the eight voxels around it
        weight = np.where(offset, share, 1 - share).prod(axis=1)
        density += np.bincount(np.ravel_multi_index((corner + offset).T, shape), weight, minlength=len(density))
    density = smoothed(density.reshape(shape))

    middle, steps = np.rint(at[some]).astype(int), np.eye(3, dtype=int)
    down = np.stack([density[tuple((middle - step).T)] - density[tuple((middle + step).T)] for step in steps], axis=1)
    length = np.linalg.norm(down, axis=1, keepdims=True)
    return np.where(length > 1e-3 * density.max(), down / np.maximum(length, 1e-300), NEAR)


def lit(colours: Array, normal: Array) -> Array:
    """normal: of any length."""
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    normal = normal + np.maximum(FACING - normal @ NEAR, 0)[:, None] * NEAR
    light = np.clip(normal @ LIGHT / LIGHT[1], 0, 1)[:, None]
    return colours * (SHADOW + (1 - SHADOW) * light) + SHEEN * light * (1 - colours)


class Spheres:
    """Around points, of one radius, in pixels."""

    def __init__(self, window: Window, view: Array, near: Array, radius: float) -> None:
        self.window, self.near, self.radius = window, near, radius
        self.view, self.pixel = view, np.floor(view).astype(int)

    def fragments(self) -> Iterator[tuple[Array, Array, Array, Array]]:
        """(points, a pixel of each, the nearness of its sphere there, 1 − distance²/radius² from its middle): in parts,
        one pixel of all points each, or all pixels of one point: of two for one pixel the nearer point is the last."""
        reach = int(np.ceil(self.radius))
        offsets = np.moveaxis(np.indices((2 * reach + 1,) * 2), 0, -1).reshape(-1, 2)
        points = np.arange(len(self.near))
        if len(points) > len(offsets):
            parts = ((points, offset) for offset in offsets - reach)
        else:
            parts = ((points[k : k + 1], offsets - reach) for k in points)
        (x, y), (column_of, row_of), window = self.view.T, self.pixel.T, self.window
        for some, offset in parts:
            column, row = column_of[some] + offset[..., 0], row_of[some] + offset[..., 1]
            distance = ((column + 0.5 - x[some]) ** 2 + (row + 0.5 - y[some]) ** 2) / self.radius**2
            on_it = (column >= 0) & (column < window.width) & (row >= 0) & (row < window.height)
            (inside,) = np.nonzero(on_it & (distance < 1))
            which, share = np.broadcast_to(some, distance.shape)[inside], 1 - distance[inside]
            pixel = row[inside] * window.width + column[inside]
            yield which, pixel, self.near[which] + self.radius * np.sqrt(share), share


def surface_image(place: Array, colours: Array, spacing: float, window: Window) -> tuple[Array, Array]:
    """colours: (points × 3), of 0 to 1. Returns the image (height × width × 4), its first row the lowest, and the
    numbers of the points that one sees."""
    view, near = projected(place), place @ NEAR
    (shown,) = np.nonzero(in_front(view, near, spacing))
    shown = shown[np.argsort(near[shown], kind="stable")]  # of two that go to one pixel at once the nearer is the last
    radius = max(RADIUS * spacing * window.scale, 1)
    spheres = Spheres(window, (view[shown] - window.low) * window.scale, near[shown] * window.scale, radius)

    pixels = window.width * window.height
    front, nearest = np.full(pixels, -np.inf), np.full(pixels, -1)
    for points, pixel, depth, _ in spheres.fragments():
        nearer = depth > front[pixel]
        front[pixel[nearer]], nearest[pixel[nearer]] = depth[nearer], points[nearer]

    # A pixel takes the mean colour and normal of the spheres that come close to its front: neighbours merge.
    close_ones = []
    for points, pixel, depth, share in spheres.fragments():
        close = depth > front[pixel] - 0.6 * radius
        close_ones.append((points[close], pixel[close], share[close] ** 2 + 1e-6))
    points, pixel, weight = (np.concatenate(part) for part in zip(*close_ones))
    covered = nearest >= 0

    def mean(values: Array) -> Array:
        sums = [np.bincount(pixel, weight * column[points], minlength=pixels)[covered] for column in values.T]
        return np.stack(sums, axis=1) / np.bincount(pixel, weight, minlength=pixels)[covered, None]

    image = np.ones((pixels, 4))
    image[:, 3] = covered
    image[covered, :3] = lit(mean(colours[shown]), mean(normals(place, shown, spacing)))
    return image.reshape(window.height, window.width, 4), shown[np.unique(nearest[covered])]
