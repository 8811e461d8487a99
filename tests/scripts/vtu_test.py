#!/usr/bin/python3
"""vtu_test.py ROOT CLAIM PROGRAM: one claim about the VTU files that PROGRAM (write_fields) leaves, read by VTK and meshio."""

import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import h5py
import meshio
import numpy as np
from claims import ROOT, call, check_the_claim, claim
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

POINTS = [5, 40000, 5]  # of the frames of `write_fields plane`
PLANE = [[0, 3, None], [3, 1, None], [None, None, 2]]  # where a tensor's components stand in xx, yy, zz, xy
SPACE = [[0, 3, 5], [3, 1, 4], [5, 4, 2]]  # and in xx, yy, zz, xy, yz, zx
STILLPOINT = Path(sys.argv[3]).parent / "stillpoint"


def simulate(scene, out, *overrides):
    sets = [word for override in overrides for word in ("--set", override)]
    result = call(STILLPOINT, "run", ROOT / "problems" / scene, "--out", out, "--quiet", *sets)
    assert result.returncode in (0, 3), result


def write(what, folder):
    result = call(sys.argv[3], what, folder, "vtu")
    assert result.returncode == (1 if what == "killed" else 0) and not result.stderr, result
    return folder


def known(frame, seed, points, components):
    """(points × components), by the rule of write_fields.cpp."""
    return ((1 + np.arange(points * components) + 100 * seed + 10 * frame) / 7).reshape(points, components)


def padded(values):
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def in_full(values, places):
    flat = [place for row in places for place in row]
    return np.stack([np.zeros(len(values)) if k is None else values[:, k] for k in flat], axis=1)


