#!/usr/bin/python3
"""scaling.py [--space] [--quick]: how time, evaluations and memory grow with the number of unknowns, by several ways to
rest.

Takes the block of problems/incompressible.toml, compressible and on linear cells, or with --space that under the square
footing of problems/square_load.toml, to a residual of 1e-6 on ever finer grids. Runs go one after another, and each repetition begins with another way, so that what the machine does meanwhile
falls on all of them; of a way's repetitions the fastest counts. Prints a line for each way and size, and writes
DIR/scaling.csv, DIR/scaling.md (a table with exponents, and where one way
overtakes Newton's) and DIR/scaling.png. Exit status 1 if a run does not end in
equilibrium, which leaves its place empty, 2 for bad input. Needs build/release/stillpoint.
"""

import argparse
import json
import os
import re
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from limited_run import run_in
from scaling_table import Figure, line, markdown, write_csv

ROOT = Path(__file__).resolve().parent.parent

@dataclass(frozen=True)
class Body:
    scene: Path
    settings: tuple[str, ...]
    sizes: tuple[tuple[int, ...], ...]  # cells


PLANE = Body(
    ROOT / "problems/incompressible.toml",
    ("constants.nu=0.3", "grid.basis=linear", "stop.residual=1e-6"),
    ((28, 22), (88, 70), (280, 224), (480, 384), (708, 566)),  # 1e3 to 6.4e5 unknowns
)
SPACE = Body(
    ROOT / "problems/square_load.toml",
    ("stop.residual=1e-6",),
    tuple((cells, cells, cells) for cells in (8, 16, 24, 32, 40)),  # 1.7e3 to 1.9e5 unknowns, where factors take 3 GB
)
QUICK_SIZES = 3
LONG, VERY_LONG = 10, 150  # [s]: runs that are repeated once at most, and not at all


@dataclass(frozen=True)
class Way:
    name: str
    settings: tuple[str, ...]

    @property
    def static(self):
        return any(setting.startswith("solve.method=") for setting in self.settings)


WAYS = [
    Way("auto, lumped mass", ("damping.strategy=auto", "mass.kind=lumped")),
    Way("auto, multigrid", ("damping.strategy=auto", "mass.kind=multigrid")),
    Way("viscous, multigrid", ("damping.strategy=viscous", "mass.kind=multigrid")),
    Way("Newton, CHOLMOD", ("solve.method=newton",)),
    Way("Newton-CG, multigrid", ("solve.method=newton-cg", "mass.kind=multigrid")),
    Way("CG, diagonal", ("solve.method=cg",)),
]


# --- a run ---------------------------------------------------------------------------------------------


def without_damping(scene):
    """A scene's text without its table [damping], which static solvers refuse."""
    return re.sub(r"^\[damping\].*\n(?:(?!\[).*\n)*", "", scene, flags=re.MULTILINE)


def command_of(program, scene, settings, way, cells):
    settings = [*settings, *way.settings, f"grid.cells=[{','.join(map(str, cells))}]"]
    return [program, "run", scene, *(word for setting in settings for word in ("--set", setting))]


def measured(options, way, cells):
    """The figure of one run, in a folder that does not stay."""
    with tempfile.TemporaryDirectory(prefix="stillpoint-") as temporary:
        folder, scene = Path(temporary), options.body.scene
        if way.static:
            scene = folder / scene.name
            scene.write_text(without_damping(options.body.scene.read_text(encoding="utf-8")), encoding="utf-8")
        measuring = [sys.executable, "-I", "-S", ROOT / "scripts/measured_run.py", folder / "usage.json"]
        command = measuring + command_of(options.program.resolve(), scene, options.body.settings, way, cells)
        run = run_in(folder / "run", command, options.seconds, options.threads)
        return figure_of(way, cells, run, folder / "usage.json")


