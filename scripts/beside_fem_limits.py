#!/usr/bin/python3
"""beside_fem_limits.py [--quick] [--only PROBLEM] [--out DIR]: a limit load, and the end of finite elements, by both programs.

A strip footing's limit load on clay, and a block of rubber that is pressed flat: Stillpoint beside finite elements by
FEniCSx, each run a process of its own on one thread, one after another, each repetition beginning with another way; of a
way's repetitions the fastest counts. Prints a line for each way and size, and writes DIR/beside_fem_limits.csv,
DIR/beside_fem_limits_paths.csv (the way that each run takes), DIR/beside_fem/PROBLEM.png and
DIR/beside_fem_limits.md, two sections for the page of scripts/beside_fem.py. Exit status 1 if a run comes nowhere, which
leaves its place empty, 2 for bad input or without FEniCSx. Needs build/release/stillpoint.
"""

import argparse
import os
import shutil
import sys
import time
from pathlib import Path

from beside_fem import about, fem_is_there
from beside_fem_limits_page import line, sections
from beside_fem_limits_runs import measured, sizes_of, ways_of
from beside_fem_limits_table import BLOCK, FOOTING, path_of, write_csv
from beside_fem_runs import ROOT
from scaling import best, enough, rotated

PROBLEMS = (FOOTING, BLOCK)


def measure_size(options, ways, size, turn):
    """The best (row, path) of each way, and the turn that is next."""
    found = {way: [] for way in ways}
    while not all(enough([row for row, _ in runs], options.repeat) for runs in found.values()):
        for way in rotated(ways, turn):
            if not enough([row for row, _ in found[way]], options.repeat):
                found[way].append(measured(options, way, size))
        turn += 1
    return [quickest(runs) for runs in found.values()], turn


def quickest(runs):
    row = best([row for row, _ in runs])
    return next(run for run in runs if run[0] is row)


def measure(options):
    """The rows, each way's sizes after one another, and the places of their paths."""
    rows, paths = [], []
    for problem in options.only or PROBLEMS:
        ways, turn, of_problem = ways_of(problem, options.quick), 0, []
        for size in sizes_of(problem, options.quick):
            found, turn = measure_size(options, ways, size, turn)
            for row, path in found:
                print(line(row), flush=True)
                of_problem.append(row)
                paths += path_of(row, path)
        rows += [row for way in dict.fromkeys(row.way for row in of_problem) for row in of_problem if row.way == way]
        write_csv(options.out, rows, paths)
    return rows, paths


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--quick", action="store_true", help="the coarsest sizes of a few ways, some ten seconds")
    add("--only", action="append", choices=PROBLEMS, metavar="PROBLEM", help=f"of {', '.join(PROBLEMS)}")
    add("--out", type=Path, default=Path("out/beside_fem"), metavar="DIR")
    add("--repeat", type=int, default=3, metavar="N", help="runs of each; of long ones fewer")
    add("--seconds", type=float, default=1800, help="of the processor, after which a run is cut off")
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help="instead of build/release/stillpoint")
    options = parser.parse_args()
    if options.repeat < 1:
        parser.error("--repeat: expected 1 or more")
    if not options.program.is_file():
        parser.error(f"--program: there is no {options.program}")
    if options.quick:
        options.repeat = 1
    return options


def main():
    options, start, load = parse(), time.monotonic(), os.getloadavg()[0]
    if not fem_is_there():
        print("beside_fem_limits: there is no FEniCSx here: scripts/install_packages fem", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    rows, paths = measure(options)
    shutil.rmtree(options.out / "runs", ignore_errors=True)
    import plot_beside_fem_limits  # here: drawing takes a second to begin

    plot_beside_fem_limits.draw_all(rows, paths, options.out)
    text = sections(rows, paths) + "\n" + about(options, load) + "\n"
    (options.out / "beside_fem_limits.md").write_text(text, encoding="utf-8")
    missing = sum(not row.found for row in rows)
    print(f"{len(rows)} figures, {missing} missing, {time.monotonic() - start:.0f} s; {options.out / 'beside_fem_limits.md'}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
