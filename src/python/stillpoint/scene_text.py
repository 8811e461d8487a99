"""Scenes as dictionaries, and overrides, as the TOML that they stand for."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def _string(text: str) -> str:
    escapes = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    return '"' + "".join(escapes.get(c, c if c >= " " and c != "\x7f" else f"\\u{ord(c):04X}") for c in text) + '"'


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a key of a scene is a string, found {key!r}")
    return key if _BARE.fullmatch(key) else _string(key)


def value_text(value: Any) -> str:
    """A value as TOML writes it. TypeError for what no scene holds."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else {math.inf: "inf", -math.inf: "-inf"}.get(value, "nan")
    if isinstance(value, (str, os.PathLike)):
        return _string(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {value_text(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(value_text, value)) + "]"
    raise TypeError(f"a scene holds numbers, strings, lists and dictionaries, found a {type(value).__name__}")


def _is_tables(value: Any) -> bool:
    return isinstance(value, Sequence) and len(value) > 0 and all(isinstance(item, Mapping) for item in value)


def scene_text(table: Mapping[str, Any], header: str = "") -> str:
    """A dictionary with a key a line. Plain values come first: what follows a header belongs to it."""
    text, tables = "", ""
    for key, value in table.items():
        name = header + _key(key)
        if isinstance(value, Mapping):
            tables += f"\n[{name}]\n" + scene_text(value, name + ".")
        elif _is_tables(value):
            tables += "".join(f"\n[[{name}]]\n" + scene_text(item, name + ".") for item in value)
        else:
            text += f"{_key(key)} = {value_text(value)}\n"
    return text + tables


def override_texts(overrides: Mapping[str, Any]) -> list[str]:
    """Keys and values as for --set; a dictionary stands for its keys one by one: {"damping": {"c": 0.45}}."""
    texts: list[str] = []
    for key, value in overrides.items():
        if isinstance(value, Mapping):
            texts += override_texts({f"{key}.{inner}": deeper for inner, deeper in value.items()})
        else:
            texts.append(f"{key}={value_text(value)}")
    return texts
