#!/usr/bin/python3
"""beside_fem_limits_test.py ROOT CLAIM: a claim about scripts/beside_fem_limits.py of the source tree ROOT, without FEniCSx."""

import json
import math
import os
import shlex
import sys
from dataclasses import replace

from claims import ROOT, call, check_the_claim, claim, script_module

np = script_module("numpy")
LIMIT = 2 + math.pi


def footing(functions="Q2-B", program="FEniCSx", cells=12, error=0.01, seconds=1.0, **more):
    table = script_module("beside_fem_limits_table")
    figures = {"unknowns": 2 * cells**2, "iterations": 50, "whole_s": seconds, "processor_s": seconds, "megabytes": 10.0}
    return table.Row("footing", program, functions, str(cells), reached=LIMIT * (1 + error), **figures | more)


def block(functions="Q2, stick", program="FEniCSx", cells=8, reached=0.95, **more):
    table = script_module("beside_fem_limits_table")
    figures = {"unknowns": 2 * cells**2, "iterations": 50, "whole_s": 1.0, "processor_s": 1.0, "megabytes": 10.0}
    return table.Row("block", program, functions, str(cells), reached=reached, **figures | more)


def straight(row, slope=2.0):
    """The path load = slope · way of a row."""
    ways = np.linspace(0, row.reached, 20)
    return script_module("beside_fem_limits_table").path_of(row, zip(ways.tolist(), (slope * ways).tolist()))


def the_study(folder, program="#!/bin/bash\nexit 4\n", finite_elements="", *options):
    """What comes of --quick with this program, and with this module in the place of FEniCSx."""
    (folder / "program").write_text(program)
    (folder / "program").chmod(0o755)
    (folder / "dolfinx.py").write_text(finite_elements)
    words = ["--quick", "--out", folder / "out", "--program", folder / "program", *options]
    return call(sys.executable, ROOT / "scripts/beside_fem_limits.py", *words, env=os.environ | {"PYTHONPATH": str(folder)})


# --- von Mises' law ------------------------------------------------------------------------------------


def tensor(deviators):
    xx, yy, xy = deviators
    return np.array([[xx, xy, 0 * xx], [xy, yy, 0 * xx], [0 * xx, 0 * xx, -(xx + yy)]])


@claim("deviators by their components in the plane contract as tensors do, and those of a strain have no trace")
def _(_folder):
    law = script_module("von_mises")
    one, other = np.random.default_rng(1).normal(size=(2, 3))
    assert abs(law.contracted(one, other) - np.sum(tensor(one) * tensor(other))) < 1e-14
    strain = np.array([[one[0], one[2], 0], [one[2], one[1], 0], [0, 0, 0]])
    assert np.allclose(tensor(law.deviator(*one)), strain - np.trace(strain) / 3 * np.eye(3), rtol=0, atol=1e-15)


@claim("the return of a trial stress lies on the yield surface, in the trial's direction, and what is inside stays as it is")
def _(_folder):
    law, c = script_module("von_mises"), 3.0
    trial = np.random.default_rng(2).normal(scale=4.0, size=(3, 500))
    kept = law.share_kept(*trial, c)
    size = np.sqrt(0.5 * (tensor(trial) ** 2).sum(axis=(0, 1)))  # √J₂
    outside = size > c
    assert 50 < outside.sum() < 490, outside.sum()
    assert np.allclose(kept[outside] * size[outside], c, rtol=1e-14, atol=0)
    assert (kept[~outside] == 1).all() and (kept > 0).all()
    assert law.share_kept(0.0, 0.0, 0.0, c) == 1  # a point without stress divides by no zero
    assert abs(law.share_kept(0.0, 0.0, 2 * c, c) - 0.5) < 1e-15  # c is the strength in shear


# --- rows and paths ------------------------------------------------------------------------------------


@claim("rows of limits and the paths of their runs come back from their CSV as they were, with those that are missing")
def _(folder):
    table = script_module("beside_fem_limits_table")
    rows = [footing(), block(ended="no balance, it says", least_det=0.2, passes=0.4), replace(footing(), reached=None).missing("none")]
    paths = straight(rows[0]) + straight(rows[1])
    table.write_csv(folder, rows, paths)
    assert table.read_csv(folder) == (rows, paths)


@claim("a load is read between the places of a run's own path, and nowhere beyond its end")
def _(_folder):
    table = script_module("beside_fem_limits_table")
    one, other = block(reached=0.6), block("linear", "Stillpoint")
    paths = straight(one, 2.0) + straight(other, 3.0)
    assert abs(table.load_at(one, paths, 0.31) - 0.62) < 1e-12 and abs(table.load_at(other, paths, 0.7) - 2.1) < 1e-12
    assert table.load_at(one, paths, 0.7) is None and table.load_at(block(cells=64), paths, 0.1) is None


