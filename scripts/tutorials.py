#!/usr/bin/python3
"""tutorials.py [--accept] [FILE…]: runs what tutorials say to run, and compares what comes of it with what they show.

In a tutorial, a Markdown file (README.md and all of problems/manual and problems/tutorials, if none is named),

    ```console          has commands, behind '$ ', and below each what it prints,
    ```toml NAME        and the like, with a name behind the language, has a file that is written before,
    ![…](NAME.png)      has to be left by the commands; a picture in another folder has not.

Commands of a tutorial run in bash, in one empty folder that has links to problems/, scripts/ and build/release, with that
before everything on the PATH, and its Python package. In what they print '…' stands for anything in a line, a line of it for any
number of lines, and spaces for as many as there are. --accept writes what was printed and drawn into the tutorials where it differs. Exit status 1 if
something differs or a command fails, 2 for bad input.
"""

import argparse
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^```(\w+) *(\S*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PICTURE = re.compile(r"!\[[^\]]*\]\(([^)\s/]+)\)")
ANYTHING = "…"


@dataclass
class Command:
    text: str
    shown: list[str]  # lines below it


@dataclass
class Difference:
    where: str
    shown: list[str]
    printed: list[str]

    def __str__(self):
        lines = difflib.unified_diff(self.shown, self.printed, "shown", "printed", lineterm="")
        return "\n".join([self.where, *lines])


# --- what a tutorial holds -----------------------------------------------------------------------------


def commands_of(block):
    """The commands of a ```console block; one goes on in the next line behind a backslash."""
    commands = []
    for line in block.splitlines():
        if line.startswith("$ "):
            commands.append(Command(line[2:], []))
        elif commands and not commands[-1].shown and commands[-1].text.endswith("\\"):
            commands[-1].text += "\n" + line
        elif commands:
            commands[-1].shown.append(line)
        else:
            raise ValueError(f"'{line}': expected a command, '$ …', in the first line of a block")
    return commands


def text_of(commands):
    return "".join("\n".join(["$ " + command.text, *command.shown]) + "\n" for command in commands)


# --- comparing -----------------------------------------------------------------------------------------


def normal(line):
    """With one space for several: columns are as wide as their numbers."""
    return re.sub(" +", " ", line.rstrip())


def pattern_of(shown):
    lines = (r"(?:.*\n)*" if line.strip() == ANYTHING else
             ".*".join(map(re.escape, normal(line).split(ANYTHING))) + r"\n" for line in shown)  # fmt: skip
    return re.compile("".join(lines))


def agree(shown, printed):
    text = "".join(normal(line) + "\n" for line in printed)
    return pattern_of(shown).fullmatch(text) is not None


# --- running -------------------------------------------------------------------------------------------


def environment(binaries):
    paths = [str(binaries), os.environ["PATH"]]
    return os.environ | {"PATH": os.pathsep.join(paths), "PYTHONPATH": str(binaries / "python"), "LC_ALL": "C.UTF-8"}


def run(command, folder, binaries):
    """What it prints, on both streams; the exit status is its last line unless it is 0."""
    done = subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environment(binaries), check=False, text=True, encoding="utf-8",
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    status = [] if done.returncode == 0 else [f"[exit status {done.returncode}]"]
    return done.stdout.splitlines() + status


def follow(tutorial, folder, binaries):
    """The tutorial's text with what its commands print, and the differences from what it shows."""
    for name in ("problems", "scripts"):
        (folder / name).symlink_to(ROOT / name)
    (folder / "build").mkdir()
    (folder / "build/release").symlink_to(binaries)
    text, differences = tutorial.read_text(encoding="utf-8"), []
    pieces, end = [], 0
    for fence in FENCE.finditer(text):
        language, name, block = fence.groups()
        if name:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(block, encoding="utf-8")
        if language != "console":
            continue
        commands = commands_of(block)
        for command in commands:
            printed = run(command.text, folder, binaries)
            if not agree(command.shown, printed):
                differences.append(Difference(f"{tutorial.name}: $ {command.text}", command.shown, printed))
                command.shown = printed
        pieces += [text[end : fence.start(3)], text_of(commands)]
        end = fence.end(3)
    for picture in PICTURE.findall(text):
        if not (folder / picture).is_file():
            differences.append(Difference(f"{tutorial.name}: no command leaves {picture}", [picture], []))
    return "".join(pieces) + text[end:], differences


def accept(tutorial, text, folder):
    tutorial.write_text(text, encoding="utf-8")
    for picture in PICTURE.findall(text):
        if (folder / picture).is_file():
            shutil.copyfile(folder / picture, tutorial.parent / picture)


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tutorials", nargs="*", type=Path, metavar="FILE")
    parser.add_argument("--accept", action="store_true", help="write what was printed and drawn into the tutorials")
    parser.add_argument("--binaries", type=Path, default=ROOT / "build/release", help="instead of build/release")
    options = parser.parse_args()
    folders = (ROOT / "problems/manual", ROOT / "problems/tutorials")
    documents = [ROOT / "README.md", *(file for folder in folders for file in sorted(folder.glob("*.md")))]
    options.tutorials = options.tutorials or documents
    for tutorial in options.tutorials:
        if not tutorial.is_file():
            parser.error(f"there is no {tutorial}")
    if not (options.binaries / "stillpoint").is_file():
        parser.error(f"--binaries: there is no program stillpoint in {options.binaries}")
    return options


def main():
    options, different = parse(), 0
    for tutorial in options.tutorials:
        with tempfile.TemporaryDirectory(prefix="stillpoint-") as temporary:
            text, differences = follow(tutorial, Path(temporary), options.binaries.resolve())
            for difference in differences:
                print(difference, end="\n\n")
            if options.accept and (differences or PICTURE.search(text)):
                accept(tutorial, text, Path(temporary))
        different += bool(differences)
        print(f"{tutorial.name}: {len(differences) or 'nothing'} {'differs' if len(differences) < 2 else 'differ'}")
    return 1 if different and not options.accept else 0


if __name__ == "__main__":
    sys.exit(main())
