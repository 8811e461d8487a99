"""Tests by their claims: FILE_test.py ROOT CLAIM PROGRAM checks one, in a folder of its own."""

import importlib
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])  # the source tree
PLOTS = ROOT / "src/python/stillpoint/plots"
CLAIMS = {}


def claim(text):
    return lambda function: CLAIMS.setdefault(text, function)


def call(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def plot(kind, *arguments, **options):
    """By the folder that `stillpoint plot` runs."""
    return call("/usr/bin/python3", PLOTS, kind, *arguments, **options)


def plots_module(name):
    """A module of that folder, without the package around it."""
    sys.path.append(str(PLOTS.parent))
    return importlib.import_module(f"plots.{name}")


def script_module(name):
    """A script of ROOT/scripts as a module."""
    sys.path.insert(0, str(ROOT / "scripts"))
    return importlib.import_module(name)


def copy_of_scripts(folder, program):
    """scripts/ and what draws, with stubs for what installs, builds and computes; returns their folder, and an environment in which a
    program that writes to $CALLS does so to folder/calls."""
    root = folder / "a copy"
    shutil.copytree(ROOT / "scripts", root / "scripts")
    shutil.copytree(PLOTS, root / PLOTS.relative_to(ROOT))
    (root / "build/release").mkdir(parents=True)
    stubs = {"scripts/install_packages": "", "scripts/build_preset": "", "build/release/stillpoint": program}
    for name, text in stubs.items():
        (root / name).write_text(text or "#!/bin/bash\n")
        (root / name).chmod(0o755)
    return root / "scripts", os.environ | {"CALLS": str(folder / "calls")}


def check_the_claim():
    with tempfile.TemporaryDirectory() as temporary:
        CLAIMS[sys.argv[2]](Path(temporary))
