"""What a picture of fields shows: the stages of runs, read from their fields.h5."""

from dataclasses import dataclass

import h5py
import numpy as np
from matplotlib.colors import to_rgba_array
from pictures import Refused, read_summary, title_of

# Of the layers: the rows alternate in hue, the columns in tone.
LAYERS = to_rgba_array(["#0072B2", "#7DC1EA", "#D55E00", "#F5B183"]).reshape(2, 2, 4)


@dataclass
class Stage:
    t: float
    slope_angle: float | None  # [degrees]
    place: np.ndarray  # (points × dim), deformed
    values: np.ndarray  # (points) of the field; colours if that is `layers`
    mechanism: np.ndarray | None = None  # (points × dim), the velocity at a limit load
    factor: float | None = None  # of the loads, there


@dataclass
class Run:
    label: str
    title: str
    dim: int
    stages: list[Stage]


def fields_on_offer(frame):
    """The names for --field that a frame of fields.h5 can serve."""
    names = []
    for name, dataset in frame.items():
        if name == "place":
            continue
        names.append(name)
        if dataset.ndim == 2:
            names += [f"{name}_{axis}" for axis in "xyz"[: frame.attrs["dim"]]]
    if "u" in names and frame.attrs["dim"] > 1:
        names.append("layers")
    return names


def values_of(frame, field):
    if field in frame:
        values = frame[field][()]
        return np.linalg.norm(values, axis=1) if values.ndim == 2 else values
    vector, _, axis = field.rpartition("_")
    return frame[vector][:, "xyz".index(axis)]


def of_body(place):
    """Which points have not flown off: none that is farther than a quarter of its size from all but 0.2 % of it."""
    low, high = np.percentile(place, [0.1, 99.9], axis=0)
    reach = (high - low).max() / 4
    return ((place >= low - reach) & (place <= high + reach)).all(axis=1)


def body(place):
    return place[of_body(place)]


def spacing_of(place):
    """The typical distance of neighbours: √(area/points), in space ∛(volume/points). The area is measured in squares
    that hold a few points each, the volume in cubes, of a size that suits a line or a sheet of points, too."""
    place = body(place)
    size, dim = np.ptp(place, axis=0), place.shape[1]
    largest = np.cumprod(np.sort(size)[::-1])
    cell = 3 * max((largest[k] / len(place)) ** (1 / (k + 1)) for k in range(dim)) or 1.0
    numbers = np.floor((place - place.min(axis=0)) / cell).astype(np.int64)
    occupied = len(np.unique(np.ravel_multi_index(numbers.T, numbers.max(axis=0) + 1)))
    return cell * (occupied / len(place)) ** (1 / dim)


class Layers:
    """Squares, or cubes, of the undeformed body, about 8 to its shortest side, whole rows of points in each."""

    def __init__(self, undeformed):
        self.origin, self.spacing = undeformed.min(axis=0), self.distance_of_neighbours(undeformed)
        self.rows = max(2, round(np.ptp(undeformed, axis=0).min() / 8 / self.spacing))

    @staticmethod
    def distance_of_neighbours(place):
        """The median over some points."""
        if len(place) == 1:
            return 1.0
        some = place[:: -(-len(place) // 100)]
        return np.median([np.sqrt(np.partition(((place - each) ** 2).sum(axis=1), 1)[1]) for each in some]) or 1.0

    def colours(self, undeformed):
        numbers = np.floor((undeformed - self.origin) / self.spacing + 0.5) // self.rows
        row, column = numbers[:, 1], numbers.sum(axis=1) - numbers[:, 1]  # in space columns alternate along x and z
        return LAYERS[(row % 2).astype(int), (column % 2).astype(int)]


def evenly_spread(count, wanted):
    if count <= wanted:
        return list(range(count))
    return [round(k * (count - 1) / (wanted - 1)) for k in range(wanted)] if wanted > 1 else [count - 1]


def slope_angles(summary, folder):
    """{t: angle} of the stages in summary.json, if a probe of the scene asks for it."""
    try:
        if not any("slope_angle" in fields for fields in (summary.get("probes") or {}).values()):
            return {}
        stages = [(float(stage["t"]), stage["slope_angle"]) for stage in summary.get("stages") or []]
        return {t: float(angle) for t, angle in stages if angle is not None}
    except (AttributeError, TypeError, KeyError, ValueError):
        raise Refused(f"{folder / 'summary.json'}: expected stages of numbers t and slope_angle") from None


def yielded(frames, fields):
    """["plastic_strain"] if some point has yielded in one of the frames."""
    name = "plastic_strain"
    return [name] if name in fields and any((frame[name][()] > 0).any() for frame in frames) else []


def read_stages(frames, field, angles):
    layers, stages = None, []
    for frame in frames:
        t, place = float(frame.attrs["t"]), frame["place"][:, : frame.attrs["dim"]]
        known = np.isfinite(place).all(axis=1)
        if not known.any():
            raise Refused(f"{frame.file.filename}: at t = {t:.4g} no point has a place")
        place = place[known]
        if field == "layers":
            undeformed = place - frame["u"][known, : frame.attrs["dim"]]
            layers = layers or Layers(undeformed)
            values = layers.colours(undeformed)
        else:
            values = values_of(frame, field)[known]
        angle = next((angle for at, angle in angles.items() if np.isclose(at, t, rtol=1e-6, atol=0)), None)
        stages.append(Stage(t, angle, place, values))
    return stages


def add_mechanism(stage, frame, summary):
    """To the last stage of a run that ended at the limit load."""
    load = summary.get("load")
    if summary.get("status") != "limit-load" or not isinstance(load, dict) or "v" not in frame:
        return
    known = np.isfinite(frame["place"][:, : frame.attrs["dim"]]).all(axis=1)
    stage.mechanism, stage.factor = frame["v"][known, : frame.attrs["dim"]], load.get("factor")


def read_run(folder, field, wanted):
    """The run, and the field that was chosen for it."""
    summary, label = read_summary(folder)
    file = folder / "fields.h5"
    if not file.exists():
        raise Refused(f"{folder}: no fields.h5; does the scene ask for fields?")
    try:
        with h5py.File(file) as content:
            names = sorted((name for name in content if name.startswith("frame_")), key=lambda name: int(name[6:]))
            if not names:
                raise Refused(f"{file}: no frames, so nothing to draw")
            frames = [content[names[k]] for k in evenly_spread(len(names), wanted)]
            dim = int(frames[0].attrs["dim"])
            offers = [fields_on_offer(frame) for frame in frames]
            common = [name for name in offers[0] if all(name in offer for offer in offers)]
            if not common:
                raise Refused(f"{file}: no fields, so nothing to draw")
            field = field or next(name for name in (*yielded(frames, common), "u", *common) if name in common)
            if field not in common:
                raise Refused(f"{file}: no field '{field}'; there are {', '.join(common)}")
            stages = read_stages(frames, field, slope_angles(summary, folder))
            add_mechanism(stages[-1], frames[-1], summary)
    except (OSError, KeyError, ValueError) as error:
        raise Refused(f"{file}: {error}") from None
    return Run(label, title_of(summary), dim, stages), field


def read_runs(folders, field, wanted):
    runs = []
    for folder in folders:
        run, field = read_run(folder, field, wanted)
        runs.append(run)
    if len({run.dim for run in runs}) > 1:
        raise Refused("runs of different dimensions do not go into one picture")
    return runs, field
