"""Runs an unlike scene by each of its ways, and judges what comes out of each.

Outcomes
  right         exit status 0, and the answer is the one that is known, or that of the other ways
  FALSE         exit status 0, and the answer is wrong, or there should be none, or the ways differ
  noted         the same, and a note says why
  refused       exit status 2 before anything ran
  alarm         refused, though the scene has an answer and this way can find it
  honest        exit status 3 or 4: no equilibrium was claimed
  unnamed       refused, but without the words that the scene asks for
  hang, crash   no end within the seconds of a run; ended by a signal, or without a summary
"""

import math
import re
from dataclasses import dataclass

import numpy as np

from limited_run import run
from map_cases import settings_of
from unlike_scene import toml

SECONDS = 10  # of processor time, of a run
PENETRATION = 1e-9  # of a cell
STRONGER = 0.01  # than its law allows
MUCH = 0.5  # strain in a single phase
# refusals that another way does not meet
OF_THE_WAY = "needs omega_1|needs a single phase|has no time|not known beforehand|sets velocities to zero|cannot be fitted"
LAST = "output.stages=[1e300]"
WRONG = {"FALSE", "alarm", "unnamed", "hang", "crash"}


@dataclass
class Found:
    way: str
    outcome: str
    reason: str = ""
    command: list | None = None
    u: np.ndarray | None = None  # of the components that are judged, and the probes

    @property
    def wrong(self):
        return self.outcome in WRONG


def command_of(program, file, way):
    command = [str(program), "run", str(file)]
    for setting in settings_of(way):
        command += ["--set", setting]
    return command


def answer_at(X, answer):
    """u of the answer's points at those of X: where it has none, a body that does not move."""
    places, u = answer["place"] - answer["u"], np.zeros_like(X)
    scale = np.abs(X).max()
    order = {tuple(np.round(place / scale, 6)): k for k, place in enumerate(places)}
    for k, place in enumerate(X):
        row = order.get(tuple(np.round(place / scale, 6)))
        if row is not None:
            u[k] = answer["u"][row]
    return u


def known_answer(program, unlike, folder, name):
    """(u of an answer as a function of the places, what to say if there is none)"""
    if unlike.exact:
        return unlike.exact, ""
    if unlike.answer is None:
        return None, ""
    file = folder / f"{name}-answer.toml"
    file.write_text(toml(unlike.answer), encoding="utf-8")
    ended = run([*command_of(program, file, "newton"), "--set", LAST], SECONDS)
    file.unlink()
    if ended.exit_status != 0:
        return None, f"Newton's method has no answer: {ended.message or ended.summary.get('reason')}"
    return (lambda X: answer_at(X, ended.last)), ""


def off(u, right, unlike=None):
    """‖u − right‖/‖right‖; where that is 0, ‖u‖. 0 if it is no more than what the scene allows of a cell."""
    distance, scale = np.linalg.norm(u - right), np.linalg.norm(right)
    if unlike and distance <= unlike.of_cell * unlike.cell * math.sqrt(u.size):
        return 0.0
    return float(distance / (scale if scale > 0 else 1))


def beside_the_wall(unlike, u):
    """What of u (n, 3) is judged, less the motion of a wall that has taken the body along."""
    u = u.copy()
    u[:, unlike.scene["dim"] - 1] -= unlike.moved
    return u[:, list(unlike.components)]


def probe(summary, name, unlike, axis):
    """u of a probe along an axis."""
    value = summary["probes"][name]["u" if unlike.scene["dim"] == 1 else f"u.{'xyz'[axis]}"]
    return math.nan if value is None else value


def contact_fault(unlike, summary):
    """What is inside a wall, or off it."""
    for name, right in unlike.touching.items():
        away = (probe(summary, name, unlike, unlike.scene["dim"] - 1) - right) / unlike.cell
        if not abs(away) <= PENETRATION:
            return f"{name} is {away:.2g} cells off its wall"
    for name, (axis, least) in unlike.above.items():
        inside = (least - probe(summary, name, unlike, axis)) / unlike.cell
        if not inside <= PENETRATION:
            return f"{name} is {inside:.2g} cells inside its wall"
    return ""


def beyond_cone(m, xx, yy, zz, xy):
    """f/(ξ c), of the cone that matches Mohr and Coulomb's law in plane strain, tension positive:
    f = √J₂ + η p − ξ c,   η = sin φ/(√(1 − η̄²/3) + (η̄/3) sin φ),   η̄ = 3 sin ψ/√(9 + 3 sin² ψ),   ξ = η cot φ"""
    phi, psi = np.radians(m["phi"]), np.radians(m["psi"])
    of_flow = 3 * np.sin(psi) / np.sqrt(9 + 3 * np.sin(psi) ** 2)
    over = np.sqrt(1 - of_flow**2 / 3) + of_flow / 3 * np.sin(phi)
    eta, xi = np.sin(phi) / over, np.cos(phi) / over
    p = (xx + yy + zz) / 3
    J2 = ((xx - p) ** 2 + (yy - p) ** 2 + (zz - p) ** 2) / 2 + xy**2
    return (np.sqrt(J2) + eta * p) / (xi * m["c"]) - 1


