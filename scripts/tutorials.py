#!/usr/bin/python3
"""tutorials.py [--accept | --installed PREFIX] [FILE…]: runs what tutorials say to run, and compares what comes of it with
what they show.

In a tutorial, a Markdown file (README.md and all of problems/manual and problems/tutorials, if none is named),

    ```console          has commands, behind '$ ', and below each what it prints,
    ```toml NAME        and the like, with a name behind the language, has a file that is written before,
    ![…](NAME.png)      has to be left by the commands; a picture in another folder has not.

Commands of a tutorial run in bash, in one empty folder that has links to problems/, scripts/ and build/release, with
that before everything on the PATH, and its Python package. In what they print '…' stands for anything in a line, a line
of it for any number of lines, and spaces for as many as there are. --accept writes what was printed and drawn into the
tutorials where it differs. Exit status 1 if something differs or a command fails, 2 for bad input.

--installed PREFIX follows them as somebody does who has the packages and no source tree: the folder has a copy of the
scenes in PREFIX/share/stillpoint/problems, and a link 'installed' to PREFIX; the program is that of PREFIX/bin, and
PYTHONPATH is unset, but where Python does not look for modules below PREFIX by itself. Commands that name a file in
scripts/ or build/ need the source tree: they are left out, and so are the pictures that they draw. If no file is named,
all tutorials of PREFIX are followed.
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
NEEDS_THE_TREE = re.compile(r"(?<![\w/.-])(scripts|build)/")
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


@dataclass
class Place:
    """Where the program is, and what a reader's folder holds."""

    programs: Path
    modules: list[Path]  # for PYTHONPATH
    prefix: Path | None = None  # None: the source tree

    def has(self, command):
        return self.prefix is None or not NEEDS_THE_TREE.search(command.text)

    def prepare(self, folder):
        if self.prefix:
            shutil.copytree(problems_of(self.prefix), folder / "problems")
            (folder / "installed").symlink_to(self.prefix)
            return
        for name in ("problems", "scripts"):
            (folder / name).symlink_to(ROOT / name)
        (folder / "build").mkdir()
        (folder / "build/release").symlink_to(self.programs)


def problems_of(prefix):
    return prefix / "share/stillpoint/problems"


def tree(binaries):
    return Place(programs=binaries, modules=[binaries / "python"])


def installed(prefix):
    packages = prefix.glob("lib/python3*/dist-packages")
    return Place(programs=prefix / "bin", modules=[one for one in packages if str(one) not in sys.path], prefix=prefix)


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


def environment(place):
    settings = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    settings |= {"PATH": os.pathsep.join([str(place.programs), os.environ["PATH"]]), "LC_ALL": "C.UTF-8"}
    return settings | ({"PYTHONPATH": os.pathsep.join(map(str, place.modules))} if place.modules else {})


def run(command, folder, place):
    """What it prints, on both streams; the exit status is its last line unless it is 0."""
    done = subprocess.run(
        ["bash", "-c", command], cwd=folder, env=environment(place), check=False, text=True, encoding="utf-8",
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    status = [] if done.returncode == 0 else [f"[exit status {done.returncode}]"]
    return done.stdout.splitlines() + status


def follow(tutorial, folder, place):
    """The tutorial's text with what its commands print, and the differences from what it shows."""
    place.prepare(folder)
    text, differences = tutorial.read_text(encoding="utf-8"), []
    pieces, end, left_out = [], 0, ""
    for fence in FENCE.finditer(text):
        language, name, block = fence.groups()
        if name:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(block, encoding="utf-8")
        if language != "console":
            continue
        commands = commands_of(block)
        for command in commands:
            if not place.has(command):
                left_out += command.text + "\n"
                continue
            printed = run(command.text, folder, place)
            if not agree(command.shown, printed):
                differences.append(Difference(f"{tutorial.name}: $ {command.text}", command.shown, printed))
                command.shown = printed
        pieces += [text[end : fence.start(3)], text_of(commands)]
        end = fence.end(3)
    for picture in PICTURE.findall(text):
        if picture not in left_out and not (folder / picture).is_file():
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
    parser.add_argument("--binaries", type=Path, default=ROOT / "build/release", help="instead of build/release")
    way = parser.add_mutually_exclusive_group()
    way.add_argument("--accept", action="store_true", help="write what was printed and drawn into the tutorials")
    way.add_argument("--installed", type=Path, metavar="PREFIX", help="with what is installed there, not the source tree")
    options = parser.parse_args()
    options.place = installed(options.installed.resolve()) if options.installed else tree(options.binaries.resolve())
    option = "--installed" if options.installed else "--binaries"
    if not (options.place.programs / "stillpoint").is_file():
        parser.error(f"{option}: there is no program stillpoint in {options.place.programs}")
    if options.installed and not problems_of(options.place.prefix).is_dir():
        parser.error(f"{option}: there is no folder {problems_of(options.place.prefix)}")
    options.tutorials = options.tutorials or documents(options.place)
    if not options.tutorials:
        parser.error(f"{option}: there is no tutorials/*.md in {problems_of(options.place.prefix)}")
    for tutorial in options.tutorials:
        if not tutorial.is_file():
            parser.error(f"there is no {tutorial}")
    return options


def documents(place):
    if place.prefix:
        return sorted((problems_of(place.prefix) / "tutorials").glob("*.md"))
    folders = (ROOT / "problems/manual", ROOT / "problems/tutorials")
    return [ROOT / "README.md", *(file for folder in folders for file in sorted(folder.glob("*.md")))]


def main():
    options, different = parse(), 0
    for tutorial in options.tutorials:
        with tempfile.TemporaryDirectory(prefix="stillpoint-") as temporary:
            text, differences = follow(tutorial, Path(temporary), options.place)
            for difference in differences:
                print(difference, end="\n\n")
            if options.accept and (differences or PICTURE.search(text)):
                accept(tutorial, text, Path(temporary))
        different += bool(differences)
        print(f"{tutorial.name}: {len(differences) or 'nothing'} {'differs' if len(differences) < 2 else 'differ'}")
    return 1 if different and not options.accept else 0


if __name__ == "__main__":
    sys.exit(main())
