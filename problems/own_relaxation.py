#!/usr/bin/python3
"""own_relaxation.py [--out DIR]: a relaxation of one's own beside the built-in ones, on the paper's bar.

Anderson's acceleration of the step u + s M⁻¹Q(u), over the last m states: of all their combinations with Σ θ_k = 1 the
one whose a = Σ θ_k a_k is the shortest, and a step s from there,

    u⁺ = Σ θ_k (u_k + s a_k),   a_k = M⁻¹ Q(u_k),   s = h²/4        [Anderson 1965; Walker and Ni 2011]

In a linear body it does what GMRES does in m steps. Leaves compare.json and compare.csv in DIR (out/own_relaxation if not
given), and the picture compare.png beside them. After a build: PYTHONPATH=build/release/python problems/own_relaxation.py
"""

import sys
from pathlib import Path

import numpy as np
import stillpoint

HERE = Path(__file__).resolve().parent


class Anderson:
    depth = 8  # m

    def restart(self, _motion):
        self.u, self.a = np.empty((0, 0)), np.empty((0, 0))  # the last states and their a, (m × n)

    def propose(self, h, motion, u_new, v_new):
        u, a = np.array([*self.u, motion.u]), np.array([*self.a, motion.a])
        theta = self.weights(a)
        u_new[:] = theta @ (u + h**2 / 4 * a)
        v_new[:] = (u_new - motion.u) / h

    def moved(self, _h, motion):
        self.u = np.array([*self.u, motion.u - 0])[-self.depth :]
        self.a = np.array([*self.a, motion.a - 0])[-self.depth :]

    @staticmethod
    def weights(a):
        """The θ of the shortest Σ θ_k a_k: differences to the last one, by least squares."""
        if len(a) == 1:
            return np.ones(1)
        gamma = np.linalg.lstsq((a[:-1] - a[-1]).T, -a[-1], rcond=1e-10)[0]
        return np.append(gamma, 1 - gamma.sum())


def main():
    out = Path(sys.argv[sys.argv.index("--out") + 1]) if "--out" in sys.argv else Path("out/own_relaxation")
    stillpoint.add_relaxation("anderson", Anderson, equation="u+ = sum theta_k (u_k + h^2/4 Q_k/M)", source="Anderson 1965")
    comparison = stillpoint.compare(
        HERE / "bar.toml",
        strategies=["anderson", "viscous", "kinetic", "adaptive", "fire", "nesterov", "auto"],
        integrators=["leapfrog"],
        repeats=1,
        out=out,
    )
    for run in sorted(comparison.runs, key=lambda run: run.evaluations):
        print(f"{run.label:<16}{run.status:<12}{run.evaluations:>6} evaluations, error {run.error:.1e}")
    comparison.plot().savefig(out / "compare.png")
    print(f"Picture: {out / 'compare.png'}")


main()
