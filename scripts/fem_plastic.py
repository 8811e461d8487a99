#!/usr/bin/python3
"""fem_plastic.py ELEMENT CELLS FILE: the limit load of a strip footing on clay by finite elements, with FEniCSx.

The problem of problems/footing_limit.toml at small strain: an even pressure λ c on half of a footing, on ground of von Mises'
law in plane strain. The factor λ is found for its mean settlement q, in steps that are halved where Newton's method fails,
and the run ends as Stillpoint's does: once λ grows over the last fifth of the way less than a hundredth as fast as on
average. ELEMENT is Q1-1 with one point a cell, Q1-B or Q2-B with fewer points for the change of volume than for the deviator
(B-bar), Q2-R of 2 × 2 points or P2-R of 3 points a cell; CELLS are those along the ground. FILE gets an object with the path
[q, λ], the factor, the unknowns, the iterations, and the times and the memory as of fem_run.py. Exit status 1 and a message
without FEniCSx, or if no limit is found.
"""

import json
import os
import sys
from pathlib import Path

try:
    import dolfinx
except ImportError:
    sys.exit("fem_plastic: there is no FEniCSx here: scripts/install_packages fem")

import basix
import numpy as np
import ufl
from beside_fem_case import Support
from fem_forms import on_facets, supports_of
from fem_meshes import StructuredMesh
from fem_newton import Linearised, timed
from fem_stress import compiled
from von_mises import contracted, deviator, share_kept

E, NU, C = 1e9, 0.3, 10e3  # [Pa]
WIDTH, HEIGHT, B = 6.0, 4.0, 1.0  # [m]
SHEAR, BULK = E / (2 * (1 + NU)), E / (3 * (1 - 2 * NU))
# Of the quadrature, of the deviator's work and of the work of the change of volume.
DEGREES = {"Q1-1": (1, 1), "Q1-B": (3, 1), "Q2-R": (3, 3), "Q2-B": (5, 3), "P2-R": (2, 2)}
FIRST, LEAST, FURTHEST = 5e-5, 1e-7, 3e-3  # steps of the settlement, and where it ends [m]
GROWTH, RESIDUAL, ITERATIONS = 0.01, 1e-5, 20
STIFFER = 1e-6  # share of the elastic stiffness that is added to K, which is singular once the ground flows


