"""What plot_history.py and plot_fields.py have in common."""

import json
import re
import sys

import matplotlib

matplotlib.use("Agg")

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]  # Okabe and Ito
STYLE = {"axes.spines.top": False, "axes.spines.right": False}


class Refused(Exception):
    """What is wrong with the input."""


def read_summary(folder):
    """(DIR/summary.json, what the picture calls the run): {} without the file, the folder's name without DIR/label."""
    summary, label = {}, folder.resolve().name
    try:
        if (folder / "summary.json").exists():
            summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        if (folder / "label").exists():
            label = (folder / "label").read_text(encoding="utf-8").strip()
    except (OSError, ValueError) as error:
        raise Refused(f"{folder}: {error}") from None
    if not isinstance(summary, dict):
        raise Refused(f"{folder / 'summary.json'}: expected an object")
    return summary, label


def title_of(summary):
    return str(summary.get("title") or summary.get("scene") or "")


def plain(text):
    """Text of a file as it stands: no formula for matplotlib to set, but π by its letter."""
    return re.sub(r"\bpi\b", "π", text).replace("$", r"\$")


def finish(program, draw, file):
    """Draws; returns the exit status, 2 where the input was refused."""
    try:
        draw(file)
    except (Refused, OSError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 2
    print(f"Picture: {file}")
    return 0
