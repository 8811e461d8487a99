"""What the library raises beside Python's own exceptions."""

from __future__ import annotations

import re
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


def _by_key(problem: Problem) -> Problem:
    """What is wrong with an override, told by its key as with a dictionary. The library tells it by the command's options."""
    option, _, setting = problem.where.partition(" ")
    if option == "--vary":
        return problem._replace(where=f"vary {setting}")
    if option != "--set":
        return problem
    key, message = setting.partition("=")[0], problem.message.replace("--set", "an override")
    told = re.match(rf"({re.escape(key)}[^\s:]*): ", message)  # or of what is in it: probe[0].at
    where = told[1] if told else key
    return problem._replace(where=where, message=message[told.end() :] if told else message)


class SceneError(ValueError):
    """All that is wrong with a scene, found at once; .problems has each."""

    problems: tuple[Problem, ...]

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        self.problems = tuple(map(_by_key, problems))
        super().__init__("\n".join(map(str, self.problems)))

    def __reduce__(self) -> tuple[type[SceneError], tuple[tuple[Problem, ...]]]:
        return type(self), (self.problems,)


class StateError(ValueError):
    """A checkpoint that cannot be gone on from, and why."""

    def __init__(self, message: str) -> None:
        super().__init__(message.replace("without --set", "without overrides").replace(" --set ", " "))
