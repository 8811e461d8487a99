#!/usr/bin/python3
"""scripts_test.py ROOT CLAIM PROGRAM: one claim about the scripts of the source tree ROOT. PROGRAM is write_fields."""

import json
import os
import shutil
import sys

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, plot, plots_module

HEADER = "t,steps,rhs_evaluations,residual,kinetic_energy,p6.u,p6.stress\n"
HISTORY = HEADER + "0,0,1,1,0,0,0\n1,10,11,0.5,0.1,0.001,0.002\n2,20,21,,0,0.002,0.001\n"
SCENE = """
title = "costs $5 or $6"
[[variant]]
name = "c = 1"
set = ["damping.c=1", "stop.residual=0"]
[[variant]]
name = "C = 1!"
"""
# Stands for build/release/stillpoint: writes a history, and fields if there are any, notes how it was called, and ends
# with the status 3.
PROGRAM = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"; echo >>"$CALLS"
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"; cp "$HISTORY" "$2/history.csv"
[[ -z ${FIELDS:-} ]] || cp "$FIELDS" "$2/fields.h5"
exit 3
"""


def is_refused(folder, *words):
    """Drawing a history ends with status 2, says these words in one line, and draws nothing."""
    result = plot("history", folder)
    assert result.returncode == 2, result
    assert all(word in result.stderr for word in words) and result.stderr.count("\n") == 1, result.stderr
    assert not (folder / "history.png").exists()


def a_history_is_refused(folder, text, *words):
    (folder / "history.csv").write_text(text)
    is_refused(folder, *words)


@claim("the programs that draw go by their earlier names too")
def _(folder):
    (folder / "history.csv").write_text("t,steps,u\n0,0,0\n1,1,2\n")
    result = call(ROOT / "scripts/plot_history.py", folder)
    assert result.returncode == 0 and (folder / "history.png").exists(), result
    for kind, file in (("fields", "fields.h5"), ("compare", "compare.json"), ("converge", "converge.json")):
        result = call(ROOT / f"scripts/plot_{kind}.py", folder)
        assert result.returncode == 2 and f"no {file}" in result.stderr, result


@claim("a folder without a history is refused with status 2")
def _(folder):
    is_refused(folder, str(folder), "no history.csv")
    is_refused(folder / "missing", "no history.csv")


@claim("a history without rows is refused with status 2")
def _(folder):
    a_history_is_refused(folder, HEADER, "history.csv", "no rows")
    a_history_is_refused(folder, "", "history.csv", "name the columns")


@claim("a history that is no table of numbers is refused with status 2")
def _(folder):
    a_history_is_refused(folder, HISTORY + "3,30\n", "row 5 has 2 cells, expected 7")
    a_history_is_refused(folder, HISTORY + "3,30,31,0,0,soft,0\n", "soft")
    a_history_is_refused(folder, "x,y\n1,2\n", "one of them t")
    a_history_is_refused(folder, "\0PNG", "history.csv")


def panels_of(*folders):
    """{field: (label, x, lines)} of the panels that are drawn, in their order."""
    read_run = plots_module("history_runs").read_run
    panels = plots_module("history_panels").panels_of([read_run(folder) for folder in folders])
    return {field: (panel.label, panel.x_label, panel.names()) for field, panel in panels.items()}


def written(folder, text, **summary):
    """The folder of a run with this history, drawn without a word of complaint."""
    folder.mkdir(exist_ok=True)
    (folder / "history.csv").write_text(text)
    (folder / "summary.json").write_text(json.dumps(summary))
    result = plot("history", folder)
    assert result.returncode == 0 and not result.stderr and (folder / "history.png").stat().st_size > 0, result
    return folder


@claim("a history without probes is drawn by its residual and kinetic energy")
def _(folder):
    header = "t,steps,rhs_evaluations,residual,kinetic_energy\n"
    written(folder, header + "0,0,0,1,0\n1,9,9,nan,inf\n")  # neither varies: both are drawn
    assert list(panels_of(folder)) == ["residual", "energy"]
    assert list(panels_of(written(folder, header + "0,0,0,1,0\n1,9,9,0.5,0\n"))) == ["residual"]


PLANE = """t,steps,rhs_evaluations,residual,kinetic_energy,toe.stress.xy,toe.hardness,toe.u.x,toe.u.y,the.crest.u.x,\
surface.slope_angle,left.normal,left.shear,back.shear.y,base.reaction_x,base.reaction_y,punch.force_y,punch.moment_z,\
inertia.external_work,inertia.kinetic_over_work
0,0,1,1,0,-1,7,0,0,0,nan,5,1,0,0,1,0,-1200,0,nan
1,10,11,0.1,0,4,8,1,2,3,31.5,-5,2,1,0,2,3,-1200.0000001,10,1e-3
"""


@claim("a history has a panel a kind of field, with its unit and a line a component: probes, forces, residual and energies, and none of what is constant")
def _(folder):
    panels = panels_of(written(folder, PLANE))
    assert list(panels.items()) == [
        ("u", ("displacement $u$ [m]", "time $t$ [s]", ["toe x", "toe y", "the.crest x"])),
        ("stress", ("stress [Pa]", "time $t$ [s]", ["toe xy"])),
        ("hardness", ("hardness", "time $t$ [s]", ["toe"])),
        ("force", ("force [N]", "time $t$ [s]", ["left normal", "left shear", "back shear y", "punch y"])),
        ("reaction", ("reaction [N]", "time $t$ [s]", ["base x", "base y"])),
        ("residual", ("residual $‖F − R‖/‖F‖$", "time $t$ [s]", [])),
        ("energy", ("energy [J]", "time $t$ [s]", ["external work"])),
    ], panels


@claim("a history whose time stands still is drawn against the steps of the solver")
def _(folder):
    written(folder, "t,steps,rhs_evaluations,residual,kinetic_energy,p6.u\n1,0,1,1,0,0\n1,2,3,1e-3,0,2\n")
    panels = panels_of(folder)
    assert {name: panel[1] for name, panel in panels.items()} == dict.fromkeys(["u", "residual"], "steps of the solver"), panels


LOADED = """t,steps,rhs_evaluations,residual,kinetic_energy,load.factor,load.displacement
0,0,1,0,0,0,0
1,10,11,1e-3,1e-3,3,{q}
2,20,21,2e-3,1e-4,5,0.004
"""


@claim("where a displacement drives the loads their factor against it is the first panel, of two runs as of one")
def _(folder):
    runs = [written(folder / name, LOADED.format(q=q), load={"factor": 5}) for name, q in (("a", 0.001), ("b", 0.002))]
    for some in (runs[:1], runs):
        panels = panels_of(*some)
        assert list(panels) == ["load", "residual", "energy"], panels
        assert panels["load"] == (r"load factor $\lambda$", "mean displacement along the loads [m]", []), panels
    axis = plots_module("history").figure_of(*plots_module("history_runs").find_runs(runs)).axes[0]
    assert [line.get_xydata().tolist() for line in axis.lines] == [[[0, 0], [q, 3], [0.004, 5]] for q in (0.001, 0.002)]


DRIVEN = """t,steps,rhs_evaluations,residual,kinetic_energy,plate.normal,plate.shear,punch.force_x,punch.force_y,\
plate.motion,punch.motion_x,punch.motion_y
0,0,1,1,0,0,0,0,0,0,0,0
1,9,9,2,0,5,1,1,-7,-0.1,0.1,-0.3
"""


@claim("the force of what is driven is drawn against its motion, along the axis of its longest way, before all others")
def _(folder):
    panels = panels_of(written(folder, DRIVEN))
    assert list(panels)[:3] == ["plate", "punch", "force"] and "motion" not in panels, panels
    assert panels["plate"] == ("force of plate [N]", "its displacement [m]", [])
    assert panels["punch"] == ("force of punch along y [N]", "its displacement along y [m]", [])
    axis = plots_module("history").figure_of(*plots_module("history_runs").find_runs([folder])).axes[1]
    assert axis.lines[0].get_xydata().tolist() == [[0, 0], [-0.3, -7]] and axis.get_xlim() == (0, -0.3)


@claim("scripts/run without a scene says how to use it, with status 2")
def _(_folder):
    result = call(ROOT / "scripts/run")
    assert result.returncode == 2 and "usage" in result.stderr and "SCENE" in result.stderr, result


def a_copy(folder):
    """scripts/run of a copy whose program leaves a history, and its environment."""
    scripts, environment = copy_of_scripts(folder, PROGRAM)
    (folder / "my scene.toml").write_text(SCENE)
    (folder / "rows").write_text(HISTORY)
    return scripts / "run", environment | {"HISTORY": str(folder / "rows")}


@claim("scripts/run runs a scene and its variants, draws them, and ends with the status of the run")
def _(folder):
    script, environment = a_copy(folder)
    result = call(script, "my scene.toml", "--set", "body.area=2", cwd=folder, env=environment)
    assert result.returncode == 3, result
    assert (folder / "out/my scene/history.png").stat().st_size > 0
    assert "out/my scene/history.png" in result.stdout, result
    user = "<--set><body.area=2>"
    assert (folder / "calls").read_text().splitlines() == [
        f"<run><my scene.toml><--out><out/my scene>{user}",
        f"<run><my scene.toml><--out><out/my scene/c-1>{user}<--set><damping.c=1><--set><stop.residual=0><--quiet>",
        f"<run><my scene.toml><--out><out/my scene/c-1-2>{user}<--quiet>",
    ]
    assert not list(folder.rglob("fields.png"))


@claim("scripts/run draws the fields of each run that wrote some, and none of an earlier run")
def _(folder):
    script, environment = a_copy(folder)
    call(sys.argv[3], "plane", folder)
    result = call(script, "my scene.toml", cwd=folder, env=environment | {"FIELDS": str(folder / "fields.h5")})
    assert result.returncode == 3, result
    out = folder / "out/my scene"
    pictures = [out / run / "fields.png" for run in ("", "c-1", "c-1-2")]
    for picture in pictures:
        assert picture.stat().st_size > 0 and f"Picture: {picture.relative_to(folder)}" in result.stdout, result
        picture.unlink()
        os.utime(picture.with_name("fields.h5"), (0, 0))
    assert call(script, "my scene.toml", cwd=folder, env=environment).returncode == 3
    assert not any(picture.exists() for picture in pictures)


@claim("packages that cannot be installed are named, with status 2")
def _(folder):
    for tool in ("dirname", "grep"):  # a machine with neither apt-get nor any package
        (folder / tool).symlink_to(shutil.which(tool))
    result = call("/bin/bash", ROOT / "scripts/install_packages", "run", env={"PATH": str(folder)})
    assert result.returncode == 2 and "libsundials-dev" in result.stderr and "catch2" not in result.stderr, result


if __name__ == "__main__":
    check_the_claim()