@claim("a way settles within an error from the size on from which all finer ones are within it as well")
def _(_folder):
    table = script_module("beside_fem_limits_table")
    crossing = [footing(cells=n, error=error) for n, error in ((6, 0.02), (12, 0.001), (24, -0.006), (48, -0.0065))]
    assert table.settled(crossing, 0.01) is crossing[1] and table.settled(crossing, 0.003) is None
    falling = [footing("Q1-1", cells=n, error=error, seconds=n) for n, error in ((12, 0.008), (24, 0.002), (48, 0.0009))]
    assert table.settled(falling, 0.003) is falling[1] and table.settled(falling, 1e-4) is None
    assert table.time_within(falling, 0.0085) == 12 and table.time_within(falling, 1e-4) is None
    halfway = math.sqrt(0.008 * 0.002)  # straight on logarithmic axes
    assert abs(table.time_within(falling, halfway) / math.sqrt(12 * 24) - 1) < 1e-9
    assert table.quickest(crossing + falling, 0.01)[1] == "Q2-B" and table.quickest(crossing + falling, 0.003)[1] == "Q1-1"
    assert table.quickest([], 0.01) is None


@claim("forces are compared with the finest elements whose sides stick, of those that came furthest")
def _(_folder):
    reference = script_module("beside_fem_limits_table").reference
    coarse, fine = block(), block(cells=16)
    assert reference([coarse, fine, block("Q2, free", cells=32), block("linear", "Stillpoint", 64)], []) is fine
    assert reference([coarse, block(cells=32, reached=0.4)], []) is coarse
    assert reference([block("Q2, free")], []) is None


# --- runs ----------------------------------------------------------------------------------------------

HISTORY = "t,plate.normal\n0,0\n40,0.4\n80,0.8\n"
FAILS = """#!/bin/bash
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"; printf {history} >"$2/history.csv"; echo {summary} >"$2/summary.json"; exit {status}
"""


def our_row(folder, status, history=HISTORY):
    """The row and the path of a block, of a program that leaves this."""
    runs = script_module("beside_fem_limits_runs")
    summary = json.dumps({"dofs": 100, "rhs_evaluations": 10, "reason": f"{ROOT.resolve()}/a.toml:1:1: it folds" if status else ""})
    words = {"history": shlex.quote(history), "summary": shlex.quote(summary), "status": status}
    (folder / "program").write_text(FAILS.format(**words))
    (folder / "program").chmod(0o755)
    (way,) = [way for way in runs.WAYS if way.problem == "block" and way.functions == "quadratic"]
    return runs.our_run(folder / "program", way, 8, folder, 60)


@claim("a run of the block that ends early counts as far as it came, with its reason, and one that comes nowhere is missing")
def _(folder):
    row, path = our_row(folder, 4)
    assert row.found and abs(row.reached - 0.475) < 1e-12 and row.ended == "a.toml:1:1: it folds", row
    assert path == [[0, 0], [0.2375, 0.4], [0.475, 0.8]] and row.whole_s > 0 and row.unknowns is None, (row, path)
    assert "grid.cells=[32,8]" in row.command and "pressed_block.toml" in row.command
    assert our_row(folder, 0)[0].ended == ""
    row, path = our_row(folder, 4, "t,plate.normal\n")
    assert not row.found and row.reason == "a.toml:1:1: it folds" and path == [], row


@claim("of what finite elements leave the end of the path is read, and where they came through a plate")
def _(_folder):
    runs, table = script_module("beside_fem_limits_runs"), script_module("beside_fem_limits_table")
    figures = {"unknowns": 7, "iterations": 9, "whole_s": 2.0, "processor_s": 1.5, "megabytes": 3.0}
    empty = table.Row("block", "FEniCSx", "Q2, free", "8")
    places = [[0.1, 0.2, 0.9, 0.0], [0.2, 0.5, 0.8, 0.01], [0.3, 0.9, 0.7, 0.02]]
    row, path = runs.with_figures(empty, figures | {"path": places, "ended": "no balance"})
    assert (row.reached, row.least_det, row.passes, row.ended) == (0.3, 0.7, 0.2, "no balance") and path[1] == [0.2, 0.5], row
    row, path = runs.with_figures(empty, figures | {"path": [], "ended": "no balance"})
    assert not row.found and row.reason == "no balance" and path == []
    row, _ = runs.with_figures(replace(empty, problem="footing"), figures | {"path": [[0, 0], [1, 5.2]], "factor": 5.2})
    assert row.reached == 5.2 and abs(row.error - (5.2 / LIMIT - 1)) < 1e-15


