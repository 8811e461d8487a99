"""The sections of scripts/beside_fem_limits.py, beside_fem_limits.md, and its lines on the terminal."""

import re

from beside_fem_limits_table import BLOCK, ERRORS, FOOTING, load_at, quickest, reference
from beside_fem_page import table
from beside_fem_runs import FEM, OURS
from beside_fem_table import by
from scaling_table import seconds_text, with_spaces

AT = (0.1, 0.3, 0.5, 0.7, 0.9, 0.95)  # compressions at which forces are compared

FOOTING_TEXT = """## A strip footing's limit load

    scripts/beside_fem_limits.py --only footing

![Error of the limit load, and the way to it](beside_fem/footing.png)

Half of a flexible, smooth footing on weightless clay, `problems/footing_limit.toml` for both programs: an even pressure λ c on
B = 1, on ground of 6 × 4, held at the bottom, on rollers at the sides, E = 10⁵ c and ν = 0.3. λ is found for the mean
settlement under the load and ends, by both, once it grows over the last fifth of the way less than a hundredth as fast as
on average. In plane flow the limit is N_c = 2 + π exactly [Prandtl 1920].

- **FEniCSx** has von Mises' law with a radial return at small strain, its consistent tangent by UFL, and Newton's method with
  MUMPS on the system that the settlement borders, in steps that are halved where it fails. `Q1-1` has one point a cell;
  `Q1-B` and `Q2-B` have fewer points for the change of volume than for the deviator (B-bar), `Q2-R` 2 × 2 points and `P2-R` 3.
- **Stillpoint** has the same law, the cone of Drucker and Prager without friction, at finite strain, and relaxes by local
  damping with a lumped mass while the load is driven. With one point a cell, in its middle, it is the same discrete problem as
  `Q1-1`, beside which it checks both programs; with four points, cells share their change of volume.
- **Time** of FEM is meshing, assembly and solver, without Python's imports and all that is done to forms; of Stillpoint the
  whole program. **Memory** of FEM is the peak beyond what Python holds with its imports; of Stillpoint that of the whole
  program, some 28 MB of which the smallest scene takes as well.

"""

BLOCK_TEXT = """## Where finite elements end

    scripts/beside_fem_limits.py --only block

![Force against compression](beside_fem/block.png)

A square of neo-Hookean rubber in plane strain, E = 1 and ν = 0.3, between two rough plates of which the upper one comes down,
`problems/ladder/pressed_block.toml`. Both programs have the same law. The sides bulge, and the corners' right angle opens until
they lie on the plates.

- **FEniCSx** takes Newton's method with MUMPS, in steps of 1 % of the height or 0.16 of a cell, halved down to 10⁻⁴ where it
  fails; an update that turns an element inside out is halved as well. With `free` sides, as elements are without contact,
  the sides go through the plates, and from there on the solution is of another problem. With sides that `stick` a node that
  has come to a plate is held on it from then on, which `scripts/fem_fold.py` adds by hand, and which serves for flat, rough
  plates that never let go.
- **Stillpoint** takes the scene as it stands, which does not say what will touch what: its walls push every node that comes to
  them. Leapfrog with local damping follows the plate through some hundreds of phases, at a small speed.

"""


def percent(value):
    return f"{100 * value:+.2f} %"


def line(row):
    size = f"{row.problem:<8} {row.way:<28} {row.cells:>4} cells"
    if not row.found:
        return f"{size}  missing: {row.reason}"
    took = f"{row.seconds:>8.3f} s  {row.megabytes:>6.1f} MB"
    if row.problem == FOOTING:
        return f"{size}  N_c {row.reached:.4f} ({percent(row.error)})  {took}"
    return f"{size}  to {100 * row.reached:.1f} %  {took}  {row.ended}"


def in_a_cell(reason):
    """Of a reason what comes before its advice and after its place in a scene, as text of a table."""
    return re.sub(r".*\.toml:\d+:\d+: ", "", (reason or "no solution").replace("|", "/").replace("\n", " ")).partition(";")[0]


def commands(rows):
    """One figure of each way, as a command."""
    coarsest = [of_it[0].command for of_it in by(rows, "way").values() if of_it[0].command]
    return "The coarsest of each way; the others differ in their cells:\n\n" + "".join(f"    {one}\n" for one in coarsest)


# --- the footing ---------------------------------------------------------------------------------------


