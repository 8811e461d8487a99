#!/usr/bin/python3
"""compare_test.py ROOT CLAIM PROGRAM: one claim about scripts/compare and its picture."""

import json

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, plot, plots_module

RUN = {
    "label": "viscous 0.9",
    "status": "converged",
    "evaluations": 900,
    "error": 1e-6,
    "residual": 1e-7,
    "wall_s": {"median": 0.01, "least": 0.009, "most": 0.02},
    "samples": [[0, 1.0, 1.0, None], [300, 1e-2, 1e-3, 2e-2], [900, 1e-6, 1e-7, 2e-6]],
}
END = RUN | {"label": "newton", "evaluations": 3, "error": 0.0, "residual": 0.0, "samples": []}
REFUSED = END | {"label": "cg", "status": "refused", "evaluations": 0, "error": None, "residual": None, "wall_s": None}
COMPARISON = {
    "title": "costs $5 or $6",
    "goal": 1e-6,
    "goal_of": "error",
    "kappa": 9988.0,
    "lower_bound": 725.0,
    "runs": [RUN, END, REFUSED],
}
# Stands for build/release/stillpoint: leaves a comparison, if there is one, and ends with STATUS.
PROGRAM = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"
while [[ $1 != --out ]]; do shift; done
[[ -z ${COMPARISON:-} ]] || { mkdir -p "$2"; cp "$COMPARISON" "$2/compare.json"; }
exit "${STATUS:-0}"
"""


def write(folder, comparison):
    folder.mkdir(exist_ok=True)
    (folder / "compare.json").write_text(json.dumps(comparison))
    return folder


def figure_of(folder, comparison):
    """What is drawn: (axis by evaluations, axis by time)."""
    compare = plots_module("compare")
    return compare.figure_of(compare.read(write(folder, comparison))).axes


def is_refused(folder, *words):
    """Drawing ends with status 2, says these words in one line, and draws nothing."""
    result = plot("compare", folder)
    assert result.returncode == 2, result
    assert all(word in result.stderr for word in words) and result.stderr.count("\n") == 1, result.stderr
    assert not (folder / "compare.png").exists()


@claim("a comparison is drawn into compare.png, or elsewhere")
def _(folder):
    result = plot("compare", write(folder, COMPARISON))
    assert result.returncode == 0 and result.stdout == f"Picture: {folder / 'compare.png'}\n", result
    assert not result.stderr and (folder / "compare.png").read_bytes().startswith(b"\x89PNG")
    result = plot("compare", folder, "--out", folder / "a.pdf")
    assert result.returncode == 0 and (folder / "a.pdf").read_bytes().startswith(b"%PDF"), result


@claim("each way of a comparison is a line by evaluations and one by time, an end alone a dot, beside the Chebyshev estimate")
def _(folder):
    by_evaluations, by_time = figure_of(folder, COMPARISON)
    lines = {line.get_label(): line for line in by_evaluations.lines if not line.get_label().startswith("_")}
    assert list(lines) == ["viscous 0.9", "newton", "Chebyshev estimate ½ √κ ln(2/ε)"], lines
    assert lines["viscous 0.9"].get_xydata().tolist() == [[300, 1e-2], [900, 1e-6]]
    assert lines["newton"].get_marker() == "o" and len(lines["newton"].get_xdata()) == 1
    assert abs(by_time.lines[0].get_xdata()[-1] - 0.01) < 1e-12
    assert by_evaluations.get_ylabel() == "relative error"


@claim("a comparison by residual is drawn by it, without the bound of an error")
def _(folder):
    axis = figure_of(folder, COMPARISON | {"goal_of": "residual", "lower_bound": None})[0]
    lines = [line for line in axis.lines if not line.get_label().startswith("_")]
    assert lines[0].get_xydata().tolist() == [[300, 1e-3], [900, 1e-7]] and len(lines) == 2
    assert axis.get_ylabel() == "residual"


@claim("a comparison that is missing, empty, broken or without anything to draw is refused with status 2")
def _(folder):
    is_refused(folder, str(folder), "no compare.json")
    is_refused(folder / "missing", "no compare.json")
    for text, word in (("", "Expecting value"), ('{"runs": [', "Expecting"), ("[]", "with runs"), ("{}", "with runs")):
        (folder / "compare.json").write_text(text)
        is_refused(folder, "compare.json", word)
    is_refused(write(folder, COMPARISON | {"runs": []}), "nothing to draw")
    is_refused(write(folder, COMPARISON | {"runs": [REFUSED]}), "nothing to draw")
    is_refused(write(folder, {"runs": [{"label": "viscous"}]}), "compare.json", "goal_of")
    is_refused(write(folder, COMPARISON | {"runs": [{"label": "viscous"}]}), "compare.json", "samples")


@claim("scripts/compare without a scene or a folder says how to use it, with status 2")
def _(folder):
    result = call(ROOT / "scripts/compare")
    assert result.returncode == 2 and "usage" in result.stderr and "SCENE" in result.stderr, result
    result = call(ROOT / "scripts/compare", "--overshoot")
    assert result.returncode == 2 and "usage" in result.stderr, result
    scripts, environment = copy_of_scripts(folder, PROGRAM)
    result = call(scripts / "compare", "a.toml", "--out", cwd=folder, env=environment)
    assert result.returncode == 2 and "--out needs a folder" in result.stderr, result
    assert not (folder / "calls").exists()


@claim("scripts/compare compares a scene, draws the picture, and ends with the status of the comparison")
def _(folder):
    scripts, environment = copy_of_scripts(folder, PROGRAM)
    environment["COMPARISON"] = str(write(folder / "given", COMPARISON) / "compare.json")
    for status in (0, 3):
        result = call(scripts / "compare", "my scene.toml", "--overshoot", cwd=folder, env=environment | {"STATUS": str(status)})
        assert result.returncode == status, result
        picture = folder / "out/my scene-compare/compare.png"
        assert "Picture: out/my scene-compare/compare.png" in result.stdout, result
        picture.unlink()
        calls = folder / "calls"
        assert calls.read_text() == "<compare><my scene.toml><--out><out/my scene-compare><--overshoot>"
        calls.unlink()


@claim("scripts/compare draws nothing of a scene that is refused, and ends with status 2")
def _(folder):
    scripts, environment = copy_of_scripts(folder, PROGRAM)
    result = call(scripts / "compare", "a.toml", "--out=there", cwd=folder, env=environment | {"STATUS": "2"})
    assert result.returncode == 2 and not result.stderr, result
    assert (folder / "calls").read_text() == "<compare><a.toml><--out><there>"


if __name__ == "__main__":
    check_the_claim()
