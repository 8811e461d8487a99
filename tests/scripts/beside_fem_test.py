#!/usr/bin/python3
"""beside_fem_test.py ROOT CLAIM: one claim about scripts/beside_fem.py of the source tree ROOT, without FEniCSx."""

import csv
import json
import math
import os
import sys
import tomllib
from dataclasses import replace

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

np = script_module("numpy")
PLANE, SPACE = "lame", "cube"
SIZES = (10**3, 10**4, 10**5)


def row_of(functions="Q2", program="FEniCSx", solver="direct", case=PLANE, unknowns=1000, error=1e-2, seconds=1.0, **more):
    errors = {"u_l2": error**1.5, "raw_l2": error, "raw_max": 3 * error, "recovered_l2": 2 * error, "recovered_max": 6 * error}
    table = script_module("beside_fem_table")
    times = {"whole_s": seconds, "processor_s": seconds, "solution_s": seconds / 2, "recovery_s": 0.25}
    figures = errors | times | {"megabytes": 10.0} | more
    return table.Row(case, program, functions, solver, str(unknowns), unknowns, 3, **figures)


def series(functions, program, factor, case=PLANE, power=1.0, solver="direct", pace=1e-5):
    """Rows with errors factor · n^-power in as many seconds as pace · n."""
    return [row_of(functions, program, solver, case, n, factor * n**-power, pace * n) for n in SIZES]


def beside(factor, case=PLANE, pace=1e-5, solver="direct"):
    """Quadratic functions whose errors are those of Q2 times a factor."""
    return series("Q2", "FEniCSx", 1.0, case) + series("quadratic", "Stillpoint", factor, case, pace=pace, solver=solver)


def the_study(folder, program="#!/bin/bash\nexit 4\n", finite_elements="", *options):
    """What comes of --quick with this program, and with this module in the place of FEniCSx."""
    (folder / "program").write_text(program)
    (folder / "program").chmod(0o755)
    (folder / "dolfinx.py").write_text(finite_elements)
    environment = os.environ | {"PYTHONPATH": str(folder)}
    words = ["--quick", "--out", folder / "out", "--program", folder / "program", *options]
    return call(sys.executable, ROOT / "scripts/beside_fem.py", *words, env=environment)


# --- the quick form ------------------------------------------------------------------------------------


@claim("the quick form says which error is larger beside finite elements than it has to be, and takes NaN for such a one")
def _(_folder):
    study = script_module("beside_fem")
    errors = {name: {"ratio": limit} for name, limit in study.QUICK_LIMITS.items()}
    assert study.beyond(study.QUICK_LIMITS, errors) == []
    for name, limit in study.QUICK_LIMITS.items():
        for ratio in (1.01 * limit, math.nan):
            said = study.beyond(study.QUICK_LIMITS, errors | {name: {"ratio": ratio}})
            assert len(said) == 1 and said[0].startswith(name) and said[0].endswith(f"expected at most {limit}"), said


# --- curves --------------------------------------------------------------------------------------------


@claim("errors that fall by a power of the unknowns have its order in h, twice the power in the plane and thrice in space")
def _(_folder):
    table = script_module("beside_fem_table")
    for dim in (2, 3):
        order, low, high = table.order(series("Q2", "FEniCSx", 3.0, power=1.25), dim, "raw_l2")
        assert all(abs(value - 1.25 * dim) < 1e-9 for value in (order, low, high)), (order, low, high)
    assert table.order([row_of()], 2, "raw_l2") is None


@claim("two curves of errors cross where they are equal, and nowhere if one is always below")
def _(_folder):
    table = script_module("beside_fem_table")
    one, other = series("Q2", "FEniCSx", 1.0), series("quadratic", "Stillpoint", 200.0, power=1.5)
    ((x, y),) = table.crossings(*(table.curve(rows, "unknowns", "raw_l2") for rows in (one, other)))
    assert abs(x / 4e4 - 1) < 1e-9 and abs(y / 2.5e-5 - 1) < 1e-9, (x, y)
    half = [replace(row, raw_l2=row.raw_l2 / 2) for row in one]
    assert table.crossings(*(table.curve(rows, "unknowns", "raw_l2") for rows in (one, half))) == []


