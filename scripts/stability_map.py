#!/usr/bin/python3
"""stability_map.py: case × integrator × strategy → outcome, evaluations, error, of the hard cases in problems/hard.

Runs every row of problems/hard/map.toml, random variations of them, and random scenes that are unlike them, each on one
thread under a limit of time; compares the outcomes with what map.toml expects, and with problems/hard/map.csv, the last
map that was accepted. Writes DIR/map.csv and DIR/unlike.csv, and draws DIR/map.png. With --unlike N it runs N unlike
scenes and nothing else. Exit status 1 if
  - an equilibrium is false: exit status 0, and an answer that is wrong by more than the case's tolerance (1 %),
  - an outcome is not one that the case expects, or not that of the last map,
  - an unlike scene is false: by its known answer, or since another way to rest finds another equilibrium,
  - a fault that map.toml knows is gone: then its mark has to go as well.
Evaluations that differ from those of the last map by more than 20 % are reported. Needs build/release/stillpoint.
"""

import argparse
import csv
import os
import shlex
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from fnmatch import fnmatchcase
from pathlib import Path

import map_random
import map_unlike
from case_table import BadTable
from map_cases import read_known, read_rows
from map_judge import JUDGES, command_of, verdict

ROOT = Path(__file__).resolve().parent.parent
HARD = ROOT / "problems/hard"
COLUMNS = ["case", "way", "expected", "outcome", "evaluations", "error", "fault"]
LARGE_CHANGE = 0.2  # of evaluations
QUICK_RANDOM, ALL_RANDOM = 40, 500
QUICK_UNLIKE, ALL_UNLIKE = 20, 100
KNOWN_SEED = 1  # of the variations whose faults are known
SUCCESS = {"equilibrium", "end-time", "limit-load", "noted"}


def judged(rows, options):
    """(row, verdict) in order."""
    with ThreadPoolExecutor(options.jobs) as pool:
        yield from zip(rows, pool.map(lambda row: verdict(options.program, row), rows))


def as_text(row, found):
    return {
        "case": row.case,
        "way": row.way,
        "expected": " | ".join(row.expected),
        "outcome": found.outcome,
        "evaluations": "" if found.evaluations is None else str(found.evaluations),
        "error": "" if found.error is None else f"{found.error:.1e}",
        "fault": row.fault,
    }


def reproduction(program, row):
    return "    " + shlex.join(command_of(program, row))


# --- against what is expected, and against the last map ------------------------------------------------


def complaint(row, found):
    """What is wrong with a row; empty if nothing is that is not known."""
    if found.expected:
        return "the fault is gone: its mark in map.toml has to go" if row.fault else ""
    return "" if row.fault else f"expected {' or '.join(row.expected)}"


def read_map(file):
    if not file.exists():
        return {}
    with open(file, newline="", encoding="utf-8") as table:
        return {(line["case"], line["way"]): line for line in csv.DictReader(table)}


def changes(row, found, last):
    """(what is an error, what is worth a line) against the last map."""
    before = last.get((row.case, row.way))
    if before is None:
        return "", "is not in the last map: accept it with --accept"
    if before["outcome"] != found.outcome:
        change = f"was {before['outcome']} in the last map"
        return ("", change) if row.fault or row.chance else (change, "")  # what comes of a fault may be chance
    if found.outcome in SUCCESS and before["evaluations"] and found.evaluations:
        share = found.evaluations / int(before["evaluations"]) - 1
        if abs(share) > LARGE_CHANGE:
            return "", f"{found.evaluations} evaluations, {before['evaluations']} in the last map ({share:+.0%})"
    return "", ""


def run_map(options):
    """The lines of the map, and the number of those that are wrong."""
    rows = read_rows(options.cases, JUDGES)
    rows = [row for row in rows if row.quick or not options.quick]
    rows = [row for row in rows if any(fnmatchcase(row.key, pattern) for pattern in options.only)]
    last, lines, wrong, counts = read_map(options.last), [], 0, Counter()
    for row, found in judged(rows, options):
        line = as_text(row, found)
        lines.append(line)
        error, remark = ("", "") if options.accept else changes(row, found, last)
        fault = complaint(row, found)
        state = "right" if found.expected else "known fault" if row.fault else "WRONG"
        counts[state] += 1
        if not options.quick or fault or error or remark:
            print(f"{row.key:<72} {found.outcome:<12} {line['evaluations']:>8} {line['error']:>8}", end="")
            print(f"  known: {row.fault}" if row.fault else "")
        for what in filter(None, (fault, error)):
            print(f"  WRONG: {what}; {found.reason}\n{reproduction(options.program, row)}")
        if remark:
            print(f"  note: {remark}")
        wrong += bool(fault or error)
    print(f"{len(rows)} rows: " + ", ".join(f"{count} {state}" for state, count in counts.items()))
    return lines, wrong


