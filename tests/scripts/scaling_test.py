#!/usr/bin/python3
"""scaling_test.py ROOT CLAIM: one claim about scripts/scaling.py of the source tree ROOT."""

import csv
import json
import sys

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

# Stands for build/release/stillpoint: notes each call in the file `calls` beside it, takes 3 √n evaluations for
# n = 10⁴, 4·10⁴ and 16·10⁴ unknowns, and ends as the file `ends` there says of what it was called with.
PROGRAM = """#!/bin/bash
words="$*" scene=$2 here=$(dirname "$0")
[[ -s $scene ]] || exit 2
grep -q '^\\[damping\\]' "$scene" && words+=" with damping"
echo "$words" >>"$here/calls"
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"
case $words in
  *cells=?28,* | *cells=?8,*) n=10000 evaluations=300 ;;
  *cells=?88,* | *cells=?16,*) n=40000 evaluations=600 ;;
  *) n=160000 evaluations=1200 ;;
esac
status=equilibrium code=0
[[ ! -e $here/ends ]] || source "$here/ends"
printf '{"status": "%s", "reason": "too slow", "dofs": %s, "rhs_evaluations": %s}' $status $n $evaluations \\
  >"$2/summary.json"
exit $code
"""
WAYS = 6


def the_study(folder, *options, ends=""):
    """What comes of a study of three sizes, and the lines of its calls."""
    (folder / "program").write_text(PROGRAM)
    (folder / "program").chmod(0o755)
    (folder / "ends").write_text(ends)
    (folder / "calls").write_text("")
    result = call(
        *[sys.executable, ROOT / "scripts/scaling.py", "--quick", "--out", folder / "out"],
        *["--program", folder / "program", *options],
    )
    return result, (folder / "calls").read_text().splitlines()


def rows_of(folder):
    with open(folder / "out/scaling.csv", newline="") as table:
        return list(csv.DictReader(table))


@claim("an exact power law has its exponent, with an interval of no width")
def _(_folder):
    module = script_module("scaling_table")
    for power in (0.5, 1.5, -0.25, 0):
        sizes = (10**4, 10**5, 3 * 10**5, 10**6)
        rows = [module.Figure("it", "", n, "equilibrium", seconds=3e-6 * n**power) for n in sizes]
        exponent, low, high = module.exponent(rows, "seconds")
        assert all(abs(value - power) < 1e-9 for value in (exponent, low, high)), (exponent, low, high)
        assert module.exponent_text((exponent, low, high)) == f"{power:.2f} ({power:.2f} to {power:.2f})"
        assert module.exponent(rows[:2], "seconds")[1:] == (None, None)
        assert module.exponent(rows[:1], "seconds") is None


