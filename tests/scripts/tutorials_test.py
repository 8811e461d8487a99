#!/usr/bin/python3
"""tutorials_test.py ROOT CLAIM: one claim about scripts/tutorials.py of the source tree ROOT, or about the pages it follows."""

import os
import re
import sys

from claims import ROOT, call, check_the_claim, claim


TUTORIALS = sorted((ROOT / "problems/tutorials").glob("*.md"))
NOTEBOOKS = sorted((ROOT / "problems/tutorials").glob("*.ipynb"))  # tests/python/notebook_test.py runs them
LINK = re.compile(r"\]\(([^)\s]+)\)")


def program_in(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "stillpoint").write_text("#!/bin/bash\necho stillpoint \"$@\"\n")
    (folder / "stillpoint").chmod(0o755)


def followed(folder, text, *options):
    program_in(folder)
    (folder / "it.md").write_text(text)
    return call(sys.executable, ROOT / "scripts/tutorials.py", "--binaries", folder, folder / "it.md", *options)


@claim("a tutorial that shows what its commands print passes, with anything for an ellipsis and for spaces")
def _(folder):
    text = """
```toml my.toml
a = 1
```
text
```console
$ cat my.toml
a = 1
$ stillpoint run \\
    my.toml
stillpoint  …toml
$ printf '1\\n2\\n3\\n4\\n'; exit 3
1
…
4
[exit status 3]
```
"""
    result = followed(folder, text)
    assert result.returncode == 0 and "nothing differs" in result.stdout, result


@claim("a line that differs, is missing or is one too many is shown, and --accept writes what was printed")
def _(folder):
    for shown in ("a 1\nb 2\n", "a 1\n", "a 1\nb 3\nc\n", "a 1…0\nb 3\n"):
        text = "before\n```console\n$ printf 'a 1\\nb 3\\n'\n" + shown + "```\nafter\n"
        result = followed(folder, text)
        assert result.returncode == 1 and "1 differs" in result.stdout, (shown, result)
        assert (folder / "it.md").read_text() == text
        assert followed(folder, text, "--accept").returncode == 0
        assert (folder / "it.md").read_text() == "before\n```console\n$ printf 'a 1\\nb 3\\n'\na 1\nb 3\n```\nafter\n"


@claim("a picture that no command leaves is a difference, and --accept takes one that is left")
def _(folder):
    text = "![it](it.png)\n```console\n$ echo drawn >%s.png\n```\n"
    assert "no command leaves it.png" in followed(folder, text % "other").stdout
    assert followed(folder, text % "it").returncode == 0 and not (folder / "it.png").exists()
    followed(folder, text % "it", "--accept")
    assert (folder / "it.png").read_text() == "drawn\n"


@claim("a picture of another folder need not be left by a command")
def _(folder):
    result = followed(folder, "![it](../it.png)\n```console\n$ echo drawn\ndrawn\n```\n")
    assert result.returncode == 0 and "nothing differs" in result.stdout, result


def followed_installed(folder, text):
    """By an installed tree, folder/prefix, that has a scene; PYTHONPATH is set where it is called."""
    prefix = folder / "prefix"
    program_in(prefix / "bin")
    problems = prefix / "share/stillpoint/problems"
    (problems / "tutorials").mkdir(parents=True, exist_ok=True)
    (problems / "one.toml").write_text("dim = 1\n")
    (problems / "tutorials/it.md").write_text(text)
    called = os.environ | {"PYTHONPATH": "/nowhere"}
    return call(sys.executable, ROOT / "scripts/tutorials.py", "--installed", prefix, env=called)


@claim("installed, the tutorials of the prefix run by its program on a copy of its scenes, with PYTHONPATH unset")
def _(folder):
    text = """
```console
$ stillpoint run problems/one.toml; sed -i s/1/2/ problems/one.toml; cat problems/one.toml
stillpoint run problems/one.toml
dim = 2
$ echo "${PYTHONPATH-unset}"; ls; ls installed
unset
installed
problems
bin
share
```
"""
    result = followed_installed(folder, text)
    assert result.returncode == 0 and "it.md: nothing differs" in result.stdout, result
    assert (folder / "prefix/share/stillpoint/problems/one.toml").read_text() == "dim = 1\n"


