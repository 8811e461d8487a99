"""Runs a case of the accuracy ladder, and judges its rows.

A row is ok if what was computed is a number, and
  its relative error (absolute where the answer is 0) is at most the target, or it lies in the target's range;
  an order is at least the target, and its interval (95 %) has the theory's order in it, or ends within 0.05 of it, and
  is narrower than 2, or a remark says why not.
It is a MISS in any other case: a run that failed, a quantity that is not there or not a number.
"""

import csv
import json
import math
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import closed_answers
import heap
from fitted_line import fitted_slope
from limited_run import Run, difference, limited, run_in
from scene_constants import constants_of, value_of

LAST = "output.stages=[1e300]"  # the fields of the end
WIDEST = 2.0  # interval of an order that says something
# What the term of the next order may add to an order: an interval tells how errors scatter about a line, and where they
# hardly do, the last digits of one of them, which differ from processor to processor, would decide.
NEXT_TERM = 0.05


class Missing(Exception):
    """Why there is nothing to judge."""


@dataclass
class Row:
    case: str
    quantity: str
    target: float | list[float]
    exact: float | None = None
    computed: float | None = None
    error: float | None = None
    order: float | None = None
    low: float | None = None
    high: float | None = None
    ok: bool = False
    reason: str = ""  # of a MISS
    remark: str = ""  # on an order
    known_miss: str = ""
    evaluations: int | None = None
    wall_s: float = 0.0

    @property
    def known(self):
        """A miss that is known, which is of a value: what failed or is not there is never that."""
        return not self.ok and bool(self.known_miss) and self.computed is not None and math.isfinite(self.computed)

    @property
    def wrong(self):
        return bool(self.known_miss) if self.ok else not self.known


@dataclass
class Outcome:
    """What a case left."""

    runs: list[tuple[Path, list[str], Run]]  # (folder, settings, run)
    study: dict
    failure: str = ""
    evaluations: int | None = None


def set_options(settings):
    return [word for one in settings for word in ("--set", one)]


def commands_of(program, case):
    """[(command, settings)] of a case."""
    if case.refine:
        command = [str(program), "converge", str(case.scene), "--refine", case.refine, "--levels", str(case.levels)]
        command += ["--ratio", f"{case.ratio:g}", "--no-sources"]
        return [(command + set_options(case.settings), case.settings)]
    if case.safety:
        command = [str(program), "safety", str(case.scene)]
        for option, value in zip(("--from", "--to", "--width"), case.safety):
            command += [option, f"{value:g}"]
        return [(command + set_options(case.settings), case.settings)]
    found = []
    for level in case.halve or [[]]:
        settings = case.settings + level
        if any(quantity.read.removeprefix("order.").startswith(("fields.", "heap.")) for quantity in case.quantities):
            settings = settings + [LAST]
        command = [str(program), "run", str(case.scene)] + set_options(settings)
        found.append((command, settings))
    return found


# --- running -----------------------------------------------------------------------------------------


def study_of(command, folder, seconds, file, runs):
    """A study that leaves a JSON file with a list of its runs."""
    ended = limited(command, folder, seconds)
    if ended is None:
        return Outcome([], {}, f"no end within {seconds:g} s")
    file = Path(folder) / file
    study = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}
    failure = "" if ended.returncode == 0 and study else f"exit status {ended.returncode}: {ended.stderr.strip()}"
    return Outcome([], study, failure, sum(run.get("evaluations") or 0 for run in study.get(runs, [])))


def outcome_of(program, case, folder):
    commands = commands_of(program, case)
    if case.refine:
        return study_of(commands[0][0], folder, case.seconds, "converge.json", "levels")
    if case.safety:
        return study_of(commands[0][0], folder, case.seconds, "safety.json", "verdicts")
    outcome = Outcome([], {}, evaluations=0)
    for number, (command, settings) in enumerate(commands):
        own = folder / str(number) if len(commands) > 1 else folder
        run = run_in(own, command, case.seconds)
        if run.exit_status != 0:
            reason = run.summary.get("reason") or run.message
            status = "" if run.exit_status is None else f"exit status {run.exit_status}: "
            outcome.failure = outcome.failure or f"{status}{run.summary.get('status', '')} {reason}".strip()
        outcome.evaluations += run.summary.get("rhs_evaluations") or 0
        outcome.runs.append((own, settings, run))
    return outcome


# --- reading -----------------------------------------------------------------------------------------


def names_of(constants, place=()):
    """What a formula may name."""
    names = dict(constants) | dict(zip("xy", place))
    for name, function in closed_answers.OF_A_COLUMN.items():
        names[name] = lambda x, function=function: float(function(np.array([x]), **constants)[0])
    return names | {"beam": closed_answers.beam}


def mean_of_history(file, column, since):
    with open(file, newline="", encoding="utf-8") as table:
        values = [float(row[column]) for row in csv.DictReader(table) if float(row["t"]) >= since]
    return sum(values) / len(values)


def points_field(fields, name):
    """ "u", "u.y", "stress" on a line, "stress.yy" in the plane."""
    whole, _, which = name.partition(".")
    if whole in fields:
        field = fields[whole]
        return field[:, "xyz".index(which or "x")] if field.ndim == 2 else field
    return fields[f"{whole}_{which}"]


