#!/usr/bin/python3
"""containers_test.py ROOT CLAIM PROGRAM: one claim about the two ways to make a container of a source tree."""

import re

from claims import ROOT, check_the_claim, claim

FOLDER = ROOT / "scripts/containers"


def docker_commands():
    """What RUN runs, and where."""
    words = [line.split(" ", 1) for line in (FOLDER / "Dockerfile").read_text().splitlines() if line[:1].isupper()]
    return [f"cd {rest}" if word == "WORKDIR" else rest for word, rest in words if word in ("RUN", "WORKDIR")]


def apptainer_section(name):
    """The lines of all sections of a name, without their indentation."""
    sections = re.findall(rf"^%{name}.*\n((?:  .*\n)+)", (FOLDER / "stillpoint.def").read_text(), re.MULTILINE)
    return [line.strip() for section in sections for line in section.splitlines()]


@claim("Apptainer's container is made by the commands of Docker's")
def _(folder):
    # Docker's container stands in /work when it starts, Apptainer's where it is called.
    assert apptainer_section("post") == [line for line in docker_commands() if line != "cd /work"], docker_commands()


@claim("Apptainer's container is made of the files of Docker's")
def _(folder):
    taken = []
    for line in re.findall(r"^COPY (?!--)(.*)", (FOLDER / "Dockerfile").read_text(), re.MULTILINE):
        *files, place = line.split()
        taken += [f"{file} {place}{file if place.endswith('/') else ''}" for file in files]
    assert apptainer_section("files")[: len(taken)] == taken, taken
    missing = [file for file in taken if not (ROOT / file.split()[0]).exists()]
    assert not missing, missing


check_the_claim()
