"""Tests by their claims: FILE_test.py ROOT CLAIM PROGRAM checks one, in a folder of its own."""

import importlib
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1])  # the source tree
CLAIMS = {}


def claim(text):
    return lambda function: CLAIMS.setdefault(text, function)


def call(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)


def script_module(name):
    """A script of ROOT/scripts as a module."""
    sys.path.insert(0, str(ROOT / "scripts"))
    return importlib.import_module(name)


def check_the_claim():
    with tempfile.TemporaryDirectory() as temporary:
        CLAIMS[sys.argv[2]](Path(temporary))
