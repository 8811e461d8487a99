#!/usr/bin/python3
"""beside_fem_threads_test.py ROOT CLAIM: a claim about scripts/beside_fem_threads.py of the source tree ROOT, without FEniCSx."""

import math
import os
import sys

from claims import ROOT, call, check_the_claim, claim, script_module

FEM, OURS = "FEniCSx", "Stillpoint"


def row_of(seconds=1.0, threads=1, program=FEM, functions="Q2", solver="mumps", case="lame", **more):
    table = script_module("beside_fem_table")
    times = {"whole_s": seconds, "solution_s": None if seconds is None else seconds / 2, "megabytes": 10.0 * threads}
    figures = {"unknowns": 64000, "raw_l2": 1e-3, "command": f"the command of {functions} on {threads}"} | times | more
    return table.Row(case, program, functions, solver, "80", threads=threads, **figures)


def pair_of(one=1.0, two=0.5, **more):
    """A way that takes these seconds; None or a text as the reason: no solution."""
    table = script_module("beside_fem_threads_table")
    rows = [row_of(seconds, threads, **more) if isinstance(seconds, float) else row_of(None, threads, **more).missing(seconds)
            for seconds, threads in ((one, 1), (two, 2))]  # fmt: skip
    return table.Pair(*rows)


def alone(seconds=1.0, **more):
    return script_module("beside_fem_threads_table").Pair(row_of(seconds, **more), None)


def ours(one=1.0, two=0.5, **more):
    return pair_of(one, two, program=OURS, **{"functions": "quadratic", "solver": "newton"} | more)


def section_of(*pairs):
    return script_module("beside_fem_threads_page").section(list(pairs))


def the_study(folder, finite_elements, *options, path=None):
    """What comes of a small case with a program, finite elements and an mpirun that fail."""
    for name in ("program", "mpirun"):
        (folder / name).write_text("#!/bin/bash\necho 'it fails | here' >&2\nexit 4\n")
        (folder / name).chmod(0o755)
    (folder / "dolfinx.py").write_text(finite_elements)
    words = ["--only", "lame", "--unknowns", "1000", "--out", folder / "out", "--program", folder / "program", *options]
    environment = os.environ | {"PYTHONPATH": str(folder), "PATH": path or f"{folder}:{os.environ['PATH']}"}
    return call(sys.executable, ROOT / "scripts/beside_fem_threads.py", *words, env=environment)


# --- ratios --------------------------------------------------------------------------------------------


@claim("a ratio of threads is the time on one over that on two, and there is none where a run is missing or has no number")
def _(_folder):
    assert pair_of(3.0, 2.0).ratio("whole_s") == 1.5 and pair_of(3.0, 2.0).ratio("megabytes") == 0.5
    for one, two in (("none", 1.0), (1.0, "none"), (None, None), (math.nan, 1.0), (1.0, math.nan), (1.0, 0.0), (math.inf, 1.0)):
        assert pair_of(one, two).ratio("whole_s") is None, (one, two)
        assert pair_of(one, two).ratio("megabytes") is None, (one, two)
    assert pair_of(value=None).ratio("value") is None and alone().ratio("whole_s") is None


@claim("the quickest ways of both programs are compared on one thread and on at most two, in cases where both have a time on two")
def _(_folder):
    table = script_module("beside_fem_threads_table")

    def beside(*pairs):
        found = table.quickest_beside(pairs, OURS, FEM)
        return found and tuple(round(figure, 12) for figure in found)

    case = [ours(4.0, 2.0), ours(3.0, 2.5, solver="auto"), alone(1.0, solver="cholmod"), pair_of(2.0, 1.25)]
    assert beside(*case) == (3, 2, 1)  # FEM's is the one that has one thread alone
    other = [ours(12.0, 2.0, case="cook"), pair_of(1.0, 2.0, case="cook")]
    assert beside(*case, *other) == (6, 2, 2)
    for lacking in (pair_of(1.0, "no solution", case="cube"), alone(case="cube"), pair_of("no", "no", case="cube")):
        assert beside(ours(case="cube"), lacking) is None
        assert beside(*case, ours(case="cube"), lacking) == (3, 2, 1)
    assert beside() is None


