"""What all pictures have in common: the look, and the figure."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO

import matplotlib  # type: ignore[import]
from matplotlib.backends.backend_agg import FigureCanvasAgg  # type: ignore[import]
from matplotlib.figure import Figure  # type: ignore[import]

COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]  # Okabe and Ito
STYLE = {"axes.spines.top": False, "axes.spines.right": False}


class Picture(Figure):  # type: ignore[misc]
    """A figure that is none of pyplot's: it needs no display and nobody has to close it. A notebook shows it."""

    def __init__(self, width: float, height: float, dpi: float) -> None:
        super().__init__(figsize=(width, height), dpi=dpi)
        FigureCanvasAgg(self)

    def _repr_png_(self) -> bytes:
        image = BytesIO()
        self.savefig(image, format="png")
        return image.getvalue()


@contextmanager
def drawing(
    figure: Figure | None, width: float, height: float, font_size: float = 10, dpi: float = 100
) -> Iterator[Figure]:
    """Where the caller's figure, which has to be empty, or a new one is drawn on: width × height inches, in our look,
    which is that of no other picture of the program."""
    with matplotlib.rc_context({**STYLE, "font.size": font_size}):
        if figure is None:
            figure = Picture(width, height, dpi)
        else:
            figure.set_size_inches(width, height)
        yield figure
        for axis in figure.axes:  # ticks that are made only when the picture is shown or saved have it as well
            axis.tick_params(which="both", labelsize=font_size)


def plain(text: str) -> str:
    """Text of a file as it stands: no formula for matplotlib to set, but π by its letter."""
    return re.sub(r"\bpi\b", "π", text).replace("$", r"\$")
