#!/usr/bin/python3
"""beside_fem.py [--quick] [--only CASE]: Stillpoint beside finite elements by FEniCSx, error against unknowns and time.

For each case both programs solve the same problem on a series of meshes, each run a process of its own on one thread, and
their u and σ are read at the same places inside the body and compared with the exact answer. Runs go one after another,
and each repetition begins with another way, so that what the machine does meanwhile falls on all of them; of a way's
repetitions the fastest counts. Prints a line for each way and size, and writes DIR/beside_fem.csv, DIR/beside_fem.json (the
orders, ratios, crossings and verdicts), DIR/beside_fem/CASE.png and DIR/beside_fem.md, with the sections of
beside_fem_limits.py and beside_fem_threads.py if these have run into DIR before. Exit status 1 if a run has no solution,
which leaves its place empty, or, with --quick, if an error of ours is larger beside that of finite elements than it has to
be; 2 for bad input or without FEniCSx. The CSV file is written after each case; with --keep the
cases that it already has are not measured again. Needs build/release/stillpoint.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from beside_fem_cases import CASES
from beside_fem_page import line, page
from beside_fem_runs import FEM, QUICK_WAYS, ROOT, cases_named, fem_row, first_cells, our_errors, our_row, refer, sizes_of, ways_of
from beside_fem_table import by, read_csv, write_csv
from beside_fem_verdict import judged
from scaling import best, enough, rotated

QUICK_CASE, QUICK_SIZES = "lame", 2
QUICK_LIMITS = {"quadratic/Q2 stress_l2": 1.5, "cubic/Q2 u_l2": 0.3}  # of errors at equal unknowns, where cells are cut


def measured(options, case, way, unknowns, threads=1):
    folder = options.out / "runs"
    folder.mkdir(parents=True, exist_ok=True)
    first = first_cells(case, way, unknowns)
    if way.program == FEM:
        return fem_row(case, way, first, folder, options.seconds, threads)
    return our_row(options.program, case, way, first, folder, options.seconds, threads)


def with_errors(options, case, rows):
    """rows: {way: row} of one size. Stillpoint's errors are read by a run that does not count, one for all solvers."""
    errors = {}
    for way, row in rows.items():
        if row.found and way.program != FEM and way.functions not in errors:
            folder = options.out / "runs"
            errors[way.functions] = our_errors(options.program, case, way, int(row.cells), folder, options.seconds)
    return [with_these(row, errors.get(way.functions)) for way, row in rows.items()]


def with_these(row, errors):
    if errors is None or not row.found:
        return row
    return row.with_figures(**errors) if errors else row.without_figures("the run with probes failed")


def measure_size(options, case, ways, unknowns, turn):
    """The rows of all ways, and the turn that is next."""
    rows = {way: [] for way in ways}
    while not all(enough(found, options.repeat) for found in rows.values()):
        for way in rotated(ways, turn):
            if not enough(rows[way], options.repeat):
                rows[way].append(measured(options, case, way, unknowns))
        turn += 1
    return with_errors(options, case, {way: best(found) for way, found in rows.items()}), turn


def measure_case(options, case):
    rows, turn = [], 0
    refer(case)
    for unknowns in sizes_of(case)[: options.sizes]:
        ways = [way for way in (QUICK_WAYS if options.quick else ways_of(case)) if unknowns <= way.most]
        found, turn = measure_size(options, case, ways, unknowns, turn)
        for row in found:
            print(line(row), flush=True)
        rows += found
    return rows


def kept(options):
    """{case: rows} of an earlier run into the same folder, if they are to be kept."""
    file = options.out / "beside_fem.csv"
    return by(read_csv(file), "case") if options.keep and file.exists() else {}


def measure(options, rows):
    """The rows of all cases: those that are kept, and those that are asked for and not among them."""
    for case in cases_named(options.only):
        if case.name not in rows:
            rows[case.name] = measure_case(options, case)
            write_csv(options.out / "beside_fem.csv", in_order(rows))
    return in_order(rows)


def in_order(rows):
    return [row for name in CASES for row in rows.get(name, ())]


