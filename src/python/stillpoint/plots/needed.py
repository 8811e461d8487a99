"""Modules of others, and the Debian package that has each."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Any

PACKAGES = {name: f"python3-{name}" for name in ("numpy", "matplotlib", "h5py", "pandas", "meshio")}


def need(name: str) -> Any:
    """The module of that name. ImportError says in one line which package to install where there is none."""
    try:
        return import_module(name)
    except ImportError as error:
        is_there = not isinstance(error, ModuleNotFoundError) or error.name != name
        what = f"cannot load the module '{name}'" if is_there else f"finds no module '{name}'"
        how = f"install Debian's package {PACKAGES[name]}, or '{name}' by pip"
        raise ImportError(f"{sys.executable} {what}: {how}", name=name) from None
