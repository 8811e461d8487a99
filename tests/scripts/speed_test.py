#!/usr/bin/python3
"""speed_test.py ROOT CLAIM PROGRAM: one claim about scripts/speed and its page, by the command that lies where PROGRAM does."""

import os
import shlex
import sys
from pathlib import Path

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

COMMAND = Path(sys.argv[3]).parent / "stillpoint"
PAGE = "# Speed\n\nWhat a step takes.\n\n{}\n\nold tables\n{}\n\n## Beside other programs\n"
IN_SPACE = (
    "stillpoint run tests/benchmark/block_in_space.toml --set body.material=mises --set grid.basis=linear "
    "--set 'grid.cells=[20,20,20]' --set 'initial.stress=[-2e4,-2e4,-2e4,0,0,0]' --set 'initial.v=[\"0.5*y\",0,0]' "
    "--set phase.max_motion=0.9 --set stop.steps=80 --threads 1"
)
# Stand for the programs. A run notes its words, and has $PHASES phases.
STILLPOINT = """#!/bin/bash
printf '%s\\n' "$@" >>"$CALLS"
while [[ $1 != --out ]]; do shift; done
mkdir -p "$2"
printf '{"ns_per_point_step": 10, "points": 1000, "bytes_per_point": 180, "phases": %s, "t": 0.1}' ${PHASES:-1} \\
  >"$2/summary.json"
[[ ${STATUS:-3} == 3 ]] || echo "no such law" >&2
exit ${STATUS:-3}
"""
YARDSTICKS = """#!/bin/bash
[[ $1 == --quick ]] && shift
printf '{"processor": "A processor", "vector_bits": 512, "yardsticks": {"%s": {"ns_per_point_step": 2}}}' "$1"
"""


def write_program(file, text):
    file.write_text(text)
    file.chmod(0o755)


def programs(folder, stillpoint=None):
    """A folder with yardsticks, and a program that stands for the real one, or that one."""
    (folder / "programs").mkdir(exist_ok=True)
    write_program(folder / "programs/stillpoint_yardsticks", YARDSTICKS)
    if stillpoint:
        write_program(folder / "programs/stillpoint", stillpoint)
    else:
        (folder / "programs/stillpoint").symlink_to(COMMAND)
    return folder / "programs"


def speed(folder, *options, **environment):
    variables = os.environ | {"CALLS": str(folder / "calls")} | environment
    words = ["--quick", "--repeats", 1, "--programs", folder / "programs", "--page", folder / "speed.md", *options]
    return call(ROOT / "scripts/speed.py", *words, env=variables)


def page_with_markers(folder):
    module = script_module("speed_table")
    (folder / "speed.md").write_text(PAGE.format(module.MARKER, module.END))
    return module


def check(command):
    """What `stillpoint check` says of the settings of a command of the page."""
    run, threads = shlex.split(command)[1:-2], shlex.split(command)[-2:]
    assert run[0] == "run" and threads[0] == "--threads" and threads[1].isdigit(), command
    result = call(COMMAND, "check", *run[1:], cwd=ROOT)
    assert result.returncode == 0, (command, result.stderr)


@claim("a table of speed has the least figures of its cases, how far the slowest was above them, and their commands")
def _(_folder):
    module = script_module("speed_table")
    table = module.tables(False)[2]
    assert [law.material for _, _, law in table.rows][2:4] == ["hencky", "mises"] and table.title == "In space"
    found = module.Found()
    for case in table.cases():
        for threads in (1, 2):
            # 20 ns of a linear case, on one thread: 10 more of a higher degree, half of it on two.
            ns = (20 + 10 * module.BASES.index(case.basis)) / threads
            mises_on_cubic = case.law.material == "mises" and case.basis == "cubic"
            for value in (ns * (1.25 if mises_on_cubic else 1.1), ns):
                summary = {"ns_per_point_step": value, "points": 64000, "bytes_per_point": 10 * ns * threads}
                found.add(case, threads, summary)
        found.flowing[case.body, case.law] = 0.625
    found.figures.yardsticks["space"] = 8.0
    text = module.section(table, found)
    head, _, *lines = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("|")]
    linear = [f"`linear`, `--threads {threads}`" for threads in (1, 2)]
    assert head[:5] == ["law, `body.material`", "flows", *linear, "by hand"]
    assert head[5:7] == ["`quadratic`, `--threads 1`", "`quadratic`, `--threads 2`"] and head[-1] == "most over least"
    figures = ["20.0", "10.0", "2.5 ×", "30.0", "15.0", "40.0", "20.0"]
    assert lines[2] == ["Hencky, `hencky`", "-", *figures, "+10 %"], lines[2]
    assert lines[3] == ["von Mises, `mises`", "62 %", *figures, "+25 %"], lines[3]
    assert "64 000 points, of 200, 300 and 400 bytes in Drucker–Prager with linear, quadratic and cubic" in text
    assert "12.8, 19.2 and 25.6 MB" in text, text
    assert f"    {IN_SPACE}\n" in text and text.count("    stillpoint run ") == 2, text


