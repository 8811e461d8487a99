"""What a relaxation written in Python remembers, for checkpoints: its attributes, as text that runs no code when read."""

from __future__ import annotations

import json
from typing import Any

import numpy as np


def _written(name: str, value: Any) -> Any:
    if isinstance(value, np.ndarray) and value.dtype.kind in "fib":
        return {"dtype": value.dtype.str, "shape": list(value.shape), "values": value.ravel().tolist()}
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise TypeError(
        f"the attribute '{name}' of the relaxation is a {type(value).__name__}, which no checkpoint takes; "
        "expected numbers, strings, None and arrays of numbers"
    )


def to_text(own: object) -> str:
    """The attributes of an object; of a function none."""
    return json.dumps({name: _written(name, value) for name, value in getattr(own, "__dict__", {}).items()})


def from_text(own: object, text: str) -> None:
    """Gives an object the attributes of to_text(), with the same bits."""
    for name, value in json.loads(text).items():
        if isinstance(value, dict):
            value = np.array(value["values"], dtype=np.dtype(value["dtype"])).reshape(value["shape"])
        setattr(own, name, value)
