"""How the files of a run's or a study's folder are read."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any


class Refused(ValueError):
    """What is wrong with the input."""


def read_summary(folder: Path) -> tuple[dict[str, Any], str]:
    """(DIR/summary.json, what the picture calls the run): {} without the file, the folder's name without DIR/label."""
    summary, label = {}, folder.resolve().name
    try:
        if (folder / "summary.json").exists():
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if (folder / "label").exists():
            label = (folder / "label").read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        raise Refused(f"{folder}: {error}") from None
    if not isinstance(summary, dict):
        raise Refused(f"{folder / 'summary.json'}: expected an object")
    return summary, label


def read_study(folder: Path, name: str, *keys: str) -> dict[str, Any]:
    """DIR/name.json of a study, an object with one of these keys."""
    file = folder / f"{name}.json"
    try:
        study = json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise Refused(f"{folder}: no {name}.json; is this the folder of `stillpoint {name}`?") from None
    except (OSError, ValueError) as error:
        raise Refused(f"{file}: {error}") from None
    if not isinstance(study, dict) or not any(isinstance(study.get(key), (dict, list)) for key in keys):
        raise Refused(f"{file}: expected an object with {' or '.join(keys)}")
    return study


def title_of(summary: Mapping[str, Any]) -> str:
    return str(summary.get("title") or summary.get("scene") or "")
