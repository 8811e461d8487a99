"""Runs a row of the stability map under a time limit, and judges what comes out.

Outcomes
  equilibrium, end-time, limit-load   exit status 0, and the answer is right
  FALSE                   exit status 0, and the answer is wrong by more than 1 %, or there should be none
  inaccurate              the same, by more than the case's tolerance but not by 1 %
  noted                   exit status 0, the answer is wrong or should be none, and a note says why (`notes` of the case)
  wrong figure            exit status 0, the answer is right and a figure of the summary is not
  step-limit, failed, …   exit status 3 or 4: the status of summary.json
  refused                 exit status 2 before anything ran
  unnamed                 as it should be, but without the words that `says` or `notes` ask for
  not judged              exit status 0, and the judge has no answer
  hang, crash             no end within the seconds of the case; ended by a signal, or without a summary
"""

import math
import threading
from dataclasses import dataclass, field

import numpy as np

import closed_answers
from limited_run import difference, run
from map_cases import Row, settings_of
from scene_constants import constants_of

WRONG = 0.01  # an error that makes an equilibrium a false one
STEPS = 50_000  # at most of a run, where the scene does not say
LAST = "output.stages=[1e300]"  # the fields of the end


@dataclass
class Verdict:
    outcome: str
    evaluations: int | None = None
    error: float | None = None
    reason: str = ""
    expected: bool = False  # one of those that the row expects


def command_of(program, row, settings=()):
    command = [str(program), "run", str(row.scene)]
    for setting in [*row.settings, *settings_of(row.way), *settings]:
        command += ["--set", setting]
    return command


# --- judges: the error of a run ----------------------------------------------------------------------


def by_exact(_program, _row, run_):
    return run_.summary["error"]["u_rel_l2"]


@dataclass
class Answer:
    """A static solver's, found once for all ways."""

    lock: threading.Lock = field(default_factory=threading.Lock)
    known: bool = False
    fields: dict | None = None


_lock, _answers = threading.Lock(), {}  # answers by their commands


def static_answer(program, row, method):
    """The fields of the equilibrium by a static solver in one phase; None where it finds none."""
    settings = [setting for setting in row.settings if not setting.startswith(("integrator.", "damping."))]
    plain = Row(row.case, method, row.scene, settings, [])
    wanted = ["stop.residual=1e-8", "stop.distance=0", "phase.max_motion=none", LAST, *row.judge_settings]
    command = command_of(program, plain, wanted)
    with _lock:
        answer = _answers.setdefault(tuple(command), Answer())
    with answer.lock:
        if not answer.known:
            ended = run(command, row.seconds)
            answer.fields = ended.last if ended.exit_status == 0 else None
            answer.known = True
    return answer.fields


def by_static_solver(method):
    def judge(program, row, run_):
        answer = static_answer(program, row, method)
        return None if answer is None else difference(run_.last["u"], answer["u"])

    return judge


def by_closed_answer(name):
    def judge(_program, row, run_):
        constants = constants_of(row.scene, row.settings)
        along = 1 if constants.get("vertical") else 0
        start = run_.last["place"] - run_.last["u"]
        return difference(run_.last["u"][:, along], getattr(closed_answers, name)(start[:, along], **constants))

    return judge


def by_column_stress(_program, row, run_):
    """Of the Cauchy stress −ρ g (l − X) of a column on a line."""
    constants = constants_of(row.scene, row.settings)
    start = (run_.last["place"] - run_.last["u"])[:, 0]
    weight = constants["rho"] * constants["g"]
    return difference(run_.last["stress"], -weight * (constants["l"] - start))


def by_conservation(_program, _row, run_):
    """The largest drift of the points' momentum, angular momentum and energy; all points have the same mass."""

    def sums(frame):
        x, v = frame["place"], frame["v"]
        return v.mean(axis=0), np.cross(x, v).mean(axis=0), (v**2).sum(axis=1).mean()

    (p0, l0, e0), (p, l, e) = sums(run_.first), sums(run_.last)
    speed, size = math.sqrt(e0), np.abs(run_.first["place"]).max()
    return max(np.linalg.norm(p - p0) / speed, np.linalg.norm(l - l0) / (speed * size), abs(e / e0 - 1))


