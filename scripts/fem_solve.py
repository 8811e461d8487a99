"""The solution of a case of scripts/beside_fem with FEniCSx: by linear elements, at large strain, and by mixed ones."""

import sys

import dolfinx
import dolfinx.fem.petsc
import dolfinx.nls.petsc
import numpy as np
import ufl
from fem_forms import WORK_OF_LOADS, large_stress, large_work, small_stress, supports_of
from fem_meshes import reference_element
from fem_stress import COMPILED, compiled, components, dofs_of, summed
from petsc4py import PETSc


def rigid_motions(V):
    """The near null space of elasticity, as in FEniCSx's demo of it: translations and rotations, orthonormal.

    Q = A L⁻ᵀ with L Lᵀ = Aᵀ A, which sums over ranks."""
    dim, x = V.mesh.geometry.dim, V.tabulate_dof_coordinates()[: V.dofmap.index_map.size_local]
    turns = [(0, 1)] if dim == 2 else [(0, 1), (1, 2), (2, 0)]
    columns = []
    for axis in range(dim):
        columns.append(np.zeros((len(x), dim)))
        columns[-1][:, axis] = 1
    for i, j in turns:
        columns.append(np.zeros((len(x), dim)))
        columns[-1][:, i], columns[-1][:, j] = -x[:, j], x[:, i]
    rows = np.stack([column.ravel() for column in columns])  # Aᵀ
    factor = np.linalg.cholesky(V.mesh.comm.allreduce(rows @ rows.T))
    vectors = [PETSc.Vec().createWithArray(row, comm=V.mesh.comm) for row in np.linalg.solve(factor, rows)]
    return PETSc.NullSpace().create(vectors=vectors)


def set_up(ksp, solver, residual, indefinite=False):
    """Of a factor; or of conjugate gradients with GAMG, as in FEniCSx's demo, until ‖F − K u‖/‖F‖ is the residual."""
    options = {"ksp_type": "preonly", "pc_type": "lu" if indefinite else "cholesky", "pc_factor_mat_solver_type": solver}
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
        dx = ufl.dx(metadata={"quadrature_degree": degree})
        self.a = compiled(ufl.inner(small_stress(u, case.law), ufl.sym(ufl.grad(v))) * dx)
        self.L = compiled(WORK_OF_LOADS[case.name](case, V.mesh, v, degree + 2))
        self.u = self.solution = dolfinx.fem.Function(V)
        self.stress = components(small_stress(self.u, case.law), case.law.lame[0] * ufl.div(self.u))

    def solve(self, solver):
        """The iterations of conjugate gradients."""
        conditions = supports_of(self.case.supports, self.V)
        A = dolfinx.fem.petsc.assemble_matrix(self.a, bcs=conditions)
        A.assemble()
        A.setOption(PETSc.Mat.Option.SPD, True)
        b = dolfinx.fem.petsc.assemble_vector(self.L)
        dolfinx.fem.petsc.apply_lifting(b, [self.a], [conditions])
        dolfinx.fem.petsc.set_bc(summed(b), conditions)
        if solver == "gamg":
            A.setNearNullSpace(rigid_motions(self.V))
        ksp = PETSc.KSP().create(self.V.mesh.comm)
        ksp.setOperators(A)
        set_up(ksp, solver, self.case.fem_residual or self.case.residual)
        ksp.solve(b, self.u.vector)
        self.u.x.scatter_forward()
        if ksp.getConvergedReason() <= 0:
            sys.exit(f"fem_run: PETSc ended for its reason {ksp.getConvergedReason()}")
        return ksp.getIterationNumber()

    def raw(self, _mesh, gradient, _cells, _local):
        """σ (n, 3, 3) of the functions themselves."""
        return self.case.law.stress(gradient)


