#!/usr/bin/python3
"""fields_test.py ROOT CLAIM PROGRAM: one claim about the fields.h5 and fields.xdmf that PROGRAM (write_fields) leaves."""

import sys
from xml.etree import ElementTree

import h5py
import numpy as np
from claims import call, check_the_claim, claim

POINTS = [5, 40000, 5]  # of the frames of `write_fields plane`
COMPONENTS = {"u": 2, "v": 2, "stress": 4, "plastic_strain": 1, "n": 3}
TENSOR = ["stress_xx", "stress_yy", "stress_zz", "stress_xy"]
TENSOR_IN_SPACE = [*TENSOR, "stress_yz", "stress_zx"]
VECTORS, SCALARS = ["u", "v", "n"], [*TENSOR, "plastic_strain", "material"]


def write(what, folder):
    result = call(sys.argv[3], what, folder)
    assert result.returncode == (1 if what == "killed" else 0) and not result.stderr, result
    return folder / "fields.h5"


def known(frame, seed, points, components):
    """(points × components), by the rule of write_fields.cpp."""
    return ((1 + np.arange(points * components) + 100 * seed + 10 * frame) / 7).reshape(points, components)


def padded(values):
    return np.pad(values, ((0, 0), (0, 3 - values.shape[1])))


def same(dataset, values):
    return dataset.dtype == values.dtype and dataset.shape == values.shape and dataset[()].tobytes() == values.tobytes()


def check_plane(file):
    with h5py.File(file) as fields:
        assert sorted(fields) == ["frame_0000", "frame_0001", "frame_0002", "vertex"]
        for k, points in enumerate(POINTS):
            frame = fields[f"frame_{k:04d}"]
            assert (frame.attrs["t"], frame.attrs["dim"]) == (k / 3, 2)
            assert set(frame) == {"place", *VECTORS, *SCALARS}
            assert same(frame["place"], padded(known(k, 0, points, 2)))
            for seed, (name, components) in enumerate(COMPONENTS.items(), start=1):
                values = known(k, seed, points, components)
                if components == 4:
                    assert all(same(frame[part], values[:, j].copy()) for j, part in enumerate(TENSOR))
                else:
                    assert same(frame[name], padded(values) if components > 1 else values[:, 0]), name
            assert same(frame["material"], (np.arange(points) % 3 - 1).astype("<i4"))
            assert same(fields[f"vertex/{points}"], np.arange(points, dtype="<i4"))


@claim("fields.h5 holds every number to the bit")
def _(folder):
    check_plane(write("plane", folder))


@claim("fields.h5 is compressed in chunks, and holds no times of day")
def _(folder):
    with h5py.File(write("plane", folder)) as fields:
        for dataset in fields["frame_0001"].values():
            assert dataset.chunks[0] == 16384 and dataset.shuffle, dataset
            assert (dataset.compression, dataset.compression_opts) == ("gzip", 1), dataset
            assert h5py.h5g.get_objinfo(dataset.id).mtime == 0


@claim("fields of a bar keep their names, and stand on the axis x")
def _(folder):
    with h5py.File(write("bar", folder)) as fields:
        frame = fields["frame_0000"]
        assert frame.attrs["dim"] == 1 and set(frame) == {"place", "u", "v", "stress"}
        assert same(frame["place"], padded(known(0, 0, 4, 1)))
        assert same(frame["stress"], known(0, 3, 4, 1)[:, 0])


@claim("a body in space has vectors of three components and the six of its stress by their names")
def _(folder):
    with h5py.File(write("space", folder)) as fields:
        frame = fields["frame_0000"]
        assert frame.attrs["dim"] == 3 and set(frame) == {"place", "u", "v", "plastic_strain", *TENSOR_IN_SPACE}
        for seed, name in enumerate(["place", "u", "v"]):
            assert same(frame[name], known(0, seed, 60, 3)), name
        stress = known(0, 3, 60, 6)
        assert all(same(frame[name], stress[:, k].copy()) for k, name in enumerate(TENSOR_IN_SPACE))


@claim("a killed process leaves the frames that it wrote, a file each")
def _(folder):
    write("killed", folder)
    assert not (folder / "fields.h5").exists()
    parts = sorted((folder / "fields.partial").glob("*.h5"))
    assert [part.stem for part in parts] == ["frame_0000", "frame_0001", "frame_0002"], parts
    with h5py.File(folder / "joined.h5", "w") as joined:
        for part in parts:
            with h5py.File(part) as fields:
                fields.copy(fields[part.stem], joined)
                for points in fields["vertex"]:
                    if f"vertex/{points}" not in joined:
                        fields.copy(fields["vertex"][points], joined.require_group("vertex"))
    check_plane(folder / "joined.h5")


@claim("what HDF5 has to say is in the exception alone")
def _(folder):
    (folder / "fields.h5.partial").mkdir()
    result = call(sys.argv[3], "plane", folder)
    assert "Is a directory" in result.stderr and result.stderr.count("\n") == 1, result


def check_item(item, folder):
    """A <DataItem> refers to a dataset that exists, with its shape and type of numbers; returns the dataset's name."""
    file, name = item.text.split(":")
    with h5py.File(folder / file) as fields:
        dataset = fields[name]
        assert item.get("Format") == "HDF" and item.get("Dimensions") == " ".join(map(str, dataset.shape)), name
        kind = {"f": "Float", "i": "Int"}[dataset.dtype.kind]
        assert (item.get("NumberType"), item.get("Precision")) == (kind, str(dataset.dtype.itemsize)), name
    return name


@claim("fields.xdmf names each dataset of fields.h5 once, with its shape and type of numbers")
def _(folder):
    in_space = ("space", ["u", "v"], [*TENSOR_IN_SPACE, "plastic_strain"], 1)
    for what, vectors, scalars, frames in (("plane", VECTORS, SCALARS, 3), ("bar", [], ["u", "v", "stress"], 1), in_space):
        write(what, folder)
        grids = ElementTree.parse(folder / "fields.xdmf").findall("Domain/Grid/Grid")
        assert len(grids) == frames
        for k, grid in enumerate(grids):
            group = f"/frame_{k:04d}"
            points = grid.find("Topology").get("NumberOfElements")
            assert grid.find("Topology").get("TopologyType") == "Polyvertex"
            assert check_item(grid.find("Topology/DataItem"), folder) == f"/vertex/{points}"
            assert grid.find("Geometry").get("GeometryType") == "XYZ"
            assert check_item(grid.find("Geometry/DataItem"), folder) == f"{group}/place"
            types = {item.get("Name"): item.get("AttributeType") for item in grid.findall("Attribute")}
            assert types == {name: "Vector" for name in vectors} | {name: "Scalar" for name in scalars}
            for attribute in grid.findall("Attribute"):
                assert attribute.get("Center") == "Node"
                assert check_item(attribute.find("DataItem"), folder) == f"{group}/{attribute.get('Name')}"


@claim("the times of fields.xdmf are those of fields.h5 to the bit")
def _(folder):
    write("plane", folder)
    collection = ElementTree.parse(folder / "fields.xdmf").find("Domain/Grid")
    assert (collection.get("GridType"), collection.get("CollectionType")) == ("Collection", "Temporal")
    assert [float(time.get("Value")) for time in collection.findall("Grid/Time")] == [0, 1 / 3, 2 / 3]


if __name__ == "__main__":
    check_the_claim()