@claim("how far errors on two threads are from those on one is told of the pair that is furthest, and not where none is known")
def _(_folder):
    table = script_module("beside_fem_threads_table")
    off = table.Pair(row_of(threads=1), row_of(threads=2, raw_l2=1e-3 * (1 + 1e-5)))
    assert abs(table.apart([pair_of(), off], "raw_l2") / 1e-5 - 1) < 1e-3 and table.apart([pair_of()], "raw_l2") == 0
    assert table.apart([ours(raw_l2=None)], "raw_l2") is None and table.apart([pair_of(1.0, "none")], "raw_l2") is None


# --- runs ----------------------------------------------------------------------------------------------


@claim("two threads are two ranks of finite elements on one thread each, and one is a process without MPI")
def _(_folder):
    runs = script_module("beside_fem_runs")
    assert runs.ranks(1) == [] and runs.ranks(2)[:3] == ["mpirun", "-n", "2"]
    assert runs.on_threads(2)["OMP_NUM_THREADS"] == "2" and "PATH" in runs.on_threads(1)


@claim("our run on two threads says so to the program and to all that it calls")
def _(folder):
    runs, cases = script_module("beside_fem_runs"), script_module("beside_fem_cases")
    (folder / "program").write_text('#!/bin/bash\necho "$OMP_NUM_THREADS $*" >&2\nexit 4\n')
    (folder / "program").chmod(0o755)
    way = runs.Way(OURS, "quadratic", "newton")
    for threads in (1, 2):
        row = runs.our_row(folder / "program", cases.CASES["lame"], way, 8, folder, 60, threads)
        assert row.reason.startswith(f"{threads} run ") and f"--threads {threads} " in row.reason + " ", row
        assert row.command.endswith(f" --threads {threads}") and row.threads == threads, row


@claim("ways beyond their size are left out on two threads, and what is left are both programs' in every case")
def _(_folder):
    study, cases = script_module("beside_fem_threads"), script_module("beside_fem_cases")
    for name in study.USUAL:
        case = cases.CASES[name]
        ways = study.chosen_ways(case, study.UNKNOWNS[case.dim])
        assert {way.program for way in ways if len(study.threads_of(way)) == 2} == {FEM, OURS}, (name, ways)
        assert all(way.most >= study.UNKNOWNS[case.dim] for way in ways), (name, ways)
    assert not any(way.functions == "quadratic" for way in study.chosen_ways(cases.CASES["cube"], 1e6))


# --- the section ---------------------------------------------------------------------------------------


@claim("the section on threads has every time, ratio and command, and says in words what they come to")
def _(_folder):
    text = section_of(pair_of(2.0, 1.25), alone(1.5, solver="cholmod"), ours(12.0, 6.0), ours(9.0, 8.0, solver="auto"))
    for words in ("## On two threads\n", "| lame | FEniCSx Q2, mumps | 64 000 | 2.00 | 1.25 | 1.60 | 1.00 | 0.62 | 1.60 | 10, 20 |",
                  "| lame | FEniCSx Q2, cholmod | 64 000 | 1.50 | one rank alone |  | 0.75 |  |  | 10 |", "| 12.0 | 6.00 | 2.00 |",
                  "Stillpoint is 1.50 times as fast on two threads as on one, its solution alone 1.50 times: geometric means of 2 pairs.",
                  "FEniCSx is 1.60 times as fast", "of one pair.", "The second thread serves FEniCSx more.",
                  "takes 6 times as long as that of FEniCSx on one thread and 4.8 times on at most two.", "to a relative 0e+00.",
                  "    the command of Q2 on 1\n    the command of Q2 on 2\n"):  # fmt: skip
        assert words in text, (words, text)
    assert all(line.count("|") == 11 for line in text.splitlines() if line.startswith("|")), text
    assert "serves both alike" in section_of(pair_of(), ours()) and "None" not in text and "nan" not in text


