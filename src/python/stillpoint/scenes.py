"""Scenes from files and from dictionaries."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Union

from . import _core
from .scene_text import override_texts, scene_text

Source = Union[str, "os.PathLike[str]", Mapping[str, Any]]


def load(source: Source, overrides: Mapping[str, Any] | None = None, /, **more: Any) -> _core.Scene:
    """Reads, checks and completes a scene.

    source: a TOML file, or a dictionary with the same keys; files that a dictionary names are looked for from the present
    folder. overrides, and keywords, change any key: load("bar.toml", damping={"c": 0.45}), or
    load("bar.toml", {"damping.c": "pi/10", "force[0].value": 0.002}).

    SceneError lists all that is wrong, with file, line and column, or with the key of a dictionary.
    """
    return scene_of(source, override_texts({**(overrides or {}), **more}))


def scene_of(scene: _core.Scene | Source, overrides: Sequence[str] = ()) -> _core.Scene:
    """A scene that was loaded, or the one of a file or a dictionary, with overrides as for --set laid over it."""
    if isinstance(scene, _core.Scene):
        return _core.load_again(scene, overrides) if overrides else scene
    if isinstance(scene, Mapping):
        return _core.load_text(str(Path.cwd() / "scene.toml"), scene_text(scene), overrides)
    return _core.load_file(os.fspath(scene), overrides)
