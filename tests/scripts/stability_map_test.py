#!/usr/bin/python3
"""stability_map_test.py ROOT CLAIM: one claim about scripts/stability_map.py of the source tree ROOT."""

import math
import sys
import tomllib

from claims import ROOT, call, check_the_claim, claim, script_module

# Stands for build/release/stillpoint: a scene says in the shell's words how it ends.
PROGRAM = """#!/bin/bash
scene=$2
while [[ $1 != --out ]]; do shift; done
summary() { printf '{"status": "%s", "reason": "%s", "rhs_evaluations": %d, "error": {"u_rel_l2": %s}}' "$@"; }
out=$2/summary.json
source "$scene"
"""
RIGHT = 'summary equilibrium "" 100 1e-5 >"$out"\n'
WRONG = 'summary equilibrium "" 100 0.02 >"$out"\n'
COLUMNS = "case,way,expected,outcome,evaluations,error,fault\n"


def the_map(folder, scene, keys="", last="", expected='"equilibrium"', judge="exact", options=()):
    """What comes of a map of one case."""
    (folder / "program").write_text(PROGRAM)
    (folder / "program").chmod(0o755)
    (folder / "scene.toml").write_text(scene)
    case = f'name = "it"\nscene = "scene.toml"\nways = ["auto"]\nexpected = {expected}\nseconds = 1\n'
    case += f'judge = "{judge}"\n'
    (folder / "map.toml").write_text(f"[[case]]\n{case}{keys}")
    (folder / "last.csv").write_text(COLUMNS + last)
    return call(
        *[sys.executable, ROOT / "scripts/stability_map.py", "--random", "0", "--out", folder / "out"],
        *["--cases", folder / "map.toml", "--last", folder / "last.csv", "--program", folder / "program", *options],
    )


@claim("an equilibrium that is right passes, and the map is written and drawn")
def _(folder):
    result = the_map(folder, RIGHT)
    assert result.returncode == 0 and "1 right" in result.stdout, result
    assert (folder / "out/map.csv").read_text() == COLUMNS + "it,auto,equilibrium,equilibrium,100,1.0e-05,\n"
    assert (folder / "out/map.png").stat().st_size > 0


@claim("a false equilibrium ends the map with status 1, and with the command that reproduces it")
def _(folder):
    result = the_map(folder, WRONG)
    assert result.returncode == 1 and "FALSE" in result.stdout, result
    assert f"run {folder / 'scene.toml'} --set damping.strategy=auto" in result.stdout, result


@claim("an error that is no number is no equilibrium")
def _(folder):
    result = the_map(folder, 'summary equilibrium "" 100 NaN >"$out"\n')
    assert result.returncode == 1 and "FALSE" in result.stdout, result


@claim("a known fault passes, and fails once it is gone")
def _(folder):
    fault = 'fault = [{ where = "au*", reason = "not mended yet" }]\n'
    result = the_map(folder, WRONG, fault)
    assert result.returncode == 0 and "known: not mended yet" in result.stdout, result
    result = the_map(folder, RIGHT, fault)
    assert result.returncode == 1 and "the fault is gone" in result.stdout, result


@claim("a success without the figures that its judge asks for is not judged, and not right")
def _(folder):
    result = the_map(folder, 'summary equilibrium "" 100 null >"$out"\n')
    assert result.returncode == 1 and "not judged" in result.stdout, result
    result = the_map(folder, RIGHT, judge="momentum")
    assert result.returncode == 1 and "not judged" in result.stdout, result


@claim("a run that does not end is cut off")
def _(folder):
    result = the_map(folder, "while :; do :; done\n")
    assert result.returncode == 1 and "hang" in result.stdout, result


@claim("a run that ends by a signal, or without a summary, has crashed")
def _(folder):
    for scene in ("kill -SEGV $$\n", "exit 4\n"):
        result = the_map(folder, scene, expected='["failed", "refused"]')
        assert result.returncode == 1 and "crash" in result.stdout, result


@claim("bad input is refused, and a failure is what the summary says")
def _(folder):
    assert the_map(folder, "exit 2\n", expected='"refused"').returncode == 0
    failure = 'summary failed "point 3 left" 7 null >"$out"; exit 4\n'
    assert the_map(folder, failure, expected='"failed"').returncode == 0


