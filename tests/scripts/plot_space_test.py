#!/usr/bin/python3
"""plot_space_test.py ROOT CLAIM PROGRAM: one claim about the pictures of a body in space."""

import json

import numpy as np
from claims import check_the_claim, claim, plots_module
from field_pictures import figure_of, is_refused, write
from matplotlib import colormaps
from matplotlib.colors import to_rgb

OUTER, INNER = 1, 2  # materials


def a_block(*numbers, spacing=0.1):
    """(points × 3): points along x, y and z, in the middles of cells of a spacing."""
    axes = [spacing * (np.arange(number) + 0.5) for number in numbers]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def a_nut(folder):
    """A block of 2 m with a kernel that one does not see: from 0.4 m to 1.6 m along x, y and z."""
    place = a_block(20, 20, 20)
    inside = (np.abs(place - 1) < 0.6).all(axis=1)
    return write(folder, [{"t": 0.0, "place": place, "material": np.where(inside, INNER, OUTER)}], dim=3)


class Pixels:
    """Of the first panel of a figure."""

    def __init__(self, figure):
        figure.canvas.draw()
        self.panel, self.picture = figure.axes[0], np.asarray(figure.canvas.buffer_rgba())[:, :, :3] / 255

    def position(self, place):
        """(column, row) of a place, from the picture's upper left corner."""
        projected = plots_module("surface_image").projected(np.array(place, dtype=float))
        column, row = self.panel.transData.transform(projected)
        return np.array([column, len(self.picture) - row])

    def at(self, place):
        column, row = self.position(place).astype(int)
        return self.picture[row, column]

    def material_at(self, place):
        """The one whose colour is nearest in hue: light and shadow change how bright it is."""
        hues = np.array([to_rgb(plots_module("pictures").COLOURS[k]) for k in (0, 1)])
        unit = lambda colour: colour / np.linalg.norm(colour, axis=-1, keepdims=True)  # noqa: E731
        return (OUTER, INNER)[np.argmax(unit(hues) @ unit(self.at(place)))]


def is_background(colour):
    return np.all(colour > 0.94)  # of the floor, too


@claim("a body in space is drawn to one scale along x, y and z, y upwards")
def _(folder):
    alone = [0.0, 2.0, 0.0]
    place = np.concatenate([a_block(10, 4, 4), [alone]])
    pixels = Pixels(figure_of([write(folder, [{"t": 0.0, "place": place, "u": place}], dim=3)]))
    origin = pixels.position([0, 0, 0])
    along = np.array([pixels.position(unit) - origin for unit in np.eye(3)])
    lengths = np.linalg.norm(along, axis=1)
    assert lengths.min() > 50 and np.ptp(lengths) < 1e-6 * lengths.max(), lengths
    assert np.allclose(along[1], [0, -lengths[1]]) and along[0][0] > 0 > along[2][0]
    assert not is_background(pixels.at(alone)) and is_background(pixels.at([0.0, 1.7, 0.0]))
    assert not is_background(pixels.at([1.0, 0.2, 0.4])) and is_background(pixels.at([1.3, 0.2, 0.4]))


@claim("a point behind another is not drawn over it, in whatever order they come")
def _(folder):
    sheet, material = a_block(8, 8, 1), np.repeat([INNER, OUTER], 64)
    for distance in (0.12, 0.6):
        place = np.concatenate([sheet, sheet + distance])  # the second is before the first, along the view
        for order in (slice(None), slice(None, None, -1)):
            write(folder, [{"t": 0.0, "place": place[order], "material": material[order]}], dim=3)
            pixels = Pixels(figure_of([folder]))
            assert all(pixels.material_at(at) == OUTER for at in place[64:]), (distance, order)


@claim("neighbours in space leave no gap between them, coarse or fine")
def _(folder):
    surface_image = plots_module("surface_image")
    for number in (3, 10, 47):
        place = a_block(number, number, number, spacing=1 / number)
        window = surface_image.Window(np.array([-0.8, -0.9]), 250, 400, 450)
        image, _ = surface_image.surface_image(place, place, plots_module("field_stages").spacing_of(place), window)
        corners = surface_image.projected(a_block(2, 2, 2, spacing=1 - 1 / number) + (2 / number - 1) / 2)
        across, up = (np.indices((450, 400))[::-1] + 0.5) / 250 + window.low[:, None, None]
        inside = (np.abs(across) < corners[:, 0].max()) & (
            np.abs(up) + np.abs(across) / np.sqrt(3) < corners[:, 1].max()
        )
        assert inside.sum() > 20000 and np.all(image[inside, 3] == 1), number


