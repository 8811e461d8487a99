#!/usr/bin/python3
"""strategies_test.py ROOT CLAIM PACKAGE: one claim about dampings, relaxations and stopping tests written in Python."""

from modules import BAR, SLOPE, HeavyBall, raised  # first: finds the package

import json

import numpy as np
import stillpoint
from claims import ROOT, call, check_the_claim, claim


def cundall(v, Q, alpha):
    return -alpha * np.abs(Q) * np.sign(v)


@claim("a damping in Python takes the steps of the built-in one with the same formula, bit for bit")
def _(_folder):
    stillpoint.add_damping("cundall-again", cundall, stiffness_factor=1.7)
    for method in "leapfrog", "erk:rk4", "gsl:rk4":
        runs = []
        for name in "cundall", "cundall-again":
            over = {"damping": {"strategy": name, "alpha": 0.7}, "mass.kind": "lumped", "integrator.method": method}
            runs.append(stillpoint.Simulation(stillpoint.load(BAR, over, stop={"steps": 200})).run())
        built_in, own = runs
        assert own.steps == built_in.steps == 200 and own.summary.critical_step == built_in.summary.critical_step
        assert np.array_equal(own.history, built_in.history), method
        assert own.summary.damping == "cundall-again"


@claim("a relaxation in Python takes the steps of the built-in damping with the same formula")
def _(_folder):
    stillpoint.add_relaxation("heavy-ball", HeavyBall, needs_omega_1=True)
    runs = []
    for over in {"strategy": "viscous", "c": "critical"}, {"strategy": "heavy-ball"}:
        simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping": over, "integrator.step": 0.25}))
        for _ in range(100):
            simulation.step()
        runs.append(simulation)
    built_in, own = runs
    assert own.t == built_in.t == 25 and own.evaluations == built_in.evaluations
    assert np.allclose(own.unknowns.u, built_in.unknowns.u, rtol=1e-11, atol=0)
    assert own.run().status == "equilibrium", own.reason


@claim("a relaxation that is a function and returns its state is one as well")
def _(_folder):
    def gradient(h, motion, _u_new, _v_new):
        v = motion.a * h / 4
        return motion.u + h * v, v

    stillpoint.add_relaxation("gradient", lambda: gradient, equation="u+ = u + h^2/4 Q/M")
    simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "gradient"}, stop={"steps": 50}))
    energies = [-np.dot(simulation.unknowns.external_force(), simulation.unknowns.u)]
    while simulation.step():
        u = simulation.unknowns.u
        work = np.dot(simulation.unknowns.internal_force(), u) / 2 - np.dot(simulation.unknowns.external_force(), u)
        assert work < energies[-1]
        energies.append(work)
    assert simulation.steps == 50


@claim("compare draws a relaxation of the reader's own beside the built-in ones, by the example of problems/")
def _(folder):
    result = call("/usr/bin/python3", ROOT / "problems/own_relaxation.py", "--out", folder, env=environment())
    assert result.returncode == 0, result
    runs = json.loads((folder / "compare.json").read_text(encoding="utf-8"))["runs"]
    own = [run for run in runs if run["strategy"] == "anderson"]
    assert len(own) == 1 and own[0]["status"] == "converged", own
    assert own[0]["evaluations"] < min(r["evaluations"] for r in runs if r["strategy"] in ("kinetic", "fire"))
    assert (folder / "compare.png").stat().st_size > 10_000 and len(runs) > 4


def environment():
    import os
    import sys

    return os.environ | {"PYTHONPATH": sys.argv[3]}


@claim("what a relaxation raises reaches the caller, and the simulation goes on from there")
def _(_folder):
    class Faulty(HeavyBall):
        faults = []

        def propose(self, h, motion, u_new, v_new):
            super().propose(h, motion, u_new, v_new)
            if "propose" in self.faults:
                raise ZeroDivisionError("within propose")

        def moved(self, _h, _motion):
            if "moved" in self.faults:
                raise ZeroDivisionError("within moved")

    stillpoint.add_relaxation("faulty", Faulty, needs_omega_1=True)
    scene = stillpoint.load(BAR, {"damping.strategy": "faulty"})
    simulation = stillpoint.Simulation(scene)
    simulation.step()
    u, t = simulation.unknowns.u.copy(), simulation.t
    Faulty.faults = ["propose"]
    assert "within propose" in str(raised(ZeroDivisionError, simulation.step))
    assert simulation.t == t and np.array_equal(simulation.unknowns.u, u) and not simulation.done
    Faulty.faults = []
    assert simulation.run().status == "equilibrium"
    assert np.array_equal(simulation.unknowns.u, stillpoint.Simulation(scene).run().unknowns.u)
    Faulty.faults = ["moved"]
    again = stillpoint.Simulation(scene)
    again.step()
    assert "within moved" in str(raised(ZeroDivisionError, again.step))


@claim("what a relaxation raises as a phase begins reaches the caller")
def _(_folder):
    class Short(HeavyBall):
        made = 0

        def __init__(self):
            Short.made += 1
            if Short.made > 1:
                raise ZeroDivisionError("a second phase")

        def propose(self, h, motion, u_new, v_new):
            v_new[:] = 0.9 * motion.v + motion.a * h
            u_new[:] = motion.u + h * v_new

    stillpoint.add_relaxation("short", Short)
    scene = stillpoint.load("problems/hard/column_in_phases.toml", {"damping": {"strategy": "short"}})
    simulation = stillpoint.Simulation(scene)
    raised(ZeroDivisionError, simulation.run)
    assert simulation.phases == 2 and simulation.summary.steps > 0 and not simulation.done