@claim("sizes of few unknowns, and those that are missing, have no part in an exponent")
def _(_folder):
    module = script_module("scaling_table")
    rows = [module.Figure("it", "", n, "equilibrium", evaluations=n // 100) for n in (10**4, 10**5, 10**6)]
    rows += [module.Figure("it", "", 1000, "equilibrium", evaluations=10**6), module.Figure("it", "", 10**7, "failed")]
    assert all(abs(value - 1) < 1e-9 for value in module.exponent(rows, "evaluations"))


@claim("two power laws cross where they are equal, and ways that never do have no crossing")
def _(_folder):
    module = script_module("scaling_table")
    sizes = (10**3, 10**4, 10**5, 10**6)
    laws = {"Newton, CHOLMOD": lambda n: 1e-6 * n**1.5, "steady": lambda n: 0.01 * n**0.5, "quick": lambda n: 1e-9 * n}
    rows = [module.Figure(way, "", n, "equilibrium", seconds=law(n)) for way, law in laws.items() for n in sizes]
    ((way, unknowns, seconds),) = module.overtaken(rows)
    assert way == "steady" and abs(unknowns / 1e4 - 1) < 1e-9 and abs(seconds - 1) < 1e-9, (way, unknowns, seconds)
    ((_, unknowns, _),) = module.overtaken([row for row in rows if row.unknowns != 10**4])
    assert abs(unknowns / 1e4 - 1) < 1e-9, unknowns
    assert module.overtaken([row for row in rows if row.way == "quick"]) == []


@claim("of noise around a power law the interval has the true exponent in it 95 times of 100")
def _(_folder):
    numpy, fitted_slope = script_module("numpy"), script_module("fitted_line").fitted_slope
    noise, sizes = numpy.random.default_rng(1), numpy.log([1e4, 1e5, 3e5, 6.4e5])
    inside, repetitions = 0, 4000
    for _repetition in range(repetitions):
        _, low, high = fitted_slope(sizes, 1.5 * sizes - 7 + 0.1 * noise.standard_normal(len(sizes)))
        inside += low < 1.5 < high
    assert abs(inside / repetitions - 0.95) < 0.01, inside  # three times its standard deviation


@claim("the peak memory of a run is its own, whatever the process that starts it holds")
def _(folder):
    held = bytearray(b"x") * 200_000_000
    for program, least, most in (("pass", 5, 50), ("x = bytearray(b'x')*100_000_000", 100, 150)):
        measuring = [sys.executable, "-I", "-S", ROOT / "scripts/measured_run.py", folder / "usage.json"]
        assert call(*measuring, sys.executable, "-I", "-S", "-c", program).returncode == 0
        took = json.loads((folder / "usage.json").read_text())
        assert least < took["megabytes"] < most and took["seconds"] > 0, (took, len(held))


@claim("a measured run ends as its command does, be it by a signal")
def _(folder):
    for words, status in ((["sh", "-c", "exit 3"], 3), (["sh", "-c", "kill -KILL $$"], -9), (["no-such-program"], 2)):
        result = call(sys.executable, ROOT / "scripts/measured_run.py", folder / "usage.json", *words)
        assert result.returncode == status, result


@claim("a scaling study has a row for each way and size, their exponents, and a picture")
def _(folder):
    result, calls = the_study(folder, "--repeat", 2)
    assert result.returncode == 0 and "18 figures, 0 missing" in result.stdout, result
    rows = rows_of(folder)
    assert [row["unknowns"] for row in rows[::WAYS]] == ["10000", "40000", "160000"] and len(rows) == 3 * WAYS
    assert all(float(row["seconds"]) > 0 and 1 < float(row["megabytes"]) < 100 for row in rows), rows
    table = (folder / "out/scaling.md").read_text()
    assert "| unknowns | 10 000 | 40 000 | 160 000 |" in table and table in result.stdout
    assert table.count("| 0.50 (0.50 to 0.50) |") == WAYS and str(folder) not in table, table
    assert (folder / "out/scaling.png").read_bytes().startswith(b"\x89PNG")
    assert len(calls) == 2 * 3 * WAYS and all("constants.nu=0.3" in words for words in calls)
    # Static solvers refuse [damping], and the other ways need it.
    assert all(("solve.method" in words) != ("with damping" in words) for words in calls), calls


@claim("with --space the study is of a body in space, whose cells have three numbers")
def _(folder):
    result, calls = the_study(folder, "--repeat", 1, "--space")
    assert result.returncode == 0 and "18 figures, 0 missing" in result.stdout, result
    assert [row["cells"] for row in rows_of(folder)[::WAYS]] == ["8x8x8", "16x16x16", "24x24x24"]
    assert all("square_load.toml" in words and "constants.nu" not in words for words in calls), calls


@claim("each repetition begins with another way")
def _(folder):
    _, calls = the_study(folder, "--repeat", 2)
    firsts = [words.partition("stop.residual=1e-6")[2].partition("grid.cells")[0] for words in calls[::WAYS]]
    assert len(set(firsts)) == 6, firsts


@claim("a run that does not end in equilibrium is missing, is not repeated, and makes the status 1")
def _(folder):
    for ends in ("status=step-limit code=3", "code=4", "exit 2", "kill -SEGV $$"):
        where = f"if [[ $words == *method=cg*cells=?88,* ]]; then {ends}; fi\n"
        result, calls = the_study(folder, "--repeat", 2, ends=where)
        assert result.returncode == 1 and "18 figures, 1 missing" in result.stdout, result
        (row,) = [row for row in rows_of(folder) if row["status"] != "equilibrium"]
        assert row["way"].startswith("CG") and row["cells"] == "88x70" and row["reason"] and not row["seconds"], row
        table = (folder / "out/scaling.md").read_text()
        assert table.count("missing") == 1 and table.count("| 0.50 (0.50 to 0.50) |") == WAYS - 1, table
        assert table.count("| 0.50 |") == 1, table  # two sizes are left
        assert len(calls) == 2 * 3 * WAYS - 1
    endless = "if [[ $words == *method=cg*cells=?88,* ]]; then while :; do :; done; fi\n"
    result, _ = the_study(folder, "--repeat", 1, "--seconds", 1, ends=endless)
    assert result.returncode == 1 and "no end within 1 s" in result.stdout, result
    result, _ = the_study(folder, "--repeat", 1, ends="exit 2\n")
    assert result.returncode == 1 and "18 figures, 18 missing" in result.stdout, result


@claim("a scaling study that is not there, or has no figures, is not drawn, with status 2")
def _(folder):
    script = ROOT / "scripts/plot_scaling.py"
    header = ",".join(script_module("scaling_table").COLUMNS)
    for text, words in ((None, "no scaling.csv"), (header + "\n", "no figures"), ("x\n1\n", "unexpected")):
        if text is not None:
            (folder / "scaling.csv").write_text(text)
        result = call(script, folder)
        assert result.returncode == 2 and words in result.stderr and not (folder / "scaling.png").exists(), result
        assert result.stderr.count("\n") == 1, result


@claim("scripts/scaling builds, measures and ends with its status")
def _(folder):
    scripts, environment = copy_of_scripts(folder, "#!/bin/bash\nexit 4\n")
    (scripts.parent / "problems").mkdir()
    (scripts.parent / "problems/incompressible.toml").write_text('title = "it"\n')
    result = call(scripts / "scaling", "--quick", cwd=folder, env=environment)
    assert result.returncode == 1 and (folder / "out/scaling/scaling.csv").exists(), result
    result = call(scripts / "scaling", "--program", "nowhere", cwd=folder, env=environment)
    assert result.returncode == 2 and "there is no nowhere" in result.stderr, result


@claim("processes and threads are compared on the same body and on larger ones, by the time of a point and step")
def _(folder):
    # Takes 30 ns alone, and 20 where two share the work.
    program = """#!/bin/bash
[[ " $* " == *" --threads 2 "* || ${OMPI_COMM_WORLD_SIZE:-1} == 2 ]] && ns=20 || ns=30
echo "$*" >>"$(dirname "$0")/calls"
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"
printf '{"status": "step-limit", "reason": "", "points": 1000, "ns_per_point_step": %s}' $ns >"$2/summary.json"
exit 3
"""
    (folder / "program").write_text(program)
    (folder / "program").chmod(0o755)
    arguments = ["--quick", "--repeat", 2, "--cores", 2, "--out", folder / "out", "--program", folder / "program"]
    result = call(sys.executable, ROOT / "scripts/scaling_ranks.py", *arguments)
    assert result.returncode == 0, result
    with open(folder / "out/ranks.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    assert [(row["kind"], row["ranks"], row["threads"]) for row in rows[:5]] == [
        ("strong", "1", "1"), ("strong", "1", "2"), ("strong", "2", "1"), ("weak", "1", "2"), ("weak", "2", "1")
    ], rows  # fmt: skip
    assert [float(row["efficiency"]) for row in rows] == 2 * [1, 0.75, 0.75, 0.75, 0.75], rows
    assert all(0 < float(row["megabytes"]) < 50 for row in rows), rows
    assert "| plane | weak | 2 | 1 | 1000 | 20.0 | 0.75 |" in (folder / "out/ranks.md").read_text()
    calls = (folder / "calls").read_text()
    assert calls.count("grid.cells=[120, 66]") == 2 * (1 + 1 + 2) and "grid.cells=[170, 93]" in calls, calls


@claim("a run of several processes that fails leaves its place in the table empty, and the status is 1")
def _(folder):
    (folder / "program").write_text("#!/bin/bash\necho no such key >&2\nexit 2\n")
    (folder / "program").chmod(0o755)
    arguments = ["--quick", "--repeat", 1, "--cores", 1, "--out", folder / "out", "--program", folder / "program"]
    result = call(sys.executable, ROOT / "scripts/scaling_ranks.py", *arguments)
    assert result.returncode == 1 and "no such key" in result.stderr and "2 rows, 2 missing" in result.stdout, result
    assert "| plane | strong | 1 | 1 |  |  |  |  |" in (folder / "out/ranks.md").read_text()


if __name__ == "__main__":
    check_the_claim()