def by_momentum(_program, _row, run_):
    """The drift of the points' momentum, over that at the start."""
    p0, p = (frame["v"].mean(axis=0) for frame in (run_.first, run_.last))
    return float(np.linalg.norm(p - p0) / np.linalg.norm(p0))


def by_threads(program, row, run_):
    """The largest difference to what 2 and 3 threads give: 0, or the promise of the same bits is broken."""
    others = [run(command_of(program, row, [LAST]), row.seconds, threads) for threads in (2, 3)]
    if any(other.summary["steps"] != run_.summary["steps"] for other in others):
        return math.inf
    return max(np.abs(other.last["u"] - run_.last["u"]).max() for other in others) / np.abs(run_.last["u"]).max()


def by_figures(_program, row, run_):
    """The largest error of the case's figures, relative but where 0 is right."""
    errors = [figure_error(run_.summary, name, right) for name, right in row.figures.items()]
    return max(errors, default=0.0)


JUDGES = {
    "exact": by_exact,
    "newton": by_static_solver("newton"),
    "cg": by_static_solver("cg"),
    "auto": by_static_solver("auto"),  # with what judge_set adds or holds, in phases too
    "slow": by_static_solver("viscous"),  # under the loads of judge_set, which rise slowly
    "hencky_column": by_closed_answer("hencky_column"),
    "neo_hookean_column": by_closed_answer("neo_hookean_column"),
    "conserved": by_conservation,
    "momentum": by_momentum,
    "column_stress": by_column_stress,
    "pulled": by_closed_answer("pulled"),
    "resting_column": by_closed_answer("resting_column"),
    "threads": by_threads,
    "figures": by_figures,
}


def figure(summary, name):
    """A figure of the summary: "omega_1", or "probe.field"."""
    probe, _, of_probe = name.partition(".")  # of_probe may have a point of its own: stress.yy
    return summary["probes"][probe][of_probe] if of_probe else summary[name]


def figure_error(summary, name, right):
    value = figure(summary, name)
    return math.inf if value is None else abs(value - right) / (abs(right) or 1)


def wrong_figure(row, summary):
    for name, right in row.figures.items():
        if not figure_error(summary, name, right) <= row.figures_tolerance:
            return f"{name} is {figure(summary, name)}, expected {right:g}"
    return ""


# --- the verdict -------------------------------------------------------------------------------------


def frames_wanted(row):
    """Of a motion the fields at the start as well. A scene that says when has its own."""
    if any("output.stages" in setting for setting in row.settings):
        return []
    return ["output.stages=[0, 1e300]"] if row.judge in ("conserved", "momentum") else [LAST]


def outcome_of(program, row, ended):
    """(outcome, error, reason)"""
    summary = ended.summary
    reason = summary.get("reason") or ended.message
    if ended.exit_status is None:
        return "hang", None, reason
    if ended.exit_status == 2 and not summary:
        outcome = "refused"
    elif ended.exit_status not in (0, 3, 4) or not summary:
        return "crash", None, f"exit status {ended.exit_status}: {reason}"
    else:
        outcome = summary["status"]
    if ended.exit_status != 0:
        return (outcome if ended.says(row.says) else "unnamed"), None, reason
    said, may_be_noted = ended.says(row.notes), "noted" in row.expected
    if not row.judge:
        return ("noted" if may_be_noted and said else "FALSE"), None, reason
    try:
        error = JUDGES[row.judge](program, row, ended)
    except (KeyError, TypeError) as missing:  # in what the run left
        return "not judged", None, f"{row.judge}: {missing!r}"
    if error is None:
        return "not judged", None, f"{row.judge} finds no answer"
    if not error <= row.tolerance:
        outcome = "inaccurate" if error <= WRONG else "FALSE"
        return ("noted" if may_be_noted and said else outcome), error, f"error {error:.2g}; {reason}"
    if figures := wrong_figure(row, summary):
        return "wrong figure", error, figures
    return (outcome if said or may_be_noted else "unnamed"), error, reason


def verdict(program, row):
    settings = frames_wanted(row)
    if not any("stop.steps" in setting for setting in row.settings):
        settings.append(f"stop.steps={STEPS}")
    ended = run(command_of(program, row, settings), row.seconds)
    outcome, error, reason = outcome_of(program, row, ended)
    return Verdict(outcome, ended.summary.get("rhs_evaluations"), error, reason, outcome in row.expected)
