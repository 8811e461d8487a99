#!/usr/bin/python3
"""plot_history.py, plot_fields.py, plot_compare.py and plot_converge.py DIR…: what `stillpoint plot KIND DIR…` was called
before it was a command, for whoever calls it so. Their kind is in their name."""

import runpy
import sys
from pathlib import Path

sys.argv[1:1] = [Path(sys.argv[0]).stem.removeprefix("plot_")]
runpy.run_path(str(Path(__file__).resolve().parent.parent / "src/python/stillpoint/plots"), run_name="__main__")