class Large:
    """dW(u)(v) = loads"""

    def __init__(self, case, V, degree):
        self.case, self.V = case, V
        self.u = self.solution = dolfinx.fem.Function(V)
        v = ufl.TestFunction(V)
        dx = ufl.dx(metadata={"quadrature_degree": degree})
        self.share = dolfinx.fem.Constant(V.mesh, PETSc.ScalarType(1))  # of the load
        residual = ufl.derivative(large_work(self.u, case.law, dx), self.u, v)
        residual -= self.share * WORK_OF_LOADS[case.name](case, V.mesh, v, degree + 2)
        self.problem = dolfinx.fem.petsc.NonlinearProblem(residual, self.u, supports_of(case.supports, V), jit_params=COMPILED)
        self.stress = components(*large_stress(self.u, case.law))

    def solve(self, solver):
        """The iterations of Newton's method, of all steps of the load."""
        newton = dolfinx.nls.petsc.NewtonSolver(self.V.mesh.comm, self.problem)
        newton.convergence_criterion, newton.rtol, newton.atol = "residual", self.case.residual, 1e-14
        newton.krylov_solver.setOptionsPrefix("")
        set_up(newton.krylov_solver, solver, self.case.residual)
        iterations = 0
        for step in range(1, self.case.steps + 1):
            self.share.value = step / self.case.steps
            iterations += newton.solve(self.u)[0]
        return iterations

    def raw(self, _mesh, gradient, _cells, _local):
        return self.case.law.stress(gradient)


class Mixed:
    """σ = 2 μ ε + p I with div u = p/λ, of Taylor and Hood's elements: P of one order less for p."""

    def __init__(self, case, V, degree):
        self.case, self.V, self.mesh = case, V, V.mesh
        of_u, self.order = V.ufl_element(), V.ufl_element().degree() - 1
        self.W = dolfinx.fem.FunctionSpace(V.mesh, of_u * ufl.FiniteElement("Lagrange", V.mesh.ufl_cell(), self.order))
        lam, mu = case.law.lame
        (u, p), (v, q) = ufl.TrialFunctions(self.W), ufl.TestFunctions(self.W)
        dx = ufl.dx(metadata={"quadrature_degree": degree})
        strain = ufl.sym(ufl.grad(u))
        work = 2 * mu * ufl.inner(strain, ufl.sym(ufl.grad(v))) + p * ufl.div(v) + q * ufl.div(u) - p * q / lam
        self.a = compiled(work * dx)
        self.L = compiled(WORK_OF_LOADS[case.name](case, V.mesh, v, degree + 2))
        self.w = self.solution = dolfinx.fem.Function(self.W)
        u, p = ufl.split(self.w)
        self.stress = components(2 * mu * ufl.sym(ufl.grad(u)) + p * ufl.Identity(len(u)), p)

    def solve(self, solver):
        conditions = supports_of(self.case.supports, self.V, self.W)
        A = dolfinx.fem.petsc.assemble_matrix(self.a, bcs=conditions)
        A.assemble()
        b = summed(dolfinx.fem.petsc.assemble_vector(self.L))
        dolfinx.fem.petsc.set_bc(b, conditions)
        ksp = PETSc.KSP().create(self.mesh.comm)
        ksp.setOperators(A)
        set_up(ksp, solver, self.case.residual, indefinite=True)
        ksp.solve(b, self.w.vector)
        self.w.x.scatter_forward()
        self.u, self.p = self.w.sub(0).collapse(), self.w.sub(1).collapse()
        return ksp.getIterationNumber()

    def raw(self, mesh, gradient, cells, local):
        N = reference_element(mesh.kind, self.order).tabulate(0, local)[0, :, :, 0]
        p = np.einsum("na,na->n", N, self.p.x.array[dofs_of(self.p.function_space, cells)])
        lam, mu = self.case.law.lame
        isochoric = self.case.law.stress(gradient) - lam * np.trace(gradient, axis1=1, axis2=2)[:, None, None] * np.eye(3)
        return isochoric + p[:, None, None] * np.eye(3)


def problem_of(case, V, element, degree):
    kind = Large if case.law.large_strain else Mixed if "-" in element else Linear
    return kind(case, V, degree)
