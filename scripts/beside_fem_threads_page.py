"""The section of scripts/beside_fem_threads.py, beside_fem_threads.md, and its lines on the terminal."""

from statistics import geometric_mean

from beside_fem_page import table
from beside_fem_runs import FEM, OURS
from beside_fem_table import by
from beside_fem_threads_table import apart, positive, quickest_beside, ratios, solved
from scaling_table import seconds_text, with_spaces

INTRODUCTION = """## On two threads

    scripts/beside_fem_threads.py                # all of them
    scripts/beside_fem_threads.py --only cook    # one case

Both programs on one thread and on two, in turn, at one large size of each case, by the ways that are quickest there.

- **Stillpoint** runs with `--threads 2`: a relaxation takes two, and one while that is quicker. Of Newton's method all that
  fills the matrix is on two; CHOLMOD's factor is on one, as results are the same bits for any number.
- **FEniCSx** runs as two ranks of MPI, each on one thread, which divide the cells between them and let other processes run
  while they wait. CHOLMOD knows one rank alone; MUMPS and GAMG know any number.
- **Time and memory** are as above: of two ranks the time of the slower one and the memory of both, without the start of MPI.
  A ratio is the time on one thread over that on two; 2 is all that a second thread can give.
"""
HEADINGS = [
    "case", "program, functions, solver", "unknowns", "whole time on one [s]", "on two [s]", "ratio",
    "solution alone on one [s]", "on two [s]", "ratio", "memory on one, on two [MB]",
]  # fmt: skip


def line(row):
    size = f"{row.case:<8} {row.way:<38} {row.threads} {row.unknowns or row.cells:>7}"
    if not solved(row):
        return f"{size}  {missing(row)}"
    return f"{size}  {row.whole_s:>8.3f} s, solution {row.solution_s:>8.3f} s  {row.megabytes:>7.1f} MB"


# --- the table -----------------------------------------------------------------------------------------


def missing(row):
    return "missing: " + (row.reason or "no time").replace("|", "/").replace("\n", " ")


def whole_text(row):
    if row is None:
        return "one rank alone"
    return seconds_text(row.whole_s).removesuffix(" s") if solved(row) else missing(row)


def figure_text(row, quantity, text):
    """Nothing where the row has no solution, or not this figure."""
    figure = getattr(row, quantity) if row and solved(row) else None
    return text(figure) if positive(figure) else ""


def solution_text(row):
    return figure_text(row, "solution_s", lambda seconds: seconds_text(seconds).removesuffix(" s"))


def ratio_text(pair, quantity):
    ratio = pair.ratio(quantity)
    return f"{ratio:.2f}" if ratio else ""


def pair_line(pair):
    unknowns = next((with_spaces(row.unknowns) for row in pair.rows if row.unknowns), "")
    whole = [whole_text(pair.one), whole_text(pair.two), ratio_text(pair, "whole_s")]
    solution = [solution_text(pair.one), solution_text(pair.two), ratio_text(pair, "solution_s")]
    memory = [figure_text(row, "megabytes", "{:.0f}".format) for row in pair.rows]
    return [pair.one.case, pair.one.way, unknowns, *whole, *solution, ", ".join(filter(None, memory))]


# --- what it comes to ----------------------------------------------------------------------------------


def gain_text(program, pairs):
    whole, solution = ratios(pairs, "whole_s"), ratios(pairs, "solution_s")
    if not whole:
        return f"Of {program} no way has a time on both."
    alone = f", its solution alone {geometric_mean(solution):.2f} times" if solution else ""
    over = f"geometric means of {len(whole)} pairs" if len(whole) > 1 else "of one pair"
    return f"{program} is {geometric_mean(whole):.2f} times as fast on two threads as on one{alone}: {over}."


def whom_it_serves(of_program):
    """Nothing unless both programs have a time on both."""
    found = {program: ratios(pairs, "whole_s") for program, pairs in of_program.items()}
    if not all(found.values()):
        return []
    means = {program: round(geometric_mean(of_it), 2) for program, of_it in found.items()}
    if means[OURS] == means[FEM]:
        return ["The second thread serves both alike."]
    return [f"The second thread serves {max(means, key=means.get)} more."]


def quickest_text(pairs):
    found = quickest_beside(pairs, OURS, FEM)
    if not found:
        return []
    one, two, cases = found
    mean = f", geometric means of {cases} cases" if cases > 1 else ""
    times = f"{one:.2g} times as long as that of {FEM} on one thread and {two:.2g} times on at most two"
    return [f"At about as many unknowns the quickest way of {OURS} takes {times}{mean}."]


def apart_text(pairs):
    largest = apart(pairs, "raw_l2")
    return [] if largest is None else [f"Errors of σ by {FEM} on two ranks are those on one to a relative {largest:.0e}."]


def sentences(pairs):
    of_program = {program: [pair for pair in pairs if pair.one.program == program] for program in (OURS, FEM)}
    gains = [gain_text(program, of_it) for program, of_it in of_program.items()]
    return "\n".join(gains + whom_it_serves(of_program) + quickest_text(pairs) + apart_text(pairs)) + "\n"


def commands(pairs):
    """Of each way on one thread and on two, of the first case that has it."""
    of_way = by([pair.one for pair in pairs], "way")
    first = [next(pair for pair in pairs if pair.one is rows[0]) for rows in of_way.values()]
    lines = [row.command for pair in first for row in pair.rows if row.command]
    text = "One figure of each way; of other cases the name or the scene and the cells differ:\n\n"
    return text + "".join(f"    {one}\n" for one in lines)


def section(pairs):
    return "\n".join([INTRODUCTION, sentences(pairs), table(HEADINGS, map(pair_line, pairs)), commands(pairs)])
