#!/usr/bin/python3
"""benchmark_test.py ROOT CLAIM: one claim about scripts/benchmark and its table."""

import math
import os

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

README = "# Benchmarks\n\n{}\n\nan old table\n{}\n\n## What a point costs\n"
# Stand for the programs: figures that are known, in the form of theirs. A folder "slow" takes twice as long. Yardsticks are
# of the new programs alone; in space they take 4 ns, in the plane 2.
BENCHMARKS = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"
name=${2#--benchmark_filter=^} slow=1
[[ $0 != */slow/* ]] || slow=2
printf '{"benchmarks": [{"run_type": "iteration", "run_name": "%s", "items_per_second": %s}]}' \\
  "${name%$}" $((200000000 / slow))
"""
STILLPOINT = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"
slow=1 scene=$2
[[ $0 != */slow/* ]] || slow=2
while [[ $1 != --out ]]; do shift; done
printf '{"ns_per_point_step": %s, "points": 1000, "steps": 100, "wall_s": 0.5, "rhs_evaluations": 101}' \\
  $((10 * slow)) >"$2/summary.json"
exit "${STATUS:-0}"
"""
YARDSTICKS = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"
printf '{"processor": "A processor", "vector_bits": 512, "yardsticks": {'
separator=
for name in "$@"; do
  [[ $name != --* ]] || continue
  ns=2
  [[ $name != *space* ]] || ns=4
  printf '%s"%s": {"points": 1000, "bytes_per_point_step": 144, "ns_per_point_step": %s}' "$separator" "$name" $ns
  separator=,
done
printf '}}'
"""


def write_program(file, text):
    file.write_text(text)
    file.chmod(0o755)


def programs(folder, name, yardsticks=False):
    (folder / name).mkdir()
    write_program(folder / name / "stillpoint", STILLPOINT)
    write_program(folder / name / "stillpoint_benchmarks", BENCHMARKS)
    if yardsticks:
        write_program(folder / name / "stillpoint_yardsticks", YARDSTICKS)
    return folder / name


def benchmark(folder, *options, **environment):
    variables = os.environ | {"CALLS": str(folder / "calls")} | environment
    return call(ROOT / "scripts/benchmark.py", "--repeats", 2, "--quick", *options, env=variables)


def table(folder):
    module = script_module("benchmark_table")
    return module, folder / "README.md"


@claim("Google Benchmark's JSON is read as ns a point, of repetitions the least, without their means")
def _(_folder):
    of_benchmarks = script_module("benchmark_table").of_benchmarks
    row = {"run_type": "iteration", "run_name": "plane_step/basis:0/threads:1/real_time", "items_per_second": 2e8}
    mean = row | {"run_type": "aggregate", "items_per_second": 1e12}
    slower = row | {"items_per_second": 1e8}
    assert of_benchmarks({"benchmarks": [slower, row, mean]}) == {"plane_step/basis:0/threads:1": 5.0}
    module = script_module("benchmark_table")
    try:
        of_benchmarks({"benchmarks": [row | {"name": "it", "error_occurred": True, "error_message": "the step failed"}]})
        raise AssertionError("a benchmark that failed was taken for one")
    except module.BadFigures as error:
        assert "the step failed" in str(error)


@claim("the set-up of a run is what its steps leave of its wall time")
def _(_folder):
    of_summary = script_module("benchmark_table").of_summary
    found = of_summary({"ns_per_point_step": 10, "points": 1000, "steps": 100, "wall_s": 0.5, "rhs_evaluations": 101})
    assert math.isclose(found["set-up"][0], 0.499) and found["evaluations"] == (101, "evaluations")


@claim("of old and new the least times are compared, with their ratio and how far repetitions swing")
def _(_folder):
    module = script_module("benchmark_table")
    figures = module.Figures(["old", "new"])
    for program, value in (("old", 4.0), ("new", 3.0), ("new", 2.0), ("old", 5.0)):
        figures.add("a step", 1, "ns", program, value)
    figures.add("only new", 2, "s", "new", 1.5)
    assert module.texts(figures, ("a step", 1)) == ["a step", "1", "4.0 ns", "2.0 ns", "0.50", "-", "-", "+50 %"]
    assert module.texts(figures, ("only new", 2)) == ["only new", "2", "-", "1.5 s", "-", "-", "-", "+0 %"]
    lines = module.terminal_table(figures).splitlines()
    assert len(lines) == 3 and lines[0].split()[:3] == ["what", "threads", "old"]
    try:
        figures.add("a step", 1, "ns", "new", math.nan)
        raise AssertionError("a figure that is none was taken")
    except module.BadFigures:
        pass


@claim("a figure of the new program is set beside the least of its yardstick and of the memory, where it has them")
def _(_folder):
    module = script_module("benchmark_table")
    figures = module.Figures(["old", "new"])

    def printed(**ns):
        found = {name: {"ns_per_point_step": value} for name, value in ns.items()}
        return {"processor": "A processor", "vector_bits": 256, "yardsticks": found}

    module.of_yardsticks(printed(plane_linear=2.5, stream_plane=3.0), figures)
    module.of_yardsticks(printed(plane_linear=2.0, stream_plane=4.0), figures)
    both = ("plane_linear", "stream_plane")
    for program, value in (("old", 12.0), ("new", 6.0), ("new", 7.0)):
        figures.add("a step", 1, "ns", program, value, both)
    figures.add("only old", 1, "ns", "old", 6.0, both)
    figures.add("without a yardstick", 1, "ns", "new", 6.0, (None, "stream_plane"))
    assert module.texts(figures, ("a step", 1))[4:7] == ["0.50", "3.0", "2.0"]
    assert module.texts(figures, ("only old", 1))[5:7] == ["-", "-"]
    assert module.texts(figures, ("without a yardstick", 1))[5:7] == ["-", "2.0"]
    assert figures.vector_bits == 256
    assert figures.yardsticks_in_words() == (
        "Yardsticks, ns a point and step on one thread: plane linear 2.0, stream plane 3.0."
    )
    for nothing in (0, math.nan):
        try:
            module.of_yardsticks(printed(space=nothing), figures)
            raise AssertionError("a yardstick of no length was taken")
        except module.BadFigures as error:
            assert "space" in str(error)


@claim("a table is written between the marks of a README, again and again, and nothing else is touched")
def _(folder):
    module, readme = table(folder)
    readme.write_text(README.format(module.MARKER, module.END))
    figures = module.Figures(["new"])
    figures.add("a step", 1, "ns", "new", 2.0)
    for _again in range(2):
        module.SECTION.write(readme, module.markdown(figures, "Commit abc, 2 cores."))
    text = readme.read_text()
    assert text.count("| a step | 1 | 2.0 ns | - | - | +0 % |") == 1 and text.count(module.MARKER) == 1
    assert "old table" not in text and text.startswith("# Benchmarks\n\n<!--") and text.endswith("## What a point costs\n")
    readme.write_text("# Benchmarks\n")
    try:
        module.SECTION.write(readme, "")
        raise AssertionError("a README without marks was written to")
    except ValueError as error:
        assert "README.md" in str(error) and readme.read_text() == "# Benchmarks\n"


@claim("tests/benchmark/README.md has the marks that scripts/benchmark writes between, and no path of a machine")
def _(_folder):
    module = script_module("benchmark_table")
    text = (ROOT / "tests/benchmark/README.md").read_text()
    assert text.count(module.MARKER) == 1 and text.index(module.MARKER) < text.index(module.END)
    assert "/home/" not in text and "/work/" not in text and "/tmp/" not in text


@claim("scripts/benchmark.py measures old and new in turn and names the faster by a ratio below 1")
def _(folder):
    module, readme = table(folder)
    readme.write_text(README.format(module.MARKER, module.END))
    options = ["--old", programs(folder, "slow"), "--new", programs(folder, "fast", True), "--readme", readme, "--accept"]
    result = benchmark(folder, *options)
    assert result.returncode == 0, result
    step = [line for line in result.stdout.splitlines() if line.startswith("a step, linear, Drucker-Prager")]
    assert len(step) == 2, step
    assert step[0].split()[-9:] == ["10.0", "ns", "5.0", "ns", "0.50", "2.5", "2.5", "+0", "%"], step
    text = readme.read_text()
    figures = "20.0 ns | 10.0 ns | 0.50 | {} | +0 % |"
    by = "5.0 | 5.0"
    assert f"| the slope, quadratic, max_motion = 0: ns a point and step | 2 | {figures.format(by)}" in text
    block = "| a block in space, {}, Drucker-Prager: ns a point and step | 1 | "
    assert block.format("linear") + figures.format("2.5 | 2.5") in text
    assert block.format("quadratic") + figures.format("- | 2.5") in text
    assert "evaluations | 1 | 101 | 101 | 1.00 | - | - | +0 % |" in text and str(folder) not in text
    calls = (folder / "calls").read_text()
    assert "<phase.max_motion=0>" in calls and "<--threads><2>" in calls
    assert calls.count("<--quick><plane_linear>") == 2, "the yardsticks are measured in each repetition"
    assert "A processor with vectors of 512 bits, " in text and "cores, the least of 2 repetitions in turn" in text
    assert "on one thread: plane linear 2.0, plane quadratic 2.0, space 4.0, stream plane 2.0, stream space 4.0." in text


@claim("a program that fails or says nothing of use ends scripts/benchmark.py with status 2 and its words")
def _(folder):
    new = programs(folder, "fast", True)
    result = benchmark(folder, "--new", new, STATUS="4")
    assert result.returncode == 2 and "stillpoint ended with 4" in result.stderr, result
    (new / "stillpoint_benchmarks").write_text("#!/bin/bash\necho no JSON\n")
    assert benchmark(folder, "--new", new).returncode == 2
    assert benchmark(folder, "--new", folder / "missing").returncode == 2
    (new / "stillpoint_benchmarks").write_text(BENCHMARKS)
    for text in ("echo no JSON", "echo '{}'", "echo too wide >&2; exit 1"):
        (new / "stillpoint_yardsticks").write_text(f"#!/bin/bash\n{text}\n")
        result = benchmark(folder, "--new", new)
        assert result.returncode == 2 and result.stderr.splitlines()[-1].startswith("benchmark: "), result
    assert "stillpoint_yardsticks ended with 1: too wide" in result.stderr, result


@claim("scripts/benchmark builds, takes a folder of old programs, and refuses what is no commit")
def _(folder):
    scripts, environment = copy_of_scripts(folder, STILLPOINT)
    fast = scripts.parent / "build/release"
    write_program(fast / "stillpoint_benchmarks", BENCHMARKS)
    write_program(fast / "stillpoint_yardsticks", YARDSTICKS)
    arguments = ["--quick", "--repeats", 1, "--threads", 1]
    result = call(scripts / "benchmark", programs(folder, "slow"), *arguments, cwd=folder, env=environment)
    assert result.returncode == 0 and "new/old" in result.stdout and "0.50" in result.stdout, result
    result = call(scripts / "benchmark", *arguments, cwd=folder, env=environment)
    assert result.returncode == 0 and "new/old" not in result.stdout, result
    result = call(scripts / "benchmark", "no-such-commit", cwd=folder, env=environment)
    assert result.returncode == 2 and "no-such-commit" in result.stderr, result


@claim("scripts/benchmark builds an older commit in a worktree that does not stay, once")
def _(folder):
    scripts, environment = copy_of_scripts(folder, STILLPOINT)
    root = scripts.parent
    given = programs(folder, "given", True)
    # A build copies the programs to where it stands.
    (scripts / "build_preset").write_text(
        f'#!/bin/bash\ncd "$(dirname "$0")/.." && mkdir -p build/release && cp "{given}"/* build/release && echo built\n'
    )
    (root / ".gitignore").write_text("build/\n")
    author = ["-c", "user.name=nobody", "-c", "user.email=nobody@example.org"]
    for words in (["init", "-q"], ["add", "."], [*author, "commit", "-q", "-m", "An older one"]):
        assert call("git", "-C", root, *words).returncode == 0
    for builds in (2, 1):
        result = call(scripts / "benchmark", "HEAD", "--quick", "--repeats", 1, "--threads", 1, env=environment)
        assert result.returncode == 0 and "new/old" in result.stdout, result
        assert result.stdout.count("built") == builds, result.stdout
        assert len(call("git", "-C", root, "worktree", "list").stdout.splitlines()) == 1
    assert not list((root / "build").glob("*/tree"))


if __name__ == "__main__":
    check_the_claim()