@claim("points deep inside of a body in space are left out, which changes nothing that one sees")
def _(folder):
    surface_image = plots_module("surface_image")
    place = a_block(40, 40, 40, spacing=0.025)
    place[:, 1] *= 1 - 0.5 * place[:, 0] ** 2
    window = surface_image.Window(np.array([-0.8, -0.9]), 200, 320, 360)
    some, _ = surface_image.surface_image(place, place, 0.025, window)
    left = surface_image.in_front(surface_image.projected(place), place @ surface_image.NEAR, 0.025)
    assert 0.05 < left.mean() < 0.35, left.mean()
    surface_image.in_front = lambda view, near, spacing: np.full(len(near), True)
    everything, _ = surface_image.surface_image(place, place, 0.025, window)
    assert np.mean(np.abs(some - everything).max(axis=2) > 0.02) < 1e-3


@claim("the faces of a block are of different brightness, its top the brightest, in a colour near that of the bar")
def _(folder):
    place = a_block(12, 12, 12)
    figure = figure_of([write(folder, [{"t": 0.0, "place": place, "heat": 0 * place[:, 0] + 3.0}], dim=3)])
    pixels = Pixels(figure)
    top, front, side = (pixels.at(at) for at in ([0.6, 1.2, 0.6], [0.6, 0.6, 1.2], [1.2, 0.6, 0.6]))
    assert top.sum() > 1.15 * front.sum() and front.sum() > 1.1 * side.sum(), (top, front, side)
    in_the_bar = colormaps["viridis"](0.5)  # the one value that there is
    assert np.allclose(top, in_the_bar[:3], atol=0.16)


@claim("a cut shows the inside of a body, which nothing shows without it")
def _(folder):
    a_nut(folder)
    pixels = Pixels(figure_of([folder]))
    for k, place in enumerate(2 * np.random.default_rng(1).uniform(size=(300, 3))):
        place[k % 3] = 2.0  # on one of the faces that one sees
        assert pixels.material_at(place) == OUTER, place
    for k, axis in enumerate("xyz"):
        for value, material in ((1.7, OUTER), (1.5, INNER)):
            pixels = Pixels(figure_of([folder], cuts=[f"{axis}={value}"]))
            middle, rim = np.ones(3), np.full(3, 1.85)
            middle[k] = rim[k] = value
            assert pixels.material_at(middle) == material and pixels.material_at(rim) == OUTER, (axis, value)


@claim("several cuts take a corner out of a body, and leave what lies behind any of them")
def _(folder):
    pixels = Pixels(figure_of([a_nut(folder)], cuts=["x=1", "z=1"]))
    assert pixels.material_at([1.0, 1.0, 1.3]) == INNER and pixels.material_at([1.3, 1.0, 1.0]) == INNER
    assert pixels.material_at([0.5, 2.0, 1.7]) == OUTER and pixels.material_at([1.7, 2.0, 0.5]) == OUTER
    assert is_background(pixels.at([1.7, 0.0, 1.7]))


@claim("a cut that is none, or where no body is, is refused with status 2")
def _(folder):
    a_nut(folder)
    for cut in ("x", "x=", "w=1", "=1", "xy=1", "x=here", "x=nan", "x=inf", "x=1=2"):
        is_refused([f"--cut {cut}:", "expected x=VALUE"], folder, "--cut", cut)
    is_refused(["--cut y=2:", "already"], folder, "--cut", "y=1", "--cut", "y=2")
    for cut in ("z=2.5", "z=-0.5"):
        is_refused([f"the cut {cut}:", "between z = 0.05 and 1.95"], folder, "--cut", cut)
    place = a_block(8, 8, 1)
    is_refused(["only a body in space"], write(folder, [{"t": 0.0, "place": place, "u": place}]), "--cut", "x=0.3")