@claim("a failure that does not say what it should is none that is expected")
def _(folder):
    failure = 'summary failed "point 3 left" 7 null >"$out"; exit 4\n'
    assert the_map(folder, failure, 'says = "point .*left"\n', expected='"failed"').returncode == 0
    result = the_map(folder, failure, 'says = "in cell"\n', expected='"failed"')
    assert result.returncode == 1 and "unnamed" in result.stdout, result


@claim("a note excuses an answer that is wrong, if the case says so")
def _(folder):
    note = WRONG.replace('>"$out"', """| sed 's/}$/, "notes": ["it overshot"]}/' >"$out" """)
    assert the_map(folder, note, 'notes = "overshot"\n', expected='"noted"').returncode == 0
    assert the_map(folder, note, 'notes = "overshot"\n').returncode == 1
    assert the_map(folder, WRONG, 'notes = "overshot"\n', expected='"noted"').returncode == 1


@claim("an outcome that is not that of the last map fails, and many more evaluations are said")
def _(folder):
    result = the_map(folder, RIGHT, last="it,auto,equilibrium,step-limit,100,,\n", expected='["equilibrium"]')
    assert result.returncode == 1 and "was step-limit in the last map" in result.stdout, result
    result = the_map(folder, RIGHT, last="it,auto,equilibrium,equilibrium,50,,\n")
    assert result.returncode == 0 and "100 evaluations, 50 in the last map (+100%)" in result.stdout, result


@claim("an outcome that chance decides may be another than in the last map, but only one that is expected")
def _(folder):
    last = "it,auto,failed | equilibrium,failed,50,,\n"
    result = the_map(folder, RIGHT, "chance = true\n", last, expected='["failed", "equilibrium"]')
    assert result.returncode == 0 and "was failed in the last map" in result.stdout, result
    result = the_map(folder, RIGHT, "chance = true\n", last, expected='["failed", "diverged"]')
    assert result.returncode == 1, result


@claim("what is accepted takes the place of its row in the last map, and rows that are no more go")
def _(folder):
    last = "it,auto,equilibrium,equilibrium,50,,\ngone,auto,equilibrium,equilibrium,50,,\n"
    assert the_map(folder, RIGHT, last=last, options=["--accept"]).returncode == 0
    assert (folder / "last.csv").read_text() == COLUMNS + "it,auto,equilibrium,equilibrium,100,1.0e-05,\n"


@claim("a map with an unknown key or judge, or with an answer that nothing judges, is refused with status 2")
def _(folder):
    result = the_map(folder, RIGHT, 'colour = "red"\n')
    assert result.returncode == 2 and "unknown key colour" in result.stderr, result
    result = the_map(folder, RIGHT, judge="")
    assert result.returncode == 2 and "nothing judges it" in result.stderr, result
    result = the_map(folder, RIGHT, judge="hope")
    assert result.returncode == 2 and "unknown judge hope" in result.stderr, result


@claim("every scene of problems/hard has a case in the map, and every case its reason")
def _(_folder):
    cases = tomllib.loads((ROOT / "problems/hard/map.toml").read_text())["case"]
    scenes = {path.name for path in (ROOT / "problems/hard").glob("*.toml")} - {"map.toml"}
    assert scenes == {case["scene"] for case in cases if not case["scene"].startswith("../")}
    assert all(case["about"].endswith(".") for case in cases)


@claim("a closed answer is that of Lambert's W, and fulfils its equation")
def _(_folder):
    numpy, closed = __import__("numpy"), script_module("closed_answers")
    W = 0.5671432904097838  # of 1
    assert abs(closed.hencky_column(numpy.array([1.0]), 1, 0, 1, 1, 1)[0] - (W + W**2 / 2 - 1)) < 1e-12
    x, d = numpy.array([0.3]), 1e-5
    u = [closed.neo_hookean_column(at, 2, 0.3, 1, 1, 1) for at in (x - d, x + d)]
    F = 1 + (u[1] - u[0]) / (2 * d)
    lam, mu = closed.lame(2, 0.3)
    assert abs(mu * (F - 1 / F) + lam * math.log(F[0]) / F + 0.7)[0] < 1e-8


