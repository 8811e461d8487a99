#!/usr/bin/python3
"""scripts_test.py ROOT CLAIM: one claim about the scripts of the source tree ROOT."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])
CLAIMS = {}

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
# Stands for build/release/stillpoint: writes a history, notes how it was called, and ends with the status 3.
PROGRAM = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"; echo >>"$CALLS"
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"; cp "$HISTORY" "$2/history.csv"
exit 3
"""


def claim(text):
    return lambda function: CLAIMS.setdefault(text, function)


def call(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def is_refused(folder, *words):
    """plot_history.py ends with status 2, says these words in one line, and draws nothing."""
    result = call(ROOT / "scripts/plot_history.py", folder)
    assert result.returncode == 2, result
    assert all(word in result.stderr for word in words) and result.stderr.count("\n") == 1, result.stderr
    assert not (folder / "history.png").exists()


def a_history_is_refused(folder, text, *words):
    (folder / "history.csv").write_text(text)
    is_refused(folder, *words)


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


@claim("a history without probes is drawn by its residual and kinetic energy")
def _(folder):
    (folder / "history.csv").write_text("t,steps,rhs_evaluations,residual,kinetic_energy\n0,0,0,1,0\n1,9,9,nan,inf\n")
    result = call(ROOT / "scripts/plot_history.py", folder)
    assert result.returncode == 0 and (folder / "history.png").stat().st_size > 0, result


@claim("scripts/run without a scene says how to use it, with status 2")
def _(_folder):
    result = call(ROOT / "scripts/run")
    assert result.returncode == 2 and "usage" in result.stderr and "SCENE" in result.stderr, result


@claim("scripts/run runs a scene and its variants, draws them, and ends with the status of the run")
def _(folder):
    root = folder / "a copy"
    shutil.copytree(ROOT / "scripts", root / "scripts")
    (root / "build/release").mkdir(parents=True)
    stubs = {"scripts/install_packages": "", "scripts/build_preset": "", "build/release/stillpoint": PROGRAM}
    for name, text in stubs.items():
        (root / name).write_text(text or "#!/bin/bash\n")
        (root / name).chmod(0o755)
    (folder / "my scene.toml").write_text(SCENE)
    (folder / "rows").write_text(HISTORY)

    environment = os.environ | {"CALLS": str(folder / "calls"), "HISTORY": str(folder / "rows")}
    result = call(root / "scripts/run", "my scene.toml", "--set", "body.area=2", cwd=folder, env=environment)
    assert result.returncode == 3, result
    assert (folder / "out/my scene/history.png").stat().st_size > 0
    assert "out/my scene/history.png" in result.stdout, result
    user = "<--set><body.area=2>"
    assert (folder / "calls").read_text().splitlines() == [
        f"<run><my scene.toml><--out><out/my scene>{user}",
        f"<run><my scene.toml><--out><out/my scene/c-1>{user}<--set><damping.c=1><--set><stop.residual=0><--quiet>",
        f"<run><my scene.toml><--out><out/my scene/c-1-2>{user}<--quiet>",
    ]


@claim("packages that cannot be installed are named, with status 2")
def _(folder):
    for tool in ("dirname", "grep"):  # a machine with neither apt-get nor any package
        (folder / tool).symlink_to(shutil.which(tool))
    result = call("/bin/bash", ROOT / "scripts/install_packages", "run", env={"PATH": str(folder)})
    assert result.returncode == 2 and "libsundials-dev" in result.stderr and "catch2" not in result.stderr, result


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        CLAIMS[sys.argv[2]](Path(temporary))
