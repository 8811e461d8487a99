#!/usr/bin/python3
"""layers_test.py ROOT CLAIM PROGRAM: one claim about the scripts that hold the rooms of src/ apart."""

import shutil

from claims import ROOT, call, check_the_claim, claim


def check_with(folder, script, file, line):
    """What the script says of the tree with one more line at the end of a file."""
    for part in ("src", "include"):
        shutil.copytree(ROOT / part, folder / part)
    clean = call(ROOT / "scripts" / script, folder)
    assert clean.returncode == 0 and clean.stdout == "", clean
    with open(folder / file, "a", encoding="utf-8") as planted:
        planted.write(line + "\n")
    return call(ROOT / "scripts" / script, folder)


@claim("a planted include of a room below is found, with its file and line")
def _(folder):
    result = check_with(folder, "check_layers", "src/linalg/vector.cpp", '#include "space/grid/grid.hpp"')
    assert result.returncode == 1, result
    assert result.stdout.startswith("src/linalg/vector.cpp:"), result.stdout
    assert "linalg includes space/grid, which is below it" in result.stdout, result.stdout


@claim("a planted include that does not name its room is found")
def _(folder):
    result = check_with(folder, "check_layers", "src/linalg/vector.cpp", '#include "vector_operations.hpp"')
    assert result.returncode == 1 and "expected a room before the file" in result.stdout, result


@claim("a planted comparison with a damping's name is found, with its file and line")
def _(folder):
    result = check_with(folder, "check_names", "src/simulation/model.cpp", 'bool b = strategy == "viscous";')
    assert result.returncode == 1, result
    assert result.stdout.startswith("src/simulation/model.cpp:") and result.stdout.count("\n") == 1, result.stdout


check_the_claim()