@claim("a random variation is the same scene however many there are, and another for another seed")
def _(folder):
    map_random = script_module("map_random")
    scenes = [map_random.variation(seed, k, folder).scene for seed in (1, 2) for k in range(30)]
    texts = [scene.read_text() for scene in scenes]
    assert all(tomllib.loads(text)["title"] for text in texts) and len(set(texts)) == 60
    assert map_random.variation(1, 7, folder).scene.read_text() == texts[7]


@claim("a random unlike scene is the same however many there are, and of every family there is one that TOML reads")
def _(_folder):
    unlike, writer = script_module("map_unlike"), script_module("unlike_scene")
    texts = {}
    for family in unlike.names():
        families = unlike.families_of(family)
        drawn = [writer.toml(unlike.draw(seed, k, families)[1].scene) for seed in (1, 2) for k in range(20)]
        texts[family] = len(set(drawn))
        assert all(tomllib.loads(text)["title"] for text in drawn)
        assert writer.toml(unlike.draw(1, 7, families)[1].scene) == drawn[7]
    assert min(texts.values()) == 40, texts


def the_unlike_scenes(folder, program, options=()):
    """What comes of unlike scenes if every run ends as this text in the shell's words says."""
    (folder / "program").write_text(program)
    (folder / "program").chmod(0o755)
    (folder / "map.toml").write_text("")
    return call(
        *[sys.executable, ROOT / "scripts/stability_map.py", "--unlike", "3", "--out", folder / "out"],
        *["--program", folder / "program", "--cases", folder / "map.toml", *options],
    )


ENDS = '#!/bin/bash\nwhile [[ $1 != --out ]]; do shift; done\n%s\n'


@claim("unlike scenes that are refused or not at rest are right, and no other part of the map runs")
def _(folder):
    beyond = ["--family", "blocks_with_a_gap"]
    result = the_unlike_scenes(folder, ENDS % "echo a gap, 2 cells apart >&2; exit 2", beyond)
    assert result.returncode == 0 and "3 unlike scenes of seed 1: 0 wrong" in result.stdout, result
    assert not (folder / "out/map.csv").exists() and (folder / "out/unlike.csv").exists()
    honest = ENDS % """printf '{"status": "step-limit", "reason": "", "notes": []}' >"$2/summary.json"; exit 3"""
    assert the_unlike_scenes(folder, honest, beyond).returncode == 0


@claim("an equilibrium of an unlike scene that has none ends the map with status 1, and leaves the scene and its command")
def _(folder):
    rest = ENDS % """printf '{"status": "equilibrium", "reason": "", "notes": [], "probes": {}}' >"$2/summary.json" """
    result = the_unlike_scenes(folder, rest, ["--family", "blocks_with_a_gap", "--seed", "2"])
    assert result.returncode == 1 and "nothing holds the block beyond the gap" in result.stdout, result
    scene = next((folder / "out/random").glob("unlike-2-*.toml"))
    assert f"run {scene} --set" in result.stdout, result


@claim("an unlike scene that is refused although it has an answer is wrong")
def _(folder):
    result = the_unlike_scenes(folder, ENDS % "echo no >&2; exit 2", ["--family", "column_on_wall"])
    assert result.returncode == 1 and "alarm: no" in result.stdout, result


@claim("ways that find different equilibria of one scene are false but for the one in their middle")
def _(_folder):
    numpy, judge = __import__("numpy"), script_module("unlike_judge")
    unlike = script_module("unlike_scene").Unlike({"dim": 2}, [], unique=1e-6)
    found = [judge.Found(str(k), "right", u=numpy.array([1.0, u])) for k, u in enumerate((2, 2 + 1e-9, 2.1, 2))]
    judge.compare_ways(unlike, found)
    assert [one.outcome for one in found] == ["right", "right", "FALSE", "right"], found
    found[1].u = numpy.array([math.nan, math.nan])
    judge.compare_ways(unlike, found)
    assert [one.outcome for one in found] == ["right", "FALSE", "FALSE", "right"], found


if __name__ == "__main__":
    check_the_claim()
