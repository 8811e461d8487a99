"""Figures by name, as summary.json, compare.json and converge.json have them."""

from __future__ import annotations

import json
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray


class Figures(dict[str, Any]):
    """A dictionary whose keys are attributes as well: figures["residual"] is figures.residual. None: not computed."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no figure '{name}'; expected {', '.join(self)}") from None

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def _repr_html_(self) -> str:
        """A table with a row a figure, for notebooks."""
        return _html(self)


def _html(value: Any) -> str:
    if isinstance(value, Figures):
        rows = (f"<tr><th>{escape(key)}</th><td>{_html(inner)}</td></tr>" for key, inner in value.items())
        return f"<table>{''.join(rows)}</table>"
    if isinstance(value, list) and any(isinstance(one, Figures) for one in value):
        return "".join(map(_html, value))
    if value is None:
        return "not computed"
    return escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def figures_of(value: Any) -> Any:
    """Dictionaries of parsed JSON as Figures, all the way down."""
    if isinstance(value, dict):
        return Figures({key: figures_of(inner) for key, inner in value.items()})
    if isinstance(value, list):
        return [figures_of(inner) for inner in value]
    return value


def figures_in(text: str) -> Figures:
    """Of a JSON object."""
    return Figures({key: figures_of(value) for key, value in json.loads(text).items()})


def numbers_of(values: list[float | None]) -> NDArray[np.float64]:
    """An array of floats; NaN for what was not computed."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def table_of(columns: list[str], rows: Any, whole: tuple[str, ...] = ()) -> NDArray[Any]:
    """A structured array with a field a column; those in whole are integers, the others floats. rows: (rows × columns)."""
    table = np.empty(len(rows), dtype=[(name, np.int64 if name in whole else float) for name in columns])
    values = np.array(rows, dtype=float).reshape(len(rows), len(columns))
    for number, name in enumerate(columns):
        table[name] = values[:, number]
    return table