def beyond_pyramid(m, xx, yy, zz, xy):
    """f/(2 c cos φ),   f = (σ₁ − σ₃) + (σ₁ + σ₃) sin φ − 2 c cos φ"""
    phi = np.radians(m["phi"])
    mean, radius = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    largest, least = np.maximum(mean + radius, zz), np.minimum(mean - radius, zz)
    return (largest - least + (largest + least) * np.sin(phi)) / (2 * m["c"] * np.cos(phi)) - 1


def beyond_strength(unlike, ended):
    """The most that a point bears beyond its strength, as a share of it."""
    m = unlike.scene["material"]["m"]
    beyond = beyond_pyramid if m["law"] == "mohr-coulomb" else beyond_cone
    return float(beyond(m, *(ended.last[f"stress_{name}"] for name in ("xx", "yy", "zz", "xy"))).max())


def wrong_ground(unlike, ended):
    if unlike.strong and not (beyond := beyond_strength(unlike, ended)) <= STRONGER:
        return f"a point bears {beyond:.2g} more than its strength"
    if unlike.squeezed and not is_said_to_be_squeezed(ended):
        return f"nothing is said beside the status of a strain of {ended.summary['single_phase_strain']:.0%}"
    return ""


def is_said_to_be_squeezed(ended):
    """Of a body that flows in a single phase: in the status line where that is much, otherwise in a note."""
    strain = ended.summary["single_phase_strain"] or 0
    said = ended.summary["reason"] if strain > MUCH else " ".join([ended.summary["reason"], *ended.summary["notes"]])
    return bool(re.search("strained|single phase", said))


def wrong_answer(unlike, ended, answer):
    """What is wrong with an equilibrium; empty if nothing is that can be known from it alone."""
    summary = ended.summary
    if unlike.never:
        return "" if unlike.squeezed and is_said_to_be_squeezed(ended) else unlike.never
    if unlike.factor is not None:
        if summary["status"] != "limit-load":
            return ""
        off_by = summary["load"]["factor"] / unlike.factor - 1
        return "" if abs(off_by) <= unlike.tolerance else f"a limit load of {off_by + 1:.3g} times the right one"
    if answer is not None:
        error = off_answer(unlike, ended, answer)
        if not error <= unlike.tolerance:
            return f"u is off by {error:.2g}"
    return contact_fault(unlike, summary) or wrong_ground(unlike, ended)


def off_answer(unlike, ended, answer):
    u = ended.last["u"]
    return off(beside_the_wall(unlike, u), beside_the_wall(unlike, answer(ended.last["place"] - u)), unlike)


def compared(unlike, ended):
    """What the ways have to have in common: u of the points, and at the probes."""
    values = []
    for one in unlike.scene.get("probe", []):
        for field in one["fields"]:
            axis = max("xyz".find(field[-1]), 0)  # "u" of a line, "u.y" of others
            moved = unlike.moved if axis == unlike.scene["dim"] - 1 else 0
            values.append(probe(ended.summary, one["name"], unlike, axis) - moved)
    return np.concatenate([beside_the_wall(unlike, ended.last["u"]).ravel(), values])


def judged(unlike, way, ended, answer, command):
    if ended.exit_status is None:
        return Found(way, "hang", ended.message, command)
    if ended.exit_status == 2 and not ended.summary:
        named = not unlike.says or ended.says(f"{unlike.says}|{OF_THE_WAY}")
        alarm = unlike.needed and not ended.says(OF_THE_WAY)
        return Found(way, "alarm" if alarm else "refused" if named else "unnamed", ended.message, command)
    if ended.exit_status not in (0, 3, 4) or not ended.summary:
        return Found(way, "crash", f"exit status {ended.exit_status}: {ended.message}", command)
    said = f"{ended.summary['status']}: {ended.summary.get('reason') or ''}"
    if ended.exit_status != 0:
        return Found(way, "honest", said, command)
    if wrong := wrong_answer(unlike, ended, answer):
        noted = unlike.notes and ended.says(unlike.notes)
        return Found(way, "noted" if noted else "FALSE", f"{wrong}; {said}", command)
    return Found(way, "right", said, command, compared(unlike, ended))


def compare_ways(unlike, found):
    """Those that are apart from the one that is nearest to all others are false."""
    claims = [one for one in found if one.outcome == "right"]
    if not unlike.unique or unlike.factor is not None or len(claims) < 2:
        return
    apart = [[np.nan_to_num(off(one.u, other.u, unlike), nan=np.inf) for other in claims] for one in claims]
    middle = int(np.argmin([np.median(row) for row in apart]))
    for k, one in enumerate(claims):
        distance = apart[k][middle]
        if not distance <= unlike.unique:
            one.outcome, one.reason = "FALSE", f"u is {distance:.2g} off that by {claims[middle].way}; {one.reason}"


def verdicts(program, unlike, folder, name):
    """(what came of each way, why there is no answer to judge by)"""
    file = folder / f"{name}.toml"
    file.write_text(toml(unlike.scene), encoding="utf-8")
    answer, missing = known_answer(program, unlike, folder, name)
    found = []
    for way in unlike.ways:
        command = command_of(program, file, way)
        found.append(judged(unlike, way, run([*command, "--set", LAST], SECONDS), answer, command))
    compare_ways(unlike, found)
    if not any(one.wrong for one in found):
        file.unlink()
    return found, missing
