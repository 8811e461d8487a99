#!/usr/bin/python3
"""converge_test.py ROOT CLAIM PROGRAM: one claim about scripts/converge and its picture."""

import json
import math

from claims import call, check_the_claim, claim, copy_of_scripts, plot, plots_module

LEVEL = {"size": 0.5, "wall_s": 0.1, "status": "equilibrium"}
ORDER = {"order": 2.0, "low": 1.9, "high": 2.1, "theory": 2.0, "levels": [1, 3]}
STUDY = {
    "title": "costs $5 or $6",
    "refined": ["h"],
    "reference": "the exact solution",
    "levels": [LEVEL, LEVEL | {"size": 0.25, "wall_s": 0.3}, LEVEL | {"size": 0.125, "wall_s": 1.0}],
    "quantities": {
        "u_l2": {"values": [0.16, 0.04, 0.01], "errors": [0.16, 0.04, 0.01]},
        "end.u": {"values": [1.2, 1.1, None], "errors": [0.2, 0.1, None]},
    },
    "orders": {"u_l2": ORDER, "end.u": ORDER | {"low": None, "high": None, "theory": None}},
}
VARIED = {
    "title": "two bases",
    "varied": ["grid.basis"],
    "refined": ["h"],
    "series": [
        STUDY | {"set": ["grid.basis=linear"]},
        STUDY | {"set": ["grid.basis=cubic"], "orders": {"u_l2": ORDER | {"order": 4.0, "theory": 4.0}},
                 "quantities": {"u_l2": {"values": [1e-2, 1e-3, 1e-4], "errors": [1e-2, 1e-3, 1e-4]}}},
        STUDY | {"set": ["grid.basis=quadratic"], "orders": {}, "quantities": {}},  # it failed on all levels
    ],
}
# Stands for build/release/stillpoint: leaves a study, if there is one, and ends with STATUS.
PROGRAM = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"
while [[ $1 != --out ]]; do shift; done
[[ -z ${STUDY:-} ]] || { mkdir -p "$2"; cp "$STUDY" "$2/converge.json"; }
exit "${STATUS:-0}"
"""


def write(folder, study):
    folder.mkdir(exist_ok=True)
    (folder / "converge.json").write_text(json.dumps(study))
    return folder


def figure_of(folder, study):
    converge = plots_module("converge")
    return converge.figure_of(converge.read(write(folder, study)))


def is_refused(folder, *words):
    """Drawing ends with status 2, says these words in one line, and draws nothing."""
    result = plot("converge", folder)
    assert result.returncode == 2, result
    assert all(word in result.stderr for word in words) and result.stderr.count("\n") == 1, result.stderr
    assert not (folder / "converge.png").exists()


def slopes_of(axis):
    """{order: ends of its line} of the order lines."""
    lines = [line.get_xydata() for line in axis.lines if line.get_label().startswith("_")]
    return {round(math.log(b[1] / a[1]) / math.log(b[0] / a[0]), 12): (a, b) for a, b in lines}


@claim("a convergence study is drawn with a line a quantity, its order, and lines of the orders that theory knows")
def _(folder):
    by_size, by_time = figure_of(folder, STUDY).axes
    lines = {line.get_label(): line for line in by_size.lines if not line.get_label().startswith("_")}
    assert list(lines) == ["u_l2: 2.00 (1.90 to 2.10)", "end.u: 2.00"], lines
    assert lines["u_l2: 2.00 (1.90 to 2.10)"].get_xydata().tolist() == [[0.5, 0.16], [0.25, 0.04], [0.125, 0.01]]
    assert lines["end.u: 2.00"].get_xydata().tolist() == [[0.5, 0.2], [0.25, 0.1]]
    slopes = slopes_of(by_size)
    assert list(slopes) == [2] and [text.get_text() for text in by_size.texts] == ["2"], slopes
    assert slopes[2][0][0] == 0.125 and slopes[2][1][0] == 0.5 and slopes[2][0][1] < 0.01, slopes
    assert by_time.lines[0].get_xdata().tolist() == [0.1, 0.3, 1.0]
    result = plot("converge", folder, "--out", folder / "a.png")
    assert result.returncode == 0 and (folder / "a.png").read_bytes().startswith(b"\x89PNG"), result


@claim("of varied values each has its line in both parts of the picture, with the slope of its own theory")
def _(folder):
    by_size, by_time = figure_of(folder, VARIED).axes
    lines = {line.get_label(): line for line in by_size.lines if not line.get_label().startswith("_")}
    assert list(lines) == ["grid.basis=linear: 2.00 (1.90 to 2.10)", "grid.basis=cubic: 4.00 (1.90 to 2.10)"], lines
    assert by_size.get_ylabel().startswith("u_l2: error"), by_size.get_ylabel()
    assert [list(line.get_xdata()) for line in by_time.lines] == [[0.1, 0.3, 1.0]] * 2
    assert list(slopes_of(by_size)) == [2, 4], slopes_of(by_size)
    is_refused(write(folder / "none", VARIED | {"series": [VARIED["series"][2]]}), "nothing to draw")


@claim("where theory knows no order the line beside errors has the whole one nearest to what was measured, below all of them")
def _(folder):
    measured = ORDER | {"order": 2.6, "low": None, "high": None, "theory": None}
    errors = {"fast": [0.8, 0.1, 0.05], "slow": [0.5, 0.45, 0.4], "two": [0.04, 0.01, None], "one": [0.3, None, None]}
    quantities = {name: {"values": values, "errors": values} for name, values in errors.items()}
    study = STUDY | {"quantities": quantities, "orders": {"fast": measured, "slow": None, "two": None, "one": None}}
    axis = figure_of(folder, study).axes[0]
    slopes = slopes_of(axis)
    assert sorted(slopes) == [1, 2, 3], slopes  # 2.6, 0.17 of two levels, and 2
    for order, name in ((3, "fast"), (1, "slow"), (2, "two")):
        (size, error), _ = slopes[order]
        levels = zip((0.5, 0.25, 0.125), errors[name])
        assert all(at is None or error * (h / size) ** order < 0.7 * at for h, at in levels), (order, slopes)
    assert axis.get_xlabel() == "$h$ [m]" and [tick.get_text() for tick in axis.get_xticklabels()] == ["0.125", "0.25", "0.5"]


@claim("a convergence study that is missing, broken or without errors is refused with status 2")
def _(folder):
    is_refused(folder, str(folder), "no converge.json")
    for text, word in (("", "Expecting value"), ("[]", "with quantities"), ("{}", "with quantities")):
        (folder / "converge.json").write_text(text)
        is_refused(folder, "converge.json", word)
    is_refused(write(folder, STUDY | {"quantities": {}}), "nothing to draw")
    is_refused(write(folder, STUDY | {"quantities": {"u_l2": {"errors": [None, None, None]}}}), "nothing to draw")
    is_refused(write(folder, {"quantities": {"u_l2": {"errors": [1]}}}), "converge.json", "levels")


@claim("scripts/converge studies a scene, draws the picture, and ends with the status of the study")
def _(folder):
    scripts, environment = copy_of_scripts(folder, PROGRAM)
    environment["STUDY"] = str(write(folder / "given", STUDY) / "converge.json")
    for status in (0, 3):
        result = call(scripts / "converge", "my scene.toml", "--refine", "h", cwd=folder,
                      env=environment | {"STATUS": str(status)})
        assert result.returncode == status, result
        picture = folder / "out/my scene-converge/converge.png"
        assert "Picture: out/my scene-converge/converge.png" in result.stdout, result
        picture.unlink()
        calls = folder / "calls"
        assert calls.read_text() == "<converge><my scene.toml><--out><out/my scene-converge><--refine><h>"
        calls.unlink()
    assert call(scripts / "converge").returncode == 2


if __name__ == "__main__":
    check_the_claim()