@claim("a point in space whose value is no number is grey, and one at no place or far off leaves the picture as it is")
def _(folder):
    place = a_block(20, 20, 20)
    heat = place[:, 1].copy()
    heat[place[:, 0] > 1.8] = np.nan
    frame = {"t": 0.0, "place": place, "heat": heat}
    picture = Pixels(figure_of([write(folder, [frame], dim=3)])).picture
    pixels = Pixels(figure_of([folder]))
    grey = pixels.at([2.0, 1.0, 1.0])
    assert np.ptp(grey) < 0.02 and 0.3 < grey.mean() < 0.75, grey
    assert np.ptp(pixels.at([1.0, 1.0, 2.0])) > 0.1
    lost = np.array([[np.nan, 1, 1], [1, 1, np.inf], [300, 1, 1]])
    more = {"t": 0.0, "place": np.concatenate([place, lost]), "heat": np.concatenate([heat, [1.0, 1.0, 1.0]])}
    assert np.array_equal(Pixels(figure_of([write(folder, [more], dim=3)])).picture, picture)


@claim("each stage in space has a panel with its time, on a box that all share, and vectors have three components")
def _(folder):
    place = a_block(10, 10, 10)
    frames = [{"t": float(k), "place": place * [1 + k, 1, 1], "u": place * [k, 0, 0]} for k in range(4)]
    write(folder, frames, dim=3)
    figure = figure_of([folder], "u_x")
    panels = figure.axes[:4]
    assert [panel.get_title() for panel in panels] == [f"$t$ = {k}" for k in range(4)]
    assert len({(panel.get_xlim(), panel.get_ylim()) for panel in panels}) == 1
    boxes = [axis.get_tightbbox(figure.canvas.get_renderer()) for axis in figure.axes]
    assert all(not a.overlaps(b) for k, a in enumerate(boxes) for b in boxes[:k])
    assert all(box.x0 >= 0 and box.y0 >= 0 and box.x1 <= figure.bbox.width for box in boxes)
    names = {text.get_text() for text in panels[2].texts}
    assert {"$x$ [m]", "$y$ [m]", "$z$ [m]", "0", "2"} <= names, names
    assert figure_of([folder], "u_z").axes[-1].get_xlabel() == "displacement $u_{z}$ [m]"
    is_refused(["there are u, u_x, u_y, u_z, layers\n"], folder, "--field", "heat")


@claim("layers of a body in space are cubes of the undeformed one")
def _(folder):
    layers = plots_module("field_stages").Layers(a_block(16, 24, 16))
    assert layers.rows == 2
    colours = layers.colours(a_block(16, 24, 16)).reshape(16, 24, 16, 4)
    assert len(np.unique(colours.reshape(-1, 4), axis=0)) == 4
    assert np.array_equal(colours, np.repeat(np.repeat(np.repeat(colours[::2, ::2, ::2], 2, 0), 2, 1), 2, 2))
    cubes = colours[::2, ::2, ::2]
    for axis in range(3):  # the next cube along any axis has another colour, the one after it the same
        one, next_one, third = (np.moveaxis(cubes, axis, 0)[k] for k in range(3))
        assert np.all(np.any(one != next_one, axis=-1)) and np.array_equal(one, third), axis


@claim("arrows at a limit load in space are those of the points that one sees, along the view")
def _(folder):
    from matplotlib.quiver import Quiver

    place = a_block(16, 16, 16)
    seen = (place > 1.5).any(axis=1)  # the outer layer of the three faces
    v = np.where(seen[:, None], [1.0, 0.0, 0.0], [0.0, 50.0, 0.0])
    write(folder, [{"t": 1.0, "place": place, "plastic_strain": place[:, 1], "v": v}], dim=3)
    (folder / "summary.json").write_text(json.dumps({"status": "limit-load", "load": {"factor": 5.2321}}))
    panel = figure_of([folder]).axes[0]
    (quiver,) = (one for one in panel.collections if isinstance(one, Quiver))
    assert len(quiver.U) > 50 and np.allclose(quiver.U, np.sqrt(1 / 2)) and np.allclose(quiver.V, -np.sqrt(1 / 6))
    assert r"$\lambda$ = 5.232" in panel.get_title()


if __name__ == "__main__":
    check_the_claim()
