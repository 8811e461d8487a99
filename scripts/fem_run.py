#!/usr/bin/python3
"""fem_run.py CASE ELEMENT SOLVER CELLS FILE: one case of scripts/beside_fem by finite elements, with FEniCSx.

ELEMENT is P1, P2, Q1 or Q2; SOLVER is cholmod, mumps or gamg; CELLS are those along the first parameter of the body. FILE
gets an object with the unknowns, the errors at the places at which both programs are read, the wall time of meshing, of
the solution (assembly and solver) and of the stress's projection, and the peak memory of these. Python's imports and all
that is done to forms, by Python and by the compiler, is in none of them. Exit status 1 without FEniCSx, or if there is no solution.
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
    import dolfinx.fem.petsc
    import dolfinx.nls.petsc
except ImportError:
    sys.exit("fem_run: there is no FEniCSx here: scripts/install_packages fem")

import numpy as np
import ufl
from beside_fem_cases import CASES
from beside_fem_errors import errors_of
from fem_forms import large_work, small_stress, supports_of, work_of_loads
from fem_meshes import StructuredMesh, reference_element, values_and_slopes
from petsc4py import PETSc

COMPILED = {"cffi_extra_compile_args": ["-O3", "-march=native"]}


def resident(what):
    """VmRSS, the memory now, or VmHWM, its peak [MB]."""
    text = Path("/proc/self/status").read_text(encoding="utf-8")
    return 1.024e-3 * int(re.search(rf"{what}:\s+(\d+) kB", text)[1])


def compiled(form):
    return dolfinx.fem.form(form, jit_params=COMPILED)


# --- solvers -------------------------------------------------------------------------------------------


def rigid_motions(V):
    """The near null space of elasticity, as in FEniCSx's demo of it: translations and rotations, orthonormal."""
    dim, x = V.mesh.geometry.dim, V.tabulate_dof_coordinates()
    turns = [(0, 1)] if dim == 2 else [(0, 1), (1, 2), (2, 0)]
    columns = []
    for axis in range(dim):
        columns.append(np.zeros((len(x), dim)))
        columns[-1][:, axis] = 1
    for i, j in turns:
        columns.append(np.zeros((len(x), dim)))
        columns[-1][:, i], columns[-1][:, j] = -x[:, j], x[:, i]
    basis, _ = np.linalg.qr(np.stack([column.ravel() for column in columns], axis=1))
    vectors = [PETSc.Vec().createWithArray(column.copy(), comm=V.mesh.comm) for column in basis.T]
    return PETSc.NullSpace().create(vectors=vectors)


def set_up(ksp, solver, residual):
    """Of a factor; or of conjugate gradients with GAMG, as in FEniCSx's demo, until ‖F − K u‖/‖F‖ is the residual."""
    options = {"ksp_type": "preonly", "pc_type": "cholesky", "pc_factor_mat_solver_type": solver}
    if solver == "gamg":
        options = {
            "ksp_type": "cg", "ksp_rtol": residual, "ksp_norm_type": "unpreconditioned", "ksp_max_it": 1000,
            "pc_type": "gamg", "mg_levels_ksp_type": "chebyshev", "mg_levels_pc_type": "jacobi",
            "mg_levels_ksp_chebyshev_esteig_steps": 10,
        }  # fmt: skip
    database = PETSc.Options()
    for key, value in options.items():
        database[key] = value
    ksp.setFromOptions()