@claim("installed, PYTHONPATH names the module's folder where Python does not look by itself")
def _(folder):
    modules = folder / "prefix/lib/python3.11/dist-packages"
    modules.mkdir(parents=True)
    result = followed_installed(folder, f"```console\n$ echo $PYTHONPATH\n{modules.resolve()}\n```\n")
    assert result.returncode == 0 and "nothing differs" in result.stdout, result


@claim("installed, commands that need the source tree are left out, with the pictures that they draw, and no others")
def _(folder):
    needs_the_tree = "$ python3 scripts/draw.py --out %s.png\n$ cmake --install build/release\n"
    text = f"![it](it.png)\n```console\n{needs_the_tree}$ echo 1\n1\n```\n"
    result = followed_installed(folder, text % "it")
    assert result.returncode == 0 and "nothing differs" in result.stdout, result
    assert "no command leaves it.png" in followed_installed(folder, text % "other").stdout
    assert "+2" in followed_installed(folder, "```console\n$ echo 2 # my_scripts/ builds/\n1\n```\n").stdout


@claim("a prefix without a program, without scenes or without tutorials is refused")
def _(folder):
    prefix = folder / "prefix"
    for name, missing in (("", "program"), ("bin", "folder"), ("share/stillpoint/problems", "tutorials")):
        if name == "bin":
            program_in(prefix / name)
        (prefix / name).mkdir(parents=True, exist_ok=True)
        result = call(sys.executable, ROOT / "scripts/tutorials.py", "--installed", prefix)
        assert result.returncode == 2 and f"there is no {missing}" in result.stderr, (name, result)


@claim("every tutorial says where to run it, in the source tree and installed, before its first block")
def _(_folder):
    for page in TUTORIALS:
        start = re.split(r"^```", page.read_text(encoding="utf-8"), flags=re.MULTILINE)[0]
        where = start.partition("**Where to run it.**")[2]
        assert "source tree" in where and "installed" in where, page
        assert "cp -r /usr/share/stillpoint/problems ." in where or "ln -s /usr installed" in where, page
    assert len(TUTORIALS) >= 10


@claim("every tutorial ends with what comes next, and its links and those of the lists of tutorials lead somewhere")
def _(_folder):
    for page in TUTORIALS:
        text = page.read_text(encoding="utf-8")
        last = re.split(r"^## ", text, flags=re.MULTILINE)[-1]
        assert last.startswith("What next\n") and len(LINK.findall(last)) >= 3, page
        for link in LINK.findall(text):
            name, _, heading = link.partition("#")
            if name.startswith("https:"):
                continue
            linked = page.parent / name
            assert linked.exists(), (page, link)
            if heading:
                headings = re.findall(r"^#+ (.*)$", linked.read_text(encoding="utf-8"), re.MULTILINE)
                assert heading in [one.lower().replace(" ", "-") for one in headings], (page, link)
    for page in (ROOT / "README.md", ROOT / "problems/manual/README.md"):
        text = page.read_text(encoding="utf-8")
        listed = {(page.parent / link).resolve() for link in LINK.findall(text) if "tutorials/" in link}
        assert listed == {one.resolve() for one in TUTORIALS + NOTEBOOKS}, page


@claim("every scene that the README and the manual show has a name, and a command of the page runs it")
def _(_folder):
    scenes = 0
    for page in (ROOT / "README.md", *sorted((ROOT / "problems/manual").glob("*.md"))):
        text = page.read_text(encoding="utf-8")
        for name in re.findall(r"^```toml *(.*)$", text, re.MULTILINE):
            assert name and f"\n$ stillpoint run {name}" in text, (page, name)
            scenes += 1
    assert scenes >= 4


if __name__ == "__main__":
    check_the_claim()
