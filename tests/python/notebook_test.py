#!/usr/bin/python3
"""notebook_test.py ROOT CLAIM PACKAGE: one claim about the notebooks among the tutorials."""

from modules import ROOT, raised  # first: finds the package

import ast
import json
import os
import re

from claims import check_the_claim, claim

NOTEBOOKS = sorted((ROOT / "problems/tutorials").glob("*.ipynb"))


def cells_of(notebook, kind):
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in cells if cell["cell_type"] == kind]


def run_cell(source, names):
    """Runs a cell among the names of those before it; returns the value of its last line if that is an expression."""
    body = ast.parse(source).body
    last = body.pop() if body and isinstance(body[-1], ast.Expr) else None
    exec(compile(ast.Module(body, []), "<cell>", "exec"), names)
    return eval(compile(ast.Expression(last.value), "<cell>", "eval"), names) if last else None


def shown(value):
    """Of which kind is what a notebook shows below a cell."""
    if hasattr(value, "_repr_png_"):
        assert value._repr_png_().startswith(b"\x89PNG")
        return "picture"
    return "table" if hasattr(value, "_repr_html_") and value._repr_html_() else "text"


def run(notebook):
    """(the names that its cells leave, what each cell shows)"""
    os.chdir(notebook.parent)
    names = {"__name__": "__main__"}
    return names, [shown(run_cell("".join(cell["source"]), names)) for cell in cells_of(notebook, "code")]


@claim("the cells of the notebook run one after the other, and show their pictures and tables")
def _(_folder):
    names, kinds = run(ROOT / "problems/tutorials/notebook.ipynb")
    assert names["simulation"].status == "equilibrium" and len(names["runs"]) == 3
    assert {one.status for one in names["comparison"].runs} == {"converged"}
    assert abs(names["order"].order - names["order"].theory) < 0.3
    assert kinds.count("picture") == 5 and kinds.count("table") == 4, kinds


@claim("a cell that fails ends the run of a notebook, with what it raised")
def _(folder):
    cells = [{"cell_type": "code", "source": [line]} for line in ("a = 1\n", "a = b\n", "a = 3\n")]
    (folder / "wrong.ipynb").write_text(json.dumps({"cells": cells}), encoding="utf-8")
    assert "'b'" in str(raised(NameError, run, folder / "wrong.ipynb"))


@claim("a notebook holds no output, says where to run it, ends with what comes next, and its links lead somewhere")
def _(_folder):
    assert NOTEBOOKS
    for notebook in NOTEBOOKS:
        assert json.loads(notebook.read_text(encoding="utf-8"))["nbformat"] == 4
        assert not any(cell["outputs"] or cell["execution_count"] for cell in cells_of(notebook, "code")), notebook
        texts = ["".join(cell["source"]) for cell in cells_of(notebook, "markdown")]
        assert "**Where to run it.**" in texts[0] and texts[-1].startswith("## What next\n"), notebook
        for link in re.findall(r"\]\(([^)\s#]+)", "\n".join(texts)):
            assert (notebook.parent / link).exists(), (notebook, link)


check_the_claim()