class Linear:
    """∫ σ(u) : ∇v = loads"""

    def __init__(self, case, V, degree):
        self.case, self.V = case, V
        u, v = ufl.TrialFunction(V), ufl.TestFunction(V)
        dx, load = (ufl.dx(metadata={"quadrature_degree": d}) for d in (degree, degree + 2))
        self.a = compiled(ufl.inner(small_stress(u, case.law), ufl.sym(ufl.grad(v))) * dx)
        self.L = compiled(work_of_loads(case, V.mesh, v, load, degree + 2))
        self.u = dolfinx.fem.Function(V)

    def solve(self, solver):
        """The iterations of conjugate gradients."""
        conditions = supports_of(self.case, self.V)
        A = dolfinx.fem.petsc.assemble_matrix(self.a, bcs=conditions)
        A.assemble()
        A.setOption(PETSc.Mat.Option.SPD, True)
        b = dolfinx.fem.petsc.assemble_vector(self.L)
        dolfinx.fem.petsc.set_bc(b, conditions)
        if solver == "gamg":
            A.setNearNullSpace(rigid_motions(self.V))
        ksp = PETSc.KSP().create(self.V.mesh.comm)
        ksp.setOperators(A)
        set_up(ksp, solver, self.case.residual)
        ksp.solve(b, self.u.vector)
        if ksp.getConvergedReason() <= 0:
            sys.exit(f"fem_run: PETSc ended for its reason {ksp.getConvergedReason()}")
        return ksp.getIterationNumber()


class Large:
    """dW(u)(v) = loads"""

    def __init__(self, case, V, degree):
        self.case, self.V, self.u = case, V, dolfinx.fem.Function(V)
        v = ufl.TestFunction(V)
        dx, load = (ufl.dx(metadata={"quadrature_degree": d}) for d in (degree, degree + 2))
        residual = ufl.derivative(large_work(self.u, case.law, dx), self.u, v)
        residual -= work_of_loads(case, V.mesh, v, load, degree + 2)
        self.problem = dolfinx.fem.petsc.NonlinearProblem(residual, self.u, supports_of(case, V), jit_params=COMPILED)

    def solve(self, solver):
        """The iterations of Newton's method."""
        newton = dolfinx.nls.petsc.NewtonSolver(self.V.mesh.comm, self.problem)
        newton.convergence_criterion, newton.rtol, newton.atol = "residual", self.case.residual, 1e-14
        newton.krylov_solver.setOptionsPrefix("")
        set_up(newton.krylov_solver, solver, self.case.residual)
        iterations, _ = newton.solve(self.u)
        return iterations


# --- stress --------------------------------------------------------------------------------------------


def gradient_at(mesh, V, element, u, cells, local):
    """u (n, dim) and ∂u/∂x (n, dim, dim) at reference coordinates of cells."""
    values = u.x.array.reshape(-1, mesh.dim)[dofs_of(V, cells)]
    N, dN = values_and_slopes(element, local)
    _, J = mesh.map(cells, local)
    slopes = np.einsum("naj,nai->nij", dN, values)
    return np.einsum("na,nai->ni", N, values), slopes @ np.linalg.inv(J)


def dofs_of(V, cells):
    return np.array([V.dofmap.cell_dofs(cell) for cell in cells])


def cauchy(case, u):
    """{(i, j): form} of the components of σ"""
    dim = len(u)
    lam, mu = case.law.lame
    if case.law.large_strain:
        F = ufl.Identity(dim) + ufl.grad(u)
        J = ufl.det(F)
        sigma = (mu * (F * F.T - ufl.Identity(dim)) + lam * ufl.ln(J) * ufl.Identity(dim)) / J
        through = lam * ufl.ln(J) / J
    else:
        sigma, through = small_stress(u, case.law), lam * ufl.div(u)
    forms = {(i, j): sigma[i, j] for i in range(dim) for j in range(i, dim)}
    return forms if dim == 3 else forms | {(2, 2): through}


