"""The runs of scripts/beside_fem_limits.py, by FEniCSx and by Stillpoint, each a process of its own on one thread."""

import csv
import json
import os
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

from beside_fem_limits_table import BLOCK, FOOTING, Row
from beside_fem_runs import FEM, OURS, ROOT, on_threads, our_command
from limited_run import run_in
from scene_constants import constants_of

SCENES = {FOOTING: ROOT / "problems/footing_limit.toml", BLOCK: ROOT / "problems/ladder/pressed_block.toml"}
FOOTING_CELLS, BLOCK_CELLS = (12, 24, 48, 96), (8, 16, 32)  # of linear functions along the ground; along a side
QUICK_SIZES = {FOOTING: 2, BLOCK: 1}


@dataclass(frozen=True)
class Way:
    problem: str
    program: str
    functions: str
    settings: tuple[str, ...] = ()  # of the scene
    coarser: int = 1  # by how much the cells are larger than those of linear functions

    def cells(self, size):
        return size // self.coarser


WAYS = [
    Way(FOOTING, FEM, "Q1-1"),
    Way(FOOTING, FEM, "Q1-B"),
    Way(FOOTING, FEM, "P2-R", coarser=2),
    Way(FOOTING, FEM, "Q2-R", coarser=2),
    Way(FOOTING, FEM, "Q2-B", coarser=2),
    Way(FOOTING, OURS, "linear, 1 point", ("body.points_per_cell=1", "phase.dilatation=points")),
    Way(FOOTING, OURS, "linear, 4 points", ("body.points_per_cell=4", "phase.dilatation=cells")),
    *(Way(BLOCK, FEM, f"{element}, {sides}") for sides in ("free", "stick") for element in ("Q1", "P2", "Q2")),
    Way(BLOCK, OURS, "linear", ("grid.basis=linear", "body.points_per_cell=4")),
    Way(BLOCK, OURS, "quadratic", ("grid.basis=quadratic", "body.points_per_cell=9")),
]
QUICK = ("Q2-B", "linear, 1 point", "Q2, free", "Q2, stick", "quadratic")


def ways_of(problem, quick):
    return [way for way in WAYS if way.problem == problem and (not quick or way.functions in QUICK)]


def sizes_of(problem, quick):
    sizes = FOOTING_CELLS if problem == FOOTING else BLOCK_CELLS
    return sizes[: QUICK_SIZES[problem]] if quick else sizes


def measured(options, way, size):
    """(row, path) of one run."""
    folder = options.out / "runs"
    folder.mkdir(parents=True, exist_ok=True)
    if way.program == FEM:
        return fem_run(way, way.cells(size), folder, options.seconds)
    return our_run(options.program, way, way.cells(size), folder, options.seconds)


# --- FEniCSx -------------------------------------------------------------------------------------------


def fem_run(way, cells, folder, seconds):
    script, file = "fem_plastic.py" if way.problem == FOOTING else "fem_fold.py", folder / "figures.json"
    words = [*way.functions.split(", "), str(cells)]
    row = Row(way.problem, FEM, way.functions, str(cells), command=shlex.join([f"scripts/{script}", *words, "figures.json"]))
    command = ["/usr/bin/python3", str(ROOT / "scripts" / script), *words, str(file)]
    try:
        ended = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False, env=on_threads(1))
    except subprocess.TimeoutExpired:
        return row.missing(f"no end within {seconds:g} s"), []
    if ended.returncode != 0:
        return row.missing((ended.stderr.strip().splitlines() or [f"exit status {ended.returncode}"])[-1]), []
    return with_figures(row, json.loads(file.read_text(encoding="utf-8")))


def with_figures(row, found):
    """(row, path) of what fem_plastic.py or fem_fold.py left."""
    names = ("unknowns", "iterations", "whole_s", "processor_s", "megabytes")
    row = replace(row, **{name: found[name] for name in names})
    if row.problem == FOOTING:
        return replace(row, reached=found["factor"]), found["path"]
    if not found["path"]:
        return row.missing(found["ended"]), []
    compression, _, least_det, _ = found["path"][-1]
    passes = next((place[0] for place in found["path"] if place[3] > 0), None)
    row = replace(row, reached=compression, least_det=least_det, passes=passes, ended=found["ended"])
    return row, [place[:2] for place in found["path"]]


# --- Stillpoint ----------------------------------------------------------------------------------------


def settings_of(way, cells):
    grid = (cells, round(cells * 2 / 3)) if way.problem == FOOTING else (4 * cells, cells)
    return [f"grid.cells=[{grid[0]},{grid[1]}]", *way.settings]


def our_run(program, way, cells, folder, seconds):
    scene, settings = SCENES[way.problem], settings_of(way, cells)
    words = our_command("build/release/stillpoint", os.path.relpath(scene, ROOT), settings)
    row = Row(way.problem, OURS, way.functions, str(cells), command=shlex.join([*words, "--threads", "1"]))
    shutil.rmtree(folder / "run", ignore_errors=True)
    measuring = [sys.executable, "-I", "-S", str(ROOT / "scripts/measured_run.py"), str(folder / "usage.json")]
    run = run_in(folder / "run", measuring + our_command(Path(program).resolve(), scene, settings), seconds)
    what_ended = "" if run.exit_status == 0 else run.summary.get("reason") or run.message or f"exit status {run.exit_status}"
    what_ended = what_ended.replace(f"{ROOT}/", "")
    path = history(way, folder / "run/history.csv", constants_of(scene, settings))
    if not path or "dofs" not in run.summary or (what_ended and way.problem == FOOTING):
        return row.missing(what_ended), []
    took = json.loads((folder / "usage.json").read_text(encoding="utf-8"))
    row = replace(
        row, unknowns=run.summary["dofs"] if way.problem == FOOTING else None, iterations=run.summary["rhs_evaluations"],
        whole_s=took["seconds"], processor_s=took["processor_seconds"], megabytes=took["megabytes"],
        reached=run.summary["load"]["factor"] if way.problem == FOOTING else path[-1][0], ended=what_ended,
    )  # fmt: skip
    return row, path


def history(way, file, constants):
    """[settlement, factor] or [compression, force of the plate] of each row of a run's history."""
    if not file.exists():
        return []
    with open(file, newline="", encoding="utf-8") as table:
        lines = list(csv.DictReader(table))
    if way.problem == FOOTING:
        return [[float(line["load.displacement"]), float(line["load.factor"])] for line in lines]
    pace = constants["most"] / constants["T"]
    return [[pace * float(line["t"]), float(line["plate.normal"])] for line in lines]
