"""u, its gradient and σ of a solution with FEniCSx, at places, and σ's projection."""

import dolfinx
import dolfinx.fem.petsc
import numpy as np
import ufl
from fem_meshes import values_and_slopes
from petsc4py import PETSc

COMPILED = {"cffi_extra_compile_args": ["-O3", "-march=native"]}


def compiled(form):
    return dolfinx.fem.form(form, jit_params=COMPILED)


def gradient_at(mesh, element, u, cells, local):
    """u (n, dim) and ∂u/∂x (n, dim, dim) at reference coordinates of cells."""
    values = u.x.array.reshape(-1, mesh.dim)[dofs_of(u.function_space, cells)]
    N, dN = values_and_slopes(element, local)
    _, J = mesh.map(cells, local)
    slopes = np.einsum("naj,nai->nij", dN, values)
    return np.einsum("na,nai->ni", N, values), slopes @ np.linalg.inv(J)


def dofs_of(V, cells):
    return np.array([V.dofmap.cell_dofs(cell) for cell in cells])


def components(sigma, through):
    """{(i, j): form} of σ (dim, dim), of those that are not 0; through: σ_zz in plane strain."""
    dim = sigma.ufl_shape[0]
    forms = {(i, j): sigma[i, j] for i in range(dim) for j in range(i, dim)}
    if dim == 2 and not isinstance(through, ufl.constantvalue.Zero):
        forms[2, 2] = through
    return forms


class Projection:
    """σ's L2 projection onto continuous functions: ∫ s v = ∫ σ_ij v for each component."""

    def __init__(self, S, stress, degree):
        self.S = S
        s, v, dx = ufl.TrialFunction(S), ufl.TestFunction(S), ufl.dx(metadata={"quadrature_degree": degree})
        self.mass = compiled(s * v * dx)
        self.loads = {key: compiled(component * v * dx) for key, component in stress.items()}

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
            ksp.solve(summed(dolfinx.fem.petsc.assemble_vector(load)), found[key].vector)
            found[key].x.scatter_forward()
        return found


def summed(b):
    """An assembled vector with what other ranks' cells add to it."""
    b.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
    return b


def projected_at(S, element, found, cells, local):
    """σ (n, 3, 3)"""
    N, dofs = element.tabulate(0, local)[0, :, :, 0], dofs_of(S, cells)
    stress = np.zeros((len(cells), 3, 3))
    for (i, j), function in found.items():
        stress[:, i, j] = stress[:, j, i] = np.einsum("na,na->n", N, function.x.array[dofs])
    return stress
