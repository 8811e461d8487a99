#!/usr/bin/python3
"""fem_reference.py CASE [CELLS]: the answer of a case of scripts/beside_fem that has no closed form, to build/beside_fem.

Lagrange elements of order 4 on quadrilaterals that are graded towards all sides, 72 a side if CELLS is not given, or 24 at
large strain: of a higher order and, at the corners, with far smaller cells than anything that is compared with it. Prints the value that the
case reads. CASE.npz has u and its gradient at the places.
"""

import sys

import dolfinx
import numpy as np
from beside_fem_case import REFERENCES
from beside_fem_cases import CASES
from fem_meshes import StructuredMesh, reference_element
from fem_run import value_read
from fem_solve import problem_of
from fem_stress import gradient_at

ORDER, CELLS, CELLS_AT_LARGE_STRAIN = 4, 72, 24


def graded(s):
    """ξ = 4 s³ from each end to the middle."""
    return np.where(s < 0.5, 4 * s**3, 1 - 4 * (1 - s) ** 3)


def ungraded(s):
    """The inverse of graded()."""
    return np.where(s < 0.5, np.cbrt(s / 4), 1 - np.cbrt((1 - s) / 4))


class GradedMesh(StructuredMesh):
    def locate(self, parameters):
        return super().locate(ungraded(parameters))


def found(case, cells):
    mesh = GradedMesh([cells] * case.dim, "Q", 1, lambda s: case.place(graded(s)))
    V = dolfinx.fem.VectorFunctionSpace(mesh.mesh, ("Lagrange", ORDER))
    problem = problem_of(case, V, f"Q{ORDER}", 2 * ORDER)
    problem.solve("mumps")
    element = reference_element(mesh.kind, ORDER)
    u, gradient = gradient_at(mesh, element, problem.u, *mesh.locate(case.parameters()))
    return {"u": u, "gradient": gradient, "read": value_read(case, mesh, element, problem.u)}


def main():
    name = sys.argv[1]
    usual = CELLS_AT_LARGE_STRAIN if CASES[name].law.large_strain else CELLS
    answer = found(CASES[name], int(sys.argv[2]) if len(sys.argv) > 2 else usual)
    REFERENCES.mkdir(parents=True, exist_ok=True)
    np.savez(REFERENCES / f"{name}.npz", **answer)
    print(f"{name}: {answer['read']:.6f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
