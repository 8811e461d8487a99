"""Structured meshes for FEniCSx: unit squares or cubes of cells, mapped onto a body, and where a place lies in them.

On several ranks of MPI each has a part of the cells.
"""

import basix
import dolfinx
import numpy as np
import ufl
from mpi4py import MPI

# The corners of a simplex in a square's or a cube's corners, which are numbered as by basix: x first.
TRIANGLES = ((0, 1, 3), (0, 3, 2))
TETRAHEDRA = ((0, 1, 3, 7), (0, 1, 7, 5), (0, 5, 7, 4), (0, 3, 2, 7), (0, 6, 4, 7), (0, 2, 6, 7))
KINDS = {(2, "Q"): "quadrilateral", (2, "P"): "triangle", (3, "Q"): "hexahedron", (3, "P"): "tetrahedron"}


def reference_element(kind, order):
    cell = getattr(basix.CellType, kind)
    return basix.create_element(basix.ElementFamily.P, cell, order, basix.LagrangeVariant.gll_warped)


class StructuredMesh:
    """cells: how many along each parameter; family: "P" for simplices or "Q"; order: of the geometry; place: parameters
    -> positions, of the unit square or cube, or of blocks as a Case has them."""

    def __init__(self, cells, family, order, place, blocks=1):
        self.cells, self.blocks = np.array(cells), blocks
        self.dim = len(cells)
        self.kind = KINDS[self.dim, family]
        self.geometry = reference_element(self.kind, order)
        self.corners = self._corners(family)
        nodes, x = self._nodes(order, place)
        if MPI.COMM_WORLD.rank > 0:  # the first hands out all of them
            nodes, x = nodes[:0], x[:0]
        vector = ufl.VectorElement("Lagrange", ufl.Cell(self.kind, geometric_dimension=self.dim), order)
        self.mesh = dolfinx.mesh.create_mesh(MPI.COMM_WORLD, nodes, x, ufl.Mesh(vector))
        self.place = place
        self.cell_of = self._own_cells()

    def _own_cells(self):
        """This rank's number of each cell of the whole mesh; −1 of those that are another's."""
        count = self.mesh.topology.index_map(self.dim).size_local
        found = np.full(self.blocks * np.prod(self.cells) * len(self.corners), -1)
        found[self.mesh.topology.original_cell_index[:count]] = np.arange(count)
        return found

    def _corners(self, family):
        """(simplices in a box, corners, dim): of each in units of the box."""
        box = np.array([[(k >> d) & 1 for d in range(self.dim)] for k in range(2**self.dim)], dtype=float)
        if family == "Q":
            return box[None]
        return np.array([box[list(simplex)] for simplex in (TRIANGLES if self.dim == 2 else TETRAHEDRA)])

    def _local_to_box(self, simplex, points):
        """Points of the reference cell in units of the box."""
        corners = self.corners[simplex]
        if len(corners) == 2**self.dim:
            return points
        return corners[0] + points @ (corners[1:] - corners[0])

    def _nodes(self, order, place):
        """The nodes of each cell, and their positions; nodes of two blocks in one place are one."""
        boxes = np.stack(np.meshgrid(*(np.arange(n) for n in self.cells), indexing="ij"), axis=-1).reshape(-1, 1, self.dim)
        fine = order * self.cells + 1
        cells = []
        for simplex in range(len(self.corners)):
            inside = np.rint(order * self._local_to_box(simplex, self.geometry.points)).astype(np.int64)
            cells.append(np.ravel_multi_index(tuple(np.moveaxis(order * boxes + inside, -1, 0)), fine))
        cells = np.stack(cells, axis=1).reshape(-1, len(self.geometry.points))
        grid = np.stack(np.meshgrid(*(np.linspace(0, 1, n) for n in fine), indexing="ij"), axis=-1).reshape(-1, self.dim)
        if self.blocks == 1:
            return cells, place(grid)
        first = np.eye(self.dim)[0]
        x = np.concatenate([place(grid + 2 * block * first) for block in range(self.blocks)])
        cells = np.concatenate([cells + block * len(grid) for block in range(self.blocks)])
        size = np.abs(x).max()
        _, kept, number = np.unique(np.rint(x / size * 1e9).astype(np.int64), axis=0, return_index=True, return_inverse=True)
        return number.reshape(-1)[cells], x[kept]

    def locate(self, parameters):
        """(cells, reference coordinates) of the places with these parameters; cell −1 where it is another rank's."""
        block = np.minimum(parameters[:, 0] // 2, self.blocks - 1).astype(np.int64)
        scaled = (parameters - 2 * np.outer(block, np.eye(self.dim)[0])) * self.cells
        box = np.clip(scaled.astype(np.int64), 0, self.cells - 1)
        within = scaled - box
        simplex, local = np.zeros(len(box), dtype=np.int64), within
        if len(self.corners) > 1:
            simplex, local = self._in_simplices(within)
        original = (block * np.prod(self.cells) + np.ravel_multi_index(tuple(box.T), self.cells)) * len(self.corners) + simplex
        cells = self.cell_of[original]
        own = cells >= 0
        if own.any():
            local[own] = self._pulled_back(cells[own], local[own], self.place(parameters[own]))
        return cells, local

    def read(self, parameters, at):
        """The arrays at(cells, reference coordinates) of all places, each read by the rank that has its cell: on the first
        rank, and None on others."""
        cells, local = self.locate(parameters)
        own = np.flatnonzero(cells >= 0)
        parts = self.mesh.comm.gather((own, *at(cells[own], local[own])) if len(own) else None)
        if parts is None:
            return None
        places, *found = (np.concatenate(part) for part in zip(*filter(None, parts)))
        return [values[np.argsort(places)] for values in found]

    def _in_simplices(self, within):
        found = []
        for corners in self.corners:
            local = (within - corners[0]) @ np.linalg.inv(corners[1:] - corners[0])
            found.append(np.concatenate([local, 1 - local.sum(axis=1, keepdims=True)], axis=1))
        found = np.array(found)
        best = found.min(axis=2).argmax(axis=0)
        return best, found[best, np.arange(len(within)), :-1]

    def _pulled_back(self, cells, local, x):
        """Reference coordinates with Σ_a N_a(X) x_a = x, by Newton's method."""
        for _ in range(8):
            now, J = self.map(cells, local)
            local = local + np.linalg.solve(J, (x - now)[..., None])[..., 0]
        return local

    def map(self, cells, local):
        """Positions (n, dim) and ∂x/∂X (n, dim, dim) at reference coordinates."""
        dofs = self.mesh.geometry.dofmap.array.reshape(-1, len(self.geometry.points))[cells]
        nodes = self.mesh.geometry.x[dofs][..., : self.dim]
        N, dN = values_and_slopes(self.geometry, local)
        return np.einsum("na,nai->ni", N, nodes), np.einsum("naj,nai->nij", dN, nodes)


def values_and_slopes(element, local):
    """N_a (n, a) and ∂N_a/∂X_j (n, a, j)"""
    table = element.tabulate(1, local)[..., 0]
    return table[0], np.moveaxis(table[1:], 0, -1)
