#!/usr/bin/python3
"""fem_run.py CASE ELEMENT SOLVER CELLS FILE: one case of scripts/beside_fem by finite elements, with FEniCSx.

ELEMENT is P1, P2, Q1, Q2, or P2-P1 or Q2-Q1 with a pressure; SOLVER is cholmod, mumps or gamg; CELLS are those along the
first parameter of the body. FILE gets an object with the unknowns, the errors at the places at which both programs are
read, the wall time of meshing, of the solution (assembly and solver) and of the stress's projection, and the peak memory of
these. Python's imports and all that is done to forms, by Python and by the compiler, is in none of them. By `mpirun -n RANKS`
several ranks divide the cells; times are then those of the slowest one, the processor's time and the memory those of all
together. Exit status 1 without FEniCSx, or if there is no solution.
"""

import json
import os
import re
import sys
import time
from contextlib import contextmanager
from pathlib import Path

try:
    import dolfinx
except ImportError:
    sys.exit("fem_run: there is no FEniCSx here: scripts/install_packages fem")

import numpy as np
from beside_fem_cases import CASES
from beside_fem_errors import errors_of
from fem_forms import supports_of
from fem_meshes import StructuredMesh, reference_element
from fem_solve import problem_of
from fem_stress import Projection, gradient_at, projected_at
from mpi4py import MPI


def resident(what):
    """VmRSS, the memory now, or VmHWM, its peak [MB]."""
    text = Path("/proc/self/status").read_text(encoding="utf-8")
    return 1.024e-3 * int(re.search(rf"{what}:\s+(\d+) kB", text)[1])


def cells_of(case, first):
    return [max(1, round(first * share)) for share in case.aspect]


def quadrature_degree(case, element):
    """That integrates the stiffness of a parallelogram or a simplex, or more where that is no polynomial."""
    order = int(element[1])
    return 2 * order if element[0] == "Q" or case.curved or case.law.large_strain else max(2 * order - 2, 1)


def unknowns_of(case, problem):
    """Degrees of freedom that no support holds, of all ranks."""
    held = [dofs[:own] for dofs, own in (condition.dof_indices() for condition in supports_of(case.supports, problem.V))]
    dofmap = problem.solution.function_space.dofmap
    free = dofmap.index_map.size_local * dofmap.index_map_bs - len(np.unique(np.concatenate(held)))
    return MPI.COMM_WORLD.allreduce(free)


class Clock:
    """Seconds of what runs under it, by name; all ranks begin together."""

    def __init__(self):
        self.seconds, self.processor_seconds = {}, {}

    @contextmanager
    def of(self, name):
        MPI.COMM_WORLD.Barrier()
        start, processor = time.monotonic(), time.process_time()
        yield
        self.seconds[name] = time.monotonic() - start
        self.processor_seconds[name] = time.process_time() - processor


def run(case, element, solver, first):
    """Figures of all ranks, with the errors on the first one."""
    order, clock, before = int(element[1]), Clock(), resident("VmRSS")
    with clock.of("meshing"):
        mesh = StructuredMesh(cells_of(case, first), element[0], order if case.curved else 1, case.place, case.blocks)
        V = dolfinx.fem.VectorFunctionSpace(mesh.mesh, ("Lagrange", order))
    meshed = resident("VmRSS")
    S = dolfinx.fem.FunctionSpace(mesh.mesh, ("Lagrange", order))
    problem = problem_of(case, V, element, quadrature_degree(case, element))
    projection = Projection(S, problem.stress, 2 * order)
    Path("/proc/self/clear_refs").write_text("5", encoding="utf-8")  # begins the peak anew
    compiled_at = resident("VmRSS")
    with clock.of("solution"):
        iterations = problem.solve(solver)
    with clock.of("projection"):
        stress = projection.solve()
    world = MPI.COMM_WORLD
    figures = {f"{name}_s": world.allreduce(seconds, MPI.MAX) for name, seconds in clock.seconds.items()}
    figures["processor_s"] = world.allreduce(clock.processor_seconds["meshing"] + clock.processor_seconds["solution"])
    figures |= {"unknowns": unknowns_of(case, problem), "iterations": iterations}
    figures["megabytes"] = world.allreduce(resident("VmHWM") - compiled_at + meshed - before)
    return figures | errors(case, mesh, problem, S, order, stress)


def errors(case, mesh, problem, S, order, stress):
    """Of all places, on the first rank."""
    parameters, element = case.parameters(), reference_element(mesh.kind, order)

    def at(cells, local):
        u, gradient = gradient_at(mesh, element, problem.u, cells, local)
        return u, problem.raw(mesh, gradient, cells, local), projected_at(S, element, stress, cells, local)

    read = mesh.read(parameters, at)
    value = value_read(case, mesh, element, problem.u) if case.read else None
    if read is None:
        return {}
    return errors_of(case, case.place(parameters), *read) | (case.value_error(value) if case.read else {})


def value_read(case, mesh, element, u):
    """The component of u at the place that the case names, on the first rank."""
    parameters, component = case.read
    read = mesh.read(np.array([parameters]), lambda cells, local: gradient_at(mesh, element, u, cells, local))
    return None if read is None else float(read[0][0, component])


def main():
    case, element, solver, first, file = sys.argv[1:]
    figures = run(CASES[case], element, solver, int(first))
    if MPI.COMM_WORLD.rank == 0:
        with open(file, "w", encoding="utf-8") as found:
            json.dump(figures, found)
    sys.stdout.flush()
    MPI.Finalize()  # mpirun takes a rank that ends without it for a failed one
    os._exit(0)  # PETSc's own end frees what Python's has freed


if __name__ == "__main__":
    sys.exit(main())