class Projection:
    """σ's L2 projection onto continuous functions: ∫ s v = ∫ σ_ij v for each component."""

    def __init__(self, case, S, u, degree):
        self.S = S
        s, v, dx = ufl.TrialFunction(S), ufl.TestFunction(S), ufl.dx(metadata={"quadrature_degree": degree})
        self.mass = compiled(s * v * dx)
        self.loads = {key: compiled(component * v * dx) for key, component in cauchy(case, u).items()}

    def solve(self):
        """{(i, j): function}"""
        M = dolfinx.fem.petsc.assemble_matrix(self.mass)
        M.assemble()
        ksp = PETSc.KSP().create(self.S.mesh.comm)
        ksp.setOperators(M)
        ksp.setType("cg")
        ksp.getPC().setType("jacobi")
        ksp.setTolerances(rtol=1e-10)
        found = {key: dolfinx.fem.Function(self.S) for key in self.loads}
        for key, load in self.loads.items():
            ksp.solve(dolfinx.fem.petsc.assemble_vector(load), found[key].vector)
        return found


def projected_at(S, element, found, cells, local):
    """σ (n, 3, 3)"""
    N, dofs = element.tabulate(0, local)[0, :, :, 0], dofs_of(S, cells)
    stress = np.zeros((len(cells), 3, 3))
    for (i, j), function in found.items():
        stress[:, i, j] = stress[:, j, i] = np.einsum("na,na->n", N, function.x.array[dofs])
    return stress


# --- a run ---------------------------------------------------------------------------------------------


def cells_of(case, first):
    return [max(1, round(first * share)) for share in case.aspect]


def quadrature_degree(case, element):
    """That integrates the stiffness of a parallelogram or a simplex, or more where that is no polynomial."""
    order = int(element[1])
    return 2 * order if element[0] == "Q" or case.curved or case.law.large_strain else max(2 * order - 2, 1)


def unknowns_of(case, V):
    """Degrees of freedom that no support holds."""
    held = [condition.dof_indices()[0] for condition in supports_of(case, V)]
    return V.dofmap.index_map.size_global * V.dofmap.index_map_bs - len(np.unique(np.concatenate(held)))


class Clock:
    """Seconds of what runs under it, by name."""

    def __init__(self):
        self.seconds = {}

    @contextmanager
    def of(self, name):
        start = time.monotonic()
        yield
        self.seconds[name] = time.monotonic() - start


def run(case, element, solver, first):
    order, clock, before = int(element[1]), Clock(), resident("VmRSS")
    with clock.of("meshing"):
        mesh = StructuredMesh(cells_of(case, first), element[0], order if case.curved else 1, case.place)
        V = dolfinx.fem.VectorFunctionSpace(mesh.mesh, ("Lagrange", order))
    meshed = resident("VmRSS")
    S = dolfinx.fem.FunctionSpace(mesh.mesh, ("Lagrange", order))
    problem = (Large if case.law.large_strain else Linear)(case, V, quadrature_degree(case, element))
    projection = Projection(case, S, problem.u, 2 * order)
    Path("/proc/self/clear_refs").write_text("5", encoding="utf-8")  # begins the peak anew
    compiled_at = resident("VmRSS")
    with clock.of("solution"):
        iterations = problem.solve(solver)
    with clock.of("projection"):
        stress = projection.solve()
    figures = {f"{name}_s": seconds for name, seconds in clock.seconds.items()}
    figures |= {"unknowns": unknowns_of(case, V), "iterations": iterations}
    figures["megabytes"] = resident("VmHWM") - compiled_at + meshed - before
    return figures | errors(case, mesh, V, S, order, problem.u, stress)


def errors(case, mesh, V, S, order, u, stress):
    parameters = case.parameters()
    cells, local = mesh.locate(parameters)
    element = reference_element(mesh.kind, order)
    at, gradient = gradient_at(mesh, V, element, u, cells, local)
    recovered = projected_at(S, element, stress, cells, local)
    return errors_of(case, case.place(parameters), at, case.law.stress(gradient), recovered)


def main():
    case, element, solver, first, file = sys.argv[1:]
    figures = run(CASES[case], element, solver, int(first))
    with open(file, "w", encoding="utf-8") as found:
        json.dump(figures, found)
    sys.stdout.flush()
    os._exit(0)  # PETSc's own end frees what Python's has freed


if __name__ == "__main__":
    sys.exit(main())
