#!/usr/bin/python3
"""plot_command_test.py ROOT CLAIM PROGRAM: one claim about `stillpoint plot`, by the command that lies where PROGRAM does."""

import json
import os
import shutil
import sys
from pathlib import Path

import numpy as np
from claims import PLOTS, call, check_the_claim, claim
from field_pictures import write as write_fields

COMMAND = Path(sys.argv[3]).parent / "stillpoint"
HISTORY = "t,steps,rhs_evaluations,residual,kinetic_energy,tip.u\n0,0,1,1,0,0\n1,9,10,0.1,0.2,0.3\n"
RUN = {"label": "auto", "status": "converged", "evaluations": 9, "error": 1e-7, "residual": 1e-8, "wall_s": None,
       "samples": [[3, 1e-2, 1e-3, None], [9, 1e-7, 1e-8, None]]}  # fmt: skip
COMPARISON = {"title": "a", "goal": 1e-6, "goal_of": "error", "kappa": 99.0, "lower_bound": 7.0, "runs": [RUN]}
LEVELS = [{"size": 0.5, "wall_s": 0.1}, {"size": 0.25, "wall_s": 0.3}]
STUDY = {"title": "a", "refined": ["h"], "reference": "the finest", "levels": LEVELS, "orders": {},
         "quantities": {"u_l2": {"errors": [0.16, 0.04]}}}  # fmt: skip
STUDIES = {"compare": COMPARISON, "converge": STUDY}


def drawn(*words, **environment):
    """What `stillpoint plot` comes to without a display."""
    settings = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return call(COMMAND, "plot", *words, env=settings | environment)


def a_folder(folder):
    """One with something to draw of each kind."""
    side = (np.arange(5) + 0.5) / 5
    place = np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3)
    write_fields(folder, [{"t": t, "place": place, "u": place * t} for t in (0.0, 1.0)], dim=3)
    (folder / "history.csv").write_text(HISTORY)
    for name, study in STUDIES.items():
        (folder / f"{name}.json").write_text(json.dumps(study))
    return folder


def is_refused(result, *words):
    """In one line, which has these words."""
    assert result.returncode == 2 and not result.stdout, result
    assert all(word in result.stderr for word in words) and result.stderr.count("\n") == 1, result.stderr


@claim("stillpoint plot draws each kind of picture without a display, beside the results or into a file of any format")
def _(folder):
    a_folder(folder)
    for kind in ("history", "fields", "compare", "converge"):
        for environment in ({}, {"MPLBACKEND": "TkAgg"}):
            result = drawn(kind, folder, **environment)
            assert result.returncode == 0 and result.stdout == f"Picture: {folder / kind}.png\n", result
            assert not result.stderr and (folder / f"{kind}.png").read_bytes().startswith(b"\x89PNG")
    options = ["--field", "u_x", "--cut", "x=0.5", "--cut", "z=0.5", "--stages", 1]
    result = drawn("fields", folder, *options, "--out", folder / "a.pdf")
    assert result.returncode == 0 and (folder / "a.pdf").read_bytes().startswith(b"%PDF"), result
    is_refused(drawn("history", folder, "--out", folder / "a.abc"), "a.abc", ".png")
    is_refused(drawn("history", folder, "--out", folder / "none/a.png"), "none/a.png")


@claim("stillpoint plot draws several runs side by side, and names its options in its help")
def _(folder):
    runs = [a_folder(folder / name) for name in ("-a", "b c")]
    result = drawn("history", *runs, "--out", folder / "both.png")
    assert result.returncode == 0 and (folder / "both.png").stat().st_size > 0, result
    help_text = drawn("--help").stdout
    assert all(f"--{option} " in help_text for option in ("out", "field", "cut", "stages", "show")), help_text


@claim("stillpoint plot refuses a folder without what is to be drawn in one line, with status 2")
def _(folder):
    files = {"history": "history.csv", "fields": "fields.h5", "compare": "compare.json", "converge": "converge.json"}
    for kind, file in files.items():
        for where in (folder, folder / "missing"):
            is_refused(drawn(kind, where), f"plot {kind}: {where}: no {file}")
    (folder / "compare.json").write_text('{"runs": [{"label": "a"}]}')
    is_refused(drawn("compare", folder), "compare.json", "goal_of")
    assert drawn("picture", folder).returncode == 2 and drawn("history").returncode == 2
    assert not list(folder.glob("*.png"))


