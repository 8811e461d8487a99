"""What the scripts that draw have in common."""

import argparse
import csv
import json
import re
import sys
from pathlib import Path

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


def read_study(folder, name, *keys):
    """DIR/name.json of a study, an object with one of these keys."""
    file = folder / f"{name}.json"
    try:
        study = json.loads(file.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise Refused(f"{folder}: no {name}.json; is this the folder of `stillpoint {name}`?") from None
    except (OSError, ValueError) as error:
        raise Refused(f"{file}: {error}") from None
    if not isinstance(study, dict) or not any(isinstance(study.get(key), (dict, list)) for key in keys):
        raise Refused(f"{file}: expected an object with {' or '.join(keys)}")
    return study


def read_table(file, what):
    """The lines of a table, {column: text} each; what: of which it is."""
    if not file.exists():
        raise Refused(f"{file.parent}: no {file.name}; is this the folder of {what}?")
    with open(file, newline="", encoding="utf-8") as text:
        lines = list(csv.DictReader(text))
    if not lines:
        raise Refused(f"{file}: no rows")
    return lines


def read_figures(file, read_csv, study):
    """The rows of a study's table, which has figures; read_csv raises ValueError or TypeError if it is another's."""
    if not file.exists():
        raise Refused(f"{file.parent}: no {file.name}; is this the folder of {study}?")
    try:
        rows = read_csv(file)
    except (ValueError, TypeError) as error:
        raise Refused(f"{file}: {error}") from None
    if not any(row.found for row in rows):
        raise Refused(f"{file}: no figures")
    return rows


def draw_table(name, about, read, draw):
    """The program plot_NAME.py DIR [--out FILE], of DIR/NAME.csv; returns the exit status."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", type=Path)
    parser.add_argument("--out", metavar="FILE", type=Path)
    options = parser.parse_args()
    file = options.folder / f"{name}.csv"
    return finish(f"plot_{name}", lambda to: draw(read(file), to), options.out or options.folder / f"{name}.png")


def draw_study(name, about, read, draw):
    """The program plot_NAME.py DIR [--out FILE]; returns the exit status."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", type=Path)
    parser.add_argument("--out", metavar="FILE", type=Path)
    options = parser.parse_args()

    def draw_to(file):
        study = read(options.folder)
        try:
            draw(study, file)
        except (KeyError, TypeError) as error:
            missing = f"no {error}" if isinstance(error, KeyError) else error
            raise Refused(f"{options.folder / name}.json: {missing}") from None

    return finish(f"plot_{name}", draw_to, options.out or options.folder / f"{name}.png")
