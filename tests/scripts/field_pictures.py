"""What the tests of pictures of fields have in common."""

import h5py
from claims import plot, plots_module


def write(folder, frames, dim=2):
    """frames: [{"t": …, "place": …, field: …}…]"""
    folder.mkdir(exist_ok=True)
    with h5py.File(folder / "fields.h5", "w") as file:
        for number, frame in enumerate(frames):
            group = file.create_group(f"frame_{number:04d}")
            group.attrs.update({"t": frame["t"], "dim": dim})
            for name, values in frame.items():
                if name != "t":
                    group[name] = values
    return folder


def figure_of(folders, field=None, wanted=6, cuts=()):
    runs, field = plots_module("field_files").read_runs(folders, field, wanted)
    return plots_module("fields").figure_of(runs, field, plots_module("field_space").read_cuts(cuts))


def is_refused(words, *arguments):
    """Drawing fields ends with status 2, says these words in one line, and draws nothing."""
    result = plot("fields", *arguments)
    assert result.returncode == 2 and all(word in result.stderr for word in words), result
    assert result.stderr.count("\n") == 1, result.stderr
    assert not list(arguments[0].glob("*.png"))
