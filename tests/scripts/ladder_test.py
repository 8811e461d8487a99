#!/usr/bin/python3
"""ladder_test.py ROOT CLAIM: one claim about scripts/ladder.py of the source tree ROOT."""

import csv
import math
import sys
import tomllib

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

# Stands for build/release/stillpoint: a scene says in the shell's words, which TOML takes for a comment, how it ends.
PROGRAM = """#!/bin/bash
scene=$2
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"
summary() {
  printf '{"status": "%s", "reason": "%s", "rhs_evaluations": 9, "error": {"u_rel_l2": %s}, "probes": {%s}, ' "$@"
  printf '"probe_places": {"end": [0.5]}}'
}
study() {
  printf '{"levels": [{"evaluations": 3}], "orders": {"u_l2": '
  printf '{"order": %s, "low": %s, "high": %s, "theory": %s}}}' "$@"
}
run=$2/summary.json converge=$2/converge.json safety=$2/safety.json
sed -n 's/^#! //p' "$scene" >"$2/words"
source "$2/words"
"""
RIGHT = """#! summary equilibrium "" 1e-5 '"end": {"u": 1.0001}' >"$run"\n[constants]\na = 2.0\nb = "a/2"\n"""
VALUE = 'name = "end"\nread = "end.u"\nexact = 1.0\ntarget = 1e-3\n'
ORDER = 'name = "u"\nread = "order.u_l2"\ntarget = 1.9\n'
COLUMNS = "case,quantity,exact,computed,error,order,target,ok,wall_s,low,high,evaluations,known_miss,reason,remark"


def the_ladder(folder, scene, quantity=VALUE, keys="", options=()):
    """What comes of a ladder of one row."""
    (folder / "program").write_text(PROGRAM)
    (folder / "program").chmod(0o755)
    (folder / "scene.toml").write_text(scene)
    case = f'[[case]]\nname = "it"\nabout = "A row."\nsource = "none"\nscene = "scene.toml"\nseconds = 1\n{keys}'
    (folder / "ladder.toml").write_text(f"{case}[[case.quantity]]\n{quantity}")
    return call(
        *[sys.executable, ROOT / "scripts/ladder.py", "--out", folder / "out", "--cases", folder / "ladder.toml"],
        *["--program", folder / "program", *options],
    )


def row_of(folder):
    with open(folder / "out/ladder.csv", newline="") as table:
        (row,) = csv.DictReader(table)
    return row


def is_miss(folder, words, *arguments, **keywords):
    """The ladder ends with status 1, and its row is a MISS for a reason with these words."""
    result = the_ladder(folder, *arguments, **keywords)
    row = row_of(folder)
    assert result.returncode == 1 and row["ok"] == "MISS" and words in row["reason"], (result, row)
    assert words in result.stdout and "1 wrong" in result.stdout, result
    return row


def passes(folder, *arguments, **keywords):
    result = the_ladder(folder, *arguments, **keywords)
    assert result.returncode == 0 and "0 wrong" in result.stdout, result
    return row_of(folder)


def study(order, low, high, theory, after=""):
    return f'#! study {order} {low} {high} {theory} >"$converge"{after}\n'


@claim("a row that meets its target is ok, and the ladder is written and drawn")
def _(folder):
    row = passes(folder, RIGHT)
    assert ",".join(row) == COLUMNS
    assert row["ok"] == "ok" and float(row["exact"]) == 1 and float(row["computed"]) == 1.0001
    assert abs(float(row["error"]) - 1e-4) < 1e-12 and row["evaluations"] == "9" and float(row["wall_s"]) > 0
    assert (folder / "out/ladder.png").read_bytes().startswith(b"\x89PNG")


@claim("an exact answer that is off by 1 % makes its row a MISS, with the command that reproduces it")
def _(folder):
    for off in ("1.01", "0.99"):
        is_miss(folder, "above 0.001", RIGHT, VALUE.replace("exact = 1.0", f"exact = {off}"))
    result = the_ladder(folder, RIGHT, VALUE.replace("exact = 1.0", 'exact = "1.01*b"'))
    assert f"run {folder / 'scene.toml'}" in result.stdout, result


