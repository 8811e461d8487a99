"""Which panels a picture of histories has, and which lines are in each.

First the load against the displacement that drives it, where there is one; then, against time, the probes, the forces of
walls, supports and rigid bodies, the residual, and the energies. What never changes has no panel.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from .folders import Refused
from .history_runs import Run, extent, is_varying
from .pictures import plain

PROBES = {  # in this order; the names that a user's law has given come after them
    "u": "displacement $u$ [m]",
    "v": "velocity $v$ [m/s]",
    "strain": "strain",
    "stress": "stress [Pa]",
    "effective_stress": "effective stress [Pa]",
    "pore_pressure": "pore pressure [Pa]",
    "plastic_strain": "plastic strain",
    "pc": "$p_c$ [Pa]",
    "slope_angle": "slope angle [°]",
    "volume": "volume [m³]",
    "momentum": "momentum [kg m/s]",
    "angular_momentum": "angular momentum [kg m²/s]",
}
FORCES = {
    "force": "force [N]",
    "reaction": "reaction [N]",
    "moment": "moment [N m]",
    "displacement": "displacement of the rigid body [m]",
    "contact_area": "contact area [m²]",
    "penetration": "penetration [cells]",
    "slipping": "share of the contact that slips",
}
OWN = {  # of the run itself
    "residual": "residual $‖F − R‖/‖F‖$",
    "distance": "distance from equilibrium $‖u − u^*‖/‖u‖$",
    "energy": "energy [J]",  # kinetic, and the work of external forces
    "kinetic_over_work": "kinetic energy / external work",
}
TOGETHER = {"normal": "force", "shear": "force"}  # fields of one panel: those of a wall
ENERGIES = {"kinetic_energy": "kinetic energy", "inertia.external_work": "external work"}
COUNTERS = {"t", "steps", "rhs_evaluations"}
TIME = ("t", "time $t$ [s]")
STEPS = ("steps", "steps of the solver")  # of a static one, whose time stands still
# toe.u.x, and base.reaction_y of a support, punch.force_y of a rigid body
COLUMN = re.compile(
    r"(?P<probe>.+?)\.(?P<field>(?:force|reaction|moment|displacement|motion)(?=_[xyz]$)|[^.]+)"
    r"(?:[._](?P<component>[xyz]{1,2}))?"
)
FORCE_OF = {"normal", "force", "reaction"}  # of what moves as `motion` prescribes


@dataclass
class Panel:
    """Lines in one pair of axes."""

    label: str
    lines: list[tuple[Run, str, str]]  # (run, name of the line, column)
    x: str = TIME[0]
    x_label: str = TIME[1]
    log: bool = False

    def names(self) -> list[str]:
        return list(dict.fromkeys(line for _, line, _ in self.lines if line))

    def leave_out_what_no_logarithm_shows(self) -> None:
        if self.log:
            shown = [line for line in self.lines if any(value > 0 for value in line[0].columns[line[2]])]
            self.lines = shown or self.lines

    def varies(self) -> bool:
        return any(is_varying(run.columns[name]) for run, _, name in self.lines)


def place_of(name: str) -> tuple[str, str]:
    """Column → (panel, line in it): toe.u.x is the line 'toe x' of u; a figure of the run is a line without a name."""
    if name in ENERGIES:
        return "energy", ENERGIES[name]
    parts = COLUMN.fullmatch(name)
    if not parts:
        return name, ""
    probe, field, component = parts.group("probe", "field", "component")
    if field in OWN:
        return field, ""
    words = [probe] + [field] * (field in TOGETHER) + [component] * bool(component)
    return TOGETHER.get(field, field), " ".join(words)


def load_panel(runs: Sequence[Run]) -> Panel:
    """The factor of the loads against the displacement that drives them."""
    driven = [run for run in runs if {"load.factor", "load.displacement"} <= run.columns.keys()]
    lines = [(run, "", "load.factor") for run in driven]
    return Panel("load factor $\\lambda$", lines, "load.displacement", "mean displacement along the loads [m]")


def driven_panels(runs: Sequence[Run]) -> dict[str, Panel]:
    """{name: the force of what moves as it is told against how far that is}, along the axis of its longest way."""
    ways: dict[str, dict[str | None, float]] = {}  # {name: {component: length}}
    for run in runs:
        for column, values in run.columns.items():
            parts = COLUMN.fullmatch(column)
            if parts and parts["field"] == "motion" and is_varying(values):
                way = ways.setdefault(parts["probe"], {})
                low, high = extent(values) or (0, 0)
                way[parts["component"]] = max(way.get(parts["component"], 0), high - low)
    panels = {}
    for name, way in ways.items():
        component = max(way, key=lambda one: way[one])
        end = f"_{component}" if component else ""
        motion = f"{name}.motion{end}"
        forces = [f"{name}.{field}{'' if field == 'normal' else end}" for field in sorted(FORCE_OF)]
        lines = [(run, "", force) for run in runs if motion in run.columns for force in forces if force in run.columns]
        along = f" along {component}" if component else ""
        panels[name] = Panel(f"force of {plain(name)}{along} [N]", lines, motion, f"its displacement{along} [m]")
    return panels


def rank(field: str) -> tuple[int, int]:
    """Where a panel stands: of two that are not known the first column comes first."""
    for number, fields in enumerate((PROBES, FORCES, OWN)):
        if field in fields:
            return number, list(fields).index(field)
    return 0, len(PROBES)


def panels_of(runs: Sequence[Run]) -> dict[str, Panel]:
    """{field: its panel}, in the order in which a reader asks."""
    names = dict.fromkeys(name for run in runs for name in run.columns)
    x = TIME if any(is_varying(run.columns["t"]) for run in runs) else STEPS
    fields: dict[str, Panel] = {}
    for name in names:
        field, line = place_of(name)
        if name in COUNTERS or name.startswith("load.") or field == "motion":
            continue
        label = next((of[field] for of in (PROBES, FORCES, OWN) if field in of), plain(field.replace("_", " ")))
        panel = fields.setdefault(field, Panel(label, [], *x, log=field in OWN))
        panel.lines += [(run, line, name) for run in runs if name in run.columns]
    panels = {"load": load_panel(runs), **driven_panels(runs)}
    panels |= {field: fields[field] for field in sorted(fields, key=rank)}
    for panel in fields.values():
        panel.leave_out_what_no_logarithm_shows()
    panels = {field: panel for field, panel in panels.items() if panel.lines}
    if not panels:
        raise Refused(f"{runs[0].label}: no column of its history to draw against t")
    return {field: panel for field, panel in panels.items() if panel.varies()} or panels