@claim("two curves are compared at the largest size of both, and not where one has no size")
def _(_folder):
    table = script_module("beside_fem_table")
    short, long = (table.curve(rows, "unknowns", "raw_l2") for rows in (beside(0.25)[:2], beside(0.25)[3:]))
    x, ratio = table.ratio_at_end(long, short)
    assert abs(x - 1e4) < 1e-6 and abs(ratio - 0.25) < 1e-9, (x, ratio)
    assert table.ratio_at_end(long, table.curve([], "unknowns", "raw_l2")) is None
    assert table.ratio_at_end(long, table.Curve((10.0, 100.0), (1.0, 1.0))) is None


@claim("the time to an error lies between two sizes, is that of the smallest if it is as good, and none if no size is")
def _(_folder):
    table = script_module("beside_fem_table")
    rows = series("Q2", "FEniCSx", 1.0)  # errors 1e-3, 1e-4, 1e-5 in 0.01, 0.1 and 1 s
    assert abs(table.time_to(rows, 2e-4, "raw_l2") / 0.05 - 1) < 1e-9, table.time_to(rows, 2e-4, "raw_l2")
    assert table.time_to(rows, 1e-2, "raw_l2") == rows[0].whole_s
    assert table.time_to(rows, 1e-6, "raw_l2") is None
    slow = series("Q1", "FEniCSx", 1.0, pace=1e-3)
    assert table.best_time_to(slow + rows, 2e-4, "raw_l2")[1] == "FEniCSx Q2, direct"
    assert table.best_time_to(slow + rows, 1e-6, "raw_l2") is None


@claim("the time of the projection counts where the projected stress is the better one, and only there")
def _(_folder):
    table = script_module("beside_fem_table")
    row = row_of()
    assert row.stress_l2 == row.raw_l2 and table.seconds_for(row, "stress_l2") == row.whole_s
    better = replace(row, recovered_l2=row.raw_l2 / 2)
    assert better.stress_l2 == better.recovered_l2 and table.seconds_for(better, "stress_l2") == row.whole_s + 0.25
    assert table.seconds_for(row, "recovered_l2") == row.whole_s + 0.25
    assert table.seconds_for(row, "raw_l2") == table.seconds_for(better, "u_l2") == row.whole_s


@claim("where no recovered stress is read, the functions' own counts, and its curve ends")
def _(_folder):
    table = script_module("beside_fem_table")
    rows = series("quadratic", "Stillpoint", 1.0)
    rows[-1] = replace(rows[-1], recovered_l2=None, recovered_max=None)
    assert rows[-1].stress_l2 == rows[-1].raw_l2 and rows[-1].stress_max == rows[-1].raw_max
    assert table.curve(rows, "unknowns", "recovered_l2").x == SIZES[:2] and len(table.curve(rows, "unknowns", "stress_l2").x) == 3
    assert table.seconds_for(rows[-1], "stress_l2") == rows[-1].whole_s
    assert abs(table.order(rows, 2, "recovered_l2")[0] - 2) < 1e-9 and table.time_to(rows, 1e-5, "recovered_l2") is None


@claim("rows come back from their CSV as they were, with those that are missing")
def _(folder):
    table = script_module("beside_fem_table")
    rows = [row_of(recovery_s=None), row_of().missing("too slow, it says"), table.Row("lame", "FEniCSx", "P1", "gamg", "4", reason="no")]
    table.write_csv(folder / "rows.csv", rows)
    assert table.read_csv(folder / "rows.csv") == rows


# --- runs ----------------------------------------------------------------------------------------------


@claim("meshes and grids have about as many unknowns as are asked for")
def _(_folder):
    runs, cases = script_module("beside_fem_runs"), script_module("beside_fem_cases")
    for case in cases.CASES.values():
        for way in runs.ways_of(case):
            asked = 6e4
            first = runs.first_cells(case, way, asked)
            if "-" in way.functions:
                continue  # of a pressure as well
            if way.program == runs.FEM:
                nodes = case.blocks * np.prod([int(way.functions[1]) * round(first * share) + 1 for share in case.aspect])
            else:
                nodes = case.filled * np.prod([first * share / case.grid[0] + 1 for share in case.grid])
            assert 0.7 < case.dim * nodes / asked < 1.4, (case.name, way, first, case.dim * nodes)


