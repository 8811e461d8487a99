#!/usr/bin/python3
"""scenes_test.py ROOT CLAIM PACKAGE: one claim about the scenes of the Python package."""

from modules import BAR, ROOT, raised, table_of  # first: finds the package

import math
import os
import pickle
from pathlib import Path

import numpy as np
import stillpoint
from claims import check_the_claim, claim


@claim("a dictionary with a file's keys relaxes to the same bits")
def _(_folder):
    table = table_of(BAR)
    by_file, by_table = (stillpoint.Simulation(scene).run() for scene in (BAR, table))
    assert by_file.status == "equilibrium" and by_table.steps == by_file.steps
    assert np.array_equal(by_file.history, by_table.history)
    assert np.array_equal(by_file.points.stress, by_table.points.stress)


@claim("every scene of problems/ is the same scene as a dictionary")
def _(_folder):
    files = [file for file in sorted((ROOT / "problems").glob("*.toml"))]
    assert len(files) > 20
    os.chdir(ROOT / "problems")  # where a dictionary's files are looked for
    for file in files:
        scene, of_table = stillpoint.load(file), stillpoint.load(table_of(file))
        assert (of_table.title, of_table.dim) == (scene.title, scene.dim), file
        import tomllib

        assert tomllib.loads(of_table.text) == table_of(file), file


@claim("everything wrong with a dictionary is told at once, by its keys")
def _(_folder):
    table = table_of(BAR)
    table["grid"]["cells"] = "a"
    table["body"]["material"] = "none"
    table["suport"] = [{"at": 1.0}]
    table["support"][0]["at"] = True
    error = raised(stillpoint.SceneError, stillpoint.load, table)
    assert isinstance(error, ValueError)
    told = {problem.where: problem.message for problem in error.problems}
    assert set(told) == {"grid.cells", "body.material", "suport", "support[0].at"}, told
    assert "did you mean 'support'" in told["suport"]
    assert str(error).splitlines() == [f"{where}: {message}" for where, message in told.items()], str(error)


@claim("what a dictionary lacks is told by the table that it belongs into, and what is wrong with a variant by the variant")
def _(_folder):
    def told(table):
        problems = raised(stillpoint.SceneError, stillpoint.load, table).problems
        assert not any(problem.line or problem.column for problem in problems), problems
        return {problem.where: problem.message for problem in problems}

    table = table_of(BAR)
    del table["grid"], table["body"]["material"]
    lacking = told(table)
    assert lacking["grid"].startswith("this table is missing: ") and lacking["body"] == "the key 'material' is missing", lacking
    assert "unknown key 'titel'" in told({**table_of(BAR), "titel": "a bar"})["titel"]
    table = {**table_of(BAR), "variant": [{"name": "wide", "set": ["grid.cells=0"]}]}
    assert list(told(table)) == ["variant[0].set"], told(table)


@claim("what only the set-up of a dictionary finds is told by its key, and so it is of an override")
def _(_folder):
    table = table_of(BAR)
    for refine, where in ("motion", "phase"), ("rtol", "integrator"):
        error = raised(stillpoint.SceneError, stillpoint.converge, table, refine=[refine])
        assert [(problem.where, problem.line) for problem in error.problems] == [(where, 0)], error.problems
    error = raised(stillpoint.SceneError, stillpoint.converge, table, {"grid.cells": 0})
    assert [problem.where for problem in error.problems] == ["grid.cells"], error.problems


@claim("everything wrong with a file is told at once, with line and column")
def _(folder):
    file = folder / "wrong.toml"
    file.write_text(BAR.read_text(encoding="utf-8").replace("cells = 4", "cells = 0").replace("E = 1.0", "E = -1.0"))
    error = raised(stillpoint.SceneError, stillpoint.load, file)
    assert len(error.problems) == 2 and all(problem.where == str(file) for problem in error.problems), error.problems
    lines = file.read_text(encoding="utf-8").splitlines()
    assert {lines[problem.line - 1].split("=")[0].strip() for problem in error.problems} == {"cells", "E"}
    assert f"{file}:{error.problems[0].line}:{error.problems[0].column}: " in str(error)


