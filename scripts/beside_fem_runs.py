"""The runs of scripts/beside_fem: by FEniCSx and by Stillpoint, each a process of its own, on one thread if nothing is said.

On more threads FEniCSx runs as so many ranks of MPI, each on one thread.
"""

import json
import math
import os
import shlex
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from beside_fem_case import REFERENCES
from beside_fem_cases import CASES
from beside_fem_errors import errors_of
from beside_fem_table import Row
from beside_fem_scenes import SCENES
from limited_run import run_in

ROOT = Path(__file__).resolve().parent.parent
FEM, OURS = "FEniCSx", "Stillpoint"
AXES = "xyz"
AUTO = ("solve.method=relaxation", "damping.strategy=auto")
SOLVERS = {
    "newton": ("solve.method=newton",),
    "auto, lumped mass": (*AUTO, "mass.kind=lumped"),
    "auto, multigrid": (*AUTO, "mass.kind=multigrid"),
}
# Root may start Open MPI. Ranks may be more than cores, and are bound to none. One that waits for another lets other processes
# run, or else a core that something else keeps busy costs tens of times as much. A failed rank has the last word.
OPEN_MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_orte_execute_quiet": "1",
}  # fmt: skip
STRESSES = {2: ("xx", "yy", "zz", "xy"), 3: ("xx", "yy", "zz", "xy", "yz", "zx")}


@dataclass(frozen=True)
class Way:
    program: str
    functions: str  # P1, P2, Q1, Q2, P2-P1 or Q2-Q1 with a pressure; linear, quadratic, cubic
    solver: str
    most: float = math.inf  # unknowns

    @property
    def name(self):
        return f"{self.program} {self.functions}, {self.solver}"


# --- sizes ---------------------------------------------------------------------------------------------


def first_cells(case, way, unknowns):
    """The number of cells along the first parameter of a mesh, or along the first axis of a grid, that has about as many
    unknowns."""
    dim, nodes = case.dim, unknowns / case.dim
    if way.program == FEM:
        return max(1, round((nodes / case.blocks / np.prod(case.aspect)) ** (1 / dim) * case.aspect[0] / int(way.functions[1])))
    return max(2, round((nodes / case.filled / np.prod(case.grid)) ** (1 / dim) * case.grid[0]))


def points_per_cell(case, functions):
    """Gauss points that integrate a cell fully; in cells that a border cuts as many as Stillpoint's notes ask for."""
    fitted = {"linear": 2, "quadratic": 3, "cubic": 4}
    cut = {2: {"linear": 4, "quadratic": 4, "cubic": 6}, 3: {"linear": 3, "quadratic": 4, "cubic": 5}}[case.dim]
    return (fitted if case.fitted else cut)[functions] ** case.dim


# --- FEniCSx -------------------------------------------------------------------------------------------


def fem_row(case, way, first, folder, seconds, threads=1):
    file = folder / "figures.json"
    words = [case.name, way.functions, way.solver, str(first)]
    shown = shlex.join([*ranks(threads), "scripts/fem_run.py", *words, "figures.json"])
    row = Row(case.name, FEM, *words[1:], command=shown, threads=threads)
    command = [*(ranks(threads) or ["/usr/bin/python3"]), str(ROOT / "scripts/fem_run.py"), *words, str(file)]
    try:
        environment = on_threads(1) | OPEN_MPI
        ended = subprocess.run(command, capture_output=True, text=True, timeout=seconds, check=False, env=environment)
    except subprocess.TimeoutExpired:
        return row.missing(f"no end within {seconds:g} s")
    if ended.returncode != 0:
        return row.missing((ended.stderr.strip().splitlines() or [f"exit status {ended.returncode}"])[-1])
    found = json.loads(file.read_text(encoding="utf-8"))
    return row.with_figures(
        whole_s=found["meshing_s"] + found["solution_s"],
        recovery_s=found["projection_s"],
        **{key: value for key, value in found.items() if key not in ("meshing_s", "projection_s")},
    )


def on_threads(count):
    return os.environ | {"OMP_NUM_THREADS": str(count)}


def ranks(threads):
    """What starts a script on several ranks, of which one that fails ends the others."""
    return ["mpirun", "-n", str(threads), "/usr/bin/python3", "-m", "mpi4py"] if threads > 1 else []