@claim("a run on two threads that is missing is told with its reason, and never as a ratio")
def _(_folder):
    text = section_of(pair_of(2.0, "no end | at all\n"), pair_of("none", 1.0, solver="gamg"), ours(math.nan, 1.0))
    for words in ("| 2.00 | missing: no end / at all  |  | 1.00 |  |  | 10 |", "| missing: none | 1.00 |  |  | 0.50 |  | 20 |",
                  "| missing: no time | 1.00 |  |", "Of Stillpoint no way has a time on both.", "Of FEniCSx no way"):  # fmt: skip
        assert words in text, (words, text)
    for words in ("times as", "serves", "Errors of σ", "nan", "None"):
        assert words not in text, (words, text)


@claim("the lines of threads on the terminal say how many, how long, or why not")
def _(_folder):
    line = script_module("beside_fem_threads_page").line
    assert " 2 " in line(row_of(threads=2)) and "1.000 s" in line(row_of()) and "20.0 MB" in line(row_of(threads=2))
    assert line(row_of(None).missing("too slow")).endswith("missing: too slow") and "missing: no time" in line(row_of(math.nan))


@claim("rows on two threads come back from their CSV as they were, and those of an older one are on one")
def _(folder):
    table = script_module("beside_fem_table")
    rows = [row_of(), row_of(threads=2), row_of(None, 2).missing("none"), row_of(threads=2).without_figures("no probes")]
    table.write_csv(folder / "rows.csv", rows)
    assert table.read_csv(folder / "rows.csv") == rows and rows[-1].threads == 2
    (folder / "old.csv").write_text("case,program,functions,solver,cells,whole_s\nlame,FEniCSx,Q2,mumps,8,1.5\n")
    assert [row.threads for row in table.read_csv(folder / "old.csv")] == [1]


# --- the script ----------------------------------------------------------------------------------------


@claim("the page on finite elements ends with the sections of the other studies, of those that are there")
def _(folder):
    study = script_module("beside_fem")
    options = type("Options", (), {"out": folder})
    assert study.with_sections(options, "page\n") == "page\n"
    (folder / "beside_fem_threads.md").write_text("threads\n")
    assert study.with_sections(options, "page\n") == "page\n\nthreads\n"
    (folder / "beside_fem_limits.md").write_text("limits\n")
    assert study.with_sections(options, "page\n") == "page\n\nlimits\n\nthreads\n"


@claim("without FEniCSx or mpirun the comparison on threads says so in one line, with status 2")
def _(folder):
    result = the_study(folder, "raise ImportError('none')\n")
    assert result.returncode == 2 and result.stderr.count("\n") == 1 and "there is no FEniCSx" in result.stderr, result
    result = the_study(folder, "", path=str(folder / "nowhere"))
    assert result.returncode == 2 and "there is no mpirun" in result.stderr and "install_packages fem" in result.stderr, result


@claim("a comparison on threads in which nothing has a solution still has its section, and status 1")
def _(folder):
    result = the_study(folder, "")
    assert result.returncode == 1 and "13 figures, 13 missing" in result.stdout, result
    text = (folder / "out/beside_fem_threads.md").read_text()
    assert text.count("missing: ") == 13 and "missing: it fails / here" in text, text
    rows = script_module("beside_fem_table").read_csv(folder / "out/beside_fem_threads.csv")
    assert [row.threads for row in rows].count(2) == 6 and not any(row.found for row in rows), rows
    assert not (folder / "out/runs").exists()


@claim("what is no option of the comparison on threads, and a program that is not there, are refused with status 2")
def _(folder):
    for words in ("--only slope", "--repeat 0", "--unknowns 5", "--unknowns nan"):
        assert the_study(folder, "", *words.split()).returncode == 2, words
    result = call(sys.executable, ROOT / "scripts/beside_fem_threads.py", "--program", folder / "nowhere")
    assert result.returncode == 2 and "there is no" in result.stderr, result


if __name__ == "__main__":
    check_the_claim()