def run_random(options, count):
    """The number of variations that are wrong. The scenes of those that are not right stay in options.scenes."""
    options.scenes.mkdir(parents=True, exist_ok=True)
    known = read_known(options.cases, "variations") if options.seed == KNOWN_SEED else {}
    rows = [map_random.variation(options.seed, k, options.scenes) for k in range(count)]
    for k, row in enumerate(rows):
        row.fault = known.get(k, "")
    counts, wrong = Counter(), 0
    for row, found in judged(rows, options):
        counts[found.outcome] += 1
        if found.expected:
            row.scene.unlink()
        what = complaint(row, found)
        wrong += bool(what)
        if what or row.fault:
            print(f"{row.key:<72} {found.outcome:<12}  {f'known: {row.fault}' if row.fault else ''}")
            print(f"  {f'WRONG: {what}; ' if what else ''}{found.reason}\n{reproduction(options.program, row)}")
    words = ", ".join(f"{number} {outcome}" for outcome, number in counts.most_common())
    print(f"{count} random variations of seed {options.seed}: {words}")
    return wrong


def run_unlike(options, count):
    """The number of unlike scenes that are wrong, and not known to be."""
    known = read_known(options.cases, "unlike") if options.seed == KNOWN_SEED and not options.all_ways else {}
    return map_unlike.run_unlike(options, count, known if options.family == "*" else {})


def write_map(file, lines):
    with open(file, "w", newline="", encoding="utf-8") as table:
        writer = csv.DictWriter(table, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)


def accept(options, lines):
    """Puts these lines in the place of the last map's; those whose row is no more go."""
    kept = read_map(options.last) | {(line["case"], line["way"]): line for line in lines}
    rows = [(row.case, row.way) for row in read_rows(options.cases, JUDGES)]
    write_map(options.last, [kept[row] for row in rows if row in kept])


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--quick", action="store_true", help="the short form, under a minute: fewer cases, 40 variations, 20 unlike scenes")
    add("--random", type=int, metavar="N", help="random variations (40 if quick, otherwise 500)")
    add("--unlike", type=int, metavar="N", help="unlike scenes, and nothing else (besides the map: 20 if quick, otherwise 100)")
    add("--family", default="*", metavar="PATTERN", help="of the unlike scenes: those whose names match (*, ?)")
    add("--all-ways", action="store_true", help="each unlike scene by all of its ways, not by three or four")
    add("--seed", type=int, default=KNOWN_SEED, help="of the variations and of the unlike scenes")
    add("--only", action="append", metavar="PATTERN", help="rows 'case [values]: way' that match (*, ?)")
    add("--out", type=Path, default=Path("out/stability_map"), metavar="DIR")
    add("--accept", action="store_true", help="keep what comes out as the last map, problems/hard/map.csv")
    add("--jobs", type=int, default=os.cpu_count(), help="runs side by side")
    add("--cases", type=Path, default=HARD / "map.toml", help=argparse.SUPPRESS)
    add("--last", type=Path, default=HARD / "map.csv", help=argparse.SUPPRESS)
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.scenes = options.out / "random"
    asked = options.unlike is not None
    if not asked:
        rows_alone = options.only or options.random is not None
        options.unlike = 0 if rows_alone else QUICK_UNLIKE if options.quick else ALL_UNLIKE
    if options.random is None:
        options.random = 0 if options.only or asked else QUICK_RANDOM if options.quick else ALL_RANDOM
    options.only = options.only or ([] if asked else ["*"])
    return options


def main():
    options, start = parse(), time.monotonic()
    options.out.mkdir(parents=True, exist_ok=True)
    try:
        lines, wrong = run_map(options) if options.only else ([], 0)
        if options.only:
            write_map(options.out / "map.csv", lines)
        wrong += run_random(options, options.random) if options.random else 0
        wrong += run_unlike(options, options.unlike) if options.unlike else 0
    except BadTable as error:
        print(f"stability_map: {error}", file=sys.stderr)
        return 2
    if options.accept:
        accept(options, lines)
    if lines:
        import plot_map  # here: drawing takes a second to begin

        plot_map.draw(lines, options.out / "map.png")
        print(f"Picture: {options.out / 'map.png'}")
    print(f"{wrong} wrong, {time.monotonic() - start:.0f} s")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
