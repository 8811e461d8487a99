"""What Newton's method takes with FEniCSx for a residual R(u): its assembly, K = dR/du, MUMPS's factor of K, and the clock."""

from pathlib import Path

import dolfinx
import dolfinx.fem.petsc
import numpy as np
import ufl
from fem_run import Clock, resident
from fem_solve import set_up
from fem_stress import compiled
from petsc4py import PETSc


class Linearised:
    """R, a form in a test function that depends on u; stiffer: a form that is added to K, if K alone is singular."""

    def __init__(self, residual, u, conditions, stiffer=None):
        self.u = u
        K = ufl.derivative(residual, u)
        self.R, self.K = compiled(residual), compiled(K if stiffer is None else K + stiffer)
        self.hold(conditions)

    def hold(self, conditions):
        """From now on these supports."""
        self.conditions = conditions
        self.held = np.unique(np.concatenate([condition.dof_indices()[0] for condition in conditions]))

    def prepare(self):
        """The pattern of K, which is made once a mesh."""
        self.matrix = dolfinx.fem.petsc.create_matrix(self.K)
        self.ksp = PETSc.KSP().create(self.u.function_space.mesh.comm)
        self.ksp.setOperators(self.matrix)
        set_up(self.ksp, "mumps", 0, indefinite=True)

    @property
    def unknowns(self):
        return len(self.u.x.array) - len(self.held)

    def forces(self):
        """R of all degrees of freedom: of those that are held the reactions."""
        return dolfinx.fem.petsc.assemble_vector(self.R).array.copy()

    def factor(self):
        self.matrix.zeroEntries()
        dolfinx.fem.petsc.assemble_matrix(self.matrix, self.K, bcs=self.conditions)
        self.matrix.assemble()

    def solve(self, right):
        """K⁻¹ right, of a right-hand side that is 0 where supports hold."""
        return self._solved(PETSc.Vec().createWithArray(right.copy()))

    def update(self):
        """−K⁻¹ R, by which held degrees of freedom come to their values as well."""
        right = dolfinx.fem.petsc.assemble_vector(self.R)
        dolfinx.fem.petsc.apply_lifting(right, [self.K], [self.conditions], x0=[self.u.vector], scale=-1.0)
        dolfinx.fem.petsc.set_bc(right, self.conditions, self.u.vector, -1.0)
        return -self._solved(right)

    def _solved(self, right):
        """NaN where K has no factor."""
        found = right.duplicate()
        try:
            self.ksp.solve(right, found)
        except PETSc.Error:
            return np.full(len(self.u.x.array), np.nan)
        return found.array.copy()


def timed(meshing, problem_of, solution):
    """(problem, what the solution returns, figures): what is done to forms counts neither to the times nor to the memory.

    meshing() -> (mesh, V); problem_of(mesh, V) makes the forms; solution(problem)."""
    clock, before = Clock(), resident("VmRSS")
    with clock.of("meshing"):
        mesh, V = meshing()
    meshed = resident("VmRSS")
    problem = problem_of(mesh, V)
    Path("/proc/self/clear_refs").write_text("5", encoding="utf-8")  # begins the peak anew
    compiled_at = resident("VmRSS")
    with clock.of("solution"):
        found = solution(problem)
    return problem, found, {
        "whole_s": sum(clock.seconds.values()),
        "processor_s": sum(clock.processor_seconds.values()),
        "megabytes": resident("VmHWM") - compiled_at + meshed - before,
    }  # fmt: skip
