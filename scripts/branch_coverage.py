#!/usr/bin/python3
"""branch_coverage.py BUILD PATTERN LEAST: the share of branches that the tests of BUILD took, of the files whose path in
the source tree matches PATTERN; exit status 1 if it is below LEAST per cent.

A branch of a template is taken if one instantiation takes it: gcovr counts those of each. Branches that only an
exception takes do not count. BUILD holds the counts of gcc's --coverage, of a build without inlining.
"""

import json
import re
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def instantiations(file, line, branches):
    """How many of a template the branches of a line are of: gcov gives lambdas of all of them as one line."""
    if "function_name" in line:
        return 1
    around = sum(f["start_line"] <= line["line_number"] <= f["end_line"] for f in file["functions"])
    return around if around and branches % around == 0 else 1


def branches_of(counts, build, pattern):
    """{(file, line, number of its branches, index): how often it was taken} of one object."""
    gcov = ["gcov", "--branch-probabilities", "--json-format", "--stdout", counts.name]
    taken = defaultdict(int)
    for document in subprocess.run(gcov, capture_output=True, cwd=counts.parent, check=True).stdout.splitlines():
        for file in json.loads(document)["files"]:
            path = (build / file["file"]).resolve()
            if not path.is_relative_to(ROOT) or not pattern.match(str(path.relative_to(ROOT))):
                continue
            for line in file["lines"]:
                branches = [branch["count"] for branch in line["branches"] if not branch["throw"]]
                each = len(branches) // instantiations(file, line, len(branches))
                for index, count in enumerate(branches):
                    taken[str(path.relative_to(ROOT)), line["line_number"], each, index % each] += count
    return taken


def main():
    build, pattern, least = Path(sys.argv[1]).resolve(), re.compile(sys.argv[2]), float(sys.argv[3])
    taken = defaultdict(int)
    with ThreadPoolExecutor(2) as pool:
        for one in pool.map(lambda counts: branches_of(counts, build, pattern), sorted(build.rglob("*.gcda"))):
            for branch, count in one.items():
                taken[branch] += count
    of_file = defaultdict(list)
    for (file, line, _, _), count in taken.items():
        of_file[file].append((line, count > 0))
    for file, branches in sorted(of_file.items()):
        hit = sum(was_taken for _, was_taken in branches)
        missed = sorted({line for line, was_taken in branches if not was_taken})
        print(f"{file:52} {hit:4} of {len(branches):4} {hit / len(branches):5.0%}  {', '.join(map(str, missed))}")
    share = 100 * sum(count > 0 for count in taken.values()) / len(taken) if taken else 0
    print(f"branches taken: {share:.1f} % of {len(taken)}, {least:.0f} % asked for")
    return 0 if share >= least else 1


if __name__ == "__main__":
    sys.exit(main())
