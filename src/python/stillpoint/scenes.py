"""Scenes from files and from dictionaries."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar, Union

from . import _core
from .errors import Problem, SceneError
from .scene_text import SceneText, override_texts

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]
Result = TypeVar("Result")


def _with_keys(error: SceneError, text: SceneText, file: str) -> SceneError:
    """The same error with keys of the dictionary in the place of lines."""

    def told(problem: Problem) -> Problem:
        if problem.where != file:
            return problem
        known = 0 < problem.line <= len(text.keys)
        key = text.keys[problem.line - 1] if known else "the scene"
        return Problem(key, 0, 0, problem.message.removeprefix(f"{key}: "))

    return SceneError(tuple(map(told, error.problems)))


def reading(source: Source, file: str, read: Callable[[str, str], Result]) -> Result:
    """read(file, text) of a dictionary; what it says of lines is said of keys."""
    assert isinstance(source, Mapping)
    text = SceneText(source)
    try:
        return read(file, text.text)
    except SceneError as error:
        raise _with_keys(error, text, file) from None


def load(source: Source, overrides: Mapping[str, Any] | None = None, /, **more: Any) -> _core.Scene:
    """Reads, checks and completes a scene.

    source: a TOML file, or a dictionary with the same keys; files that a dictionary names are looked for from the present
    folder. overrides, and keywords, change any key: load("bar.toml", damping={"c": 0.45}), or
    load("bar.toml", {"damping.c": "pi/10", "force[0].value": 0.002}).

    SceneError lists all that is wrong, with file, line and column, or with the key of a dictionary.
    """
    sets = override_texts({**(overrides or {}), **more})
    if not isinstance(source, Mapping):
        return _core.load_file(os.fspath(source), sets)
    file = str(Path.cwd() / "scene.toml")
    return reading(source, file, lambda name, text: _core.load_text(name, text, sets))


def scene_of(scene: _core.Scene | Source) -> _core.Scene:
    """A scene that was loaded, or the one of a file or a dictionary."""
    return scene if isinstance(scene, _core.Scene) else load(scene)
