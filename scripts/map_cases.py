"""The cases of the stability map, problems/hard/map.toml: what is run, by which ways, and what is expected of each.

A [[case]] has
  name       of the row
  scene      file, beside the table
  about      what is hard in it, a sentence
  set        ["key=value", …] for --set
  vary       {key = [value, …], …}: a row for each combination, named by the values; keys joined by + vary together,
             each value an array
  ways       ["strategy", "integrator/strategy", "integrator:adaptive/strategy", "a static solver", …], with leapfrog if
             there is no integrator; or the name of a list in [ways]
  expected   an outcome, or an array of those that are as good (see map_judge.py)
  judge      what gives the answer (JUDGES of map_judge.py): the scene's own exact one, Newton's method in one phase of
             the same points, a closed answer, what is conserved, …; not needed where no answer is expected
  judge_set  ["key=value", …] besides, for the run by Newton's method
  figures    {omega_1 = 1.57, "probe.field" = …}: figures of summary.json that have to come out besides
  tolerance  of the error, 0.01 if not given; figures_tolerance of the figures, the same if not given
  says       what a failure has to say: a regular expression for its message, its reason or one of its notes
  notes      what a run that succeeds has to say in one of its notes, and one that is wrong if "noted" is expected
  seconds    of processor time that a run may take, 20 if not given
  quick      false: not in the quick form
  chance     true: rounding decides which of the expected outcomes it is, so that it may be another than the last time
and may have [[case.fault]], what is known to be wrong and is not mended yet:
  where      a pattern, or an array of them, of "values of vary: way" (*, ?, [abc]); all if not given
  reason     what is wrong
A row with a known fault has to fail: once it does not, the mark has to go.
"""

from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path

from case_table import BadTable, as_list, combinations, read_table

STATIC = {"newton", "newton-cg", "cg", "lbfgs"}
OF_CASE = {
    "name", "scene", "about", "set", "vary", "ways", "expected", "judge", "judge_set", "figures", "tolerance",
    "figures_tolerance", "says", "notes", "seconds", "quick", "chance", "fault",
}  # fmt: skip
# what a row takes from its case
AS_IT_IS = {"judge", "figures", "tolerance", "says", "notes", "seconds", "quick", "chance"}


@dataclass
class Row:
    case: str
    way: str
    scene: Path
    settings: list[str]
    expected: list[str]
    judge: str = ""
    judge_settings: list[str] = field(default_factory=list)
    figures: dict[str, float] = field(default_factory=dict)
    tolerance: float = 0.01
    figures_tolerance: float = 0.01
    says: str = ""
    notes: str = ""
    seconds: float = 20
    quick: bool = True
    chance: bool = False
    fault: str = ""  # the reason of a known one

    @property
    def key(self):
        return f"{self.case}: {self.way}"


def settings_of(way):
    """The keys that make a run take this way to rest."""
    if way in STATIC:
        return [f"solve.method={way}"]
    integrator, _, strategy = way.rpartition("/")
    settings = [f"damping.strategy={strategy}"]
    if integrator.endswith(":adaptive"):
        integrator = integrator.removesuffix(":adaptive")
        settings.append("integrator.rtol=1e-3")
    return settings + ([f"integrator.method={integrator}"] if integrator else [])


def fault_of(case, variant, way):
    where = f"{variant}: {way}" if variant else way
    for fault in case.get("fault", []):
        if any(fnmatchcase(where, pattern) for pattern in as_list(fault.get("where", "*"))):
            return fault["reason"]
    return ""


def rows_of(case, ways, folder):
    name = case.get("name", "a case without a name")
    for key in case.keys() - OF_CASE:
        raise BadTable(f"{name}: unknown key {key}")
    for key in ("name", "scene", "ways", "expected"):
        if key not in case:
            raise BadTable(f"{name}: {key} is missing")
    expected = as_list(case["expected"])
    if not case.get("judge") and {"equilibrium", "end-time", "limit-load"} & set(expected):
        raise BadTable(f"{name}: an answer is expected, and nothing judges it")
    taken = {key: case[key] for key in AS_IT_IS & case.keys()}
    taken["figures_tolerance"] = case.get("figures_tolerance", case.get("tolerance", 0.01))
    listed = ways[case["ways"]] if isinstance(case["ways"], str) else case["ways"]
    for variant, settings in combinations(case.get("vary", {})):
        for way in listed:
            yield Row(
                case=f"{name} [{variant}]" if variant else name,
                way=way,
                scene=folder / case["scene"],
                settings=case.get("set", []) + settings,
                judge_settings=case.get("judge_set", []),
                expected=expected,
                fault=fault_of(case, variant, way),
                **taken,
            )


def read_known(file, kind):
    """{number: reason} of the random scenes of this kind, "variations" or "unlike", that are known to be false."""
    return {int(number): reason for number, reason in read_table(file).get(kind, {}).items()}


def read_rows(file, judges):
    table = read_table(file)
    rows = [row for case in table["case"] for row in rows_of(case, table.get("ways", {}), file.parent)]
    seen = set()
    for row in rows:
        if row.key in seen:
            raise BadTable(f"{row.key} is there twice")
        seen.add(row.key)
        if row.judge and row.judge not in judges:
            raise BadTable(f"{row.case}: unknown judge {row.judge}; expected one of {', '.join(judges)}")
        if not row.scene.exists():
            raise BadTable(f"{row.case}: there is no {row.scene}")
    return rows