@claim("what a damping raises within a stage of ARKODE or GSL reaches the caller")
def _(_folder):
    def failing(v, Q, _alpha):
        if len(v) == 9 and np.any(v):  # the bar's, not the oscillators by which the critical step is found
            raise KeyError("within a stage")
        return 0 * Q

    stillpoint.add_damping("failing", failing)
    for method in "leapfrog", "erk:rk4", "gsl:rk4":
        over = {"damping.strategy": "failing", "mass.kind": "lumped", "integrator.method": method}
        assert "within a stage" in str(raised(KeyError, stillpoint.Simulation(stillpoint.load(BAR, over)).run)), method


@claim("what a relaxation returns in another shape is refused, and so is a name that is taken")
def _(_folder):
    stillpoint.add_relaxation("bent", lambda: lambda h, m, u, v: (m.u[1:], m.v))
    simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "bent"}))
    assert "expected an array of shape (9,)" in str(raised(ValueError, simulation.step))
    stillpoint.add_relaxation("nothing", lambda: 3)
    raised(TypeError, stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "nothing"})).step)
    for name in "auto", "viscous", "newton", "Two words", "":
        raised(ValueError, stillpoint.add_relaxation, name, HeavyBall)
    raised(ValueError, stillpoint.add_damping, "bent", cundall)
    raised(ValueError, stillpoint.add_damping, "soft", cundall, stiffness_factor=0.5)


@claim("a strategy that is added again under its name takes the place of the first")
def _(_folder):
    stillpoint.add_damping("again", lambda v, Q, alpha: 0 * Q)
    first = stillpoint.load(BAR, {"damping.strategy": "again", "stop.steps": 20})
    undamped = stillpoint.Simulation(first).run().unknowns.u
    stillpoint.add_damping("again", cundall, stiffness_factor=1.7)
    assert not np.array_equal(stillpoint.Simulation(first).run().unknowns.u, undamped)


@claim("a relaxation in Python that remembers is resumed with the same bits")
def _(folder):
    class Growing:
        def __init__(self):
            self.count, self.share, self.last = 0, 0.1, np.zeros(0)

        def propose(self, h, motion, u_new, v_new):
            v_new[:] = 0.9 * motion.v + self.share * h * motion.a
            u_new[:] = motion.u + h * v_new

        def moved(self, _h, motion):
            self.count += 1
            self.share = min(1.01 * self.share, 0.5)
            if self.last.size and np.dot(self.last, motion.Q) < 0:
                self.share = 0.1
            self.last = motion.Q.copy()

    stillpoint.add_relaxation("growing", Growing)
    scene = stillpoint.load(BAR, {"damping.strategy": "growing"}, stop={"steps": 400})
    whole, first = stillpoint.Simulation(scene), stillpoint.Simulation(scene)
    for _ in range(50):
        first.step()
    first.save(str(folder / "state.h5"))
    resumed = stillpoint.resume(folder / "state.h5")
    assert resumed.steps == 50
    whole.run(), resumed.run()
    assert np.array_equal(whole.unknowns.u, resumed.unknowns.u) and resumed.steps == whole.steps == 400


@claim("a relaxation that remembers what no checkpoint takes is told when it is saved")
def _(folder):
    class Rich(HeavyBall):
        def __init__(self):
            self.file = {}

    stillpoint.add_relaxation("rich", Rich, needs_omega_1=True)
    simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "rich"}))
    simulation.step()
    assert "'file'" in str(raised(TypeError, simulation.save, str(folder / "state.h5")))
    assert not (folder / "state.h5").exists()


@claim("a stopping test in Python ends the simulation, with its reason")
def _(_folder):
    def far_enough(simulation):
        seen.append(simulation.t)
        return simulation.residual < 1e-3 and f"residual {simulation.residual:.1e}"

    seen = []
    simulation = stillpoint.Simulation(BAR, stop=far_enough).run()
    assert (simulation.status, simulation.reason[:9]) == ("stop-test", "residual ") and simulation.residual < 1e-3
    assert simulation.summary.exit_status == 0 and len(seen) == simulation.steps and not simulation.step()
    assert stillpoint.Simulation(BAR, stop=lambda _: False).run().status == "equilibrium"
    assert "own stopping test" in stillpoint.Simulation(BAR, stop=lambda _: True).run().reason
    raised(ZeroDivisionError, stillpoint.Simulation(BAR, stop=lambda _: 1 / 0).step)
    raised(RuntimeError, stillpoint.Simulation(BAR, stop=lambda simulation: simulation.step()).step)


@claim("a motion that is kept shows nothing after its call, and its arrays stay whole")
def _(_folder):
    kept = []

    class Keeping(HeavyBall):
        def propose(self, h, motion, u_new, v_new):
            kept.extend([motion, motion.u, motion.Q, u_new])
            raised(ValueError, motion.u.__setitem__, 0, 1.0)
            super().propose(h, motion, u_new, v_new)

    stillpoint.add_relaxation("keeping", Keeping, needs_omega_1=True)
    simulation = stillpoint.Simulation(stillpoint.load(BAR, {"damping.strategy": "keeping"}))
    simulation.step()
    del simulation
    raised(RuntimeError, lambda: kept[0].u)
    assert all(np.all(np.isfinite(array)) and len(array) == 9 for array in kept[1:4])


check_the_claim()
