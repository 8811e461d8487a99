#!/usr/bin/python3
"""manual_test.py ROOT CLAIM PROGRAM: one claim about the manual page and the completion, beside the command that lies where
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
    assert len(commands()) == 7
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


OFFERS = """
source "$1"
compopt() { :; } # which bash has in a completion alone
COMP_WORDS=("${@:2}") COMP_CWORD=$(($# - 2))
_stillpoint stillpoint "${*: -1}" "${*: -2:1}"
printf '%s\\n' "${COMPREPLY[@]}"
"""


@claim("bash completes commands, options, scenes, keys of a scene, and names of methods")
def _(folder):
    (folder / "slab.toml").touch()
    (folder / "slab.csv").touch()
    environment = os.environ | {"PATH": f"{COMMAND.parent}:{os.environ['PATH']}"}

    def offers(*words):
        script = ROOT / "src/command/completion.bash"
        result = call("bash", "-euc", OFFERS, "bash", script, "stillpoint", *words, cwd=folder, env=environment)
        assert result.returncode == 0, result.stderr
        return result.stdout.split()

    assert offers("sp") == ["spectrum"]
    assert offers("run", "sl") == ["slab.toml"]
    assert offers("run", "slab.toml", "--th") == ["--threads"]
    assert offers("run", "slab.toml", "--set", "grid.c") == ["grid.cells="]
    assert "force[0].value=" in offers("run", "slab.toml", "--set", "force")
    assert "kinetic" in offers("compare", "slab.toml", "--strategies", "k")
    assert "erk:rk4" in offers("compare", "slab.toml", "--integrators", "erk:rk")
    assert offers("list", "b") == ["bases"]


if __name__ == "__main__":
    check_the_claim()