def refer(case):
    """Computes the answer of a case that has no closed form, once."""
    if case.reference and not (REFERENCES / f"{case.name}.npz").exists():
        command = ["/usr/bin/python3", str(ROOT / "scripts/fem_reference.py"), case.name]
        ended = subprocess.run(command, capture_output=True, text=True, check=False, env=on_threads(1))
        if ended.returncode != 0:
            sys.exit(f"beside_fem: {case.name} has no answer to compare with: {ended.stderr.strip()}")


# --- Stillpoint ----------------------------------------------------------------------------------------


def scene_of(case, first, folder):
    """The scene's file, written to the folder if the project does not have it."""
    if case.scene:
        return ROOT / "problems" / case.scene
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{case.name}_{first}.toml"
    file.write_text(SCENES[case.name](first), encoding="utf-8")
    return file


def settings_of(case, way, first):
    cells = [max(1, round(first * share / case.grid[0])) for share in case.grid]
    sharing = (f"phase.dilatation={'splines' if way.functions == 'cubic' else 'cells'}",) if case.dilatation else ()
    return [
        f"grid.basis={way.functions}", f"grid.cells=[{','.join(map(str, cells))}]",
        f"body.points_per_cell={points_per_cell(case, way.functions)}", f"stop.residual={case.residual:g}",
        *SOLVERS[way.solver], *sharing, *case.settings,
    ]  # fmt: skip


def our_command(program, scene, settings):
    return [str(program), "run", str(scene), *(word for setting in settings for word in ("--set", setting))]


def probes(case, x):
    """[[probe]] tables that read u, ∂u/∂x and σ at these places."""
    axes = AXES[: case.dim]
    fields = [f"u.{i}" for i in axes] + [f"strain.{i}{j}" for i in axes for j in axes]
    fields += [f"stress.{name}" for name in STRESSES[case.dim]]
    names = ", ".join(f'"{name}"' for name in fields)
    tables = [probe(f"p{k}", place, names) for k, place in enumerate(x)]
    if case.read:
        parameters, component = case.read
        tables.append(probe("read", case.place(np.array([parameters]))[0], f'"u.{AXES[component]}"'))
    return "".join(tables)


def probe(name, place, fields):
    return f'\n[[probe]]\nname = "{name}"\nat = {[float(value) for value in place]}\nfields = [{fields}]\n'


def read_probes(case, summary, count):
    """u (n, dim), ∂u/∂x (n, dim, dim), σ (n, 3, 3)"""
    axes = AXES[: case.dim]
    read = [summary["probes"][f"p{k}"] for k in range(count)]

    def column(name):
        return np.array([np.nan if probe[name] is None else probe[name] for probe in read], dtype=float)

    stress = np.zeros((count, 3, 3))
    for name in STRESSES[case.dim]:
        i, j = map(AXES.index, name)
        stress[:, i, j] = stress[:, j, i] = column(f"stress.{name}")
    gradient = np.array([[column(f"strain.{i}{j}") for j in axes] for i in axes])
    return np.stack([column(f"u.{i}") for i in axes], axis=1), np.moveaxis(gradient, -1, 0), stress


def our_row(program, case, way, first, folder, seconds, threads=1):
    measuring = ["env", f"OMP_NUM_THREADS={threads}", sys.executable, "-I", "-S"]
    measuring += [str(ROOT / "scripts/measured_run.py"), str(folder / "usage.json")]
    scene = scene_of(case, first, folder)
    command = our_command(Path(program).resolve(), scene, settings_of(case, way, first))
    words = our_command("build/release/stillpoint", os.path.relpath(scene, ROOT), settings_of(case, way, first))
    shown = shlex.join([*words, "--threads", str(threads)])
    row = Row(case.name, OURS, way.functions, way.solver, str(first), command=shown, threads=threads)
    run = run_in(folder / "run", measuring + command, seconds, threads)
    if run.exit_status != 0:
        return row.missing(run.message or run.summary.get("reason") or f"exit status {run.exit_status}")
    took = json.loads((folder / "usage.json").read_text(encoding="utf-8"))
    return row.with_figures(
        unknowns=run.summary["dofs"], iterations=run.summary["rhs_evaluations"], whole_s=took["seconds"],
        processor_s=took["processor_seconds"], solution_s=run.summary["wall_s"], megabytes=took["megabytes"],
    )  # fmt: skip


