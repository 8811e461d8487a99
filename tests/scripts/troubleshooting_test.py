#!/usr/bin/python3
"""troubleshooting_test.py ROOT CLAIM: one claim about problems/troubleshooting.md of the source tree ROOT."""

import re

from claims import ROOT, check_the_claim, claim

LITERAL = r'"((?:[^"\\\n]|\\.)*)"'
ADJACENT = re.compile(LITERAL + r"(?:\s*" + LITERAL + ")*")


def messages():
    """The texts that the program is made of, without what is filled in."""
    for file in [*(ROOT / "src").rglob("*.?pp"), *(ROOT / "include").rglob("*.?pp")]:
        for literals in ADJACENT.finditer(file.read_text(encoding="utf-8")):
            joined = "".join(re.findall(LITERAL, literals.group()))
            yield from re.split(r"\{[^}]*\}", joined.replace('\\"', '"'))


def quoted():
    """What the tables of the page quote in their first column, piece by piece between …"""
    page = (ROOT / "problems/troubleshooting.md").read_text(encoding="utf-8")
    for row in re.findall(r"^\| ([^|]*)\|", page, re.MULTILINE):
        for quotation in re.findall(r"`([^`]*)`", row):
            yield from (piece for piece in map(str.strip, quotation.split("…")) if piece)


@claim("every message that the page on troubleshooting quotes is one that the program can give")
def _(_folder):
    known = list(messages())
    pieces = list(quoted())
    unknown = [piece for piece in pieces if not any(piece in message for message in known)]
    assert len(pieces) > 15 and not unknown, unknown


if __name__ == "__main__":
    check_the_claim()
