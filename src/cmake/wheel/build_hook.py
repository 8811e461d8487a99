"""Builds what a wheel holds beside the files in Python, whenever pip or another front end asks hatchling for one.

STILLPOINT_WHEEL_PRESET names the preset of CMakePresets.json. `pip`, the default, builds for this machine and its libraries;
`wheel` builds for every processor, and carries the libraries.
"""

import os
import shutil
import sys
import sysconfig
from pathlib import Path
from subprocess import check_call, check_output

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class BuildHook(BuildHookInterface):
    def initialize(self, version, build_data):
        if version == "editable":
            raise RuntimeError("an editable install would have no compiled half; PYTHONPATH=build/release/python has both")
        root = Path(self.root)
        preset = os.environ.get("STILLPOINT_WHEEL_PRESET", "pip")
        files = root / "build/wheel_files"  # laid out as in the wheel; pyproject.toml takes the data from there
        package, beside = files / "stillpoint", files / "stillpoint_mpm"
        shutil.rmtree(files, ignore_errors=True)

        check_call([root / "scripts/build_preset", preset, f"-DPython_EXECUTABLE={sys.executable}"])
        for component in ("command", "library", "python", "multigrid"):
            check_output(["cmake", "--install", root / "build" / preset, "--prefix", beside, "--strip", "--component", component])
        for module in beside.glob("lib/stillpoint/*.so"):  # of the multigrid mass: here Python and the program find it
            module.rename(package / module.name)

        platform = sysconfig.get_platform().replace("-", "_")
        if preset == "wheel":
            platform = check_output([sys.executable, root / "src/cmake/wheel/carry_libraries.py", files], text=True).strip()
        python = f"cp{sys.version_info.major}{sys.version_info.minor}"
        build_data["tag"] = f"{python}-{python}-{platform}"
        build_data["pure_python"] = False
        for made in [*package.glob("*.so"), *(beside / name for name in ("bin", "lib", "copyright"))]:
            if made.exists():
                build_data["force_include"][str(made)] = str(made.relative_to(files))
