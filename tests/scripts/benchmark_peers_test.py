#!/usr/bin/python3
"""benchmark_peers_test.py ROOT CLAIM: one claim about scripts/benchmark --peers and its file."""

import os
import subprocess

from claims import ROOT, call, check_the_claim, claim, copy_of_scripts, script_module

# A program that stands for others: it sleeps for 1 ms a step. By the clock of a file, if there is one, which it sets ahead,
# it takes 3 s to start and 0.25 s a step.
PEERS = r'''
[[peer]]
name = "Snail"
folder = "snail"
address = "https://example.org/snail"
commit = "0123456789abcdef"
licence = "MIT"
what = "A program that is slow."
theirs = "it crawls."
ours = "haste."
packages = ["snail-dev"]
build = ["cp snail.sh snail", "chmod +x snail"]

[[peer.also]]
name = "its house"
folder = "house"
address = "https://example.org/house"
commit = "fedcba9876543210"
licence = "BSD"

[[peer.file]]
name = "snail.sh"
text = """
#!/bin/bash
echo "Step 1"; echo "Step $1"; echo "$1 $2" >>calls
if [[ -f clock ]]; then awk -v steps="$1" '{ print $1 + 3 + 0.25 * steps }' clock >later && mv later clock; fi
sleep "$(awk -v steps="$1" 'BEGIN { print 0.001 * steps }')"
"""

[[peer.case]]
name = "a garden"
points = 1000
threads = [1, 2]
run = ["./snail STEPS THREADS"]
steps = [10, 30]
scene = "garden.toml"
settings = ["body.material=leaf"]
classical = ["phase.max_motion=0"]
frozen = ["stop.steps=9"]

[[peer]]
name = "Fossil"
folder = "fossil"
address = "https://example.org/fossil"
commit = "aaaa"
licence = "none is named"
what = "A program that was."
not_run = "its compiler is extinct."
'''
FIGURES = """
[measurement]
date = 2026-01-02
commit = "abc"
processor = "A processor"
vector_bits = 512
cores = 2
compiler = "g++ 12"
repetitions = 3
load = 0.1

[[measured]]
peer = "Snail"
case = "a garden"
threads = 1
theirs = [1200.0, 1500.0]
classical = [100.0, 101.0]
frozen = [20.0, 22.0]
"""
PAGE = "# Speed\n\n{}\n\nan old table\n{}\n\n## More\n"
# Stands for stillpoint: 40 ns a step where the grid is made anew, and 8 ns where it is kept.
STILLPOINT = """#!/bin/bash
printf '<%s>' "$@" >>"$CALLS"; echo >>"$CALLS"
ns=8
[[ "$*" != *max_motion=0* ]] || ns=40
while [[ $1 != --out ]]; do shift; done
printf '{"ns_per_point_step": %s, "points": 1000}' $ns >"$2/summary.json"
exit "${STATUS:-3}"
"""


def peers():
    return script_module("benchmark_peers")


def page():
    return script_module("benchmark_peers_page")


def written(folder, text=PEERS):
    file = folder / "peers.toml"
    file.write_text(text)
    return file


def refusal(file):
    """What read_peers() says of a file that lacks something."""
    module = peers()
    try:
        module.read_peers(file)
    except module.BadPeers as error:
        return str(error)
    raise AssertionError(f"it was taken: {file.read_text()}")


def build(folder, text=PEERS):
    """The peer, by the commands that are printed, in folder/built; there its sources have been brought already."""
    module = peers()
    for name in ("source", "house"):
        (folder / "built/snail" / name).mkdir(parents=True)
    script = folder / "build_peers"
    script.write_text(module.commands(module.read_peers(written(folder, text))))
    done = call("bash", script, folder / "built")
    assert done.returncode == 0 and (folder / "built/snail/snail").exists(), done
    return folder / "built"


def stillpoint(folder):
    program = folder / "stillpoint"
    program.write_text(STILLPOINT)
    program.chmod(0o755)
    return program


def run(folder, *options, **environment):
    variables = os.environ | {"CALLS": str(folder / "calls")} | environment
    files = ["--file", folder / "peers.toml", "--page", folder / "speed.md", "--program", folder / "stillpoint"]
    return call(ROOT / "scripts/benchmark_peers.py", *files, *options, env=variables)


