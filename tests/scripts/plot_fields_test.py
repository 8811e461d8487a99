#!/usr/bin/python3
"""plot_fields_test.py ROOT CLAIM PROGRAM: one claim about the pictures of fields. PROGRAM is write_fields."""

import json
import sys

import numpy as np
from claims import call, check_the_claim, claim, plot
from field_pictures import figure_of, is_refused, write

SIDE = 0.1  # between the points of a_body
ASKED = {"surface": {"slope_angle": 31.26}}  # probes of a summary


def a_body(columns=40, rows=24):
    x, y = np.meshgrid(SIDE * (np.arange(columns) + 0.5), SIDE * (np.arange(rows) + 0.5))
    return np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)


def sheared(place, by):
    return place + by * np.stack([place[:, 1], 0 * place[:, 0], 0 * place[:, 0]], axis=1)


def a_shear(folder, count=2):
    place = a_body()
    steps = [(float(k), sheared(place, 0.3 * k)) for k in range(count)]
    return write(folder, [{"t": t, "place": at, "u": at - place, "plastic_strain": t * at[:, 1]} for t, at in steps])


def panels_of(figure):
    return [axis for axis in figure.axes if axis.get_xlabel() != "plastic strain"]


@claim("fields that are not there or cannot be drawn are refused with status 2, with those on offer")
def _(folder):
    is_refused([str(folder), "no fields.h5; does the scene"], folder)
    (folder / "fields.pvd").touch()
    is_refused([str(folder), "no fields.h5", 'output.format = ["xdmf", "vtu"]'], folder)
    (folder / "fields.h5").write_text("no HDF5")
    is_refused(["fields.h5", "signature"], folder)
    is_refused(["no frames"], write(folder, []))
    nowhere = {"t": 3.0, "place": np.full((4, 3), np.nan), "w": np.ones(4)}
    is_refused(["at t = 3 no point has a place"], write(folder, [nowhere]))
    is_refused(["no fields, so nothing to draw"], write(folder, [{"t": 3.0, "place": a_body()}]))
    is_refused(["'place'"], write(folder, [{"t": 0.0, "w": np.ones(4)}]))
    is_refused(["no field 'heat'; there are plastic_strain, u, u_x, u_y, layers\n"], a_shear(folder), "--field", "heat")
    is_refused(["no field 'u_z'"], folder, "--field", "u_z")
    bar = write(folder / "bar", [{"t": 0.0, "place": a_body(rows=1), "u": np.ones(40)}], dim=1)
    is_refused(["no field 'layers'"], bar, "--field", "layers")
    is_refused(["the cut x=1", "only a body in space"], bar, "--cut", "x=1")
    is_refused(["one picture"], a_shear(folder), bar, "--field", "u")
    for stage in ({"t": 0}, {"t": 0, "slope_angle": "steep"}):
        (folder / "summary.json").write_text(json.dumps({"stages": [stage], "probes": ASKED}))
        is_refused(["summary.json", "slope_angle"], folder)
    result = plot("fields", folder, "--stages", "0")
    assert result.returncode == 2 and "one at least" in result.stderr


@claim("the fields that a run wrote are drawn into fields.png, or elsewhere")
def _(folder):
    for what in ("plane", "bar", "space"):
        call(sys.argv[3], what, folder / what)
        result = plot("fields", folder / what)
        assert result.returncode == 0 and result.stdout == f"Picture: {folder / what / 'fields.png'}\n", result
        assert not result.stderr and (folder / what / "fields.png").read_bytes().startswith(b"\x89PNG")
    result = plot("fields", folder / "plane", "--field", "stress_xy", "--out", folder / "a.pdf")
    assert result.returncode == 0 and (folder / "a.pdf").read_bytes().startswith(b"%PDF"), result


