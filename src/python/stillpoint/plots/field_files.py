"""The stages of runs, read from their fields.h5."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from .field_frames import run_of
from .field_stages import Run
from .folders import Refused, read_summary
from .frames import open_frames


def evenly_spread(count: int, wanted: int) -> list[int]:
    if count <= wanted:
        return list(range(count))
    return [round(k * (count - 1) / (wanted - 1)) for k in range(wanted)] if wanted > 1 else [count - 1]


def slope_angles(summary: Mapping[str, Any], folder: Path) -> dict[float, float]:
    """{t: angle} of the stages in summary.json, if a probe of the scene asks for it."""
    try:
        if not any("slope_angle" in fields for fields in (summary.get("probes") or {}).values()):
            return {}
        stages = [(float(stage["t"]), stage["slope_angle"]) for stage in summary.get("stages") or []]
        return {t: float(angle) for t, angle in stages if angle is not None}
    except (AttributeError, TypeError, KeyError, ValueError):
        raise Refused(f"{folder / 'summary.json'}: expected stages of numbers t and slope_angle") from None


def read_run(folder: Path, field: str | None, wanted: int) -> tuple[Run, str]:
    """The run, and the field that was chosen for it."""
    summary, label = read_summary(folder)
    angles = slope_angles(summary, folder)
    with open_frames(folder) as frames:
        some = [frames[k] for k in evenly_spread(len(frames), wanted)]
        return run_of(some, field, label, summary, angles)


def read_runs(folders: Sequence[Path], field: str | None, wanted: int) -> tuple[list[Run], str]:
    """All by the field that was chosen for the first."""
    runs: list[Run] = []
    for folder in folders:
        run, field = read_run(folder, field, wanted)
        runs.append(run)
    if len({run.dim for run in runs}) > 1:
        raise Refused("runs of different dimensions do not go into one picture")
    return runs, field or ""
