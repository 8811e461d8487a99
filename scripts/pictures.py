"""What the scripts that draw have in common; their look is that of the package's plots."""

import argparse
import csv
import sys
from pathlib import Path

import matplotlib

sys.path.append(str(Path(__file__).resolve().parent.parent / "src/python/stillpoint"))
from plots.folders import Refused  # noqa: E402
from plots.pictures import COLOURS, STYLE, plain  # noqa: E402, F401

matplotlib.use("Agg")


def finish(program, draw, file):
    """Draws; returns the exit status, 2 where the input was refused."""
    try:
        draw(file)
    except (Refused, OSError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 2
    print(f"Picture: {file}")
    return 0


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