@claim("what probes read comes back as displacement, gradient and stress of each place")
def _(_folder):
    runs = script_module("beside_fem_runs")
    for case in (script_module("beside_fem_plane").RING, script_module("beside_fem_space").CUBE):
        x = case.place(case.parameters(7))
        tables = tomllib.loads(runs.probes(case, x))["probe"]
        exact = {"u": case.u(x), "strain": case.gradient(x), "stress": case.stress(x)}

        def value(k, name, exact=exact):
            field, _, letters = name.partition(".")
            return float(exact[field][(k, *("xyz".index(letter) for letter in letters))])

        read = [{name: value(k, name) for name in table["fields"]} for k, table in enumerate(tables)]
        summary = {"probes": {table["name"]: values for table, values in zip(tables, read)}}
        found = runs.read_probes(case, summary, len(x))
        assert [table["at"] for table in tables] == x.tolist()
        assert all(np.array_equal(one, other) for one, other in zip(found, exact.values())), case.name


@claim("errors are relative in L2, and the largest over the largest exact value; a place that is not read has none")
def _(_folder):
    relative = script_module("beside_fem_errors").relative
    exact = np.array([[3.0, 4.0], [0.0, 5.0], [0.0, 0.0]])
    assert relative(exact, exact) == (0, 0)
    l2, largest = relative(exact + [[0, 0], [0.3, 0.4], [0, 0]], exact)
    assert abs(l2 - 0.5 / math.sqrt(50)) < 1e-15 and abs(largest - 0.1) < 1e-15, (l2, largest)
    assert math.isnan(relative(exact + [[math.nan, 0], [0, 0], [0, 0]], exact)[0])


# --- verdicts ------------------------------------------------------------------------------------------


@claim("the claim on stress holds where ours is the worse at equal unknowns, and its verdict says where")
def _(_folder):
    judged = script_module("beside_fem_verdict").judged

    def verdict(rows):
        return judged(rows)["claims"]["less accurate"]["verdict"]

    assert verdict(beside(2.0)) == "holds in the one comparison"
    assert verdict(beside(0.5)) == "does not hold in the one comparison"
    assert verdict(beside(0.5) + beside(0.5, SPACE)) == "does not hold in any of 2 comparisons"
    assert verdict(beside(2.0) + beside(2.0, SPACE)) == "holds in all 2 comparisons"
    mixed = verdict(beside(2.0) + beside(0.5, SPACE))
    assert mixed == "holds in lame (quadratic/Q2); does not in cube (quadratic/Q2)", mixed
    assert verdict(series("Q2", "FEniCSx", 1.0)) == "not measured"
    poorly_read = [replace(row, recovered_l2=9 * row.recovered_l2) if row.program == "Stillpoint" else row for row in beside(0.5)]
    claims = judged(poorly_read)["claims"]
    assert claims["less accurate"]["verdict"].startswith("does not hold"), claims
    assert claims["less accurate where probes read"]["verdict"].startswith("holds"), claims


@claim("errors are compared at all sizes that any solver has, whichever solver ends first")
def _(_folder):
    errors_beside = script_module("beside_fem_verdict").errors_beside
    newton = [replace(row, solver="newton") for row in series("quadratic", "Stillpoint", 0.5)]
    failed = newton[1].without_figures("too large")
    auto = series("quadratic", "Stillpoint", 0.5, solver="auto")
    found = errors_beside(series("Q2", "FEniCSx", 1.0) + [newton[0], replace(failed, cells=auto[1].cells)] + auto)
    assert found["quadratic/Q2 raw_l2"]["unknowns"] == SIZES[-1], found


@claim("the claim on time is judged at equal errors, not at equal unknowns")
def _(_folder):
    judged = script_module("beside_fem_verdict").judged
    slow_but_exact = judged([replace(row, raw_l2=20 * row.raw_l2, recovered_l2=40 * row.recovered_l2)
                             for row in beside(0.01, pace=2e-5)])  # fmt: skip
    ratios = slow_but_exact["claims"]["more time"]["ratios"]["lame"]
    assert ratios["0.001"] < 1, ratios
    assert judged(beside(1.0, pace=1e-3))["claims"]["more time"]["verdict"].startswith("holds in all")


@claim("the claim on a diagonal mass compares the space with the plane, by ways with such a mass alone")
def _(_folder):
    judged = script_module("beside_fem_verdict").judged

    def verdict(plane, space, solver="auto, lumped mass"):
        rows = beside(1.0, PLANE, plane, solver) + beside(1.0, SPACE, space, solver)
        return judged(rows)["claims"]["competitive in space"]["verdict"]

    assert verdict(5e-5, 2e-5) == "holds in the one comparison"
    assert verdict(2e-5, 5e-5) == "does not hold in the one comparison"
    assert verdict(5e-5, 2e-5, "newton") == "not measured"