def our_errors(program, case, way, first, folder, seconds):
    """{error: value}, by a run of its own that reads the places."""
    x = case.place(case.parameters())
    scene = folder / "with_probes.toml"
    tables = probes(case, x)
    scene.write_text(scene_of(case, first, folder).read_text(encoding="utf-8") + tables, encoding="utf-8")
    run = run_in(folder / "probed", our_command(Path(program).resolve(), scene, settings_of(case, way, first)), seconds)
    if run.exit_status != 0:
        return {}
    u, gradient, stress = read_probes(case, run.summary, len(x))
    errors = errors_of(case, x, u, case.law.stress(gradient), stress)
    return errors | (case.value_error(*run.summary["probes"]["read"].values()) if case.read else {})


# --- what is run ---------------------------------------------------------------------------------------

PLANE_SIZES, SPACE_SIZES = (250, 1e3, 4e3, 1.6e4, 6.4e4), (3e3, 2e4, 1e5, 1e6)
IN_PLANE = [Way(FEM, element, "cholmod") for element in ("P1", "P2", "Q1", "Q2")] + [
    Way(FEM, "Q2", "mumps"),
    Way(FEM, "P2", "gamg"),
    Way(FEM, "Q2", "gamg"),
]
NEARLY_INCOMPRESSIBLE = [Way(FEM, element, "mumps") for element in ("Q1", "Q2", "P2-P1", "Q2-Q1")]
AT_LARGE_STRAIN = [Way(FEM, element, "mumps") for element in ("P1", "P2", "Q1", "Q2")]
IN_SPACE = (
    [Way(FEM, element, "gamg", most=2e5) for element in ("P1", "P2")]
    + [Way(FEM, element, "gamg") for element in ("Q1", "Q2")]
    + [Way(FEM, element, "cholmod", most=3e4) for element in ("Q1", "Q2")]
)
BASES = ("linear", "quadratic", "cubic")
# Where K becomes too wide to be worth the wait [unknowns].
PLANE_MOST = {("cubic", solver): 2e4 for solver in SOLVERS}
SPACE_MOST = {
    ("linear", "newton"): 3e4, ("quadratic", "newton"): 5e3, ("cubic", "newton"): 5e3,
    ("linear", "auto, multigrid"): 2e5, ("quadratic", "auto, multigrid"): 3e4, ("cubic", "auto, multigrid"): 5e3,
    ("quadratic", "auto, lumped mass"): 2e5, ("cubic", "auto, lumped mass"): 1.2e5,
}  # fmt: skip
OUR_PLANE, OUR_SPACE = (
    [Way(OURS, basis, solver, most.get((basis, solver), math.inf)) for basis in BASES for solver in SOLVERS]
    for most in (PLANE_MOST, SPACE_MOST)
)
# A cut cell's points for cubic functions take 50 ms to find, most of a run's time whatever the solver.
OUR_IN_CUT_CELLS = [way for way in OUR_SPACE if way.functions != "cubic"] + [Way(OURS, "cubic", "auto, lumped mass", 5e3)]
# With a diagonal mass the number of steps grows as the square root of K/G as well.
OUR_NEARLY_INCOMPRESSIBLE = [
    replace(way, most=5e3) if way.solver == "auto, lumped mass" else way for way in OUR_PLANE if way.functions != "cubic"
] + [Way(OURS, "cubic", "newton", 5e3)]
# A slender body's frequencies lie so far apart that relaxation takes tens of thousands of steps.
OUR_BENDING = [way if way.solver == "newton" else replace(way, most=300) for way in OUR_PLANE]
QUICK_WAYS = [Way(FEM, "Q2", "cholmod"), Way(OURS, "quadratic", "newton"), Way(OURS, "cubic", "newton")]  # of the quick case


def ways_of(case):
    if case.dim == 3:
        return IN_SPACE + (OUR_SPACE if case.fitted else OUR_IN_CUT_CELLS)
    if case.dilatation:
        return NEARLY_INCOMPRESSIBLE + OUR_NEARLY_INCOMPRESSIBLE
    if case.steps > 1:
        return AT_LARGE_STRAIN + OUR_BENDING
    return (AT_LARGE_STRAIN if case.law.large_strain else IN_PLANE) + OUR_PLANE


def sizes_of(case):
    return SPACE_SIZES if case.dim == 3 else PLANE_SIZES


def cases_named(names):
    return [CASES[name] for name in names] if names else list(CASES.values())