def is_refused(result, *words):
    assert result.returncode == 2, result
    last = result.stderr.splitlines()[-1]
    assert last.startswith("benchmark: ") and all(word in last for word in words), result.stderr
    assert "Traceback" not in result.stderr, result.stderr


@claim("each program of peers.toml has an address, a commit, a licence, commands and figures of each case, or why it was not run")
def _(_folder):
    module = script_module("benchmark_peers_file")
    document = module.read_peers(ROOT / "tests/benchmark/peers.toml")
    names = {peer["name"] for peer in document["peer"]}
    assert {"MPM3D-F90", "mls-mpm88", "Matter", "geomechanics/mpm", "Exagoop"} <= names, names
    for peer in document["peer"]:
        assert peer["address"].startswith("https://") and len(peer["commit"]) == 40 and peer["licence"], peer["name"]
    for peer, case, threads in module.cases_of(document):
        row = module.row_of(document, peer, case, threads)
        assert row is not None, f"{peer['name']}, {case['name']}, {threads} threads: no figures"
        assert all(0 < row[way][0] <= row[way][1] for way in module.WAYS), row
        assert any("STEPS" in command for command in case["run"]) and (ROOT / case["scene"]).exists(), case
        assert threads == 1 or any("THREADS" in command for command in case["run"]), case
    assert len(document["measured"]) == len(module.cases_of(document)), "figures of a case that there is no more"
    text = (ROOT / "tests/benchmark/peers.toml").read_text()
    assert not any(path in text for path in ("/home/", "/work/", "/tmp/")), "a path of a machine"


@claim("the table of other programs has the least figures of each case, their ratios to ours and how far they swing, and who was not run")
def _(folder):
    written(folder, PEERS + FIGURES)
    result = run(folder)
    assert result.returncode == 0, result
    rows = [line.split("  ") for line in result.stdout.splitlines() if line.startswith(("Snail: ", "Fossil  "))]
    cells = [[cell.strip() for cell in row if cell.strip()] for row in rows]
    assert cells == [
        ["Snail: a garden", "1", "1200 ns", "100 ns", "20 ns", "12.0", "60.0", "+25 %"],
        ["Snail: a garden", "2", "not measured", "-", "-", "-", "-", "-"],
        ["Fossil", "-", "not run", "-", "-", "-", "-", "-"],
    ], cells
    assert "2 January 2026, commit abc, A processor with vectors of 512 bits, 2 cores, g++ 12, " in result.stdout
    text = " ".join(result.stdout.split())
    assert "the least of 3 repetitions in turn" in text and "one machine and of one day" in text, text
    assert "What it does in a step and ours does not: it crawls. The other way around: haste." in text, text
    assert "Not run: its compiler is extinct." in text, text


@claim("a program, a case or a row of peers.toml without one of its fields is refused with the field's name")
def _(folder):
    fields = [line.partition(" = ")[0] for line in (PEERS + FIGURES).splitlines() if " = " in line]
    assert len(fields) > 40
    for number, line in enumerate((PEERS + FIGURES).splitlines()):
        field, _, value = line.partition(" = ")
        if not value or value == '"""' or field == "not_run":
            continue
        without = (PEERS + FIGURES).splitlines()
        del without[number]
        said = refusal(written(folder, "\n".join(without)))
        assert said.startswith("peers.toml: ") and f"no '{field}'" in said, (line, said)
    assert "Fossil has no 'theirs'" in refusal(written(folder, PEERS.partition("not_run")[0]))
    for old, new, words in (
        ("steps = [10, 30]", "steps = [30, 10]", ["'steps' of a case of Snail", "the second the larger"]),
        ("points = 1000", 'points = "many"', ["'points' of a case of Snail", "a whole number", "'many'"]),
        ('licence = "MIT"', 'licence = ""', ["'licence' of Snail", "text"]),
        ("threads = [1, 2]", "threads = []", ["'threads' of a case of Snail", "a list"]),
        ('settings = ["body', 'settings = [1, "body', ["'settings' of a case of Snail", "text"]),
        ("[1200.0, 1500.0]", "[1500.0, 1200.0]", ["'theirs' of a row", "the least and the most"]),
        ("[100.0, 101.0]", "[100.0]", ["'classical' of a row", "the least and the most"]),
        ("[[peer]]", "[[peer", ["line 2"]),
    ):
        said = refusal(written(folder, (PEERS + FIGURES).replace(old, new, 1)))
        assert all(word in said for word in words), said
    is_refused(run(folder), "peers.toml", "line 2")
    (folder / "peers.toml").unlink()
    is_refused(run(folder), "peers.toml")