def fem_is_there():
    return subprocess.run(["/usr/bin/python3", "-c", "import dolfinx"], capture_output=True, check=False).returncode == 0


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--quick", action="store_true", help="two sizes of three ways in one case, under half a minute")
    add("--only", action="append", choices=list(CASES), metavar="CASE", help=f"of {', '.join(CASES)}; may be repeated")
    add("--out", type=Path, default=Path("out/beside_fem"), metavar="DIR")
    add("--repeat", type=int, default=3, metavar="N", help="runs of each; of long ones fewer")
    add("--sizes", type=int, default=None, metavar="N", help="the N smallest sizes alone")
    add("--seconds", type=float, default=1800, help="of the processor, after which a run is cut off")
    add("--keep", action="store_true", help="measure no case again whose figures are in DIR/beside_fem.csv")
    add("--accept", action="store_true", help="write the page and its pictures to problems/, of all cases")
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help="instead of build/release/stillpoint")
    options = parser.parse_args()
    if options.repeat < 1:
        parser.error("--repeat: expected 1 or more")
    if options.quick and options.only:
        parser.error(f"--quick is of the case {QUICK_CASE}: leave out --only")
    if options.accept and (options.quick or options.only or options.sizes):
        parser.error("--accept is of all cases: leave out --quick, --only and --sizes")
    if not options.program.is_file():
        parser.error(f"--program: there is no {options.program}")
    if options.quick:
        options.only, options.sizes, options.repeat = [QUICK_CASE], QUICK_SIZES, 1
    return options


def about(options, load, threads="each run on one thread, "):
    """The machine and how it was measured."""
    return (
        f"{os.cpu_count()} cores, {threads}the fastest of {options.repeat} runs in turn (of long ones fewer), "
        f"others' load {load:.1f} when they began."
    )


def with_sections(options, text):
    """The page with the sections of the other studies, of those that have written them into the same folder."""
    files = [options.out / f"{study}.md" for study in ("beside_fem_limits", "beside_fem_threads")]
    return "\n".join([text, *(file.read_text(encoding="utf-8") for file in files if file.exists())])


def write(options, rows, verdicts, text):
    (options.out / "beside_fem.json").write_text(json.dumps(verdicts, indent=2) + "\n", encoding="utf-8")
    import plot_beside_fem  # here: drawing takes a second to begin

    pictures = plot_beside_fem.draw_all(rows, options.out)
    (options.out / "beside_fem.md").write_text(text, encoding="utf-8")
    if options.accept:
        shutil.copy(options.out / "beside_fem.md", ROOT / "problems/beside_fem.md")
        (ROOT / "problems/beside_fem").mkdir(exist_ok=True)
        for picture in pictures[0].parent.glob("*.png"):
            shutil.copy(picture, ROOT / "problems/beside_fem" / picture.name)


def beyond(limits, errors):
    """What to say of each ratio of errors that is not within its limit."""
    ratios = {name: errors[name]["ratio"] for name in limits}
    return [f"{name}: {ratio:.3g}, expected at most {limits[name]}" for name, ratio in ratios.items() if not ratio <= limits[name]]


def main():
    options, start, load = parse(), time.monotonic(), os.getloadavg()[0]
    if not fem_is_there():
        print("beside_fem: there is no FEniCSx here: scripts/install_packages fem", file=sys.stderr)
        return 2
    shutil.rmtree(options.out / "runs", ignore_errors=True)
    options.out.mkdir(parents=True, exist_ok=True)
    try:
        rows = kept(options)
    except (ValueError, TypeError) as error:
        print(f"beside_fem: {options.out / 'beside_fem.csv'} is not of this program: {error}", file=sys.stderr)
        return 2
    rows = measure(options, rows)
    verdicts = judged(rows)
    text = page(rows, verdicts, about(options, load))
    write(options, rows, verdicts, with_sections(options, text))
    missing = sum(not row.found for row in rows)
    print(f"{len(rows)} figures, {missing} missing, {time.monotonic() - start:.0f} s; {options.out / 'beside_fem.md'}")
    wrong = beyond(QUICK_LIMITS, verdicts["errors"][QUICK_CASE]) if options.quick and not missing else []
    for said in wrong:
        print(f"beside_fem: {said}", file=sys.stderr)
    return 1 if missing or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