def figure_of(way, cells, run, usage):
    figure = Figure(way.name, "x".join(map(str, cells)), run.summary.get("dofs"), run.summary.get("status", "failed"))
    if run.exit_status != 0 or not figure.found:
        figure.status = "failed" if figure.found else figure.status  # an equilibrium that could not be written is none
        figure.reason = run.message or run.summary.get("reason") or f"exit status {run.exit_status}"
        return figure
    took = json.loads(usage.read_text(encoding="utf-8"))
    figure.evaluations = run.summary["rhs_evaluations"]
    figure.seconds, figure.megabytes = took["seconds"], took["megabytes"]
    return figure


# --- all of them ---------------------------------------------------------------------------------------


def rotated(ways, turn):
    first = turn % len(ways)
    return ways[first:] + ways[:first]


def enough(figures, repeat):
    """Whether a way has had its repetitions of a size: a long run has fewer, one that failed is not repeated."""
    if not figures or not figures[-1].found:
        return bool(figures)
    longest = max(figure.seconds for figure in figures)
    return len(figures) >= (1 if longest > VERY_LONG else min(repeat, 2) if longest > LONG else repeat)


def best(figures):
    """The fastest of a way's repetitions, or the one that failed."""
    return min(figures, key=lambda figure: (figure.found, figure.seconds))


def measure_size(options, cells, turn):
    """The figures of all ways, and the turn that is next."""
    figures = {way: [] for way in WAYS}
    while not all(enough(found, options.repeat) for found in figures.values()):
        for way in rotated(WAYS, turn):
            if not enough(figures[way], options.repeat):
                figures[way].append(measured(options, way, cells))
        turn += 1
    return [best(found) for found in figures.values()], turn


def measure(options):
    rows, turn = [], 0
    for cells in options.body.sizes[: QUICK_SIZES if options.quick else None]:
        figures, turn = measure_size(options, cells, turn)
        for figure in figures:
            print(line(figure), flush=True)
        rows += figures
    return rows


def about(options, load):
    settings = ", ".join(f"`{setting}`" for setting in options.body.settings)
    return (
        f"`problems/{options.body.scene.name}` with {settings}, from the start of the program to its end, and its peak memory; "
        f"{os.cpu_count()} cores, the fastest of {options.repeat} runs in turn (of long ones fewer), others' load "
        f"{load:.1f} when they began."
    )


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--space", dest="body", action="store_const", const=SPACE, default=PLANE, help="a body in space")
    add("--quick", action="store_true", help="the three smallest sizes, about a minute")
    add("--out", type=Path, default=Path("out/scaling"), metavar="DIR")
    add("--repeat", type=int, default=3, metavar="N",
        help=f"runs of each; at most 2 beyond {LONG} s, 1 beyond {VERY_LONG} s")  # fmt: skip
    add("--seconds", type=float, default=1800, help="of the processor, after which a run is cut off")
    add("--threads", default="auto", help="of each run")
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help="instead of build/release/stillpoint")
    options = parser.parse_args()
    if options.repeat < 1:
        parser.error("--repeat: expected 1 or more")
    if not options.program.is_file():
        parser.error(f"--program: there is no {options.program}")
    return options


def main():
    options, start, load = parse(), time.monotonic(), os.getloadavg()[0]
    options.out.mkdir(parents=True, exist_ok=True)
    rows = measure(options)
    write_csv(options.out / "scaling.csv", rows)
    table = markdown(rows, about(options, load))
    (options.out / "scaling.md").write_text(table, encoding="utf-8")
    print("\n" + table)
    missing = sum(not figure.found for figure in rows)
    if missing < len(rows):
        import plot_scaling  # here: drawing takes a second to begin

        plot_scaling.draw(plot_scaling.read(options.out / "scaling.csv"), options.out / "scaling.png")
        print(f"Picture: {options.out / 'scaling.png'}")
    print(f"{len(rows)} figures, {missing} missing, {time.monotonic() - start:.0f} s")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
