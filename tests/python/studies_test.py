#!/usr/bin/python3
"""studies_test.py ROOT CLAIM PACKAGE: one claim about the studies, the files and the words of the Python package."""

from modules import BAR, raised, table_of  # first: finds the package

import json
import os
import pickle
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import stillpoint
from claims import ROOT, check_the_claim, claim


@claim("run leaves the files of the command and returns its summary")
def _(folder):
    summary = stillpoint.run(BAR, out=folder)
    written = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary == written and summary.status == "equilibrium" and summary.exit_status == 0
    assert (folder / "history.csv").exists() and summary.probes.p12.u == written["probes"]["p12"]["u"]
    raised(AttributeError, lambda: summary.nothing)


@claim("figures are a table in a notebook, row by row, and the same after pickling")
def _(_folder):
    summary = stillpoint.run(BAR)
    table = summary._repr_html_()
    for key in summary:
        assert f"<tr><th>{key}</th><td>" in table, key
    assert "<th>status</th><td>equilibrium</td>" in table and "<th>c</th><td>0.45</td>" in table
    assert "&lt;=" in table and "<=" not in table, "an inequality is no tag"
    assert pickle.loads(pickle.dumps(summary)) == summary
    assert pickle.loads(pickle.dumps(summary)).versions.stillpoint == summary.versions.stillpoint


@claim("the history has the way of a wall, a rigid body and a support beside the forces that they take")
def _(_folder):
    wall = stillpoint.Simulation(stillpoint.load("problems/slope.toml", {"grid.cells": [24, 12]})).run(2).history
    assert wall["t"][-1] == 2 and np.array_equal(wall["wall.motion"], 0.05 * wall["t"])
    pressed = {"rigid[0].motion": ["0", "-(gap+delta)*min(t,1)"], "support[0].u": "0.001*t", "stop.time": 2}
    history = stillpoint.Simulation(stillpoint.load("problems/ladder/pressed_plate.toml", pressed)).run().history
    way = np.minimum(history["t"], 1)
    assert np.array_equal(history["plate.motion_y"], -(0.005 + 0.01) * way) and history["t"][-1] == 2
    assert np.array_equal(history["floor.motion_y"], 0.001 * history["t"]), history["floor.motion_y"]
    assert "plate.motion_x" not in history.dtype.names, "it stays where it is along x"


@claim("a static solver and a multigrid mass are scenes like others, with arrays")
def _(_folder):
    solved = stillpoint.Simulation(stillpoint.load(BAR, {"solve.method": "newton"})).run()
    assert solved.status == "equilibrium" and abs(solved.points.displacement[11] - 0.00958333333) < 1e-9
    scene = stillpoint.load("problems/block.toml", {"mass": {"kind": "multigrid"}, "damping": {"strategy": "viscous"}})
    moving = stillpoint.Simulation(scene)
    for _ in range(5):
        moving.step()
    v = moving.unknowns.v
    assert np.linalg.norm(v) > 0 and not v.flags.writeable
    raised(ValueError, moving.unknowns.mass_product, v)
    moving.run()
    assert moving.status == "equilibrium" and np.linalg.norm(moving.unknowns.residual()) < 1e-3


@claim("a factor of safety is a bracket with its reasons, of a file and of a dictionary")
def _(folder):
    slope = {"grid.cells": [34, 11]}
    study = stillpoint.safety("problems/stable_slope.toml", slope, first=1.2, last=1.6, width=0.1, out=folder)
    assert study.found and 1.3 < study.factor_low < study.factor_high < 1.5
    assert np.all(np.diff(study.factors) > 0) and study.displacements[-1] > 0
    assert {one.verdict for one in study.verdicts} == {"rests", "moves"} and all(one.reason for one in study.verdicts)
    written = json.loads((folder / "safety.json").read_text(encoding="utf-8"))
    assert written["factor_low"] == study.factor_low and (folder / "report.html").exists()
    table = {**table_of("problems/stable_slope.toml"), "grid": {"min": [0, 0], "max": [34, 11], "cells": [34, 11]}}
    again = stillpoint.safety(table, first=1.2, last=1.6, width=0.1)
    assert [one.verdict for one in again.verdicts] == [one.verdict for one in study.verdicts]
    raised(ValueError, stillpoint.safety, table, width=0)
    raised(stillpoint.SceneError, stillpoint.safety, BAR)


