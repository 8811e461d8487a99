"""The page of scripts/beside_fem, beside_fem.md, and its lines on the terminal."""

from beside_fem_case import PLACES
from beside_fem_cases import CASES
from beside_fem_runs import FEM, OURS
from beside_fem_table import by
from beside_fem_verdict import one_solver
from scaling_table import exponent_text, seconds_text, with_spaces

INTRODUCTION = """# Beside finite elements

Więckowski's paper ends with three claims about the material point method beside finite elements: its stress is less
accurate where finite elements can handle the problem, it takes more time, and with a diagonal mass in space it seems more
competitive. This page measures them: Stillpoint beside FEniCSx 0.5, Debian's, on problems with an exact answer.

    scripts/beside_fem_limits.py        # a limit load and where finite elements end, at the bottom: half an hour
    scripts/beside_fem_threads.py       # both programs on one thread and on two, below it
    scripts/beside_fem                  # all the rest, with these: two hours
    scripts/beside_fem --only lame      # one case
    scripts/beside_fem --quick          # its smallest sizes, under half a minute

{about}

- **The same problem.** Body, law, supports and loads stand once, in `scripts/beside_fem_cases.py`, and both programs
  converge to the same exact answer: see the orders.
- **Errors** are taken at the same places inside the body, {plane} in the plane and {space} in space, on no grid, relative
  in L2, or the largest over the largest exact value. Each program has two stresses there: that of its functions' gradient,
  and a recovered one: FEM's L2 projection onto continuous functions of the element's order, Stillpoint's fit to the material
  points around a place, which is what its probes read.
- **A value**, of a case that has one, is v in the middle of the right side of Cook's membrane, or at the end of the beam. There
  is no closed form of these: the answer is that of elements of order 4 on a mesh graded towards all sides
  (`scripts/fem_reference.py`), and places in the membrane are at least 4 of its 48 from the clamped corners.
- **Time** of FEM is meshing, assembly and solver; Python's imports and all that is done to forms, by Python or by the
  compiler, is not counted, nor is the projection where the plain stress is the better one. Of Stillpoint it is the whole
  program, from its start to its end with its report written. The processor time is that of the whole; the solution alone is
  FEM's assembly and solver, and Stillpoint's `wall_s`.
- **Memory** of FEM is the peak beyond what Python holds with its imports; of Stillpoint that of the whole program.
- **Solvers** end at the same ‖F − R‖/‖F‖: 1e-9 in the plane, 1e-8 of the beam and where ν = 0.4999, 1e-6 in space;
  elements in torsion at 1e-10, as their ‖F‖ is that of the stiffness times the turn of the ends.
"""


def number(value):
    return "" if value is None else f"{value:.1e}"


def line(row):
    size = f"{row.case:<8} {row.way:<38} {row.unknowns or row.cells:>7}"
    if not row.found:
        return f"{size}  missing: {row.reason}"
    errors = f"u {number(row.u_l2)}  stress {number(row.raw_l2)}, recovered {number(row.recovered_l2)}"
    return f"{size}  {errors}  {row.whole_s:>8.3f} s, solution {row.solution_s:>8.3f} s  {row.megabytes:>7.1f} MB"


def table(headings, lines):
    text = ["| " + " | ".join(headings) + " |", "|" + "---|" * len(headings)]
    return "\n".join(text + ["| " + " | ".join(cells) + " |" for cells in lines]) + "\n"


# --- a case --------------------------------------------------------------------------------------------


def figures_table(rows):
    errors = ["u (L2)", "σ (L2)", "σ (max)", "recovered (L2)", "recovered (max)", "value"]
    headings = ["way", "cells", "unknowns", *errors, "whole", "processor", "solution", "memory"]
    return table(headings, [figures(row) for row in rows])


def figures(row):
    if not row.found:
        return [row.way, row.cells, "missing: " + row.reason.replace("|", "/")] + [""] * 10
    errors = [number(value) for value in (row.u_l2, row.raw_l2, row.raw_max, row.recovered_l2, row.recovered_max, row.value)]
    times = [seconds_text(seconds) for seconds in (row.whole_s, row.processor_s, row.solution_s)]
    return [row.way, row.cells, with_spaces(row.unknowns), *errors, *times, f"{row.megabytes:.0f} MB"]


