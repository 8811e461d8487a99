#!/usr/bin/python3
"""manual_test.py ROOT CLAIM PROGRAM: one claim about the manual page and the completions, beside the command that lies where
PROGRAM does."""

import os
import re
import sys
from pathlib import Path

from claims import ROOT, call, check_the_claim, claim

COMMAND = Path(sys.argv[3]).parent / "stillpoint"


def help_of(*words):
    return call(COMMAND, *words, "--help").stdout


def commands():
    return re.findall(r"^  ([a-z]+) ", help_of().partition("Subcommands:")[2], re.MULTILINE)


def options(text):
    return set(re.findall(r"^ +(?:-h,)?(--[a-z-]+)", text, re.MULTILINE))


@claim("the manual page has every command and every option that the help has, and no other")
def _(_folder):
    page = (ROOT / "src/command/stillpoint.1.in").read_text(encoding="utf-8").replace("\\-", "-")
    assert len(commands()) == 8
    for command in commands():
        assert f"\n.B {command}\n" in page, command
    offered = set().union(options(help_of()), *(options(help_of(command)) for command in commands()))
    described = set(re.findall(r"--[a-z][a-z-]+", page))
    assert len(offered) > 15 and offered == described, offered ^ described


@claim("man finds nothing wrong with the manual page")
def _(folder):
    page = folder / "stillpoint.1"
    page.write_text((ROOT / "src/command/stillpoint.1.in").read_text(encoding="utf-8"), encoding="utf-8")
    result = call("man", "--warnings", "--local-file", page, env=os.environ | {"MANWIDTH": "80", "LC_ALL": "C.UTF-8"})
    assert result.returncode == 0 and not result.stderr, result.stderr
    assert "EXIT STATUS" in result.stdout


BASH = """
source "$1"
compopt() { :; } # which bash has in a completion alone
COMP_WORDS=("${@:2}") COMP_CWORD=$(($# - 2))
_stillpoint stillpoint "${*: -1}" "${*: -2:1}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


# In zsh what offers words and files does so only while somebody types: here it prints what it is given, as a line each.
ZSH = """
compadd() { while [[ $1 != -- ]]; do shift; done; shift; print -rl -- "$@" }
_files() {
  case "$*" in
    -/) print -rl -- *(N/:t) ;;
    '-g *.toml(-.)') print -rl -- *.toml(N) ;;
    *) print -rl -- *(N) ;;
  esac
}
compdef() { : }
source $1
words=("${@:2}") CURRENT=$(($# - 1))
_stillpoint
"""

FISH = """
source $argv[1]
complete --do-complete "$argv[2..]"
"""


def offers_of_bash(folder, environment, words):
    script = ROOT / "src/command/completion.bash"
    return call("bash", "-euc", BASH, "bash", script, *words, cwd=folder, env=environment)


def offers_of_zsh(folder, environment, words):
    return call("zsh", "-fc", ZSH, "zsh", ROOT / "src/command/completion.zsh", *words, cwd=folder, env=environment)


def offers_of_fish(folder, environment, words):
    script = ROOT / "src/command/completion.fish"
    return call("fish", "--no-config", "-c", FISH, script, *words, cwd=folder, env=environment)


def completes(folder, offers_of):
    """What a shell offers for words: those that begin as the last of them does."""
    for name in ("slab.toml", "slab.csv", "slab.png"):
        (folder / name).touch()
    (folder / "slabs").mkdir()
    environment = os.environ | {"PATH": f"{COMMAND.parent}:{os.environ['PATH']}", "HOME": str(folder)}

    def offers(*words):
        result = offers_of(folder, environment, ["stillpoint", *words])
        assert result.returncode in (0, 1) and not result.stderr, result.stderr
        found = [line.partition("\t")[0].rstrip("/") for line in result.stdout.splitlines()]
        return [word for word in found if word.startswith(words[-1])]

    assert offers("sp") == ["spectrum"] and offers("--v") == ["--version"]
    assert "slab.toml" in offers("run", "sl") and "slab.csv" not in offers("run", "sl")
    assert offers("run", "slab.toml", "--th") == ["--threads"]
    assert offers("run", "slab.toml", "--out", "s") == ["slabs"] == offers("run", "--resume", "s")
    assert offers("run", "slab.toml", "--set", "grid.c") == ["grid.cells="]
    assert offers("converge", "slab.toml", "--vary", "grid.b") == ["grid.basis="]
    assert "force[0].value=" in offers("run", "slab.toml", "--set", "force")
    assert "kinetic" in offers("compare", "slab.toml", "--strategies", "k")
    assert "erk:rk4" in offers("compare", "slab.toml", "--integrators", "erk:rk")
    assert offers("converge", "slab.toml", "--refine", "m") == ["motion"]
    assert offers("list", "b") == ["bases"] and offers("list", "keys", "--format", "m") == ["markdown"]
    assert offers("plot", "c") == ["compare", "converge"] and offers("plot", "history", "s") == ["slabs"]
    assert "--field" in offers("plot", "fields", "slabs", "--f") and "slab.png" in offers("plot", "fields", "slabs", "--out", "s")
    assert offers("plot", "fields", "slabs", "--field", "lay") == ["layers"]
    assert offers("plot", "fields", "slabs", "--cut", "y") == ["y="]


@claim("bash completes commands, options, scenes, folders, keys of a scene, and names of methods")
def _(folder):
    completes(folder, offers_of_bash)


@claim("zsh completes what bash does")
def _(folder):
    completes(folder, offers_of_zsh)


@claim("fish completes what bash does")
def _(folder):
    completes(folder, offers_of_fish)


if __name__ == "__main__":
    check_the_claim()