class Ground:
    """∫ s : e(v) + K div u div v = λ ∫ −c v_y,   s = s_trial · min(1, c/√J₂),   s_trial = s_before + 2 G e(u − u_before)"""

    def __init__(self, mesh, V, degrees):
        self.u, self.before, v = dolfinx.fem.Function(V), dolfinx.fem.Function(V), ufl.TestFunction(V)
        of_points = ufl.VectorElement("Quadrature", V.mesh.ufl_cell(), degrees[0], dim=3, quad_scheme="default")
        self.s_before = dolfinx.fem.Function(dolfinx.fem.FunctionSpace(V.mesh, of_points))
        e, s = deviatoric(v), self._stress()
        dx, dx_of_volume = (ufl.dx(metadata={"quadrature_degree": degree}) for degree in degrees)
        work = contracted(s, e) * dx + BULK * ufl.div(self.u) * ufl.div(v) * dx_of_volume
        elastic = 2 * SHEAR * contracted(deviatoric(ufl.TrialFunction(V)), e) * dx
        supports = supports_of((Support(1, 0.0, (0, 1)), Support(0, 0.0, (0,)), Support(0, WIDTH, (0,))), V)
        self.system = Linearised(work, self.u, supports, STIFFER * elastic)
        loaded = on_facets(V.mesh, lambda x: np.isclose(x[1], HEIGHT) & (x[0] < B * (1 + 1e-9)), 2)
        self.load = compiled(-C * v[1] * loaded)
        points, _ = basix.make_quadrature(getattr(basix.CellType, mesh.kind), degrees[0])
        self.s = dolfinx.fem.Expression(ufl.as_vector(s), points)
        self.cells = np.arange(V.mesh.topology.index_map(2).size_local, dtype=np.int32)

    def _stress(self):
        strain = zip(deviatoric(self.u), deviatoric(self.before))
        trial = [self.s_before[i] + 2 * SHEAR * (now - before) for i, (now, before) in enumerate(strain)]
        kept = share_kept(*trial, C, root=ufl.sqrt, larger=ufl.max_value)
        return [kept * component for component in trial]

    def prepare(self):
        self.system.prepare()
        self.F = dolfinx.fem.petsc.assemble_vector(self.load).array.copy()
        self.along = self.F / np.abs(self.F).sum()  # · u is the settlement
        self.F[self.system.held] = 0

    def commit(self):
        dofs = self.s_before.function_space.dofmap.list.array
        self.s_before.x.array.reshape(-1, 3)[dofs] = self.s.eval(self.cells).reshape(-1, 3)
        self.before.x.array[:] = self.u.x.array

    def settle(self, q, factor):
        """(λ of the settlement q or None, iterations), by K du = λ F − R + dλ F with along · (u + du) = q."""
        for iteration in range(ITERATIONS + 1):
            out = factor * self.F - self.system.forces()
            out[self.system.held] = 0
            missing = q - self.along @ self.u.x.array
            if abs(missing) < 1e-9 * q and np.linalg.norm(out) <= RESIDUAL * factor * np.linalg.norm(self.F):
                return float(factor), iteration
            if iteration == ITERATIONS or not np.isfinite(factor):
                return None, iteration
            self.system.factor()
            by_forces, by_load = self.system.solve(out), self.system.solve(self.F)
            more = (missing - self.along @ by_forces) / (self.along @ by_load)
            self.u.x.array[:] += by_forces + more * by_load
            factor += more


def deviatoric(u):
    strain = ufl.sym(ufl.grad(u))
    return deviator(strain[0, 0], strain[1, 1], strain[0, 1])


def growth(path):
    """dλ/dq over the last fifth of the way, as a share of λ/q."""
    q, factor = path[-1]
    return float(5 * (factor - np.interp(0.8 * q, *zip(*path))) / factor)


def follow(ground):
    """The path from [0, 0] to the limit load, and the iterations."""
    path, step, iterations = [[0.0, 0.0]], FIRST, 0
    while path[-1][0] < FURTHEST:
        q, factor = path[-1][0] + step, path[-1][1]
        found, taken = ground.settle(q, factor)
        iterations += taken
        if found is not None:
            ground.commit()
            path.append([q, found])
            if growth(path) < GROWTH:
                return path, iterations
            continue
        ground.u.x.array[:] = ground.before.x.array
        step /= 2
        if step < LEAST:
            sys.exit(f"fem_plastic: Newton's method ends at a settlement of {q:g} m, with a factor of {factor:.4f}")
    sys.exit(f"fem_plastic: no limit load within {FURTHEST:g} m")


def run(element, cells):
    def meshing():
        along = (cells, round(cells * HEIGHT / WIDTH))
        mesh = StructuredMesh(along, element[0], 1, lambda s: s * (WIDTH, HEIGHT))
        return mesh, dolfinx.fem.VectorFunctionSpace(mesh.mesh, ("Lagrange", int(element[1])))

    def solution(ground):
        ground.prepare()
        return follow(ground)

    ground, (path, iterations), figures = timed(meshing, lambda mesh, V: Ground(mesh, V, DEGREES[element]), solution)
    return figures | {"unknowns": ground.system.unknowns, "iterations": iterations, "factor": path[-1][1], "path": path}


def main():
    element, cells, file = sys.argv[1:]
    Path(file).write_text(json.dumps(run(element, int(cells))), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)  # PETSc's own end frees what Python's has freed


if __name__ == "__main__":
    sys.exit(main())
