"""The cases of the accuracy ladder, problems/ladder/ladder.toml: what is run, what is read of it, and what is right.

A [[case]] has
  name       of its rows
  about      what it is, a sentence
  source     of the answer
  scene      file, beside the table
  set        ["key=value", …] for --set
  vary       as in the stability map: rows for each combination of values, named by them
  refine     what `stillpoint converge` makes finer, with levels and ratio (4 and 2 if not given); or
  halve      [["key=value", …], …]: runs with a size of 1, 1/2, 1/4, … of which orders are found here; or
  safety     [from, to, width] of `stillpoint safety`
  quick      false: not in the quick form
  seconds    of processor time that a run may take, 60 if not given
and [[case.quantity]] tables:
  name       of the row
  read       "safety.factor", in the middle of the bracket; "error.u_rel_l2", "load.factor", "contacts.RIGID.force_y" and the like of summary.json, "PROBE.FIELD";
             "reactions.SUPPORT.y";
             "history.COLUMN", the mean of its last values,
             from the time `from` on; "fields.u", "fields.u.y", "fields.stress.yy", …: all points beside an answer of
             closed_answers.py, the relative difference in L2; "heap.runout": how much farther to the right than before
             a heap reaches where it is `grain` deep over a piece `h` wide, of the scene's constants, with the `area` of
             all points; "heap.height"; "order.NAME": the order of a quantity of converge.json,
             or of the error of any of these over the runs of `halve`
  exact      a number, or a formula of the scene's constants, of x, y (the probe's position before the motion), and of
             the closed answers; what is an error itself has 0. Of fields: the name of the answer. Of orders not needed
  target     the largest relative error, or the least order; or [low, high] of what is computed
  theory     of an order, if the study does not know it
  where      a pattern of the values of vary for which this row is there; all if not given
  order_remark  why the interval of an order leaves the theory's out by more than 0.05; without one that is a MISS
  known_miss    why the row misses its target, which is known; once it does not, the mark has to go. No excuse for a run that
                fails or a quantity that is not there
"""

from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

from case_table import BadTable, combinations, read_table

OF_CASE = {
    "name", "about", "source", "scene", "set", "vary", "refine", "levels", "ratio", "halve", "safety", "quick", "seconds",
    "quantity",
}  # fmt: skip
OF_QUANTITY = {"name", "read", "exact", "target", "from", "theory", "where", "order_remark", "known_miss"}


@dataclass
class Quantity:
    name: str
    read: str
    target: float | list[float]
    exact: float | str | None = None
    since: float | str = 0.0  # `from`
    theory: float | None = None
    order_remark: str = ""
    known_miss: str = ""

    @property
    def of_order(self):
        return self.read.startswith("order.")


@dataclass
class Case:
    name: str
    about: str
    source: str
    scene: Path
    settings: list[str]
    quantities: list[Quantity]
    refine: str = ""
    levels: int = 4
    ratio: float = 2.0
    halve: list[list[str]] = field(default_factory=list)
    safety: list[float] = field(default_factory=list)
    quick: bool = True
    seconds: float = 60.0


def quantity_of(case, table):
    name = f"{case}: {table.get('name', 'a quantity without a name')}"
    for key in table.keys() - OF_QUANTITY:
        raise BadTable(f"{name}: unknown key {key}")
    for key in ("name", "read", "target"):
        if key not in table:
            raise BadTable(f"{name}: {key} is missing")
    if not table["read"].startswith("order.") and "exact" not in table and not isinstance(table["target"], list):
        raise BadTable(f"{name}: exact is missing")
    taken = {key: value for key, value in table.items() if key not in ("where", "from")}
    return Quantity(since=table.get("from", 0.0), **taken)


def cases_of(table, folder):
    name = table.get("name", "a case without a name")
    for key in table.keys() - OF_CASE:
        raise BadTable(f"{name}: unknown key {key}")
    for key in ("name", "about", "source", "scene", "quantity"):
        if key not in table:
            raise BadTable(f"{name}: {key} is missing")
    if len({"refine", "halve", "safety"} & table.keys()) > 1:
        raise BadTable(f"{name}: refine, halve and safety exclude each other")
    scene = (folder / table["scene"]).resolve()
    if not scene.exists():
        raise BadTable(f"{name}: there is no {scene}")
    taken = {key: table[key] for key in ("refine", "levels", "ratio", "halve", "safety", "quick", "seconds") if key in table}
    for variant, settings in combinations(table.get("vary", {})):
        there = [one for one in table["quantity"] if fnmatchcase(variant, one.get("where", "*"))]
        whole = f"{name} [{variant}]" if variant else name
        if not there:
            raise BadTable(f"{whole}: no quantity")
        yield Case(whole, table["about"], table["source"], scene, table.get("set", []) + settings,
                   [quantity_of(whole, one) for one in there], **taken)  # fmt: skip


def read_cases(file):
    try:
        cases = [case for table in read_table(file)["case"] for case in cases_of(table, file.parent)]
    except (KeyError, ValueError) as error:
        raise BadTable(f"{file}: {error}") from None
    seen = set()
    for case in cases:
        for quantity in case.quantities:
            key = (case.name, quantity.name)
            if key in seen:
                raise BadTable(f"{case.name}: {quantity.name} is there twice")
            seen.add(key)
            if quantity.of_order and not (case.refine or case.halve):
                raise BadTable(f"{case.name}: {quantity.name}: an order needs refine or halve")
            if case.refine and not quantity.of_order:
                raise BadTable(f"{case.name}: {quantity.name}: of a study there are orders alone")
            if bool(case.safety) != (quantity.read == "safety.factor"):
                raise BadTable(f"{case.name}: {quantity.name}: safety.factor is read where safety is asked for, alone")
    return cases
