#!/usr/bin/python3
"""ladder.py: problems with exact or published answers, what is computed, and how far off it is.

Runs the cases of problems/ladder/ladder.toml, each on one thread under a limit of time, prints a row for each quantity,
and writes DIR/ladder.csv and DIR/ladder.png. What the runs left stays in DIR/runs. Exit status 1 if a row is a MISS that
ladder.toml does not know, or if a known miss is one no more, 2 for bad input. Needs build/release/stillpoint.
"""

import argparse
import os
import shlex
import shutil
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase
from pathlib import Path

from case_table import BadTable
from ladder_cases import read_cases
from ladder_judge import commands_of, rows_of
from ladder_table import HEADINGS, line, texts, verdict, write_csv, write_readme
from variants import folder_names

ROOT = Path(__file__).resolve().parent.parent
LADDER = ROOT / "problems/ladder"


def run_cases(options, cases):
    """The rows, printed as they come. The longest cases begin first, so that none is left alone at the end."""
    folders = dict(zip((case.name for case in cases), folder_names([case.name for case in cases])))
    shutil.rmtree(options.out / "runs", ignore_errors=True)
    rows = []
    print(line(HEADINGS))
    with ThreadPoolExecutor(options.jobs) as pool:
        longest_first = sorted(cases, key=lambda case: -case.seconds)
        done = {case.name: pool.submit(rows_of, options.program, case, options.out / "runs" / folders[case.name])
                for case in longest_first}  # fmt: skip
        for case in cases:
            for row in done[case.name].result():
                rows.append(row)
                print(line(texts(row)), flush=True)
                if row.wrong:
                    why = row.reason or f"it is no miss any more ({row.known_miss}): its mark in ladder.toml has to go"
                    commands = [shlex.join(command) for command, _ in commands_of(options.program, case)]
                    print("  " + "\n    ".join([why, *commands]))
    return rows


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--quick", action="store_true", help="the short form, under a minute")
    add("--only", action="append", metavar="PATTERN", help="cases that match (*, ?)")
    add("--out", type=Path, default=Path("out/ladder"), metavar="DIR")
    add("--accept", action="store_true", help="write the table and its picture to problems/ladder, of the whole ladder")
    add("--jobs", type=int, default=os.cpu_count(), help="cases side by side")
    add("--cases", type=Path, default=LADDER / "ladder.toml", help=argparse.SUPPRESS)
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.accept and (options.quick or options.only):
        parser.error("--accept is of the whole ladder: leave out --quick and --only")
    if options.jobs < 1:
        parser.error("--jobs: expected 1 or more")
    return options


def chosen(options):
    cases = [case for case in read_cases(options.cases) if case.quick or not options.quick]
    cases = [case for case in cases if any(fnmatchcase(case.name, pattern) for pattern in options.only or ["*"])]
    if not cases:
        raise BadTable("no case is chosen")
    return cases


def main():
    options, start = parse(), time.monotonic()
    try:
        cases = chosen(options)
    except (BadTable, OSError) as error:
        print(f"ladder: {error}", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    rows = run_cases(options, cases)
    write_csv(options.out / "ladder.csv", rows)
    import plot_ladder  # here: drawing takes a second to begin

    plot_ladder.draw(plot_ladder.read(options.out / "ladder.csv"), options.out / "ladder.png")
    print(f"Picture: {options.out / 'ladder.png'}")
    if options.accept:
        folder = options.cases.parent
        shutil.copy(options.out / "ladder.png", folder / "ladder.png")
        write_readme(folder / "README.md", cases, rows, ROOT)
    wrong = sum(row.wrong for row in rows)
    ok, known = (sum(verdict(row) == word for row in rows) for word in ("ok", "known miss"))
    print(f"{len(rows)} rows: {ok} ok, {known} known misses, {wrong} wrong, {time.monotonic() - start:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
