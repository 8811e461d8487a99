"""`python3 plots KIND DIR… [--out FILE]`: draws what the folder of a run or a study holds. `stillpoint plot` calls it.

Exit status 2 and one line where there is nothing to draw, or where a module is missing.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .folders import Refused
from .needed import need

HISTORY = """The histories of runs, from each DIR/history.csv.

First the load against the displacement that drives it, where there is one; then, against time, the probes, the forces of
walls, supports and rigid bodies, the residual, and the energies. What never changes has no panel. A panel a field, a colour
a run, a line style a probe or a component of it; where the panels differ in their lines, each has a key of its own. Units
are those of the SI. A DIR whose subfolders hold runs too (the variants of its scene) is not drawn itself: its variants are,
and where its run ended in equilibrium, that is a grey line."""
FIELDS = """The points of DIR/fields.h5, coloured by a field.

In the plane a panel a stage: the points at their deformed places; several runs have a row each. A bar has a panel a run,
with a line a stage. NAME is what fields.h5 has (plastic_strain, stress_xy, …); of a vector its length (u) or a component
(u_x); or `layers`: alternating layers and columns of the undeformed body, to show what became of them. Without --field:
plastic_strain if some point has yielded, or u. N stages are drawn, evenly spread over those in the file: at most 6, or 3 of
each of several runs. A slope angle is told if a probe of the scene asks for it. The last stage of a run that found a limit
load has arrows along the velocity, its mechanism.

A body in space is seen from where x, y and z are large, y up, with one scale along all three. Its surface is lit: the top
has the colours of the bar, a little paler, what turns away from the light darker ones; points whose value is no number are
grey. --cut x=VALUE (y=, z=) takes away what lies before the plane where x has this value [m], in every stage, and shows the
inside; several cuts, across different axes, take away what lies before all of them, a corner. The arrows of a mechanism are
those of the points that one sees, as they appear along the view: motion straight towards the viewer has none."""
COMPARE = """The work-precision picture of a comparison, from DIR/compare.json.

Error against force evaluations and against wall time, a line a run (a dot if only its end is known), with the Chebyshev
estimate of a polynomial iteration's worst case."""
CONVERGE = """The picture of a convergence study, from DIR/converge.json.

Errors against the size of what is refined, and against wall time: speed against error. Thin grey lines have the orders that
theory knows, or else the whole one (1, 2, 3…) that is nearest to what was measured, each below the smallest errors of that
order. Of several series each is a line, of the quantity that all have an error of."""
ABOUT = {"history": HISTORY, "fields": FIELDS, "compare": COMPARE, "converge": CONVERGE}


def parse(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser("plot", description="Draws what the folder of a run or a study holds.")
    kinds = parser.add_subparsers(dest="kind", metavar="KIND", required=True)
    for kind, about in ABOUT.items():
        add = kinds.add_parser(
            kind, help=about.partition("\n")[0], description=about, formatter_class=argparse.RawDescriptionHelpFormatter
        ).add_argument
        add("folders", metavar="DIR", type=Path, nargs="+" if kind in ("history", "fields") else 1)
        add("--out", metavar="FILE", type=Path, help=f"instead of DIR/{kind}.png; its ending says of which format it is")
        add("--show", action="store_true", help="open a window with it as well")
        if kind == "fields":
            add("--field", metavar="NAME")
            add("--cut", metavar="AXIS=VALUE", action="append", default=[])
            add("--stages", metavar="N", type=int)
    options = parser.parse_args(arguments)
    if options.kind == "fields" and options.stages is not None and options.stages < 1:
        parser.error("--stages: there should be one at least")
    return options


def draw(options: argparse.Namespace, figure: Any) -> Any:
    """The figure that is asked for, on an empty one or None. Modules are imported once it is known that they can be."""
    if options.kind == "history":
        from . import history, history_runs

        return history.figure_of(*history_runs.find_runs(options.folders), figure)
    if options.kind == "fields":
        from . import field_files, field_space, fields

        wanted = options.stages or (6 if len(options.folders) == 1 else 3)
        cuts = field_space.read_cuts(options.cut)
        return fields.figure_of(*field_files.read_runs(options.folders, options.field, wanted), cuts, figure)

    (folder,) = options.folders
    if options.kind == "compare":
        from . import compare as study
    else:
        from . import converge as study  # type: ignore[no-redef]
    figures = study.read(folder)
    try:
        return study.figure_of(figures, figure)
    except (KeyError, TypeError) as error:
        missing = f"no {error}" if isinstance(error, KeyError) else error
        raise Refused(f"{folder / options.kind}.json: {missing}") from None


def save(figure: Any, file: Path) -> None:
    formats = figure.canvas.get_supported_filetypes()
    if file.suffix[1:].lower() not in formats:
        raise Refused(f"--out {file}: expected a file whose name ends with one of .{', .'.join(sorted(formats))}")
    figure.savefig(file)
    print(f"Picture: {file}", flush=True)


def empty_window() -> Any:
    """A figure of pyplot's, for which a window opens at the end."""
    from matplotlib import pyplot  # type: ignore[import]

    figure = pyplot.figure()
    if figure.canvas.required_interactive_framework is None:
        raise Refused("--show: no window can be opened; is there a display, and Debian's package python3-tk?")
    return figure


def main(arguments: Sequence[str] | None = None) -> int:
    """Returns the exit status."""
    options = parse(arguments)
    try:
        for name in ("numpy", "matplotlib", *(["h5py"] if options.kind == "fields" else [])):
            need(name)
        figure = draw(options, empty_window() if options.show else None)
        save(figure, options.out or options.folders[0] / f"{options.kind}.png")
    except (ImportError, OSError, ValueError) as error:
        print(f"plot {options.kind}: {error}", file=sys.stderr)
        return 2
    if options.show:
        from matplotlib import pyplot

        pyplot.show()
    return 0