@claim("scripts/benchmark --peers --commands prints a script that fetches the others' sources, writes our inputs and builds")
def _(folder):
    written(folder)
    result = run(folder, "--commands")
    assert result.returncode == 0, result
    for words in (
        "Debian's packages: git snail-dev",
        "git clone --quiet https://example.org/snail source\n",
        "git -C source checkout --quiet 0123456789abcdef\n",
        "git clone --quiet https://example.org/house house\n",
        "git -C house checkout --quiet fedcba9876543210\n",
        "#   ./snail STEPS THREADS",
        "# beside stillpoint run garden.toml --set body.material=leaf --set phase.max_motion=0 --threads THREADS",
        "# beside stillpoint run garden.toml --set body.material=leaf --set stop.steps=9 --threads THREADS",
        "# Not run: its compiler is extinct.",
    ):
        assert words in result.stdout, (words, result.stdout)
    built = build(folder)
    assert (built / "snail/snail").read_text().startswith("#!/bin/bash\n") and not (built / "fossil").exists()
    without_folder = call("bash", folder / "build_peers")
    assert without_folder.returncode != 0 and "expected a folder" in without_folder.stderr, without_folder
    module = peers()
    script = module.commands(module.read_peers(ROOT / "tests/benchmark/peers.toml"))
    checked = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False)
    assert checked.returncode == 0 and not checked.stderr, checked


@claim("a step of another program takes what two runs of different lengths differ by, whatever the start takes")
def _(folder):
    module = peers()
    built = build(folder)
    clock = built / "snail/clock"
    clock.write_text("0\n")
    module.time.perf_counter = lambda: float(clock.read_text())  # 3 s to start, and 0.25 s a step
    document = module.read_peers(folder / "peers.toml")
    os.environ["CALLS"] = str(folder / "calls")
    rows = module.measure(document, {"Snail": built / "snail"}, stillpoint(folder), 2)
    assert [row["threads"] for row in rows] == [1, 2]
    for row in rows:
        assert row["theirs"] == [250000.0, 250000.0], rows
        assert row["classical"] == [40.0, 40.0] and row["frozen"] == [8.0, 8.0], rows
    assert (built / "snail/calls").read_text().split("\n")[:4] == ["10 1", "30 1", "10 2", "30 2"]


@claim("how many steps another program made is read from what it prints, where it chooses them")
def _(folder):
    module = peers()
    built = build(folder, PEERS.replace("steps = [10, 30]", "steps = [10, 30]\ncounted = 'Step (\\d+)'"))
    case = module.read_peers(folder / "peers.toml")["peer"][0]["case"][0]
    case["run"] = ["./snail $((2 * STEPS)) THREADS"]
    assert module.run_of(case, 10, 1, built / "snail", "Snail")[0] == 20
    case["counted"] = "Stride ([0-9]+)"
    try:
        module.run_of(case, 10, 1, built / "snail", "Snail")
        raise AssertionError("a number of steps was read that is not there")
    except module.BadPeers as error:
        assert "Snail" in str(error) and "Stride" in str(error)


