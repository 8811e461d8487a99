#!/usr/bin/python3
"""speed.py [--repeats N] [--quick] [--accept]: what a step costs here, in ns a point and step, in one table a dimension.

Whole runs (stillpoint run) of two scenes of tests/benchmark/ by law, basis, dimension and threads, with functions at the
points that stay as they are, and some with all of them made anew in each step. All runs go one after another, and then
all of them again; of a figure's repetitions the least counts, as others can only make a program slower, and the last column
says how far the slowest was above it. Beside them the same steps by hand (stillpoint_yardsticks), on one thread. Prints the
tables, with their commands. --accept writes them to problems/speed.md. Exit status 2 and a message if a run does not end
as it has to.
"""

import argparse
import os
import sys
import time
from pathlib import Path

import limited_run
import numpy as np

from benchmark import ROOT, described, measure_yardsticks
from benchmark_table import BadFigures
from speed_table import SECTION, THREADS, Found, generated, tables

LONGEST = 600  # [s] of the processor for a run


# --- how far it is -------------------------------------------------------------------------------------


def time_text(seconds):
    return f"{seconds:.0f} s" if seconds < 60 else f"{seconds // 60:.0f} min {seconds % 60:.0f} s"


class Progress:
    """Says how many runs are done and about how long the rest will take: in one line on a terminal, elsewhere in a line
    each half minute."""

    def __init__(self, runs, work):
        self.runs, self.work = runs, work
        self.runs_done, self.work_done = 0, 0
        self.begin = self.shown = time.monotonic()
        self.on_terminal = sys.stderr.isatty()

    def add(self, work):
        self.runs_done += 1
        self.work_done += work
        now = time.monotonic()
        if now - self.shown > (0 if self.on_terminal else 30):
            self.show(now)

    def show(self, now):
        self.shown = now
        left = (now - self.begin) * max(0, self.work / self.work_done - 1)
        text = f"Measuring: {self.runs_done} of {self.runs} runs, about {time_text(left)} left"
        print(*(["\r\033[K", text] if self.on_terminal else [text, "\n"]), sep="", end="", file=sys.stderr, flush=True)

    def end(self):
        if self.on_terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def work_of(case):
    """About in proportion to the time of a run: what comes before its steps, and the steps."""
    points, anew = (2 if case.body.dim == 3 else 1), (5 if case.anew else 1)
    return 1 + points * case.functions * (0.1 + anew * case.steps / 1000)


# --- a run ---------------------------------------------------------------------------------------------


def run_of(case, threads, program, *settings):
    command = [program, "run", ROOT / case.body.scene, *case.words(*settings)]
    run = limited_run.run(command, LONGEST, threads)
    if run.exit_status != 3 or not run.summary:  # 3: ended by stop.steps
        raise BadFigures(f"{case.command(threads)} ended with {run.exit_status}: {run.message}")
    phases = run.summary["phases"]
    if phases < case.steps if case.anew else phases != 1:
        raise BadFigures(f"{case.command(threads)} had {phases} phases in {case.steps} steps")
    return run


def share_that_flows(case, program, found):
    """The share of the points whose plastic strain grows in the middle tenth of the steps."""
    step, tenth = found.summaries[case]["t"] / case.steps, max(1, case.steps // 10)
    first = (case.steps - tenth) // 2
    times = ",".join(f"{k * step:.12g}" for k in (first, first + tenth))
    run = run_of(case, 1, program, f"output.stages=[{times}]")
    return float(np.mean(run.last["plastic_strain"] != run.first["plastic_strain"]))


# --- all of them ---------------------------------------------------------------------------------------


def measure(all_tables, programs, options):
    """programs: the folder of stillpoint and stillpoint_yardsticks."""
    found, program = Found(), programs / "stillpoint"
    cases = [case for table in all_tables for case in table.cases()]
    flowing = [case for table in all_tables if not table.anew for case in table.cases() if case.law.yields]
    flowing = [case for case in flowing if case.basis == "linear"]
    once = [(case, threads) for case in cases for threads in THREADS]
    work = options.repeats * sum(work_of(case) for case, _ in once) + sum(work_of(case) for case in flowing)
    progress = Progress(options.repeats * len(once) + len(flowing), work)
    for _repetition in range(options.repeats):
        for table in all_tables:
            if table.yardsticks():  # right before what is measured by them
                measure_yardsticks(programs, table.yardsticks(), options.quick, found.figures)
            for case in table.cases():
                for threads in THREADS:
                    found.add(case, threads, run_of(case, threads, program).summary)
                    progress.add(work_of(case))
    for case in flowing:
        found.flowing[case.body, case.law] = share_that_flows(case, program, found)
        progress.add(work_of(case))
    progress.end()
    return found


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--repeats", type=int, default=2, metavar="N")
    add("--quick", action="store_true", help="a few rows of small bodies with few steps: whether it runs")
    add("--accept", action="store_true", help="write the tables to problems/speed.md")
    add("--programs", type=Path, default=ROOT / "build/release", help=argparse.SUPPRESS)
    add("--page", type=Path, default=ROOT / "problems/speed.md", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats: expected 1 or more")
    options.old = None  # what benchmark.described() asks for
    return options


def main():
    options = parse()
    load = os.getloadavg()[0]
    try:
        if options.accept:
            SECTION.around(options.page)  # rather fails now than after the measurement
        all_tables = tables(options.quick)
        found = measure(all_tables, options.programs.resolve(), options)
        text = generated(all_tables, found, described(options, found.figures, load))
        print(text)
        if options.accept:
            SECTION.write(options.page, text)
    except (BadFigures, OSError, KeyError, ValueError) as error:
        print(f"speed: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
