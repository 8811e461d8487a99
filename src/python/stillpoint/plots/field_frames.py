"""What of the points at some times is drawn."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .field_stages import Layers, Run, Stage
from .folders import Refused, title_of
from .frames import Frame


def chosen_field(frames: Sequence[Frame], field: str | None) -> str:
    """The one that is asked for; None: plastic_strain if some point has yielded, or else u."""
    offers = [frame.on_offer() for frame in frames]
    common = [name for name in offers[0] if all(name in offer for offer in offers)]
    if not common:
        raise Refused("no fields, so nothing to draw")
    if field is None:
        strain = "plastic_strain"
        yields = strain in common and any((frame.fields[strain][()] > 0).any() for frame in frames)
        field = strain if yields else "u" if "u" in common else common[0]
    if field not in common:
        raise Refused(f"no field '{field}'; there are {', '.join(common)}")
    return field


def stages_of(frames: Iterable[Frame], field: str, angles: Mapping[float, float]) -> list[Stage]:
    """What is drawn of each; angles: of a slope, by the time."""
    layers, stages = None, []
    for frame in frames:
        known, place = frame.places()
        if field == "layers":
            undeformed = place - frame.fields["u"][known, : frame.dim]
            layers = layers or Layers(undeformed)
            values = layers.colours(undeformed)
        else:
            values = frame.values(field)[known]
        angle = next((angle for at, angle in angles.items() if np.isclose(at, frame.t, rtol=1e-6, atol=0)), None)
        stages.append(Stage(frame.t, angle, place, values))
    return stages


def add_mechanism(stage: Stage, frame: Frame, summary: Mapping[str, Any]) -> None:
    """To the last stage of a run that ended at the limit load."""
    load = summary.get("load")
    if summary.get("status") != "limit-load" or not isinstance(load, Mapping) or "v" not in frame.fields:
        return
    known, _ = frame.places()
    stage.mechanism, stage.factor = frame.fields["v"][known, : frame.dim], load.get("factor")


def run_of(
    frames: Sequence[Frame],
    field: str | None,
    label: str,
    summary: Mapping[str, Any],
    angles: Mapping[float, float] | None = None,
) -> tuple[Run, str]:
    """The run that is drawn, of frames by rising time, and the field that is chosen for it."""
    chosen = chosen_field(frames, field)
    stages = stages_of(frames, chosen, angles or {})
    add_mechanism(stages[-1], frames[-1], summary)
    return Run(label, title_of(summary), frames[0].dim, stages), chosen