@claim("other programs and this one are measured in turn, and --accept writes what they gave into peers.toml and the page, and nothing else")
def _(folder):
    module = page()
    built = build(folder, PEERS.replace("0.001", "0.02").replace("threads = [1, 2]", "threads = [2]"))
    stillpoint(folder)
    (folder / "speed.md").write_text(PAGE.format(module.MARKER, module.END))
    before = (folder / "peers.toml").read_text()
    for _again in range(2):
        result = run(folder, "--measure", built, "--repeats", 1, "--accept", "--commit", "abc")
        assert result.returncode == 0, result
    document = peers().read_peers(folder / "peers.toml")
    [row] = document["measured"]
    assert 1e4 < row["theirs"][0] < 6e4, row  # 2e4, and what the machine puts between
    assert row["classical"] == [40.0, 40.0] and row["frozen"] == [8.0, 8.0] and row["threads"] == 2, row
    found = document["measurement"]
    assert found["commit"] == "abc" and found["repetitions"] == 1 and found["vector_bits"] in (128, 256, 512), found
    after = (folder / "peers.toml").read_text()
    assert after.startswith(before) and after.count("[measurement]") == after.count("[[measured]]") == 1, after
    section = (folder / "speed.md").read_text()
    assert section.startswith(f"# Speed\n\n{module.MARKER}\n\n") and section.endswith(f"\n{module.END}\n\n## More\n"), section
    assert "| Snail: a garden | 2 | " in section and "| 40 ns | 8 ns | " in section and "an old table" not in section, section
    assert found["processor"] in section and str(folder) not in section + after
    calls = (folder / "calls").read_text()
    assert (
        "<run><garden.toml><--set><body.material=leaf><--set><phase.max_motion=0><--threads><2><--quiet>" in calls
    ), calls


@claim("figures of other programs are written between the marks of a page, which is refused without them before anything is run")
def _(folder):
    module = page()
    built = build(folder)
    stillpoint(folder)
    for text in ("# Speed\n", f"{module.END}\n{module.MARKER}\n"):
        (folder / "speed.md").write_text(text)
        is_refused(run(folder, "--measure", built, "--accept"), "speed.md", module.MARKER, module.END)
        assert (folder / "speed.md").read_text() == text and not (folder / "calls").exists()
    (folder / "speed.md").unlink()
    is_refused(run(folder, "--measure", built, "--accept"), "speed.md")


@claim("a program that fails, that takes no time for its steps or that is not there ends --measure with status 2 and what is wrong")
def _(folder):
    module = page()
    built = build(folder)
    stillpoint(folder)
    (folder / "speed.md").write_text(PAGE.format(module.MARKER, module.END))
    is_refused(run(folder, "--measure", folder / "nowhere"), "none of the other programs")
    is_refused(run(folder, "--measure", folder / "nowhere", "--accept"), "Snail has not been built")
    (built / "snail/snail").write_text("#!/bin/bash\necho so slow >&2\nexit 5\n")
    is_refused(run(folder, "--measure", built), "Snail: a garden ended with 5: so slow")
    (built / "snail/snail").write_text("#!/bin/bash\nsleep $(($1 < 20))\n")
    is_refused(run(folder, "--measure", built), "Snail: a garden", "no time of a step")
    (built / "snail/snail").write_text("#!/bin/bash\nsleep $(($1 > 20))\n")
    is_refused(run(folder, "--measure", built, STATUS="2"), "Snail: a garden: ours ended with 2")
    written(folder, PEERS.replace("points = 1000", "points = 999"))
    is_refused(run(folder, "--measure", built), "ours has 1000 points, and the other 999")
    for options in (["--repeats", "0"], ["--accept"], ["--commands", "--measure", built]):
        assert run(folder, *options).returncode == 2, options


@claim("scripts/benchmark --peers builds nothing, and this program alone where it is measured")
def _(folder):
    scripts, environment = copy_of_scripts(folder, STILLPOINT)
    for name in ("install_packages", "build_preset"):
        (scripts / name).write_text(f'#!/bin/bash\necho "{name} $*" >>"$CALLS"\n')
    built = build(folder)
    words = [scripts / "benchmark", "--peers", "--file", folder / "peers.toml"]
    for option in ([], ["--commands"]):
        result = call(*words, *option, env=environment)
        assert result.returncode == 0 and "Snail" in result.stdout and not (folder / "calls").exists(), result
    (built / "snail/snail").write_text("#!/bin/bash\nsleep $(($1 > 20))\n")
    result = call(*words, f"--measure={built}", "--repeats", 1, env=environment)
    assert result.returncode == 0 and "Snail: a garden" in result.stdout, result
    called = [line for line in (folder / "calls").read_text().splitlines() if not line.startswith("<")]
    assert called == ["install_packages run", "build_preset release stillpoint_command"], called


if __name__ == "__main__":
    check_the_claim()
