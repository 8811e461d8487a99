#!/usr/bin/python3
"""fem_fold.py ELEMENT SIDES CELLS FILE: a block pressed between rough plates by finite elements, until Newton's method ends.

The problem of problems/ladder/pressed_block.toml: the unit square in plane strain, P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ, both ends
held on their plates, of which the upper one comes down. ELEMENT is Q1, Q2 or P2, CELLS are those along a side. SIDES are
`free`, which knows nothing of the plates, or `stick`: a node of a side that has come to a plate is held on it from then on.
A step begins with a hundredth of the height, or with 0.16 of a cell, and is halved where Newton's method fails; an update
is halved where it would turn an element inside out. FILE gets an object with the path [compression, force of the plate, least
det F at the points, how far the block has come through a plate], why it ended, the unknowns, the iterations, and the times
and the memory as of fem_run.py. Exit status 1 and a message without FEniCSx.
"""

import json
import math
import os
import sys
from pathlib import Path

try:
    import dolfinx
except ImportError:
    sys.exit("fem_fold: there is no FEniCSx here: scripts/install_packages fem")

import basix
import numpy as np
import ufl
from beside_fem_case import Law, same
from fem_forms import large_work
from fem_meshes import StructuredMesh
from fem_newton import Linearised, timed

LAW = Law(1.0, 0.3, large_strain=True)
FIRST, OF_CELL, LEAST, MOST = 0.01, 0.16, 1e-4, 0.95  # steps of the compression, the first in cells at most, and its end
RESIDUAL, ITERATIONS, HALVINGS = 1e-8, 25, 6  # ‖R‖ of the free degrees of freedom over that of those that are held
CAUGHT = 0.5  # of a cell: by how much a node may have come through a plate when it is caught
INSIDE_OUT = "each update turns an element inside out"


class Block:
    def __init__(self, mesh, V, sides):
        self.sticks, self.cell = sides == "stick", 1 / mesh.cells[0]
        self.X = V.tabulate_dof_coordinates()[:, :2]
        at_top, at_bottom = (np.isclose(self.X[:, 1], at) for at in (1, 0))
        self.plate = at_top.astype(int) - at_bottom  # of each node: 1 on the upper one, −1 on the lower one, 0 on none
        self.u, self.held_u = dolfinx.fem.Function(V), dolfinx.fem.Function(V)
        degree = 2 * V.ufl_element().degree()
        work = large_work(self.u, LAW, ufl.dx(metadata={"quadrature_degree": degree}))
        self.system = Linearised(ufl.derivative(work, self.u, ufl.TestFunction(V)), self.u, self._on_plates())
        points, _ = basix.make_quadrature(getattr(basix.CellType, mesh.kind), degree)
        self.J = dolfinx.fem.Expression(ufl.det(ufl.Identity(2) + ufl.grad(self.u)), points)
        self.cells = np.arange(V.mesh.topology.index_map(2).size_local, dtype=np.int32)

    def _on_plates(self):
        return [dolfinx.fem.dirichletbc(self.held_u, np.flatnonzero(self.plate).astype(np.int32))]

    def come_down(self, compression):
        """What is held on the upper plate comes down with it, and stays where it is along it."""
        of_y = self.held_u.x.array[1::2]
        of_y[self.plate > 0] = 1 - compression - self.X[self.plate > 0, 1]
        of_y[self.plate < 0] = -self.X[self.plate < 0, 1]

    def through(self, compression):
        """How far each node has come through the plane of a plate, or less than 0."""
        y = self.X[:, 1] + self.u.x.array[1::2]
        return np.maximum(y - (1 - compression), -y)

    def catch(self, compression):
        """Holds the nodes that have come to a plate; False if one has come too far through it."""
        through = self.through(compression)
        new = (self.plate == 0) & (through > 0)
        if not new.any():
            return True
        if through[new].max() > CAUGHT * self.cell:
            return False
        y = self.X[new, 1] + self.u.x.array[1::2][new]
        self.plate[new] = np.where(y > (1 - compression) / 2, 1, -1)
        self.held_u.x.array[0::2][new] = self.u.x.array[0::2][new]
        self.system.hold(self._on_plates())
        return True

    def least_det(self):
        return float(self.J.eval(self.cells).min())

    def forces(self):
        """(‖R‖ of the free degrees of freedom over that of those that are held, the force of the upper plate)"""
        R, held = self.system.forces(), self.system.held
        force, reactions = -float(R[1::2][self.plate > 0].sum()), np.linalg.norm(R[held])
        R[held] = 0
        return np.linalg.norm(R) / reactions if reactions > 0 else math.inf, force

    def improve(self):
        """An update of Newton's method, halved until it turns no element inside out: whether there is one."""
        self.system.factor()
        before, update = self.u.x.array.copy(), self.system.update()
        for halving in range(HALVINGS):
            self.u.x.array[:] = before + update / 2**halving
            if self.least_det() > 0:
                return True
        return False

    def press(self, compression):
        """(iterations, what is wrong or "")"""
        self.come_down(compression)
        held = self.system.held
        for iteration in range(1, ITERATIONS + 1):
            if not self.improve():
                return iteration, INSIDE_OUT
            in_place = np.allclose(self.u.x.array[held], self.held_u.x.array[held], rtol=0, atol=1e-10)
            if in_place and self.forces()[0] <= RESIDUAL:
                too_far = self.sticks and not self.catch(compression)
                return iteration, "a side comes too far through a plate" if too_far else ""
        return ITERATIONS, f"no balance within {ITERATIONS} iterations"


def follow(block):
    """The path, the iterations, and why it ended."""
    path, step, compression, iterations = [], min(FIRST, OF_CELL * block.cell), 0.0, 0
    while compression < MOST - LEAST:
        before = block.u.x.array.copy()
        taken, wrong = block.press(compression + step)
        iterations += taken
        if not wrong:
            compression += step
            through = max(float(block.through(compression).max()), 0.0)
            path.append([compression, block.forces()[1], block.least_det(), through])
            continue
        block.u.x.array[:] = before
        step /= 2
        if step < LEAST:
            return path, iterations, wrong
    return path, iterations, ""


def run(element, sides, cells):
    def meshing():
        mesh = StructuredMesh((cells, cells), element[0], 1, same)
        return mesh, dolfinx.fem.VectorFunctionSpace(mesh.mesh, ("Lagrange", int(element[1])))

    def solution(block):
        block.system.prepare()
        return block.system.unknowns, *follow(block)

    _, (unknowns, path, iterations, ended), figures = timed(meshing, lambda mesh, V: Block(mesh, V, sides), solution)
    return figures | {"unknowns": unknowns, "iterations": iterations, "ended": ended, "path": path}


def main():
    element, sides, cells, file = sys.argv[1:]
    Path(file).write_text(json.dumps(run(element, sides, int(cells))), encoding="utf-8")
    sys.stdout.flush()
    os._exit(0)  # PETSc's own end frees what Python's has freed


if __name__ == "__main__":
    sys.exit(main())