@claim("each stage has a panel with its time, and the slope angle if a probe asks for it, on axes and colours that all share")
def _(folder):
    a_shear(folder, 4)
    stages = [{"t": 1.0, "slope_angle": 31.26}, {"t": 2.0, "slope_angle": None}, {"t": 9.0, "slope_angle": 1}]
    summary = {"title": "costs $5 or $6", "stages": stages, "probes": {"toe": {"u.x": 1.0}}}
    (folder / "summary.json").write_text(json.dumps(summary))
    assert [axis.get_title() for axis in panels_of(figure_of([folder]))] == [f"$t$ = {k}" for k in range(4)]
    (folder / "summary.json").write_text(json.dumps(summary | {"probes": ASKED}))
    figure = figure_of([folder])
    panels = panels_of(figure)
    assert [axis.get_title() for axis in panels] == ["$t$ = 0", "$t$ = 1,  slope 31.3°", "$t$ = 2", "$t$ = 3"]
    assert len({(axis.get_xlim(), axis.get_ylim()) for axis in panels}) == 1
    assert panels[0].get_xlim()[1] > a_body()[:, 0].max() + 0.3 * 3 * a_body()[:, 1].max()
    for axis in panels:  # equal scales, two by two
        box = axis.get_window_extent()
        assert np.isclose(box.width / np.ptp(axis.get_xlim()), box.height / np.ptp(axis.get_ylim()))
    boxes = [axis.get_tightbbox(figure.canvas.get_renderer()) for axis in figure.axes]
    assert all(not a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    assert len({round(axis.get_position().x0, 6) for axis in panels}) == 2
    points = [axis.collections[0] for axis in panels]
    assert [dots.get_clim() for dots in points] == [(0, 3 * a_body()[:, 1].max())] * 4
    assert np.array_equal(points[3].get_array(), 3 * a_body()[:, 1]) and all(dots.get_rasterized() for dots in points)
    assert np.allclose(points[3].get_offsets(), sheared(a_body(), 0.9)[:, :2])
    assert figure._suptitle.get_text() == r"costs \$5 or \$6"


@claim("without --field it is the plastic strain that is drawn if some point has yielded, and otherwise the length of u")
def _(folder):
    place = a_body()
    strain = 0 * place[:, 0]
    frames = [{"t": t, "place": place, "u": place, "plastic_strain": strain.copy()} for t in (0.0, 1.0)]
    assert figure_of([write(folder / "elastic", frames)]).axes[-1].get_xlabel() == "displacement $|u|$ [m]"
    frames[1]["plastic_strain"][7] = 1e-9
    assert figure_of([write(folder / "yields", frames)]).axes[-1].get_xlabel() == "plastic strain"


@claim("without plastic strain it is the length of u that is drawn, and a component by its name, each with its unit")
def _(folder):
    place = a_body()
    u = np.stack([3 * place[:, 1], -4 * place[:, 1], 0 * place[:, 0]], axis=1)
    write(folder, [{"t": 0.0, "place": place, "u": u, "density": place[:, 0]}])
    for field, factor, label in ((None, 5, "displacement $|u|$ [m]"), ("u_y", -4, "displacement $u_{y}$ [m]")):
        figure = figure_of([folder], field)
        assert np.allclose(figure.axes[0].collections[0].get_array(), factor * place[:, 1])
        assert figure.axes[-1].get_xlabel() == label
        assert (figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()) == ("$x$ [m]", "$y$ [m]")


@claim("a material has a colour a number, and a field colours from its values but for a few extreme ones")
def _(folder):
    place = a_body()
    material = (place[:, 0] > 2).astype("i4") * 5 + 1
    extreme, positive = 1 + place[:, 1], 100 + place[:, 1]
    extreme[7] = 1e6
    write(folder, [{"t": 0.0, "place": place, "material": material, "extreme": extreme, "positive": positive}])
    figure = figure_of([folder], "material")
    colours = figure.axes[0].collections[0].to_rgba(material)
    assert len(np.unique(colours, axis=0)) == 2
    assert [text.get_text() for text in figure.axes[1].get_xticklabels()] == ["1", "6"]
    low, high = figure_of([folder], "extreme").axes[0].collections[0].get_clim()
    assert low == 0 and np.isclose(high, extreme[extreme < 1e6].max(), rtol=0.01)
    clim = figure_of([folder], "positive").axes[0].collections[0].get_clim()
    assert np.allclose(clim, (positive.min(), positive.max()), rtol=1e-12)


@claim("of many stages some are drawn, evenly spread, the first and the last among them")
def _(folder):
    a_shear(folder, 21)
    for wanted, times in ((6, [0, 4, 8, 12, 16, 20]), (3, [0, 10, 20]), (1, [20]), (2, [0, 20])):
        titles = [axis.get_title() for axis in panels_of(figure_of([folder], None, wanted))]
        assert titles == [f"$t$ = {t}" for t in times], titles


@claim("several runs have a row each, with their names")
def _(folder):
    runs = [a_shear(folder / name) for name in ("soft", "stiff")]
    (runs[1] / "label").write_text("E = 2\n")
    panels = panels_of(figure_of(runs))
    titles = [f"{name},  $t$ = {t}" for name in ("soft", "E = 2") for t in (0, 1)]
    assert [axis.get_title() for axis in panels] == titles
    assert len({round(axis.get_position().y0, 6) for axis in panels}) == 2


@claim("layers are squares of the undeformed body, whatever became of it")
def _(folder):
    place, some = a_body(), a_body()[:, 0] > 0.2  # of the last stage
    frames = [{"t": float(k), "place": sheared(place, 0.3 * k), "u": sheared(place, 0.3 * k) - place} for k in range(3)]
    frames[2] |= {name: frames[2][name][some] for name in ("place", "u")}
    figure = figure_of([write(folder, frames)], "layers")
    colours = [axis.collections[0].get_facecolors() for axis in figure.axes]
    assert np.array_equal(colours[0], colours[1]) and np.array_equal(colours[0][some], colours[2])
    grid = colours[0].reshape(24, 40, 4)  # rows × columns of a_body: squares of 3 × 3 points
    for row in range(24):
        for column in range(40):
            assert np.array_equal(grid[row, column], grid[row // 3 % 2 * 3, column // 3 % 2 * 3])
    assert len(np.unique(colours[0], axis=0)) == 4


@claim("a few points that flew off, or are at no place, do not shrink the picture")
def _(folder):
    place = a_body()
    place[0, 0], place[1, 1], place[2, 0] = 500, np.nan, np.inf
    figure = figure_of([write(folder, [{"t": 0.0, "place": place, "plastic_strain": place[:, 1] * 0}])])
    assert figure.axes[0].get_xlim()[1] < 40 * SIDE + 1
    size = figure.axes[0].collections[0].get_sizes()[0] ** 0.5 / 72 * figure.dpi  # in pixels, as the next
    spacing = SIDE * figure.axes[0].get_window_extent().width / np.ptp(figure.axes[0].get_xlim())
    assert 0.8 * spacing < size < 1.5 * spacing


@claim("the fields of a bar are lines over its places, a line a stage")
def _(folder):
    place = a_body(5, 1)[::-1]
    write(folder, [{"t": float(k), "place": place * (1 + k), "stress": k * place[:, 0]} for k in range(3)], dim=1)
    (axis,) = figure_of([folder]).axes
    assert [line.get_label() for line in axis.lines] == [f"$t$ = {k}" for k in range(3)]
    assert np.allclose(axis.lines[2].get_xydata(), (place[::-1, :1]) * [3, 2])
    assert axis.get_ylabel() == r"stress $\sigma$ [Pa]" and axis.get_xlabel() == "position $x$ [m]"


@claim("the last stage of a run that found a limit load has its factor, and arrows along the velocity where that is")
def _(folder):
    from matplotlib.quiver import Quiver

    place = a_body()
    upper = place[:, 1] > place[:, 1].mean()
    v = np.where(upper[:, None], [0.0, -2.0, 0.0], 1e-4)  # what is below hardly moves
    write(folder, [{"t": t, "place": place, "plastic_strain": place[:, 1], "v": v} for t in (0.0, 1.0)])

    def arrows(summary):
        (folder / "summary.json").write_text(json.dumps(summary))
        panels = panels_of(figure_of([folder]))
        return [[one for one in axis.collections if isinstance(one, Quiver)] for axis in panels], panels[-1].get_title()

    found, title = arrows({"status": "limit-load", "load": {"factor": 5.2321}})
    assert [len(each) for each in found] == [0, 1] and r"$\lambda$ = 5.232" in title, title
    quiver = found[1][0]
    assert 50 < len(quiver.U) < 200 and np.allclose(quiver.U, 0, atol=0.1) and np.all(quiver.V < -0.9)
    assert quiver.Y.min() > place[:, 1].mean() - 0.25  # a square that both share
    assert arrows({"status": "end-time", "load": {"factor": 5.2321}})[0] == [[], []]


if __name__ == "__main__":
    check_the_claim()