@claim("where elements lock, ours is set beside those with a pressure, and not beside the locked ones")
def _(_folder):
    judged = script_module("beside_fem_verdict").judged
    ratios = judged(beside(2.0) + series("Q2-Q1", "FEniCSx", 0.5))["claims"]["less accurate"]["ratios"]["lame"]
    assert list(ratios) == ["quadratic/Q2-Q1"] and abs(ratios["quadratic/Q2-Q1"] - 4) < 1e-9, ratios


@claim("the page has every figure, its command, the ratios and the verdicts, and says what is missing")
def _(_folder):
    page, judged = script_module("beside_fem_page").page, script_module("beside_fem_verdict").judged
    rows = [replace(row, command=f"the command of {row.functions}") for row in beside(0.5)]
    rows[-1] = replace(row_of("quadratic", "Stillpoint", unknowns=None, whole_s=None), reason="too slow")
    text = page(rows, judged(rows), "On this machine.")
    assert text.count("| FEniCSx Q2, direct |") == 3 and text.count("| Stillpoint quadratic, direct |") == 3, text
    assert "missing: too slow" in text and "On this machine." in text and "does not hold in the one comparison" in text, text
    assert "the command of Q2" in text and "the command of quadratic" in text, text
    assert "| quadratic/Q2 raw_l2 | 10 000 | 0.5 | none |" in text, text


# --- the script ----------------------------------------------------------------------------------------


@claim("without FEniCSx the comparison says so in one line, with status 2")
def _(folder):
    result = the_study(folder, finite_elements="raise ImportError('none')\n")
    assert result.returncode == 2 and result.stderr.count("\n") == 1, result
    assert "there is no FEniCSx" in result.stderr and "install_packages fem" in result.stderr, result


@claim("a comparison in which nothing has a solution still has a page, and status 1")
def _(folder):
    result = the_study(folder)
    assert result.returncode == 1 and "6 figures, 6 missing" in result.stdout, result
    with open(folder / "out/beside_fem.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert all(row["reason"] and not row["whole_s"] for row in rows), rows
    assert (folder / "out/beside_fem.md").read_text().count("missing: ") == 6
    assert json.loads((folder / "out/beside_fem.json").read_text())["claims"]["more time"]["verdict"] == "not measured"


@claim("what an earlier run measured is kept if that is asked for, and a file of another program refused with status 2")
def _(folder):
    assert the_study(folder).returncode == 1
    called = folder / "called"
    kept = the_study(folder, f"#!/bin/bash\ntouch '{called}'\nexit 4\n", "", "--keep")
    assert "6 figures, 6 missing" in kept.stdout and not called.exists(), kept
    (folder / "out/beside_fem.csv").write_text("one,two\n1,2\n")
    refused = the_study(folder, "", "", "--keep")
    assert refused.returncode == 2 and "is not of this program" in refused.stderr, refused


@claim("scripts/beside_fem installs, builds, measures and ends with its status")
def _(folder):
    scripts, environment = copy_of_scripts(folder, "#!/bin/bash\nexit 4\n")
    (scripts / "install_packages").write_text('#!/bin/bash\necho "$*" >"$CALLS"\n')
    (folder / "dolfinx.py").write_text("")
    result = call(scripts / "beside_fem", "--quick", cwd=folder, env=environment | {"PYTHONPATH": str(folder)})
    assert result.returncode == 1 and (folder / "out/beside_fem/beside_fem.md").exists(), result
    assert (folder / "calls").read_text() == "run fem\n"


@claim("options that do not go together, and a program that is not there, are refused with status 2")
def _(folder):
    refused = {"--only lame": "leave out --only", "--accept": "--accept is of all cases", "--repeat 0": "1 or more"}
    for words, message in refused.items():
        result = the_study(folder, "", "", *words.split())
        assert result.returncode == 2 and message in result.stderr, result
    result = call(sys.executable, ROOT / "scripts/beside_fem.py", "--program", folder / "nowhere")
    assert result.returncode == 2 and "there is no" in result.stderr, result


if __name__ == "__main__":
    check_the_claim()