@claim("a comparison has its runs with their ways as arrays, of a file and of a dictionary")
def _(folder):
    options = {"strategies": ["auto", "kinetic"], "integrators": ["leapfrog"], "repeats": 1}
    of_file = stillpoint.compare(BAR, out=folder, **options)
    of_table = stillpoint.compare(table_of(BAR), **options)
    for comparison in of_file, of_table:
        ways = {run.label: run for run in comparison.runs}
        kinetic = ways["kinetic 0.9"]
        assert "auto" in ways and ways["auto"].status == "converged"
        assert kinetic.status == "converged" and kinetic.samples["error"][-1] < 1e-6
        assert np.all(np.diff(kinetic.samples["evaluations"]) > 0)
    assert [run.evaluations for run in of_file.runs] == [run.evaluations for run in of_table.runs]
    assert (folder / "compare.csv").exists()
    error = raised(stillpoint.SceneError, stillpoint.compare, {**table_of(BAR), "mass": {"kind": 3}})
    assert error.problems[0].where == "mass.kind", error.problems
    raised(stillpoint.SceneError, stillpoint.compare, BAR, strategies=["none-such"])


@claim("studies of a dictionary read and write no file")
def _(folder):
    import tempfile

    tempfile.tempdir = str(folder / "no-such-folder")
    table = table_of(BAR)
    os.chdir(folder)
    assert stillpoint.compare(table, strategies=["auto"], integrators=["leapfrog"], repeats=0).runs[0].status == "converged"
    varied = stillpoint.converge(table, levels=2, dominant=False, vary=["grid.basis=linear,quadratic"])
    assert [one.set for one in varied.series] == [["grid.basis=linear"], ["grid.basis=quadratic"]]
    assert stillpoint.spectrum(table).omega_1 > 0 and stillpoint.run(table).status == "equilibrium"
    assert not list(folder.iterdir()), list(folder.iterdir())


@claim("a study of a scene is one of what was read, with more laid over it, whatever has become of its file")
def _(folder):
    file = Path(shutil.copy(BAR, folder))
    scene = stillpoint.load(file, {"grid.cells": 5})
    file.unlink()
    study = stillpoint.converge(scene, {"grid.basis": "quadratic"}, levels=2, dominant=False, out=folder / "out")
    assert [level.set for level in study.levels] == [["grid.cells=[5]"], ["grid.cells=[10]"]], study.levels
    page = (folder / "out/report.html").read_text(encoding="utf-8")
    assert "grid.cells=5" in page and 'grid.basis=\\"quadratic\\"' in page
    assert json.loads((folder / "out/converge.json").read_text(encoding="utf-8"))["scene"] == study.scene == "bar"


@claim("an option that a study cannot take is named")
def _(_folder):
    for study, kind, name, value in (
        (stillpoint.compare, TypeError, "goal", "small"),
        (stillpoint.compare, TypeError, "strategies", "kinetic"),
        (stillpoint.compare, TypeError, "repeats", 1.5),
        (stillpoint.compare, TypeError, "seed", -1),
        (stillpoint.converge, TypeError, "refine", 3),
        (stillpoint.converge, ValueError, "refine", []),
        (stillpoint.converge, ValueError, "levels", 1),
        (stillpoint.converge, ValueError, "ratio", float("nan")),
    ):
        error = raised(kind, study, BAR, **{name: value})
        assert str(error).startswith(f"{name}: expected "), error
    assert "'x'" in str(raised(ValueError, stillpoint.converge, BAR, refine=["x"]))
    assert "vary: List[str]" in str(raised(TypeError, stillpoint.converge, BAR, vary="grid.cells=4,8"))
    error = raised(stillpoint.SceneError, stillpoint.converge, BAR, vary=["grid.cells=4"])
    assert error.problems[0].where == "vary grid.cells=4", error.problems


@claim("a convergence study has its errors as arrays of the levels, and falls by the order of the basis")
def _(_folder):
    study = stillpoint.converge("problems/mms_bar.toml", levels=3, dominant=False)
    errors = study.quantities.u_l2.errors
    assert study.sizes.shape == errors.shape == (3,) and np.allclose(study.sizes[:-1] / study.sizes[1:], 2)
    assert np.all(np.log2(errors[:-1] / errors[1:]) > 3.5) and abs(study.orders.u_l2.order - 4) < 0.4
    varied = stillpoint.converge("problems/mms_bar.toml", levels=2, dominant=False, vary=["body.points_per_cell=4,5"])
    assert [one.set for one in varied.series] == [["body.points_per_cell=4"], ["body.points_per_cell=5"]]
    assert varied.series[0].dofs.shape == (2,)