@claim("an answer may be a formula of the scene's constants as they were set, and of the probe's position")
def _(folder):
    passes(folder, RIGHT, VALUE.replace("exact = 1.0", 'exact = "b*cos(0) + 2*x - a/2"'))
    passes(folder, RIGHT, VALUE.replace("exact = 1.0", 'exact = "b/3"'), keys='set = ["constants.a=6"]\n')
    is_miss(folder, "nowhere", RIGHT, VALUE.replace("exact = 1.0", 'exact = "nowhere"'))


@claim("a quantity that is missing, null or no number is a MISS")
def _(folder):
    is_miss(folder, "KeyError", RIGHT, VALUE.replace("end.u", "top.u"))
    for number in ("null", "NaN", "Infinity"):
        is_miss(folder, "end.u is", RIGHT.replace("1.0001", number))
        is_miss(folder, "end.u is", RIGHT.replace("1.0001", number), VALUE.replace("1e-3", "[-inf, inf]"))
    is_miss(folder, "", RIGHT, VALUE.replace("exact = 1.0", "exact = nan"))
    is_miss(folder, "", RIGHT, VALUE.replace("1e-3", "nan"))


@claim("a run that failed makes its rows a MISS with the run's reason, whatever figures it left")
def _(folder):
    for status in (2, 3, 4):
        failure = RIGHT.replace('equilibrium ""', 'failed "point 3 left"').replace('"$run"', f'"$run"; exit {status}')
        is_miss(folder, "point 3 left", failure)
    is_miss(folder, "exit status 4", "#! exit 4\n")
    is_miss(folder, "exit status -11", "#! kill -SEGV $$\n")
    is_miss(folder, "no end within 1 s", "#! while :; do :; done\n")
    refine = 'refine = "h"\n'
    is_miss(folder, "exit status 3", study(2, 1.9, 2.1, 2, "; exit 3"), ORDER, refine)
    is_miss(folder, "exit status 0", "#! true\n", ORDER, refine)


@claim("an order is ok if it is at least the target and its interval has the theory's order in it, or nearly")
def _(folder):
    refine = 'refine = "h"\n'
    row = passes(folder, study(1.98, 1.9, 2.1, 2), ORDER, refine)
    assert float(row["order"]) == 1.98 and float(row["exact"]) == 2 and row["evaluations"] == "3"
    is_miss(folder, "below 1.9", study(1.8, 1.5, 2.1, 2), ORDER, refine)
    passes(folder, study(2.04, 2.03, 2.05, 2), ORDER, refine)
    is_miss(folder, "leaves out 2", study(2.07, 2.06, 2.08, 2), ORDER, refine)
    is_miss(folder, "leaves out 3", study(1.98, 1.9, 2.1, 3), ORDER, refine)
    is_miss(folder, "leaves out 3", study(1.98, 1.9, 2.1, 2), ORDER + "theory = 3\n", refine)
    is_miss(folder, "says nothing", study(1.98, -9, 13, 2), ORDER, refine)
    is_miss(folder, "no interval", study(1.98, "null", "null", 2), ORDER, refine)
    is_miss(folder, "no order that theory knows", study(1.98, 1.9, 2.1, "null"), ORDER, refine)
    is_miss(folder, "", study("NaN", 1.9, 2.1, 2), ORDER, refine)
    is_miss(folder, "no order of u_max", study(1.98, 1.9, 2.1, 2), ORDER.replace("u_l2", "u_max"), refine)


@claim("a remark lets an interval leave the theory's order out, but excuses no order below its target")
def _(folder):
    refine, remark = 'refine = "h"\n', ORDER + 'order_remark = "cut cells"\n'
    assert passes(folder, study(1.98, 1.9, 2.1, 3), remark, refine)["remark"] == "cut cells"
    is_miss(folder, "below 1.9", study(1.8, 1.7, 1.9, 3), remark, refine)


@claim("a known miss passes, and fails once it is none")
def _(folder):
    known = VALUE + 'known_miss = "it locks"\n'
    row = passes(folder, RIGHT.replace("1.0001", "0.5"), known)
    assert row["ok"] == "MISS" and row["known_miss"] == "it locks"
    result = the_ladder(folder, RIGHT, known)
    assert result.returncode == 1 and "no miss any more (it locks)" in result.stdout, result


@claim("a known miss does not excuse a run that failed, or a quantity that is not there")
def _(folder):
    known = VALUE + 'known_miss = "it locks"\n'
    is_miss(folder, "exit status 4", RIGHT.replace('"$run"', '"$run"; exit 4'), known)
    is_miss(folder, "KeyError", RIGHT, known.replace("end.u", "top.u"))
    is_miss(folder, "end.u is", RIGHT.replace("1.0001", "NaN"), known)
    is_miss(folder, "no order of u_max", study(1.98, 1.9, 2.1, 2),
            ORDER.replace("u_l2", "u_max") + 'known_miss = "it locks"\n', 'refine = "h"\n')  # fmt: skip


