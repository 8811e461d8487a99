#!/usr/bin/python3
"""benchmark.py [--old DIR] [--repeats N] [--quick] [--accept]: how fast Stillpoint is here, in one table.

A step and a change of phase in ns a point (stillpoint_benchmarks), whole runs in the plane and in space and runs with a
change of phase in each step in ns a point and step, what comes before the steps, and force evaluations (stillpoint run);
on 1 and 2 threads. Beside them the yardsticks of tests/benchmark/yardsticks/, on one thread: how many times as long as a
Drucker-Prager step by hand on the same basis a figure is, and as the memory takes to move what that step has to.
With --old the same of two other programs, one after the other in each repetition, so that what the machine does
meanwhile falls on both. Of all repetitions the least counts, as others can only make a program slower; the last column
says how far the slowest was above it: ratios of figures that swing by more than they differ say nothing. --accept writes
the table to tests/benchmark/README.md. Exit status 2 and a message if something does not run.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from benchmark_table import (
    SECTION,
    BadFigures,
    Figures,
    markdown,
    of_benchmarks,
    of_summary,
    of_yardsticks,
    terminal_table,
)

ROOT = Path(__file__).resolve().parent.parent
BASES = ["linear", "quadratic"]
LAWS = {0: "linear elastic", 3: "Drucker-Prager"}  # by their numbers in plane_step.cpp
ELASTIC = ["problems/incompressible.toml", "constants.nu=0.3", "grid.cells=[120,96]", "damping.strategy=viscous"]
SLOPE = ["problems/slope.toml", "output.stages=[]"]
BLOCK = ["tests/benchmark/block_in_space.toml"]

# What a step is measured by: a yardstick of the same kind, and how fast the memory moves what that one has to.
PLANE = {basis: (f"plane_{basis}", "stream_plane") for basis in BASES}
SPACE = {"linear": ("space", "stream_space"), "quadratic": (None, "stream_space")}
NONE = (None, None)


def microbenchmarks(threads):
    """[(what, threads, yardsticks, name in stillpoint_benchmarks)]"""
    rows = [
        (f"a step, {BASES[b]}, {law}", n, PLANE[BASES[b]], f"plane_step/basis:{b}/law:{number}/threads:{n}")
        for b in range(2) for number, law in LAWS.items() for n in threads
    ]  # fmt: skip
    return rows + [
        (f"a change of phase, {BASES[b]}", n, NONE, f"change_of_phase/basis:{b}/threads:{n}")
        for b in range(2) for n in threads
    ]  # fmt: skip


def runs_in_plane(threads, quick):
    """[(what, threads, yardsticks, scene and settings, kinds of figures)]"""
    end = 0.02 if quick else 0.1
    rows = []
    for n in threads:
        for basis, by in PLANE.items():
            scene = [*SLOPE, f"grid.basis={basis}"]
            rows.append((f"the slope, {basis}", n, by, [*scene, f"stop.time={5 * end}"], ["step"]))
            classical = [*scene, f"stop.time={end}", "phase.max_motion=0"]
            rows.append((f"the slope, {basis}, max_motion = 0", n, by, classical, ["step"]))
        for basis, by in PLANE.items():
            steps = ["stop.steps=100"] if quick else []
            kinds = ["step", "set-up", "whole", "evaluations"]
            rows.append((f"an elastic block to rest, {basis}", n, by, [*ELASTIC, f"grid.basis={basis}", *steps], kinds))
    return rows


def runs_in_space(threads, quick):
    """As runs_in_plane()."""
    steps, few = ("stop.steps=50", "stop.steps=5") if quick else ("stop.steps=200", "stop.steps=20")
    rows = []
    for n in threads:
        for what, basis, settings, kinds in (
            ("linear, Drucker-Prager", "linear", [steps], ["step", "set-up"]),
            ("linear, linear elastic", "linear", [steps, "body.material=linear"], ["step"]),
            ("linear, Hencky", "linear", [steps, "body.material=hencky"], ["step"]),
            ("quadratic, Drucker-Prager", "quadratic", [steps, "grid.basis=quadratic"], ["step"]),
            ("linear, Drucker-Prager, max_motion = 0", "linear", [few, "phase.max_motion=0"], ["step"]),
        ):
            rows.append((f"a block in space, {what}", n, SPACE[basis], [*BLOCK, *settings], kinds))
    return rows


def output_of(command):
    words = [str(word) for word in command]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):  # 3: ended by stop.steps
        raise BadFigures(f"{Path(command[0]).name} ended with {done.returncode}: {done.stderr.strip()}")
    return done.stdout


def time_of(program, name, least_seconds):
    """ns a point; nothing if the program does not have it."""
    words = ["--benchmark_format=json", f"--benchmark_filter=^{name}/real_time$", f"--benchmark_min_time={least_seconds}"]
    text = output_of([program / "stillpoint_benchmarks", *words])
    return of_benchmarks(json.loads(text)).get(name) if text.strip() else None


def figures_of(program, scene, threads):
    with tempfile.TemporaryDirectory() as folder:
        settings = [word for setting in scene[1:] for word in ("--set", setting)]
        options = ["--threads", threads, "--quiet", "--out", folder]
        output_of([program / "stillpoint", "run", scene[0], *settings, *options])
        return of_summary(json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8")))


def measure_yardsticks(program, names, quick, figures):
    text = output_of([program / "stillpoint_yardsticks", *(["--quick"] if quick else []), *names])
    of_yardsticks(json.loads(text), figures)


def measure_runs(rows, programs, figures):
    """programs: [(name, folder)]"""
    for what, threads, by, scene, kinds in rows:
        for program, folder in programs:
            found = figures_of(folder, scene, threads)
            for kind in kinds:
                value, unit = found[kind]
                named = {"step": "ns a point and step", "whole": "in all"}.get(kind, kind)
                figures.add(f"{what}: {named}", threads, unit, program, value, by if kind == "step" else NONE)


def measure(programs, yardsticks, options):
    """programs: {name: folder}; yardsticks: the folder of the program that measures them."""
    figures = Figures(list(programs))
    small = microbenchmarks(options.threads)
    plane, space = (runs(options.threads, options.quick) for runs in (runs_in_plane, runs_in_space))
    for repetition in range(options.repeats):
        print(f"[{repetition + 1}/{options.repeats}]", file=sys.stderr, flush=True)
        # Each goes first as often as the other.
        order = list(programs.items())[:: -1 if repetition % 2 else 1]
        # The yardsticks right before what is measured by them.
        measure_yardsticks(yardsticks, ["plane_linear", "plane_quadratic", "stream_plane"], options.quick, figures)
        for what, threads, by, name in small:
            for program, folder in order:
                if (value := time_of(folder, name, 0.02 if options.quick else 0.2)) is not None:
                    figures.add(f"{what}: ns a point", threads, "ns", program, value, by)
        measure_runs(plane, order, figures)
        measure_yardsticks(yardsticks, ["space", "stream_space"], options.quick, figures)
        measure_runs(space, order, figures)
    return figures


def described(options, figures, load):
    def git(*words):
        done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    name = git("rev-parse", "--short", "HEAD") or "no commit"
    changed = " with changes" if git("status", "--porcelain", "--untracked-files=no") else ""
    against = f", beside {options.old_name}" if options.old else ""
    return (
        f"Commit {name}{changed}{against}, {figures.processor} with vectors of {figures.vector_bits} bits, "
        f"{os.cpu_count()} cores, the least of {options.repeats} repetitions in turn, "
        f"others' load {load:.1f} when they began"
        + (", short runs. " if options.quick else ". ")
        + figures.yardsticks_in_words()
    )


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--old", type=Path, metavar="DIR", help="a folder with other programs stillpoint and stillpoint_benchmarks")
    add("--old-name", default="other programs", help=argparse.SUPPRESS)
    add("--new", type=Path, default=ROOT / "build/release", help=argparse.SUPPRESS)
    add("--repeats", type=int, default=5)
    add("--threads", type=int, nargs="+", default=[1, 2], choices=[1, 2])
    add("--quick", action="store_true", help="short runs, for a first look")
    add("--accept", action="store_true", help="write the table to tests/benchmark/README.md")
    add("--readme", type=Path, default=ROOT / "tests/benchmark/README.md", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats: expected 1 or more")
    return options


def main():
    options = parse()
    new = options.new.resolve()
    programs = {"old": options.old.resolve(), "new": new} if options.old else {"least": new}
    load = os.getloadavg()[0]
    try:
        figures = measure(programs, new, options)
        about = described(options, figures, load)
        print(about + "\n\n" + terminal_table(figures))
        if options.accept:
            SECTION.write(options.readme, markdown(figures, about))
    except (BadFigures, OSError, KeyError, ValueError) as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
