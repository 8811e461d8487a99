"""All points of a run at the times of its fields.h5."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .folders import Refused
from .needed import need

Array = Any  # of numpy


@dataclass
class Frame:
    """At one time. The fields have the names and shapes that they have in fields.h5."""

    t: float
    dim: int
    fields: Mapping[str, Any]  # (points), or (points × 3) of vectors, such as place [m]; of numpy or h5py

    def places(self) -> tuple[Array, Array]:
        """Which points have a place, and these (… × dim)."""
        place = self.fields["place"][:, : self.dim]
        known = np.isfinite(place).all(axis=1)
        if not known.any():
            raise Refused(f"at t = {self.t:.4g} no point has a place")
        return known, place[known]

    def on_offer(self) -> list[str]:
        """The names of what can be drawn."""
        names = []
        for name, values in self.fields.items():
            if name == "place":
                continue
            names.append(name)
            if values.ndim == 2:
                names += [f"{name}_{axis}" for axis in "xyz"[: self.dim]]
        if "u" in names and self.dim > 1:
            names.append("layers")
        return names

    def values(self, field: str) -> Array:
        """(points) of a name that is on offer, but `layers`; of a vector its length."""
        if field in self.fields:
            values = self.fields[field][()]
            return np.linalg.norm(values, axis=1) if values.ndim == 2 else values
        vector, _, axis = field.rpartition("_")
        return self.fields[vector][:, "xyz".index(axis)]


@contextmanager
def open_frames(folder: Path) -> Iterator[list[Frame]]:
    """Those of DIR/fields.h5, by rising time, which can be read until the file is closed behind them."""
    file = folder / "fields.h5"
    if not file.exists():
        is_of_vtk = (folder / "fields.pvd").exists()
        how = 'output.format = ["xdmf", "vtu"] leaves both' if is_of_vtk else "does the scene ask for fields?"
        raise Refused(f"{folder}: no fields.h5; {how}")
    try:
        with need("h5py").File(file) as content:
            names = sorted((name for name in content if name.startswith("frame_")), key=lambda name: int(name[6:]))
            if not names:
                raise Refused("no frames, so nothing to draw")
            groups = [content[name] for name in names]
            yield [Frame(float(group.attrs["t"]), int(group.attrs["dim"]), group) for group in groups]
    except (OSError, KeyError, ValueError) as error:
        raise Refused(f"{file}: {error}") from None