@claim("the order of runs with half the size each is that of their errors, with its interval")
def _(folder):
    ladder_judge = script_module("ladder_judge")
    order, low, high = ladder_judge.fitted_order([1.0, 0.25, 0.0625])
    assert abs(order - 2) < 1e-12 and abs(low - 2) < 1e-9 and abs(high - 2) < 1e-9
    # log₂ of the errors 0, −2, −3: slope 1.5, residuals 1/6 of (1, −2, 1), t of 97.5 % and one degree of freedom 12.706
    order, low, high = ladder_judge.fitted_order([1.0, 0.25, 0.125])
    assert abs(order - 1.5) < 1e-12 and abs(high - order - 12.706 * math.sqrt(1 / 12)) < 1e-9
    assert ladder_judge.fitted_order([1.0, 0.5])[1:] == (None, None)
    quantity = 'name = "u"\nread = "order.end.u"\nexact = 1.0\ntarget = 1.9\ntheory = 2\n'
    halve = 'halve = [["constants.c=4"], ["constants.c=2"], ["constants.c=1"]]\n'
    by_level = RIGHT.replace("1.0001", "1.0'\"$(cut -d' ' -f$((1 + ${2##*/})) <<<'16 04 01')\"'")
    assert abs(float(passes(folder, by_level, quantity, halve)["order"]) - 2) < 1e-6
    is_miss(folder, "below", RIGHT, quantity, halve)


@claim("a factor of safety is the middle of its bracket, and one that is not found a MISS")
def _(folder):
    factor = 'name = "F"\nread = "safety.factor"\nexact = 1.5\ntarget = 0.01\n'
    asked = "safety = [1, 2, 0.02]\n"
    found = '#! echo \'{"factor_low": 1.49, "factor_high": %s, "verdicts": [{"evaluations": 7}]}\' >"$safety"%s\n'
    row = passes(folder, found % (1.51, ""), factor, asked)
    assert float(row["computed"]) == 1.5 and row["evaluations"] == "7", row
    is_miss(folder, "above 0.01", found % (1.55, ""), factor, asked)
    is_miss(folder, "TypeError", found % ("null", ""), factor, asked)
    is_miss(folder, "exit status 3", found % (1.51, "; exit 3"), factor, asked)
    result = the_ladder(folder, found % (1.55, ""), factor, asked)
    assert f"safety {folder / 'scene.toml'} --from 1 --to 2 --width 0.02" in result.stdout, result


@claim("a ladder with bad input is refused with status 2 and one line")
def _(folder):
    def is_refused(words, *arguments, **keywords):
        result = the_ladder(folder, *arguments, **keywords)
        assert result.returncode == 2 and words in result.stderr and result.stderr.count("\n") == 1, result

    is_refused("unknown key colour", RIGHT, VALUE + 'colour = "red"\n')
    is_refused("unknown key colour", RIGHT, keys='colour = "red"\n')
    is_refused("target is missing", RIGHT, VALUE.replace("target = 1e-3\n", ""))
    is_refused("exact is missing", RIGHT, VALUE.replace("exact = 1.0\n", ""))
    is_refused("an order needs", RIGHT, ORDER)
    is_refused("orders alone", RIGHT, keys='refine = "h"\n')
    is_refused("safety.factor is read", RIGHT, keys="safety = [1, 2, 0.1]\n")
    is_refused("safety.factor is read", RIGHT, VALUE.replace("end.u", "safety.factor"))
    is_refused("exclude each other", RIGHT, keys='safety = [1, 2, 0.1]\nrefine = "h"\n')
    other = '[[case]]\nname = "b"\nabout = "B."\nsource = "none"\nscene = "none.toml"\n[[case.quantity]]\n'
    is_refused("there is no", RIGHT, VALUE + other + VALUE)
    is_refused("is there twice", RIGHT, VALUE + "[[case.quantity]]\n" + VALUE)
    is_refused("no case is chosen", RIGHT, options=["--only", "other"])
    is_refused("ladder.toml", RIGHT, VALUE + "=\n")
    assert the_ladder(folder, RIGHT, options=["--accept", "--quick"]).returncode == 2


