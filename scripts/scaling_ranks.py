#!/usr/bin/python3
"""scaling_ranks.py [--quick]: how fast several processes are, and several threads of each, on the soil of slope.toml and
slope_in_space.toml.

Strong: the same body on more cores; weak: as many points on each core. A row has the time of a point and step, the
efficiency, which is that of one core over it and the number of cores, and the largest memory of a process. All numbers
of processes and threads that are powers of two and fill no more than the cores of this machine are run in turn; of the
repetitions the fastest counts. Prints a row for each, and writes DIR/ranks.csv and DIR/ranks.md. Exit status 1 if a run
fails, which leaves its place empty, 2 for bad input. Needs build/release/stillpoint and Open MPI's mpirun.
"""

import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from row_files import write_rows

ROOT = Path(__file__).resolve().parent.parent
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


@dataclass(frozen=True)
class Body:
    name: str
    scene: str
    cells: tuple[int, ...]  # of the body on one core
    steps: int


BODIES = (
    Body("plane", "slope.toml", (480, 264), 200),  # 4.6e5 points
    Body("space", "slope_in_space.toml", (78, 44, 39), 60),  # 7.6e5 points
)
QUICK = (Body("plane", "slope.toml", (120, 66), 200), Body("space", "slope_in_space.toml", (30, 17, 15), 60))


@dataclass
class Row:
    body: str
    kind: str  # strong or weak
    ranks: int
    threads: int
    points: int | None = None
    nanoseconds: float | None = None  # of a point and step
    efficiency: float | None = None
    megabytes: float | None = None  # the most of a process


def cells_of(body, kind, cores):
    share = cores ** (1 / len(body.cells)) if kind == "weak" else 1
    return [round(share * cells) for cells in body.cells]


def measured(options, body, row):
    """(points, nanoseconds, megabytes) of one run; None if it fails."""
    with tempfile.TemporaryDirectory(prefix="stillpoint-") as folder:
        settings = (f"stop.steps={body.steps}", f"grid.cells={cells_of(body, row.kind, row.ranks * row.threads)}")
        command = [options.program.resolve(), "run", ROOT / "problems" / body.scene, "--out", f"{folder}/out", "--quiet"]
        command += ["--threads", str(row.threads), *(word for one in settings for word in ("--set", one))]
        launcher = ["mpirun", "-n", str(row.ranks), "--bind-to", "none"] if row.ranks > 1 else []
        usage = f"{folder}/usage-${{OMPI_COMM_WORLD_RANK:-0}}.json"
        script = f'exec {sys.executable} -I -S {ROOT}/scripts/measured_run.py "{usage}" "$@"'
        ended = subprocess.run([*launcher, "sh", "-c", script, "sh", *map(str, command)], env=os.environ | AS_ROOT,
                               capture_output=True, text=True, check=False)  # fmt: skip
        summary = Path(folder, "out/summary.json")
        if not summary.exists():
            print(ended.stderr.strip(), file=sys.stderr)
            return None
        left = json.loads(summary.read_text(encoding="utf-8"))
        if left["status"] != "step-limit":
            print(left["reason"], file=sys.stderr)
            return None
        memory = [json.loads(file.read_text(encoding="utf-8"))["megabytes"] for file in Path(folder).glob("usage-*")]
        return left["points"], left["ns_per_point_step"], max(memory)


def rows_of(body, cores):
    powers = [1 << k for k in range(cores.bit_length()) if 1 << k <= cores]
    shapes = [(ranks, threads) for ranks in powers for threads in powers if ranks * threads <= cores]
    strong = [Row(body.name, "strong", *shape) for shape in shapes]
    return strong + [Row(body.name, "weak", *shape) for shape in shapes if math.prod(shape) > 1]


def measure(options, body):
    rows = rows_of(body, options.cores)
    found = [[] for _ in rows]
    for _ in range(options.repeat):
        for row, runs in zip(rows, found):
            runs.append(measured(options, body, row))
    for row, runs in zip(rows, found):
        if None in runs:
            continue
        row.points, row.nanoseconds, _ = min(runs, key=lambda run: run[1])
        row.megabytes = max(run[2] for run in runs)
    for row in rows:
        if row.nanoseconds and rows[0].nanoseconds:
            row.efficiency = rows[0].nanoseconds / (row.nanoseconds * row.ranks * row.threads)
        print(line(row), flush=True)
    return rows


def text(value, form):
    return "" if value is None else format(value, form)


def line(row):
    return (
        f"| {row.body} | {row.kind} | {row.ranks} | {row.threads} | {text(row.points, 'd')} | {text(row.nanoseconds, '.1f')} | "
        f"{text(row.efficiency, '.2f')} | {text(row.megabytes, '.0f')} |"
    )


def processor():
    try:
        said = re.search(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    except OSError:
        said = None
    return said.group(1).strip() if said else "unknown processor"


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--quick", action="store_true", help="small bodies, under a minute")
    add("--out", type=Path, default=Path("out/scaling"), metavar="DIR")
    add("--repeat", type=int, default=3, metavar="N", help="runs of each")
    add("--cores", type=int, default=os.cpu_count(), metavar="N", help="the most that are filled")
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help="instead of build/release/stillpoint")
    options = parser.parse_args()
    if options.repeat < 1 or options.cores < 1:
        parser.error("--repeat and --cores: expected 1 or more")
    if not options.program.is_file():
        parser.error(f"--program: there is no {options.program}")
    return options


def main():
    options = parse()
    options.out.mkdir(parents=True, exist_ok=True)
    head = ["| body | | processes | threads of each | points | ns a point and step | efficiency | MB a process |", "|" + "---|" * 8]
    print("\n".join(head), flush=True)
    rows = [row for body in (QUICK if options.quick else BODIES) for row in measure(options, body)]
    write_rows(options.out / "ranks.csv", Row, rows)
    about = f"{processor()}, {os.cpu_count()} cores; the fastest of {options.repeat} runs in turn."
    (options.out / "ranks.md").write_text("\n".join([about, "", *head, *map(line, rows), ""]), encoding="utf-8")
    missing = sum(row.nanoseconds is None for row in rows)
    print(f"{len(rows)} rows, {missing} missing: {options.out / 'ranks.md'}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