def orders_table(orders):
    headings = ["functions", "order of u", "of σ", "of the recovered σ"]
    quantities = ("u_l2", "raw_l2", "recovered_l2")
    return table(headings, [[functions, *(exponent_text(of.get(quantity)) for quantity in quantities)]
                            for functions, of in orders.items()])  # fmt: skip


def crossing_text(found):
    return ", ".join(with_spaces(round(x)) for x in found) or "none"


def errors_table(errors):
    headings = ["ours / FEM's, error of", "at unknowns", "ratio", "the curves cross at"]
    return table(headings, [[key, with_spaces(round(at["unknowns"])), f"{at['ratio']:.2g}", crossing_text(at["crossings"])]
                            for key, at in errors.items()])  # fmt: skip


def times_table(times):
    lines = []
    for error, at in times.items():
        best = [f"{seconds_text(at['best'][program][0])}, {at['best'][program][1].partition(' ')[2]}"
                if program in at["best"] else "not reached" for program in (OURS, FEM)]  # fmt: skip
        lines.append([error, *best, f"{at['ratio']:.2g}" if at["ratio"] else ""])
    return table(["to a relative error of σ of", OURS, FEM, "ratio"], lines)


def section(name, rows, verdicts):
    case = CASES[name]
    text = f"\n## {case.title}\n\n    scripts/beside_fem --only {name}\n\n"
    text += f"![Errors against unknowns and against time](beside_fem/{name}.png)\n\n"
    text += errors_table(verdicts["errors"][name]) + "\n" + times_table(verdicts["times"][name]) + "\n"
    text += "Orders in h, with 95 % (Student's t):\n\n" + orders_table(verdicts["orders"][name]) + "\n"
    return text + figures_table(rows) + "\n" + commands(name, rows)


def commands(name, rows):
    """One figure of each kind of functions, as a command."""
    smallest = [of_it[0] for of_it in one_solver(rows).values()]
    lines = [row.command for row in smallest if row.command]
    return "The smallest of each kind; of the others the cells and the solver differ:\n\n" + "".join(f"    {one}\n" for one in lines)


# --- the claims ----------------------------------------------------------------------------------------

CLAIMS = {
    "less accurate": "**The stress is less accurate than that of finite elements**: {verdict}. L2 error of σ, the better of the "
    "two of each program, ours over FEM's, functions of the same order at equal unknowns:",
    "less accurate where probes read": "**The same of the recovered stress alone**, which probes read, beside the "
    "projected one: {verdict}:",
    "more time": "**It takes more time than finite elements**: {verdict}. Time of the quickest way of Stillpoint over that of "
    "FEM's quickest, to the same error of σ:",
    "competitive in space": "**With a diagonal mass in space it is more competitive**: {verdict}. Time with a diagonal mass over "
    "FEM's best, to an error of σ of 1 %; it holds where that is less than the geometric mean of those in the plane:",
}


def ratios_text(ratios):
    lines = []
    for name, of in ratios.items():
        text = ", ".join(f"{key}: {value:.2g}" for key, value in of.items()) if isinstance(of, dict) else f"{of:.2g}"
        lines.append(f"- {CASES[name].title}: {text or 'not reached by both'}")
    return "\n".join(lines)


def claims_text(claims):
    parts = [CLAIMS[key].format(verdict=claim["verdict"]) + "\n\n" + ratios_text(claim["ratios"]) for key, claim in claims.items()]
    return "## The three claims\n\n" + "\n\n".join(parts) + "\n"


def page(rows, verdicts, about):
    text = INTRODUCTION.format(about=about, plane=PLACES[2], space=PLACES[3]) + "\n<!-- Generated by scripts/beside_fem --accept -->\n\n"
    return text + claims_text(verdicts["claims"]) + "".join(section(name, of_it, verdicts) for name, of_it in by(rows, "case").items())