@claim("the programs are compared at equal unknowns: elements of second order have cells twice as large")
def _(_folder):
    runs = script_module("beside_fem_limits_runs")
    for way in runs.ways_of("footing", False):
        order = int(way.functions[1]) if way.program == runs.FEM else 1
        assert all(order * way.cells(size) == size for size in runs.sizes_of("footing", False)), way


# --- the page ------------------------------------------------------------------------------------------


@claim("the sections on limits have every figure, its command and its error, and say what is missing")
def _(_folder):
    sections = script_module("beside_fem_limits_page").sections
    rows = [
        footing(error=0.0125, command="the command of Q2-B"),
        footing("linear, 1 point", "Stillpoint", error=0.002, seconds=0.5),
        replace(footing("Q1-1"), reached=None).missing("a | of Newton's"),
        block(),
        block("Q2, free", reached=0.384, ended="no balance", passes=0.33, least_det=0.25),
        block("quadratic", "Stillpoint", reached=0.9, unknowns=None, ended="at t = 1: a.toml:3:1: folded; expected more"),
    ]
    paths = straight(rows[3], 2.0) + straight(rows[4], 1.9) + straight(rows[5], 2.02)
    text = sections(rows, paths)
    for heading in ("## A strip footing's limit load\n", "## Where finite elements end\n"):
        assert text.count(heading) == 1, text
    for words in ("+1.25 %", "+0.20 %", "missing: a / of Newton's", "the command of Q2-B", "0.50 s, linear, 1 point",
                  "| FEniCSx Q2, free | 8 | 38.4 %: no balance | 33 % | 0.25 | -5.0 % | -5.0 % |  |", "| 90.0 %: folded |",
                  "95 %, as far as was asked", "+1.0 %", "38 % on 8 cells a side", "those of FEniCSx Q2, stick, 8 cells"):  # fmt: skip
        assert words in text, (words, text)
    only = sections(rows[:3], [])
    assert "Where finite elements end" not in only and "strip footing" in only
    assert all(line.count("|") == text_of.count("|") for text_of, line in zip(table_of(text), table_of(text)[1:])), text


def table_of(text):
    """The lines of the last table."""
    return [line for line in text.split("\n\n")[-3].splitlines() if line.startswith("|")]


@claim("the lines of limits on the terminal say how far off, how far, or why not")
def _(_folder):
    line = script_module("beside_fem_limits_page").line
    assert "(+1.00 %)" in line(footing()) and "to 38.4 %" in line(block(reached=0.384, ended="no balance"))
    assert "no balance" in line(block(ended="no balance")) and "missing: none" in line(replace(block(), reached=None).missing("none"))


# --- the script ----------------------------------------------------------------------------------------


@claim("without FEniCSx the comparison of limits says so in one line, with status 2")
def _(folder):
    result = the_study(folder, finite_elements="raise ImportError('none')\n")
    assert result.returncode == 2 and result.stderr.count("\n") == 1, result
    assert "there is no FEniCSx" in result.stderr and "install_packages fem" in result.stderr, result


@claim("a comparison of limits in which nothing comes anywhere still has its sections, and status 1")
def _(folder):
    result = the_study(folder)
    assert result.returncode == 1 and "7 figures, 7 missing" in result.stdout, result
    assert (folder / "out/beside_fem_limits.md").read_text().count("missing: ") == 7
    rows, paths = script_module("beside_fem_limits_table").read_csv(folder / "out")
    assert all(row.reason and not row.found for row in rows) and paths == [], rows
    drawn = call(ROOT / "scripts/plot_beside_fem_limits.py", folder / "out")
    assert drawn.returncode == 2 and "no figures" in drawn.stderr, drawn


@claim("what is no option of the comparison of limits, and a program that is not there, are refused with status 2")
def _(folder):
    for words in ("--only slope", "--repeat 0"):
        assert the_study(folder, "", "", *words.split()).returncode == 2, words
    result = call(sys.executable, ROOT / "scripts/beside_fem_limits.py", "--program", folder / "nowhere")
    assert result.returncode == 2 and "there is no" in result.stderr, result


@claim("the pictures of limits are drawn from their tables")
def _(folder):
    table = script_module("beside_fem_limits_table")
    rows = [footing(), footing(cells=24, error=0.005), block(), block("Q2, free", reached=0.4, ended="no balance")]
    table.write_csv(folder, rows, [place for row in rows for place in straight(row)])
    drawn = call(ROOT / "scripts/plot_beside_fem_limits.py", folder)
    assert drawn.returncode == 0, drawn
    for problem in ("footing", "block"):
        assert (folder / f"beside_fem/{problem}.png").stat().st_size > 10000


if __name__ == "__main__":
    check_the_claim()