@claim("overrides by keyword, by dotted key and by dictionaries within are those of --set")
def _(_folder):
    scene = stillpoint.load(BAR, {"damping.c": "pi/10", "force[0].value": 0.002}, damping={"strategy": "viscous"})
    assert scene.overrides == ['damping.c="pi/10"', "force[0].value=0.002", 'damping.strategy="viscous"']
    assert stillpoint.Simulation(scene).summary.c == math.pi / 10
    wide = stillpoint.load(BAR, probe=[{"name": "end", "at": 10.0, "fields": ["u"]}])
    assert list(stillpoint.Simulation(wide).summary.probes) == ["end"]
    error = raised(stillpoint.SceneError, stillpoint.load, BAR, damping={"c": -1})
    assert error.problems[0].where == "damping.c" and not error.problems[0].line


@claim("what is wrong with an override is told by its key, without a word of the command's options")
def _(_folder):
    def told(overrides):
        error = raised(stillpoint.SceneError, stillpoint.load, BAR, overrides)
        assert "--" not in str(error), error
        return {problem.where: problem.message for problem in error.problems}

    assert told({"damping.c": -1}) == {"damping.c": "must be at least 0, not -1"}
    both = told({"damping": {"strategy": "viscos", "c": "pi/"}})
    assert set(both) == {"damping.strategy", "damping.c"} and both["damping.strategy"].startswith("unknown value 'viscos'")
    assert list(told({"probe": [{"name": "x", "at": 1, "fields": ["heat"]}]})) == ["probe[0].fields[0]"]
    assert "there is no" in told({"probe[7].at": 3})["probe[7].at"]
    assert "an override can" in told({"grid": {"a b": 1}})["grid.a b"]
    state = stillpoint.StateError("it is of the scene with --set damping.c=1 --set grid.cells=5, expected one without --set")
    assert str(state) == "it is of the scene with damping.c=1 grid.cells=5, expected one without overrides"


@claim("a scene's error that was pickled, as by a pool of processes, has the same problems")
def _(_folder):
    error = raised(stillpoint.SceneError, stillpoint.load, BAR, {"damping.c": -1})
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is stillpoint.SceneError and again.problems == error.problems and str(again) == str(error)


@claim("numpy's numbers and arrays, paths and tuples are values of a scene, and nothing else is")
def _(_folder):
    from stillpoint.scene_text import scene_text

    table = {"a": np.float64(0.1), "b": np.arange(3), "c": (1, 2.5), "d": Path("x y"), "e": True, "f": 'q"\n', "g": -math.inf}
    import tomllib

    read = tomllib.loads(scene_text(table))
    assert read == {"a": 0.1, "b": [0, 1, 2], "c": [1, 2.5], "d": "x y", "e": True, "f": 'q"\n', "g": -math.inf}
    assert isinstance(read["e"], bool)
    assert "NoneType" in str(raised(TypeError, scene_text, {"a": None}))


@claim("a scene that was pickled is the same scene, of a file and of a dictionary, with what was laid over it")
def _(_folder):
    for source in (BAR, table_of(BAR)):
        scene = stillpoint.load(source, {"grid.cells": 6, "damping.c": 0.3})
        again = pickle.loads(pickle.dumps(scene))
        assert (again.file, again.text, again.overrides) == (scene.file, scene.text, scene.overrides)
        one, other = (stillpoint.Simulation(which).run() for which in (scene, again))
        assert len(one.unknowns) == 13 and np.array_equal(one.history, other.history), len(one.unknowns)


@claim("what cannot be opened is told as of the command")
def _(folder):
    error = raised(stillpoint.SceneError, stillpoint.load, folder / "none.toml")
    assert error.problems[0].message == "there is no such file", error.problems
    raised(stillpoint.StateError, stillpoint.resume, folder / "none.h5")


@claim("help() says of each member of the compiled half what its stub says to editors")
def _(_folder):
    import ast
    import inspect

    from stillpoint import _core

    stub = Path(stillpoint.__file__).with_name("_core.pyi").read_text(encoding="utf-8")
    said = 0
    for described in ast.parse(stub).body:
        if not isinstance(described, ast.ClassDef):
            continue
        compiled = getattr(_core, described.name)
        assert inspect.cleandoc(compiled.__doc__).split() == (ast.get_docstring(described) or "").split(), described.name
        for member in described.body:
            # The fields of points are found by their names.
            if isinstance(member, ast.FunctionDef) and not member.name.startswith("__") and described.name != "Points":
                text = getattr(compiled, member.name).__doc__ or ""
                # Of a function the first line is its signature.
                text = text.split("\n", 1)[1] if text.startswith(f"{member.name}(") else text
                assert text.split() == (ast.get_docstring(member) or "").split() != [], (described.name, member.name, text)
                said += 1
    assert said > 30, said


check_the_claim()