@claim("an accepted ladder leaves a table with its commands, remarks and picture beside its cases")
def _(folder):
    known = VALUE.replace("1e-3", "1e-5") + 'known_miss = "it locks"\n'
    passes(folder, RIGHT, known, keys='set = ["constants.a=2"]\n', options=["--accept"])
    text = (folder / "README.md").read_text()
    assert "| it | end | 1 | 1.0001 | 1.0e-04 |" in text and "known miss" in text and "- end: it locks" in text
    assert "scene.toml --set constants.a=2\n" in text and "build/release/stillpoint run" in text
    assert (folder / "ladder.png").exists()


@claim("an accuracy ladder that is not there or has no rows is not drawn, with status 2")
def _(folder):
    for words in ("no ladder.csv", "no rows"):
        result = call(ROOT / "scripts/plot_ladder.py", folder)
        assert result.returncode == 2 and words in result.stderr and not (folder / "ladder.png").exists(), result
        (folder / "ladder.csv").write_text(COLUMNS + "\n")


@claim("scripts/ladder builds, runs the ladder and ends with its status")
def _(folder):
    scripts, environment = copy_of_scripts(folder, "#!/bin/bash\nexit 4\n")
    problems = scripts.parent / "problems/ladder"
    problems.mkdir(parents=True)
    assert call(scripts / "ladder", cwd=folder, env=environment).returncode == 2
    (problems / "scene.toml").write_text("")
    (problems / "ladder.toml").write_text(
        f'[[case]]\nname = "it"\nabout = "A."\nsource = "s"\nscene = "scene.toml"\n[[case.quantity]]\n{VALUE}'
    )
    result = call(scripts / "ladder", cwd=folder, env=environment)
    assert result.returncode == 1 and (folder / "out/ladder/ladder.csv").exists(), result


@claim("every scene of problems/ladder has a case in the ladder, and every case its source")
def _(_folder):
    cases = tomllib.loads((ROOT / "problems/ladder/ladder.toml").read_text())["case"]
    scenes = {path.name for path in (ROOT / "problems/ladder").glob("*.toml")} - {"ladder.toml"}
    assert scenes == {case["scene"] for case in cases if not case["scene"].startswith("../")}
    assert all(case["about"].endswith(".") and case["source"] for case in cases)


@claim("the closed answers of beams and columns are the published ones")
def _(_folder):
    closed = script_module("closed_answers")
    for load, w, u in ((1, 0.30172, 0.05643), (2, 0.49346, 0.16064), (5, 0.71379, 0.38763), (10, 0.81061, 0.55500)):
        x, y = closed.beam(load, 1)
        assert abs(x + u) < 1e-5 and abs(y + w) < 1e-5, (load, x, y)
    # small loads: w = P L³/(3 E I) (1 + 3 shear)
    assert abs(closed.beam(1e-4, 1, shear=0.1)[1] / -1e-4 - (1 / 3 + 0.1)) < 1e-6
    one = script_module("numpy").array([1.0])
    for function, s0, top in (
        (closed.hencky_column, 0.1, 0.954422), (closed.hencky_column, 1, 0.727969),
        (closed.neo_hookean_column, 1, 0.647794), (closed.small_strain_column, 1, 0.5),
    ):  # fmt: skip
        assert abs(1 + function(one, 1, 0, 1, s0, 1)[0] - top) < 1e-6, (function, s0)


@claim("a heap ends where it is less than a grain deep, whatever a few loose points beyond do")
def _(_folder):
    numpy, heap = script_module("numpy"), script_module("heap")
    # 1 deep at x = 0 and of slope 1/2, it is 0.1 deep at 1.8; points of equal shares of its area, and two far off.
    x = 2 - 2 * numpy.sqrt(1 - (numpy.arange(20000) + 0.5) / 20000)
    end = heap.front(x, 1 / 20000, depth=0.1, width=0.01)
    assert abs(end - 1.8) < 0.02
    assert heap.front(numpy.append(x, [5.0, 5.001]), 1 / 20000, depth=0.1, width=0.01) == end
    # The last points of a block are its end, unless there is a gap before.
    for width, block in ((0.6, 0.75), (0.2, 0.25)):
        assert heap.front(numpy.repeat([0.25, 0.75], 4), 1 / 8, depth=0.1, width=width) == block


if __name__ == "__main__":
    check_the_claim()