def by_vtk(file):
    """The positions, the fields, the units and the time of a file."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    arrays = [grid.GetPointData().GetArray(k) for k in range(grid.GetPointData().GetNumberOfArrays())]
    units = {one.GetName(): one.GetInformation().Get(one.UNITS_LABEL()) for one in arrays}
    time = grid.GetFieldData().GetArray("TimeValue")
    return (
        vtk_to_numpy(grid.GetPoints().GetData()),
        {one.GetName(): vtk_to_numpy(one) for one in arrays},
        units,
        time and time.GetValue(0),
    )


def by_meshio(file):
    mesh = meshio.read(file)
    return mesh.points, mesh.point_data


def entries(collection):
    """(time, file) of what a .pvd lists."""
    listed = ElementTree.parse(collection).getroot().iter("DataSet")
    return [(float(one.get("timestep")), collection.parent / one.get("file")) for one in listed]


def check_frame(read, frame, points, dim, fields, tensor):
    positions, values = read
    assert np.array_equal(positions, padded(known(frame, 0, points, dim)))
    for seed, (name, components) in enumerate(fields.items(), start=1):
        expected = known(frame, seed, points, components)
        if components > 3:
            expected = in_full(expected, tensor)
        elif components > 1:
            expected = padded(expected)
        assert np.array_equal(values[name].reshape(points, -1), expected), name


IN_PLANE = {"u": 2, "v": 2, "stress": 4, "plastic_strain": 1, "n": 3}


@claim("VTK reads every number of a VTU file to the bit, with time and units")
def _(folder):
    listed = entries(write("plane", folder) / "fields.pvd")
    assert [time for time, _ in listed] == [0, 1 / 3, 2 / 3]
    for k, (time, file) in enumerate(listed):
        positions, values, units, in_file = by_vtk(file)
        check_frame((positions, values), k, POINTS[k], 2, IN_PLANE, PLANE)
        assert np.array_equal(values["material"], np.arange(POINTS[k]) % 3 - 1)
        assert in_file == time
        assert units == {"u": "m", "v": None, "stress": "Pa", "plastic_strain": None, "n": None, "material": None}


@claim("meshio reads every number of a VTU file to the bit")
def _(folder):
    for k, (_time, file) in enumerate(entries(write("plane", folder) / "fields.pvd")):
        check_frame(by_meshio(file), k, POINTS[k], 2, IN_PLANE, PLANE)


@claim("VTU files of a bar and of a body in space have vectors of three components and tensors of nine")
def _(folder):
    ((_, file),) = entries(write("bar", folder) / "fields.pvd")
    for read in (by_vtk(file)[:2], by_meshio(file)):
        check_frame(read, 0, 4, 1, {"u": 1, "v": 1, "stress": 1}, None)
    ((_, file),) = entries(write("space", folder) / "fields.pvd")
    for read in (by_vtk(file)[:2], by_meshio(file)):
        check_frame(read, 0, 60, 3, {"u": 3, "v": 3, "stress": 6, "plastic_strain": 1}, SPACE)


@claim("the grid is a VTU file of cells, written anew where it has changed")
def _(folder):
    files = [file.name for _, file in entries(write("plane", folder) / "grid.pvd")]
    assert files == ["grid_0000.vtu", "grid_0000.vtu", "grid_0002.vtu"], files
    grid = meshio.read(folder / "fields_vtu" / "grid_0000.vtu")
    x, y = [0, 0.5, 2], [0, 1.5, 3]
    assert np.array_equal(grid.points, [[a, b, 0] for b in y for a in x])
    assert np.array_equal(grid.cells_dict["quad"], [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]])
    write("space", folder)
    ((_, file),) = entries(folder / "grid.pvd")
    cells = meshio.read(file)
    corners = cells.points[cells.cells_dict["hexahedron"]]
    edges = corners[:, [1, 3, 4]] - corners[:, [0]]
    assert len(cells.points) == 27 and np.isclose(np.linalg.det(edges).sum(), 2 * 3 * 4), np.linalg.det(edges)


@claim("a killed process leaves the VTU files that it wrote, and their collection")
def _(folder):
    listed = entries(write("killed", folder) / "fields.pvd")
    for k, (_time, file) in enumerate(listed):
        check_frame(by_meshio(file), k, POINTS[k], 2, IN_PLANE, PLANE)
    assert len(listed) == 3 and not list(folder.rglob("*.partial"))


@claim("a run leaves the same numbers in VTU files and in fields.h5")
def _(folder):
    simulate("slope.toml", folder, "grid.cells=[40, 16]", "stop.time=0.05", "output.stages=[0, 0.02]",
             'output.format=["xdmf", "vtu"]')  # fmt: skip
    listed = entries(folder / "fields.pvd")
    with h5py.File(folder / "fields.h5") as fields:
        frames = [fields[name] for name in sorted(fields) if name.startswith("frame")]
        assert len(listed) == len(frames) == 3
        for (time, file), frame in zip(listed, frames):
            positions, values, units, in_file = by_vtk(file)
            assert time == in_file == frame.attrs["t"] and frame.attrs["t_unit"] == "s"
            assert np.array_equal(positions, frame["place"])
            for name in ("u", "v", "volume", "plastic_strain", "material"):
                assert np.array_equal(values[name], frame[name]), name
            stress = np.stack([frame[f"stress_{ij}"] for ij in ("xx", "yy", "zz", "xy")], axis=1)
            assert np.array_equal(values["stress"], in_full(stress, PLANE)) and stress.any()
            assert units["stress"] == frame["stress_xx"].attrs["unit"] == "Pa"
            assert "strain" not in values  # which would be that since the last phase began
    assert [one.get("timestep") for one in ElementTree.parse(folder / "grid.pvd").getroot().iter("DataSet")]


@claim("the strain in VTU files is the exact one of a block that is pressed together, and its volume the block's")
def _(folder):
    simulate("ladder/pressed_plate.toml", folder, "output.stages=[0]", 'output.format=["vtu"]')
    _, fields = by_meshio(entries(folder / "fields.pvd")[-1][1])
    delta, height, width = 0.01, 1.03, 0.55
    expected = np.zeros(9)
    expected[4] = -delta / height
    assert np.allclose(fields["strain"], expected, rtol=0, atol=1e-6 * delta / height), fields["strain"]
    assert np.isclose(fields["volume"].sum(), width * height, rtol=1e-12)


@claim("the report shows the body of a run that leaves VTU files alone")
def _(folder):
    simulate("ladder/pressed_plate.toml", folder, "output.stages=[0]", 'output.format=["vtu"]')
    assert not (folder / "fields.h5").exists()
    page = (folder / "report.html").read_text()
    assert re.search(r'"picture":\s*{', page), page[-2000:]


if __name__ == "__main__":
    check_the_claim()