@claim("the spectrum has the frequencies of the bar and the critical step of every integrator")
def _(_folder):
    spectrum = stillpoint.spectrum(BAR)
    assert abs(spectrum.omega_1 - 0.15707217) < 1e-8 and abs(spectrum.omega_max - 5.81539857) < 1e-8
    assert spectrum.kappa == (spectrum.omega_max / spectrum.omega_1) ** 2
    steps = spectrum.critical_steps
    assert {"leapfrog", "erk:rk4"} <= set(steps["method"]) and np.all(steps["step"] > 0)
    assert spectrum.estimates["omega"][spectrum.estimates["what"] == "omega_max"].min() > 5.8


@claim("a simulation is saved and resumed with the same bits")
def _(folder):
    whole = stillpoint.Simulation(BAR)
    for _ in range(100):
        whole.step()
    whole.save(folder / "state.h5")
    resumed = stillpoint.resume(folder / "state.h5")
    assert resumed.scene.text == BAR.read_text(encoding="utf-8") and resumed.steps == 100
    whole.run(), resumed.run()
    assert np.array_equal(whole.unknowns.u, resumed.unknowns.u)
    assert np.array_equal(whole.history[-len(resumed.history) :], resumed.history)
    error = raised(stillpoint.StateError, stillpoint.resume, folder / "state.h5", "problems/mms_bar.toml")
    assert "another scene" in str(error)
    raised(OSError, whole.save, folder / "no/such/folder/state.h5")


def run_snippets(page, folder):
    """The ```python blocks of a page one after the other, beside the bar and the scenes that it shows."""
    text = (ROOT / page).read_text(encoding="utf-8")
    snippets = re.findall(r"^```python\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    assert snippets
    shutil.copy(BAR, folder / "bar.toml")
    for name, scene in re.findall(r"^```toml (\S+)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        (folder / name).write_text(scene, encoding="utf-8")
    program = f"import sys; sys.path.insert(0, {sys.argv[3]!r})\n" + "\n".join(snippets)
    result = subprocess.run(["/usr/bin/python3", "-c", program], capture_output=True, text=True, cwd=folder)
    assert result.returncode == 0, result.stderr


@claim("the snippets of the README run as they stand, one after the other")
def _(folder):
    run_snippets("README.md", folder)


@claim("the snippets of the manual's chapter on programs run as they stand, one after the other")
def _(folder):
    run_snippets("problems/manual/programs.md", folder)


@claim("the installed package runs from where it was put, with its multigrid")
def _(folder):
    build = Path(sys.argv[3]).parent
    installed = subprocess.run(["cmake", "--install", build, "--prefix", folder], capture_output=True, text=True)
    assert installed.returncode == 0, installed
    (place,) = folder.glob("lib/python3*/dist-packages")
    program = """
import stillpoint
scene = stillpoint.load("problems/block.toml", mass={"kind": "multigrid"}, damping={"strategy": "auto"})
print(stillpoint.__file__, stillpoint.Simulation(scene).run().status)
"""
    environment = os.environ | {"PYTHONPATH": str(place)}
    result = subprocess.run(["/usr/bin/python3", "-c", program], capture_output=True, text=True, cwd=ROOT, env=environment)
    assert result.stdout == f"{place}/stillpoint/__init__.py equilibrium\n", result


@claim("the stubs name what the compiled half has, and mypy finds nothing wrong with the package")
def _(folder):
    import ast

    from stillpoint import _core

    stub = ast.parse((ROOT / "src/python/stillpoint/_core.pyi").read_text(encoding="utf-8"))
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    of_laws = {"__getattr__"}
    there = {name for name in vars(_core) if not name.startswith("_")}
    assert there == set(classes) | functions, there ^ (set(classes) | functions)
    computed = {"position", "initial_position", "displacement", "velocity", "strain", "stress", "volume", "mass"}
    for name, node in classes.items():
        stubbed = {inner.name for inner in node.body if isinstance(inner, ast.FunctionDef)} - of_laws
        own = {key for key in vars(getattr(_core, name)) if not key.startswith("_") or key == "__len__"}
        if name == "Points":
            own |= computed
        assert own == stubbed - {"__init__"}, (name, own ^ stubbed)
    if shutil.which("mypy"):
        checked = subprocess.run(
            ["mypy", "--strict", "--python-executable", "/usr/bin/python3", "--cache-dir", str(folder),
             str(ROOT / "src/python/stillpoint")], capture_output=True, text=True)  # fmt: skip
        assert checked.returncode == 0, checked.stdout


check_the_claim()
