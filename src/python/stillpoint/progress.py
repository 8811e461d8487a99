"""A progress bar: in a notebook a bar that fills up, in a terminal a line."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Any, Union


def _notebook_display() -> Callable[[str], Any] | None:
    """Shows HTML in the cell that runs, and returns a handle with update(); None outside a notebook."""
    shell = sys.modules.get("IPython")
    if shell is None or getattr(shell.get_ipython(), "kernel", None) is None:
        return None
    from IPython.display import HTML, display  # type: ignore[import]

    class Handle:
        def __init__(self, text: str) -> None:
            self._handle = display(HTML(text), display_id=True)

        def update(self, text: str) -> None:
            self._handle.update(HTML(text))

    return Handle


class ProgressBar:
    """Called with what a simulation or a study tells while it works; close() ends the line."""

    def __init__(self) -> None:
        self._first_residual: float | None = None
        self._show = _notebook_display()
        self._handle: Any = None
        self._width = 0

    def share(self, told: dict[str, Any]) -> float | None:
        """Of the way done: of the runs, of the time to the end, or of the residual's fall on a logarithmic scale."""
        if "total" in told:
            return told["done"] / told["total"] if told["total"] else None
        residual, goal = told["residual"], told["residual_goal"]
        if goal <= 0:
            return min(told["t"] / told["end_time"], 1.0) if told["end_time"] > 0 else None
        if not residual > 0:
            return None
        first = self._first_residual = max(residual, self._first_residual or 0)
        return min(max(math.log(first / residual) / math.log(first / goal), 0.0), 0.99) if first > goal else None

    @staticmethod
    def _words(told: dict[str, Any]) -> str:
        if "total" in told:
            return f"{told['done']} of {told['total']} runs, {told['doing']}, {told['wall_s']:.0f} s"
        return f"t = {told['t']:.4g} s, {told['steps']} steps, residual {told['residual']:.1e}, {told['wall_s']:.0f} s"

    def __call__(self, told: dict[str, Any]) -> None:
        share, words = self.share(told), self._words(told)
        if self._show is None:
            line = words if share is None else f"{100 * share:3.0f} %  {words}"
            print("\r" + line.ljust(self._width), end="", file=sys.stderr, flush=True)
            self._width = len(line)
            return
        value = "" if share is None else f' value="{share:.3f}"'
        html = f'<progress max="1"{value} style="width: 20em"></progress> {words}'
        if self._handle is None:
            self._handle = self._show(html)
        else:
            self._handle.update(html)

    def close(self) -> None:
        """The bar stays as it is, and what is printed next begins on a line of its own."""
        if self._show is None and self._width:
            print(file=sys.stderr)
            self._width = 0


Told = Union[bool, None, Callable[[dict[str, Any]], Any]]


def telling(progress: Told) -> Callable[[dict[str, Any]], Any] | None:
    """Whom a simulation tells: nobody, a bar, or a callable."""
    if progress is None or isinstance(progress, bool):
        return ProgressBar() if progress else None
    return progress


def close(told: Callable[[dict[str, Any]], Any] | None) -> None:
    """Ends the line of a bar."""
    if isinstance(told, ProgressBar):
        told.close()
