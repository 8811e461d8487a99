#!/usr/bin/python3
"""benchmark_peers.py [--commands | --measure DIR [--repeats N] [--accept]]: what other programs take for a step.

Prints what tests/benchmark/peers.toml has of them: what was measured of each and of this program beside it, and what
either does in a step and the other does not. --commands prints, in place of that, a shell script with their sources,
inputs and commands, which builds them in the folder that it is given. --measure DIR runs those that have been built there
and this program in turn, and prints what they take; of all repetitions the least counts, as others can only make a
program slower. --accept writes the figures to tests/benchmark/peers.toml, and the table to problems/speed.md. Exit
status 2 and a message if something does not run, or if the file lacks something.
"""

import argparse
import datetime
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmark_peers_file import WAYS, BadPeers, cases_of, read_peers, write_figures
from benchmark_peers_page import SECTION, about, commands, explained, section, terminal_table

ROOT = Path(__file__).resolve().parent.parent


def output_of(command, folder, what, fine=(0,)):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode not in fine:
        said = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise BadPeers(f"{what} ended with {done.returncode}" + "".join(f": {line}" for line in said))
    return done.stdout


def run_of(case, steps, threads, folder, what):
    """(steps, s) of one run of a peer."""
    command = "\n".join(["set -e", *case["run"]]).replace("STEPS", str(steps)).replace("THREADS", str(threads))
    begin = time.perf_counter()
    text = output_of(["bash", "-c", command], folder, what)
    seconds = time.perf_counter() - begin
    if "counted" in case:
        counts = re.findall(case["counted"], text)
        if not counts:
            raise BadPeers(f"{what} printed no '{case['counted']}'")
        steps = int(counts[-1])
    return steps, seconds


def time_of_peer(case, threads, folder, what):
    """ns a point and step, by what two runs differ."""
    (few, short), (many, long) = (run_of(case, steps, threads, folder, what) for steps in case["steps"])
    if many <= few or long <= short:
        raise BadPeers(
            f"{what}: {many} steps took {long:.3f} s, and {few} took {short:.3f} s: no time of a step in that"
        )
    return 1e9 * (long - short) / ((many - few) * case["points"])


def time_of_ours(case, way, threads, program, what):
    settings = [word for setting in case["settings"] + case[way] for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as out:
        command = [program, "run", case["scene"], *settings, "--threads", str(threads), "--quiet", "--out", out]
        output_of(command, ROOT, f"{what}: ours", fine=(0, 3))  # 3: ended by stop.steps
        summary = json.loads((Path(out) / "summary.json").read_text(encoding="utf-8"))
    if summary["points"] != case["points"]:
        raise BadPeers(f"{what}: ours has {summary['points']} points, and the other {case['points']}")
    value = summary["ns_per_point_step"]
    if not (math.isfinite(value) and value > 0):
        raise BadPeers(f"{what}: ours took {value} ns a point and step")
    return value


def folders_of(document, base, all_of_them):
    """{peer: folder} of those that have been built; says which have not."""
    folders = {}
    for peer in document["peer"]:
        folder = base / peer["folder"]
        if "not_run" in peer:
            continue
        if folder.is_dir():
            folders[peer["name"]] = folder
        elif all_of_them:
            raise BadPeers(f"{peer['name']} has not been built: there is no {folder}")
        else:
            print(f"{peer['name']} is left out: there is no {folder}", file=sys.stderr)
    if not folders:
        raise BadPeers(f"none of the other programs has been built in {base}: see --commands")
    return folders


def measure(document, folders, program, repeats):
    """The rows [[measured]]."""
    found = {}
    for repetition in range(repeats):
        print(f"[{repetition + 1}/{repeats}]", file=sys.stderr, flush=True)
        for peer, case, threads in cases_of(document):
            if peer["name"] not in folders:
                continue
            what = f"{peer['name']}: {case['name']}"
            row = found.setdefault((peer["name"], case["name"], threads), {way: [] for way in WAYS})
            # Each goes first as often as the other.
            for way in WAYS[:: -1 if repetition % 2 else 1]:
                if way == "theirs":
                    row[way].append(time_of_peer(case, threads, folders[peer["name"]], what))
                else:
                    row[way].append(time_of_ours(case, way, threads, program, what))
    return [
        {"peer": peer, "case": case, "threads": threads}
        | {way: [round(min(values), 1), round(max(values), 1)] for way, values in row.items()}
        for (peer, case, threads), row in found.items()
    ]


def processor():
    """(name, bits of its vectors), by what Linux says of it."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        text = ""
    name = re.search(r"^model name\s*:\s*(.+)$", text, re.MULTILINE)
    flags = set(text.split())
    return name[1] if name else "an unknown processor", 512 if "avx512f" in flags else 256 if "avx2" in flags else 128


def first_line(*command):
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.partition("\n")[0].strip()


def described(options, load):
    changed = " with changes" if first_line("git", "status", "--porcelain", "--untracked-files=no") else ""
    name, bits = processor()
    return {
        "date": datetime.date.today(),
        "commit": options.commit or (first_line("git", "rev-parse", "--short", "HEAD") or "unknown") + changed,
        "processor": name,
        "vector_bits": bits,
        "cores": os.cpu_count(),
        "compiler": first_line("g++", "--version") or "an unknown compiler",
        "repetitions": options.repeats,
        "load": round(load, 1),
    }


# --- the command ---------------------------------------------------------------------------------------


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("--commands", action="store_true", help="print a shell script that builds the other programs")
    add("--measure", type=Path, metavar="DIR", help="run the other programs, built in DIR, and this one in turn")
    add("--repeats", type=int, default=3)
    add("--accept", action="store_true", help="write the figures to tests/benchmark/peers.toml and problems/speed.md")
    add("--file", type=Path, default=ROOT / "tests/benchmark/peers.toml", help=argparse.SUPPRESS)
    add("--page", type=Path, default=ROOT / "problems/speed.md", help=argparse.SUPPRESS)
    add("--program", type=Path, default=ROOT / "build/release/stillpoint", help=argparse.SUPPRESS)
    add("--commit", help=argparse.SUPPRESS)  # of that program, if it is not that of this tree
    options = parser.parse_args()
    if options.repeats < 1:
        parser.error("--repeats: expected 1 or more")
    if options.commands and options.measure:
        parser.error("--commands prints what --measure needs: expected one of them")
    if options.accept and not options.measure:
        parser.error("--accept: expected --measure DIR, which finds the figures")
    return options


def measure_and_accept(document, options):
    load = os.getloadavg()[0]
    if options.accept:
        SECTION.around(options.page)  # rather fails now than after the measurement
    folders = folders_of(document, options.measure.resolve(), options.accept)
    document["measured"] = measure(document, folders, options.program.resolve(), options.repeats)
    document["measurement"] = described(options, load)
    if options.accept:
        write_figures(options.file, document)
        SECTION.write(options.page, section(document))


def main():
    options = parse()
    try:
        document = read_peers(options.file)
        if options.commands:
            print(commands(document))
            return 0
        if options.measure:
            measure_and_accept(document, options)
        print(about(document) + "\n\n" + terminal_table(document))
        if not options.measure:
            print("\n" + explained(document))
    except (BadPeers, OSError, KeyError, ValueError, re.error) as error:
        print(f"benchmark: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