@claim("where every step is a phase of its own the commands of speed say so, and no share of the points")
def _(_folder):
    module = script_module("speed_table")
    table = module.tables(False)[3]
    found = module.Found()
    for case in table.cases():
        for threads in (1, 2):
            found.add(case, threads, {"ns_per_point_step": 100.0})
    found.figures.yardsticks |= {"plane_linear": 4.0, "plane_quadratic": 5.0, "space": 10.0}
    text = module.section(table, found)
    assert text.count("--set phase.max_motion=0 --set stop.steps=20 ") == 2 and "flows" not in text, text
    by_hand = [line.split(" | ")[3:7:3] for line in text.splitlines() if line.startswith("| Drucker")]
    assert by_hand == [["25.0 ×", "20.0 ×"], ["10.0 ×", "-"]], by_hand


@claim("every command of problems/speed.md is one of scripts/speed, and the program accepts all that those name")
def _(_folder):
    module = script_module("speed_table")
    shown = [command for table in module.tables(False) for command in module.commands(table)]
    page = (ROOT / "problems/speed.md").read_text(encoding="utf-8").partition(module.END)[0]
    printed = [line.strip() for line in page.splitlines() if line.startswith("    stillpoint ")]
    assert set(printed) <= set(shown), set(printed) - set(shown)
    for command in shown:
        check(command)
    for case in (case for table in module.tables(False) for case in table.cases()):
        if case.basis == "linear" or case.law.material == "sand":  # each law and each basis, on each body
            check(module.replace(case, body=module.small(case.body)).command(2))


@claim("problems/speed.md has the marks of both scripts that write to it, and no path of a machine")
def _(_folder):
    module = script_module("speed_table")
    text = (ROOT / "problems/speed.md").read_text(encoding="utf-8")
    peers = [f"<!-- {words} -->" for words in (
        "Generated by scripts/benchmark --peers --accept", "End of what scripts/benchmark --peers writes")]  # fmt: skip
    marks = [module.MARKER, module.END, *peers]
    assert all(text.count(mark) == 1 for mark in marks)
    places = [text.index(mark) for mark in marks]
    assert places == sorted(places) and "## Beside other programs" in text[places[1] : places[2]]
    assert not any(path in text for path in ("/home/", "/work/", "/tmp/", "/root/"))


@claim("the share of points that flows is of those whose plastic strain grows in the middle tenth of the steps")
def _(_folder):
    module, numpy = script_module("speed"), script_module("numpy")
    table = script_module("speed_table").tables(False)[0]
    case = next(case for case in table.cases() if case.law.material == "sand")
    found = script_module("speed_table").Found()
    found.summaries[case] = {"t": 0.1}  # of 200 steps
    asked = []

    def run(command, _seconds, _threads):
        asked.extend(command)
        strains = [{"plastic_strain": numpy.array(values)} for values in ([0.0, 1.0, 2.0, 0.5], [0.0, 1.5, 2.0, 0.5])]
        return module.limited_run.Run(3, {"phases": 1}, "", *strains)

    module.limited_run.run = run
    assert module.share_that_flows(case, Path("stillpoint"), found) == 0.25
    assert "output.stages=[0.045,0.055]" in asked, asked


