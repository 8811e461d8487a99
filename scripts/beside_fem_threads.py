#!/usr/bin/python3
"""beside_fem_threads.py [--only CASE] [--unknowns N] [--out DIR]: Stillpoint and FEniCSx on one thread and on two.

Cases of scripts/beside_fem, each at one large size by the ways that are quickest there: Stillpoint with --threads, FEniCSx by
as many ranks of MPI. Each run is a process, or the ranks, of its own; one after another, each repetition with all ways on one
thread and on two and beginning with another, so that what the machine does meanwhile falls on all of them; of a way's
repetitions the fastest counts. Prints a line for each way and number of threads, and writes DIR/beside_fem_threads.csv and
DIR/beside_fem_threads.md, a section for the page of scripts/beside_fem.py. Exit status 1 if a run has no solution, which
leaves its place empty, 2 for bad input or without FEniCSx or MPI. Needs build/release/stillpoint and two cores that are idle.
"""

import argparse
import os
import shutil
import sys
import time
from pathlib import Path

from beside_fem import about, fem_is_there, measured
from beside_fem_cases import CASES
from beside_fem_runs import FEM, OURS, ROOT, cases_named, refer, ways_of
from beside_fem_table import write_csv
from beside_fem_threads_page import line, section
from beside_fem_threads_table import Pair, rows_of, solved
from scaling import best, enough, rotated

USUAL = ("vortex", "lame", "kirsch", "cook", "cube", "torsion")
UNKNOWNS = {2: 6.4e4, 3: 1e5}  # by dimension
ONE_ALONE = "cholmod"  # of FEM's solvers the one without MPI
CHOSEN = {
    2: {(FEM, "Q2", "cholmod"), (FEM, "Q2", "mumps"), (FEM, "Q2-Q1", "mumps"), (FEM, "P2", "gamg"), (FEM, "Q2", "gamg"),
        *((OURS, "quadratic", solver) for solver in ("newton", "auto, lumped mass", "auto, multigrid"))},
    3: {(FEM, "Q1", "gamg"), (FEM, "Q2", "gamg"), (OURS, "linear", "auto, lumped mass"), (OURS, "linear", "auto, multigrid"),
        (OURS, "quadratic", "auto, lumped mass")},
}  # fmt: skip


def chosen_ways(case, unknowns):
    """Those of scripts/beside_fem that are worth their time at this size."""
    chosen = CHOSEN[case.dim]
    return [way for way in ways_of(case) if (way.program, way.functions, way.solver) in chosen and unknowns <= way.most]


def threads_of(way):
    return (1,) if way.solver == ONE_ALONE else (1, 2)


def measure_case(options, case):
    """The pairs of all ways."""
    refer(case)
    unknowns = options.unknowns or UNKNOWNS[case.dim]
    ways = chosen_ways(case, unknowns)
    found, turn = {(way, threads): [] for way in ways for threads in threads_of(way)}, 0
    while not all(enough(rows, options.repeat) for rows in found.values()):
        for way, threads in rotated(list(found), turn):
            if not enough(found[way, threads], options.repeat):
                found[way, threads].append(measured(options, case, way, unknowns, threads))
        turn += 1
    rows = {key: best(rows) for key, rows in found.items()}
    return [Pair(rows[way, 1], rows.get((way, 2))) for way in ways]


def measure(options):
    pairs = []
    for case in cases_named(options.only or USUAL):
        of_case = measure_case(options, case)
        for row in rows_of(of_case):
            print(line(row), flush=True)
        pairs += of_case
        write_csv(options.out / "beside_fem_threads.csv", rows_of(pairs))
    return pairs


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--only", action="append", choices=list(CASES), metavar="CASE", help=f"of {', '.join(CASES)}; may be repeated")
    usual = f"{UNKNOWNS[2]:g} in the plane and {UNKNOWNS[3]:g} in space"
    add("--unknowns", type=float, metavar="N", help=f"about as many, instead of {usual}")
    add("--out", type=Path, default=Path("out/beside_fem"), metavar="DIR")
    add("--repeat", type=int, default=3, metavar="N", help="runs of each; of long ones fewer")
    add("--seconds", type=float, default=1800, help="of the processor, after which a run is cut off")
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help="instead of build/release/stillpoint")
    options = parser.parse_args()
    if options.repeat < 1:
        parser.error("--repeat: expected 1 or more")
    if options.unknowns is not None and not 100 <= options.unknowns <= 1e7:
        parser.error("--unknowns: expected 100 to 1e7")
    if not options.program.is_file():
        parser.error(f"--program: there is no {options.program}")
    return options


def main():
    options, start, load = parse(), time.monotonic(), os.getloadavg()[0]
    if lacking := "FEniCSx" if not fem_is_there() else "mpirun" if not shutil.which("mpirun") else None:
        print(f"beside_fem_threads: there is no {lacking} here: scripts/install_packages fem", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    pairs = measure(options)
    shutil.rmtree(options.out / "runs", ignore_errors=True)
    file = options.out / "beside_fem_threads.md"
    file.write_text(section(pairs) + "\n" + about(options, load, threads="") + "\n", encoding="utf-8")
    rows = rows_of(pairs)
    missing = sum(not solved(row) for row in rows)
    print(f"{len(rows)} figures, {missing} missing, {time.monotonic() - start:.0f} s; {file}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
