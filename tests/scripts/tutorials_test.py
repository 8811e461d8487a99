#!/usr/bin/python3
"""tutorials_test.py ROOT CLAIM: one claim about scripts/tutorials.py of the source tree ROOT, or about the pages it follows."""

import re
import sys

from claims import ROOT, call, check_the_claim, claim


def followed(folder, text, *options):
    (folder / "stillpoint").write_text("#!/bin/bash\necho stillpoint \"$@\"\n")
    (folder / "stillpoint").chmod(0o755)
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
