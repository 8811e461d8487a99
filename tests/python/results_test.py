#!/usr/bin/python3
"""results_test.py ROOT CLAIM PACKAGE: one claim about what becomes of results in Python: pictures, tables and meshes."""

from modules import BAR, SLOPE, raised  # first: finds the package

import io
import subprocess
import sys
from pathlib import Path

import numpy as np
import stillpoint
from claims import check_the_claim, claim, plot

SMALL = {"grid.cells": [24, 12]}  # of the slope


def png(figure):
    image = io.BytesIO()
    figure.savefig(image, format="png")
    return image.getvalue()


def by_the_command(kind, folder, *options):
    """The picture that `stillpoint plot` makes of a folder."""
    file = Path(folder) / "by_the_command.png"
    result = plot(kind, folder, *options, "--out", file)
    assert result.returncode == 0, result.stderr
    return file.read_bytes()


def a_slope(folder):
    """Its simulation, and the folder of a run of it with fields at 0 s and 2 s."""
    scene = stillpoint.load(SLOPE, {**SMALL, "output.stages": [0, 2], "stop.time": 2})
    stillpoint.run(scene, out=folder)
    return stillpoint.Simulation(scene).run(), stillpoint.read_run(folder)


@claim("a history is drawn in Python as the command draws it, of a simulation and of its folder")
def _(folder):
    simulation = stillpoint.Simulation(BAR)
    assert "no row yet" in str(raised(ValueError, simulation.plot))
    simulation.run()
    stillpoint.run(BAR, out=folder)
    assert png(simulation.plot()) == png(stillpoint.read_run(folder).plot()) == by_the_command("history", folder)


@claim("several histories are drawn side by side, told apart by what was laid over their scenes")
def _(folder):
    runs = [stillpoint.Simulation(stillpoint.load(BAR, {"damping.c": c})).run(20) for c in (0.1, 0.7)]
    stillpoint.run(BAR, out=folder)
    figure = runs[0].plot(runs[1], folder, stillpoint.read_run(folder))
    (key,) = figure.legends
    assert [text.get_text() for text in key.get_texts()][:3] == ["damping.c=0.1", "damping.c=0.7", folder.name]
    lines = figure.axes[0].lines
    assert len(lines) == 8, "two probes of each"
    for run, line in zip(runs, lines):
        assert np.array_equal(line.get_ydata(), run.history["p6.u"])


@claim("points are drawn in Python as the command draws them, of a simulation and of its folder")
def _(folder):
    simulation, run = a_slope(folder)
    for field in (None, "stress_xy", "layers"):
        options = ["--field", field] if field else []
        assert png(run.plot_points(field)) == by_the_command("fields", folder, *options)
        assert png(simulation.plot_points(field)) == by_the_command("fields", folder, "--stages", 1, *options)
    assert "no field 'heat'; there are" in str(raised(ValueError, simulation.plot_points, "heat"))
    assert "only a body in space" in str(raised(ValueError, simulation.plot_points, cut={"x": 1.0}))
    assert "found 'w'" in str(raised(ValueError, simulation.plot_points, cut={"w": 1.0}))


@claim("a comparison and a convergence study are drawn in Python as the command draws what they leave, and read again from it")
def _(folder):
    ways = {"strategies": ["auto", "cg"], "integrators": ["leapfrog"], "repeats": 1}
    kinds = {
        "compare": stillpoint.compare(BAR, out=folder / "compare", **ways),
        "converge": stillpoint.converge("problems/mms_bar.toml", levels=3, dominant=False, out=folder / "converge"),
    }
    for kind, study in kinds.items():
        again = stillpoint.read_study(folder / kind)
        assert type(again) is type(study) and list(again) == list(study)
        assert png(study.plot()) == png(again.plot()) == by_the_command(kind, folder / kind)
    samples = [study.runs[0].samples for study in (kinds["compare"], stillpoint.read_study(folder / "compare"))]
    assert np.array_equal(*(sample["error"] for sample in samples)) and len(samples[0]) > 5
    assert "compare.json" in str(raised(ValueError, stillpoint.read_study, folder))


@claim("a picture is drawn on an empty figure of pyplot's, and one that is new is none of pyplot's, in its own style")
def _(_folder):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    before = dict(matplotlib.rcParams)
    simulation = stillpoint.Simulation(BAR).run()
    new = simulation.plot()
    assert isinstance(new, matplotlib.figure.Figure) and not pyplot.get_fignums()
    assert new._repr_png_() == png(new), "what a notebook shows"
    own = pyplot.figure()
    assert simulation.plot(figure=own) is own and len(own.axes) == len(new.axes)
    assert dict(matplotlib.rcParams) == before
    assert {label.get_fontsize() for label in new.axes[0].get_xticklabels()} == {11}