def field_error(run, read, answer, constants):
    """Of "fields.u.y" beside a closed answer, over all points."""
    start = run.last["place"] - run.last["u"]
    along = start[:, 1 if constants.get("vertical") else 0]
    right = closed_answers.OF_A_COLUMN[answer](along, **constants)
    return difference(points_field(run.last, read.removeprefix("fields.")), right)


def of_heap(run, what, constants):
    """Of "heap.runout" and "heap.height", at the end."""
    start = run.last["place"] - run.last["u"]
    volume, depth, width = constants["area"] / len(start), constants["grain"], constants["h"]
    if what == "height":
        return float(run.last["place"][:, 1].max())
    if what != "runout":
        raise Missing(f"a heap has no {what}; expected runout or height")
    ends, began = (heap.front(x[:, 0], volume, depth, width) for x in (run.last["place"], start))
    return ends - began


def value_and_exact(case, quantity, read, outcome, number=-1):
    """(computed, exact) of a run."""
    folder, settings, run = outcome.runs[number]
    constants = constants_of(case.scene, settings)
    first, _, rest = read.partition(".")
    if first == "fields":
        return field_error(run, read, quantity.exact, constants), 0.0
    names = names_of(constants)
    if first in ("error", "load", "contacts"):
        computed = run.summary[first][rest]
    elif first == "reactions":
        support, _, axis = rest.rpartition(".")
        computed = run.summary["reactions"][support][axis]
    elif first == "heap":
        computed = of_heap(run, rest, constants)
    elif first == "history":
        computed = mean_of_history(folder / "history.csv", rest, value_of(quantity.since, names))
    else:
        computed = run.summary["probes"][first][rest]
        names = names_of(constants, run.summary["probe_places"].get(first, ()))  # a body has no place
    exact = None if quantity.exact is None else value_of(quantity.exact, names)
    return (math.nan if computed is None else float(computed)), exact


def relative(computed, exact):
    return abs(computed - exact) / (abs(exact) or 1)


def fitted_order(errors):
    """(order, low, high) of errors at sizes 1, 1/2, 1/4, …; log₂ of them by least squares, with 95 % by Student's t."""
    if not all(math.isfinite(error) and error > 0 for error in errors):
        raise Missing(f"errors {errors}")
    return fitted_slope(np.arange(len(errors)), -np.log2(errors))


# --- judging -----------------------------------------------------------------------------------------


def order_of(case, quantity, outcome):
    """(order, low, high, theory)"""
    name = quantity.read.removeprefix("order.")
    if case.refine:
        found = outcome.study["orders"].get(name)
        if not found:
            raise Missing(f"the study has no order of {name}")
        return found["order"], found["low"], found["high"], quantity.theory or found["theory"]
    errors = [relative(*value_and_exact(case, quantity, name, outcome, k)) for k in range(len(outcome.runs))]
    return *fitted_order(errors), quantity.theory


def judge_order(row, case, quantity, outcome):
    row.order, row.low, row.high, row.exact = order_of(case, quantity, outcome)
    row.computed, row.remark = row.order, quantity.order_remark
    if not row.order >= row.target:
        row.reason = f"order {row.order:.2f}, below {row.target:g}"
    elif not quantity.order_remark:
        if row.exact is None or row.low is None or row.high is None:
            row.reason = "no interval, or no order that theory knows, and no remark says why"
        elif not row.high - row.low <= WIDEST:
            row.reason = f"the interval {row.low:.2f} to {row.high:.2f} says nothing"
        elif not round(row.low - NEXT_TERM, 2) <= row.exact <= round(row.high + NEXT_TERM, 2):
            row.reason = f"the interval {row.low:.2f} to {row.high:.2f} leaves out {row.exact:g}, and no remark says why"


def factor_and_exact(case, quantity, study):
    names = names_of(constants_of(case.scene, case.settings))
    exact = None if quantity.exact is None else value_of(quantity.exact, names)
    return 0.5 * (study["factor_low"] + study["factor_high"]), exact


def judge_value(row, case, quantity, outcome):
    if case.safety:
        row.computed, row.exact = factor_and_exact(case, quantity, outcome.study)
    else:
        row.computed, row.exact = value_and_exact(case, quantity, quantity.read, outcome)
    if not math.isfinite(row.computed):
        raise Missing(f"{quantity.read} is {row.computed}")
    if row.exact is not None:
        row.error = relative(row.computed, row.exact)
    if isinstance(row.target, list):
        low, high = row.target
        row.reason = "" if low <= row.computed <= high else f"{row.computed:.6g} is not in {low:g} to {high:g}"
    elif not row.error <= row.target:
        row.reason = f"error {row.error:.2g}, above {row.target:g}"


def judged(case, quantity, outcome):
    row = Row(case.name, quantity.name, quantity.target, known_miss=quantity.known_miss)
    try:
        if outcome.failure:
            raise Missing(outcome.failure)
        (judge_order if quantity.of_order else judge_value)(row, case, quantity, outcome)
    except Missing as why:
        row.reason = str(why)
    except (KeyError, IndexError, TypeError, ValueError, ZeroDivisionError, NameError, OSError) as error:
        row.reason = f"{quantity.read}: {error!r}"
    row.ok = not row.reason
    return row


def rows_of(program, case, folder):
    """The rows of a case, run in this folder."""
    start = time.monotonic()
    outcome = outcome_of(program, case, folder)
    wall_s = time.monotonic() - start
    rows = [judged(case, quantity, outcome) for quantity in case.quantities]
    for row in rows:
        row.evaluations, row.wall_s = outcome.evaluations, wall_s
    return rows
