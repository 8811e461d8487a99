"""The fields of all points at one time, by name, and as a mesh for other programs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .plots.frames import Frame
from .plots.needed import need

if TYPE_CHECKING:
    import meshio  # type: ignore[import]

_OF_TENSOR = {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1), "yz": (1, 2), "zx": (2, 0)}


class PointFields(Mapping[str, NDArray[Any]]):
    """Arrays by the names that they have in fields.h5: fields["stress"], fields["u"], fields["plastic_strain"], …

    Of P points: scalars (P), vectors (P × 3), and symmetric tensors (P × 3 × 3); in one dimension all are scalars, along x.
    .t is the time [s], .dim the number of dimensions, and .position (P × 3) where the points then are [m].
    """

    def __init__(self, frame: Frame) -> None:
        self.t, self.dim = frame.t, frame.dim
        self.position: NDArray[np.float64] = np.array(frame.fields["place"])
        self._arrays: dict[str, NDArray[Any]] = {}
        for name, values in frame.fields.items():
            tensor, _, component = name.rpartition("_")
            if component in _OF_TENSOR and values.ndim == 1:
                i, j = _OF_TENSOR[component]
                array = self._arrays.setdefault(tensor, np.zeros((len(values), 3, 3)))
                array[:, i, j] = array[:, j, i] = values
            elif name != "place":
                self._arrays[name] = np.array(values)

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self._arrays[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        return len(self._arrays)

    def __repr__(self) -> str:
        return f"<stillpoint.PointFields at t = {self.t:.6g} of {len(self.position)} points: {', '.join(self)}>"

    def to_meshio(self) -> meshio.Mesh:
        """A mesh of meshio's with a vertex a point and all fields, for the formats that it writes: .write("points.vtu").

        A tensor has nine columns, row by row, which is what these formats take for 3 × 3. ImportError without meshio.
        """
        vertices = np.arange(len(self.position)).reshape(-1, 1)
        data = {name: array.reshape(len(array), 9) if array.ndim == 3 else array for name, array in self.items()}
        return need("meshio").Mesh(self.position, [("vertex", vertices)], point_data=data)


def _padded(values: NDArray[Any]) -> NDArray[Any]:
    """Vectors (P × 3) of (P × dim), or of (P) in one dimension."""
    values = values.reshape(len(values), -1)
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def _symmetric(gradient: NDArray[Any], dim: int, components: int) -> NDArray[Any]:
    """The strain (P × components) in the order of a stress, of the gradient (P × dim², or one more about an axis)."""
    strain = np.zeros((len(gradient), components))
    for k, (i, j) in enumerate(list(_OF_TENSOR.values())[:components]):
        if i < dim and j < dim:
            strain[:, k] = (gradient[:, dim * i + j] + gradient[:, dim * j + i]) / 2
        elif gradient.shape[1] > dim * dim:
            strain[:, k] = gradient[:, dim * dim]
    return strain


def frame_of(simulation: _core.Simulation, dim: int) -> Frame:
    """All points as they are now, as fields.h5 would have them."""
    points = simulation.points
    stress, strain = points.stress, points.strain
    fields: dict[str, NDArray[Any]] = {"place": _padded(points.position)}
    if dim == 1:
        fields |= {"u": points.displacement, "v": points.velocity, "stress": stress, "strain": strain}
    else:
        fields |= {"u": _padded(points.displacement), "v": _padded(points.velocity)}
        strain = _symmetric(strain, dim, stress.shape[1])
        for k, component in enumerate(list(_OF_TENSOR)[: stress.shape[1]]):
            fields |= {f"stress_{component}": stress[:, k], f"strain_{component}": strain[:, k]}
    shown = {"position", "initial_position", "displacement", "velocity", "stress", "strain"}
    fields |= {name: getattr(points, name) for name in dir(points) if name not in shown}
    return Frame(simulation.t, dim, fields)