@claim("histories, comparisons, levels and verdicts are tables of pandas' with a row each and the columns of their files")
def _(folder):
    import pandas

    simulation = stillpoint.Simulation(BAR, out=folder).run()
    history = simulation.to_pandas()
    written = pandas.read_csv(folder / "history.csv", float_precision="round_trip")
    pandas.testing.assert_frame_equal(history, written, check_exact=True)
    pandas.testing.assert_frame_equal(stillpoint.read_run(folder).to_pandas(), written, check_exact=True)

    comparison = stillpoint.compare(BAR, strategies=["auto", "cg"], integrators=["leapfrog"], repeats=1, out=folder)
    runs, written = comparison.to_pandas(), pandas.read_csv(folder / "compare.csv")
    assert set(written.columns) <= set(runs.columns) and len(runs) == len(written) == 2
    assert list(runs["evaluations"]) == list(written["evaluations"]) and np.isnan(runs["overshoot"]).all()
    assert np.allclose(runs["wall_most_s"], written["wall_most_s"], rtol=1e-15)

    vary = ["grid.basis=linear,quadratic"]
    study = stillpoint.converge("problems/mms_bar.toml", levels=2, dominant=False, vary=vary, out=folder)
    levels, written = study.to_pandas(), pandas.read_csv(folder / "converge.csv")
    assert list(levels["grid.basis"]) == list(written["grid.basis"]) == ["linear"] * 2 + ["quadratic"] * 2
    assert list(levels["level"]) == [1, 2, 1, 2] and np.allclose(levels["u_l2"], written["u_l2"], rtol=1e-12)
    errors = np.concatenate([one.quantities["third.u"].errors for one in study.series])
    assert np.array_equal(levels["third.u.error"], errors)

    slope = {"grid.cells": [34, 11]}
    safety = stillpoint.safety("problems/stable_slope.toml", slope, first=1.2, last=1.6, width=0.2, out=folder / "safety")
    verdicts = safety.to_pandas()
    assert list(verdicts["factor"]) == [one.factor for one in safety.verdicts]
    assert {"rests", "moves"} == set(verdicts["verdict"]) and verdicts["displacement"].dtype == float
    assert stillpoint.read_study(folder / "safety").to_pandas().equals(verdicts)


@claim("points become vertices of meshio's with all fields by name: scalars, vectors and tensors, as VTK's files hold them")
def _(folder):
    import meshio

    simulation, _run = a_slope(folder)
    points, count = simulation.points, len(simulation.points)
    simulation.to_meshio().write(folder / "points.vtu")
    mesh = meshio.read(folder / "points.vtu")
    assert np.array_equal(mesh.points[:, :2], points.position) and not mesh.points[:, 2].any()
    assert [block.type for block in mesh.cells] == ["vertex"] and len(mesh.cells[0].data) == count
    assert {"u", "v", "stress", "strain", "plastic_strain", "volume", "mass"} <= set(mesh.point_data)
    assert np.array_equal(mesh.point_data["u"][:, :2], points.displacement)
    stress = mesh.point_data["stress"].reshape(count, 3, 3)
    assert np.array_equal(stress, stress.swapaxes(1, 2)) and stress.any()
    assert np.array_equal(stress[:, [0, 1, 2, 0], [0, 1, 2, 1]], points.stress), "xx, yy, zz, xy"
    assert np.array_equal(mesh.point_data["plastic_strain"], points.plastic_strain)


@claim("the fields of a folder are those of the simulation at the time that is nearest, by the same names")
def _(folder):
    simulation, run = a_slope(folder)
    assert np.array_equal(run.times, [0, 2]) and run.summary.residual == simulation.summary.residual
    for name in simulation.history.dtype.names:
        assert np.array_equal(run.history[name], simulation.history[name], equal_nan=True), name
    now, last, first = simulation.point_fields(), run.point_fields(), run.point_fields(0.9)
    assert (first.t, last.t, now.t, last.dim) == (0, 2, 2, 2) and not first["u"].any()
    for name in ("u", "v", "stress", "plastic_strain"):
        assert np.array_equal(now[name], last[name]), name
    assert np.array_equal(now.position, last.position) and now["stress"].shape == (len(simulation.points), 3, 3)
    assert set(run.to_meshio(0).point_data) == set(first)
    assert "no fields.h5" in str(raised(ValueError, getattr, stillpoint.read_run(folder / ".."), "times"))
    raised(FileNotFoundError, stillpoint.read_run, folder / "none")


@claim("a strain is the symmetric part of the gradient, of a bar a number, in the plane and in space a tensor")
def _(_folder):
    bar = stillpoint.Simulation(BAR).run()
    assert np.array_equal(bar.point_fields()["strain"], bar.points.strain) and bar.to_meshio().points.shape == (12, 3)
    for scene, dim, cells in (("block", 2, [4, 4]), ("square_load", 3, [4, 4, 4])):
        body = stillpoint.Simulation(stillpoint.load(f"problems/{scene}.toml", {"grid.cells": cells}))
        for _ in range(5):
            body.step()
        gradient, strain = body.points.strain.reshape(-1, dim, dim), body.point_fields()["strain"]
        assert np.abs(gradient - gradient.swapaxes(1, 2)).max() > 0
        assert np.array_equal(strain[:, :dim, :dim], (gradient + gradient.swapaxes(1, 2)) / 2)
        assert not strain[:, dim:].any() and np.array_equal(strain, strain.swapaxes(1, 2))


@claim("where matplotlib, pandas or meshio is missing, what needs it says which package to install, and nothing else does")
def _(_folder):
    simulation = stillpoint.Simulation(BAR).run()
    assert not {"matplotlib", "pandas", "meshio", "h5py"} & set(sys.modules), "they take their time to import"
    for name, method in (("matplotlib", simulation.plot), ("pandas", simulation.to_pandas), ("meshio", simulation.to_meshio)):
        sys.modules[name] = None
        error = raised(ImportError, method)
        assert error.name == name and f"python3-{name}" in str(error), error


@claim("a Python without numpy is told which package to install")
def _(_folder):
    program = f"import sys; sys.path.insert(0, {sys.argv[3]!r}); import stillpoint"
    result = subprocess.run(["/usr/bin/python3", "-S", "-c", program], capture_output=True, text=True)
    last = result.stderr.splitlines()[-1]
    assert result.returncode == 1 and last.startswith("ImportError") and "python3-numpy" in last, result.stderr
    assert "During handling" not in result.stderr, result.stderr


check_the_claim()