@claim("scripts/speed.py --quick writes what the program takes between the marks of the page, and nothing else")
def _(folder):
    module = page_with_markers(folder)
    programs(folder)
    result = speed(folder, "--accept")
    assert result.returncode == 0, result
    text = (folder / "speed.md").read_text()
    module.SECTION.write(folder / "speed.md", result.stdout.removesuffix("\n"))
    assert (folder / "speed.md").read_text() == text  # as often as one likes
    before, after = PAGE.format(module.MARKER, module.END).split("\n\nold tables\n")
    assert text.startswith(before) and text.endswith(after) and "old tables" not in text
    assert text == f"{before}\n\n{result.stdout}{after}", text
    assert "A processor with vectors of 512 bits, " in text and "the least of 1 repetitions in turn, others" in text
    rows = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith(("| linear", "| Drucker"))]
    assert len(rows) == 8, rows
    assert all(float(cell) > 0 for row in rows for cell in row if cell.replace(".", "").isdigit()), rows
    assert rows[0][1] == "-" and 0 <= float(rows[1][1].removesuffix(" %")) <= 100 and rows[0][4].endswith(" ×"), rows
    assert str(folder) not in text and str(ROOT) not in text
    for line in text.splitlines():
        if line.startswith("    stillpoint "):
            check(line.strip())


@claim("a page without the marks of scripts/speed is refused before anything runs, and stays as it is")
def _(folder):
    module = page_with_markers(folder)
    programs(folder, STILLPOINT)
    for text in ("# Speed\n", PAGE.format(module.END, module.MARKER)):
        (folder / "speed.md").write_text(text)
        result = speed(folder, "--accept")
        assert result.returncode == 2 and result.stderr.startswith("speed: speed.md has no lines '<!-- Gen"), result
        assert (folder / "speed.md").read_text() == text and not (folder / "calls").exists()


@claim("a run that does not end as it has to ends scripts/speed.py with its command, its words and status 2")
def _(folder):
    page_with_markers(folder)
    programs(folder, STILLPOINT)
    old = (folder / "speed.md").read_text()
    result = speed(folder, "--accept", STATUS="4")
    words = (folder / "calls").read_text().splitlines()
    assert result.returncode == 2 and result.stderr.count("\n") == 1, result
    command, _, rest = result.stderr.removeprefix("speed: ").partition(" ended with ")
    assert rest == "4: no such law\n", rest
    # What is told is what was run.
    told = shlex.split(command)
    assert told[:2] == ["stillpoint", "run"] and str(ROOT / told[2]) == words[1], (told, words)
    assert told[3:-2] == words[2 : words.index("--out")] and told[-2:] == ["--threads", "1"], (told, words)
    result = speed(folder, "--accept", STATUS="0")  # it came to rest
    assert result.returncode == 2 and " ended with 0" in result.stderr, result
    # Functions were to be kept, and then to be made anew.
    for phases, setting in (("2", "body.material=linear"), ("1", "phase.max_motion=0 ")):
        result = speed(folder, "--accept", PHASES=phases)
        assert result.returncode == 2 and f"--threads 1 had {phases} phases in 5 steps" in result.stderr, result
        assert setting in result.stderr, result
    (folder / "programs/stillpoint").unlink()
    assert speed(folder, "--accept").returncode == 2
    assert (folder / "speed.md").read_text() == old


@claim("scripts/speed says how many runs are done, and about how long the rest will take")
def _(_folder):
    module = script_module("speed")
    assert [module.time_text(seconds) for seconds in (59.4, 60, 200)] == ["59 s", "1 min 0 s", "3 min 20 s"]
    said, now = [], [0.0]
    module.time.monotonic = lambda: now[0]
    module.sys.stderr = type("Elsewhere", (), {"isatty": lambda _: False, "flush": lambda _: None,
                                               "write": lambda _, text: said.append(text)})()  # fmt: skip
    progress = module.Progress(4, 100)
    for now[0], work in ((20, 10), (50, 10), (60, 30)):
        progress.add(work)
    assert "".join(said) == "Measuring: 2 of 4 runs, about 3 min 20 s left\n", said


@claim("scripts/speed builds, measures and ends with its status")
def _(folder):
    scripts, environment = copy_of_scripts(folder, STILLPOINT)
    write_program(scripts.parent / "build/release/stillpoint_yardsticks", YARDSTICKS)
    write_program(scripts / "build_preset", '#!/bin/bash\necho "building $*"\n')
    result = call(scripts / "speed", "--quick", cwd=folder, env=environment | {"STATUS": "2"})
    assert result.returncode == 2 and "body.material=linear" in result.stderr, result
    assert result.stdout.endswith("stillpoint_command stillpoint_yardsticks\n"), result
    result = call(scripts / "speed", "--repeats", 0, cwd=folder, env=environment)
    assert result.returncode == 2 and "expected 1 or more" in result.stderr, result


if __name__ == "__main__":
    check_the_claim()
