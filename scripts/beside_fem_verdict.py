"""What scripts/beside_fem makes of its rows: orders, ratios at equal unknowns and equal errors, and the three claims."""

from statistics import geometric_mean

from beside_fem_cases import CASES
from beside_fem_runs import FEM, OURS
from beside_fem_table import best_time_to, by, crossings, curve, order, ratio_at_end

# How the two programs' functions are set beside each other; elements with a pressure are what FEM has where others lock.
PAIRS = (("linear", "Q1"), ("quadratic", "Q2"), ("cubic", "Q2"))
MIXED_PAIRS = (("quadratic", "Q2-Q1"), ("cubic", "Q2-Q1"))
SAME_ORDER = ("linear/Q1", "quadratic/Q2", "quadratic/Q2-Q1")
ERRORS = ("u_l2", "raw_l2", "recovered_l2", "stress_l2", "stress_max")
LOOSE, TIGHT = 1e-2, 1e-3  # relative errors of stress to which times are compared
DIAGONAL = "lumped"  # of the name of a solver whose mass is diagonal


def one_solver(rows):
    """{functions: a row of each size}: errors do not depend on the solver. One that has a solution, if there is one."""
    return {functions: [next((row for row in of_size if row.found), of_size[0]) for of_size in by(of_it, "cells").values()]
            for functions, of_it in by(rows, "functions").items()}  # fmt: skip


def errors_beside(rows):
    """{"ours / theirs, quantity": ratio at the largest size of both} of one case."""
    errors, found = one_solver(rows), {}
    for ours, theirs in MIXED_PAIRS if "Q2-Q1" in errors else PAIRS:
        if ours not in errors or theirs not in errors:
            continue
        for quantity in ERRORS:
            curves = [curve(errors[functions], "unknowns", quantity) for functions in (ours, theirs)]
            at_end = ratio_at_end(*curves)
            if at_end:
                found[f"{ours}/{theirs} {quantity}"] = {
                    "unknowns": at_end[0], "ratio": at_end[1], "crossings": [x for x, _ in crossings(*curves)],
                }  # fmt: skip
    return found


def orders_of(rows, dim):
    """{functions: {quantity: (order, low, high)}}"""
    quantities = ("u_l2", "raw_l2", "recovered_l2")
    return {functions: {quantity: fitted for quantity in quantities if (fitted := order(of_it, dim, quantity))}
            for functions, of_it in one_solver(rows).items()}  # fmt: skip


def times_beside(rows):
    """{error: {program: (seconds, way)}} of the quickest way of each program, with the ratio where both get there."""
    found = {}
    for error in (LOOSE, TIGHT):
        best = {program: best_time_to(of_it, error) for program, of_it in by(rows, "program").items()}
        best = {program: time for program, time in best.items() if time}
        ratio = best[OURS][0] / best[FEM][0] if len(best) == 2 else None
        found[f"{error:g}"] = {"best": best, "ratio": ratio}
    return found


def diagonal_beside(rows, error=LOOSE):
    """Time of the quickest of our ways with a diagonal mass over FEM's best, to the same error of stress; None without."""
    ours = best_time_to([row for row in rows if row.program == OURS and DIAGONAL in row.solver], error)
    theirs = best_time_to([row for row in rows if row.program == FEM], error)
    return ours[0] / theirs[0] if ours and theirs else None


# --- the claims ----------------------------------------------------------------------------------------


def verdict_of(answers):
    """answers: {case: whether the claim holds there}"""
    if not answers:
        return "not measured"
    holds = [case for case, answer in answers.items() if answer]
    if len(holds) == len(answers):
        return f"holds in all {len(answers)} comparisons" if len(answers) > 1 else "holds in the one comparison"
    if not holds:
        return f"does not hold in any of {len(answers)} comparisons" if len(answers) > 1 else "does not hold in the one comparison"
    return f"holds in {', '.join(holds)}; does not in {', '.join(case for case in answers if case not in holds)}"


def less_accurate(cases, quantity):
    """Claim 1: σ is less accurate than FEM's, by functions of the same order at equal unknowns."""
    ratios = {name: {pair: beside[f"{pair} {quantity}"]["ratio"] for pair in SAME_ORDER if f"{pair} {quantity}" in beside}
              for name, beside in cases.items()}  # fmt: skip
    answers = {f"{name} ({pair})": ratio > 1 for name, pairs in ratios.items() for pair, ratio in pairs.items()}
    return {"verdict": verdict_of(answers), "ratios": ratios}


def slower(times):
    """Claim 2: it takes more time than FEM, to the same error of σ, the quickest way of each program."""
    ratios = {name: {error: beside["ratio"] for error, beside in of_case.items() if beside["ratio"]}
              for name, of_case in times.items()}  # fmt: skip
    answers = {f"{name} (to {error})": ratio > 1 for name, of in ratios.items() for error, ratio in of.items()}
    return {"verdict": verdict_of(answers), "ratios": ratios}


def competitive_in_space(diagonal):
    """Claim 3: with a diagonal mass it is more competitive in space: its time over FEM's is less than the geometric mean of
    those in the plane."""
    plane = {name: ratio for name, ratio in diagonal.items() if ratio and CASES[name].dim == 2}
    space = {name: ratio for name, ratio in diagonal.items() if ratio and CASES[name].dim == 3}
    answers = {name: ratio < geometric_mean(plane.values()) for name, ratio in space.items()} if plane else {}
    return {"verdict": verdict_of(answers), "ratios": plane | space}


def judged(rows):
    """Everything that beside_fem.json holds."""
    of_cases = by(rows, "case")
    errors = {name: errors_beside(of_it) for name, of_it in of_cases.items()}
    times = {name: times_beside(of_it) for name, of_it in of_cases.items()}
    diagonal = {name: diagonal_beside(of_it) for name, of_it in of_cases.items()}
    return {
        "orders": {name: orders_of(of_it, CASES[name].dim) for name, of_it in of_cases.items()},
        "errors": errors,
        "times": times,
        "claims": {
            "less accurate": less_accurate(errors, "stress_l2"),
            "less accurate where probes read": less_accurate(errors, "recovered_l2"),
            "more time": slower(times),
            "competitive in space": competitive_in_space(diagonal),
        },
    }