def footing_line(row):
    if not row.found:
        return [row.way, row.cells, "missing: " + in_a_cell(row.reason)] + [""] * 6
    figures = [with_spaces(row.unknowns), f"{row.reached:.4f}", percent(row.error), with_spaces(row.iterations)]
    return [row.way, row.cells, *figures, seconds_text(row.whole_s), seconds_text(row.processor_s), f"{row.megabytes:.0f} MB"]


def times_table(rows):
    """The time to an error within which a way stays on all finer meshes."""
    lines = []
    for error in ERRORS:
        ours, theirs = (quickest([row for row in rows if row.program == program], error) for program in (OURS, FEM))
        ratio = f"{ours[0] / theirs[0]:.2g}" if ours and theirs else ""
        lines.append([f"{100 * error:g} %", time_of(ours), time_of(theirs), ratio])
    return table(["to an error of N_c of", OURS, FEM, "ratio"], lines)


def time_of(best):
    return f"{seconds_text(best[0])}, {best[1]}" if best else "not reached"


def footing_section(rows):
    headings = ["way", "cells", "unknowns", "N_c", "error", "iterations", "whole", "processor", "memory"]
    text = FOOTING_TEXT + times_table(rows) + "\n"
    text += "A way counts from where it stays within the error on all finer meshes, straight between its sizes on\n"
    text += "logarithmic axes. Iterations are Newton's, or evaluations of forces:\n\n"
    return text + table(headings, [footing_line(row) for row in rows]) + "\n" + commands(rows)


# --- the block -----------------------------------------------------------------------------------------


def end_of(row):
    if not row.found:
        return "missing: " + in_a_cell(row.reason)
    if not row.ended:
        return f"{100 * row.reached:.0f} %, as far as was asked"
    return f"{100 * row.reached:.1f} %: {in_a_cell(row.ended)}"


def beside(row, paths, to):
    """The forces over those of the row to compare with."""
    texts = []
    for compression in AT:
        own, theirs = load_at(row, paths, compression), load_at(to, paths, compression) if to else None
        texts.append("" if own is None else f"{own:.4g}" if row is to or not theirs else f"{100 * (own / theirs - 1):+.1f} %")
    return texts


def block_line(row, paths, to):
    if not row.found:
        return [row.way, row.cells, end_of(row)] + [""] * (5 + len(AT))
    passes = "" if row.passes is None or not row.functions.endswith("free") else f"{100 * row.passes:.0f} %"
    least = "" if row.least_det is None else f"{row.least_det:.2g}"
    took = [seconds_text(row.whole_s), seconds_text(row.processor_s), f"{row.megabytes:.0f} MB"]
    return [row.way, row.cells, end_of(row), passes, least, *beside(row, paths, to), *took]


def ends_of(rows):
    """Where they end, by the cells along a side."""
    texts = []
    for cells, of_size in by([row for row in rows if row.found], "cells").items():
        low, high = (f"{100 * end(row.reached for row in of_size):.0f}" for end in (min, max))
        texts.append(f"{low} % on {cells} cells a side" if low == high else f"{low} to {high} % on {cells} cells a side")
    return ", ".join(texts) or "nowhere"


def block_section(rows, paths):
    to = reference(rows, paths)
    kinds = {
        "Elements with free sides end at a compression of": [row for row in rows if row.functions.endswith(", free")],
        "Those whose sides stick come to": [row for row in rows if row.functions.endswith(", stick")],
        "Stillpoint comes to": [row for row in rows if row.program == OURS],
    }
    text = BLOCK_TEXT + " ".join(f"{kind} {ends_of(of_kind)}." for kind, of_kind in kinds.items() if of_kind) + "\n\n"
    if to:
        text += f"Forces of the plate are those of FEniCSx {to.functions}, {to.cells} cells a side, over E, and of the others\n"
        text += "how far off they are; `through from` is the compression from which free sides lie beyond a plate:\n\n"
    forces = [f"at {100 * compression:g} %" for compression in AT]
    headings = ["way", "cells a side", "ends at", "through from", "least det F", *forces, "whole", "processor", "memory"]
    return text + table(headings, [block_line(row, paths, to) for row in rows]) + "\n" + commands(rows)


def sections(rows, paths):
    of_problem = by(rows, "problem")
    parts = [footing_section(of_problem[FOOTING])] if FOOTING in of_problem else []
    return "\n".join(parts + ([block_section(of_problem[BLOCK], paths)] if BLOCK in of_problem else []))
