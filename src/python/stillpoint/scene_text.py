"""Scenes as dictionaries: written as TOML, a key a line, so that they are read and checked like any file."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_FILES = ("body", "file"), ("body", "stl")  # keys that name files: from the present folder


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


class SceneText:
    """A dictionary as TOML text; keys[line - 1] is the key that a line of it says."""

    def __init__(self, scene: Mapping[str, Any]) -> None:
        self._lines: list[str] = []
        self.keys: list[str] = []
        self._table(scene, (), "")
        self.text = "\n".join(self._lines) + "\n"

    def _line(self, text: str, key: str) -> None:
        self._lines.append(text)
        self.keys.append(key)

    # Plain values first: what follows a header belongs to it.
    def _table(self, table: Mapping[str, Any], header: tuple[str, ...], path: str) -> None:
        inner = {key: value for key, value in table.items() if isinstance(value, Mapping) or _is_tables(value)}
        for key, value in table.items():
            if key in inner:
                continue
            if (*header, key) in _FILES and isinstance(value, (str, os.PathLike)):
                value = Path(value).absolute()
            self._line(f"{_key(key)} = {value_text(value)}", path + key)
        for key, value in inner.items():
            names = (*header, key)
            dotted = ".".join(map(_key, names))
            if isinstance(value, Mapping):
                self._line(f"[{dotted}]", path + key)
                self._table(value, names, f"{path}{key}.")
                continue
            for number, item in enumerate(value):
                self._line(f"[[{dotted}]]", f"{path}{key}[{number}]")
                self._table(item, names, f"{path}{key}[{number}].")


def override_texts(overrides: Mapping[str, Any]) -> list[str]:
    """Keys and values as for --set; a dictionary stands for its keys one by one: {"damping": {"c": 0.45}}."""
    texts: list[str] = []
    for key, value in overrides.items():
        if isinstance(value, Mapping):
            texts += override_texts({f"{key}.{inner}": deeper for inner, deeper in value.items()})
        else:
            texts.append(f"{key}={value_text(value)}")
    return texts