@claim("stillpoint plot refuses an option of another kind of picture and a second folder of a study, with status 2")
def _(folder):
    a_folder(folder)
    for option in (["--field", "u"], ["--cut", "x=1"], ["--stages", "2"]):
        is_refused(drawn("history", folder, *option), option[0], "fields")
    is_refused(drawn("compare", folder, folder), "expected one DIR")
    is_refused(drawn("fields", folder, "--field", "heat"), "no field 'heat'; there are u, u_x")
    is_refused(drawn("fields", folder, "--cut", "x=9"), "the cut x=9")


@claim("a module that a picture needs and that is missing is named with its Debian package, and no other is asked for")
def _(folder):
    a_folder(folder)
    for name in ("numpy", "matplotlib", "h5py"):
        hidden = folder / f"without {name}"
        hidden.mkdir()
        (hidden / f"{name}.py").write_text(f"raise ModuleNotFoundError('no {name}', name='{name}')")
        is_refused(drawn("fields", folder, PYTHONPATH=str(hidden)), f"'{name}'", f"python3-{name}")
    for kind in ("history", "compare", "converge"):
        result = drawn(kind, folder, PYTHONPATH=str(folder / "without h5py"))
        assert result.returncode == 0, result
    (folder / "without numpy/numpy.py").write_text("raise ImportError('for another Python')")
    is_refused(drawn("history", folder, PYTHONPATH=str(folder / "without numpy")), "cannot load", "python3-numpy")


@claim("the variable STILLPOINT_PYTHON names the Python that draws, and one that cannot be started is told")
def _(folder):
    a_folder(folder)
    python = folder / "my python"
    python.write_text(f'#!/bin/bash\necho "$@" >"{folder}/called"\nexec /usr/bin/python3 "$@"\n')
    python.chmod(0o755)
    assert drawn("history", folder, STILLPOINT_PYTHON=str(python)).returncode == 0
    assert "plots history" in (folder / "called").read_text()
    is_refused(drawn("history", folder, STILLPOINT_PYTHON="python0"), "python0", "STILLPOINT_PYTHON")


@claim("what draws needs nothing that is compiled, and leaves nothing but the picture")
def _(folder):
    a_folder(folder)
    shutil.copytree(PLOTS, folder / "any name/plots", ignore=shutil.ignore_patterns("__pycache__"))
    result = call("/usr/bin/python3", "-B", folder / "any name/plots", "history", folder, cwd=folder)
    assert result.returncode == 0 and result.stdout == f"Picture: {folder / 'history.png'}\n", result
    before = {file.stat().st_mtime_ns for file in COMMAND.parent.glob("python/stillpoint/plots/*")}
    assert drawn("history", folder).returncode == 0
    assert {file.stat().st_mtime_ns for file in COMMAND.parent.glob("python/stillpoint/plots/*")} == before


# Stands for a backend with windows: notes that they were shown, until they are closed.
BACKEND = """
from matplotlib.backend_bases import FigureManagerBase as FigureManager
from matplotlib.backends.backend_agg import FigureCanvasAgg

class FigureCanvas(FigureCanvasAgg):
    required_interactive_framework = ""  # one with windows, but without a display

def show(*arguments, **options):
    print("shown")
"""


@claim("--show opens a window with the picture where there can be one, and is refused where there is none")
def _(folder):
    a_folder(folder)
    (folder / "windows.py").write_text(BACKEND)
    result = drawn("history", folder, "--show", MPLBACKEND="module://windows", PYTHONPATH=str(folder))
    assert result.returncode == 0 and result.stdout == f"Picture: {folder / 'history.png'}\nshown\n", result
    (folder / "history.png").unlink()
    for environment in ({}, {"MPLBACKEND": "Agg"}):
        is_refused(drawn("history", folder, "--show", **environment), "no window", "display")
    assert not (folder / "history.png").exists()


if __name__ == "__main__":
    check_the_claim()
