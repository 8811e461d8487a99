"""What the library raises beside Python's own exceptions."""

from __future__ import annotations

from typing import NamedTuple


class Problem(NamedTuple):
    """One thing that is wrong with a scene."""

    where: str  # the file, or the key of a dictionary: "support[0].at"
    line: int  # 1-based; 0: there is none
    column: int
    message: str  # what, and what was expected

    def __str__(self) -> str:
        place = f"{self.where}:{self.line}:{self.column}" if self.line else self.where
        return f"{place}: {self.message}"


class SceneError(ValueError):
    """All that is wrong with a scene, found at once; .problems has each."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = problems


class StateError(ValueError):
    """A checkpoint that cannot be gone on from, and why."""
