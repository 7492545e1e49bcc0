"""What can go wrong, as one family: every exception of the package is an :class:`Error`.

A file that cannot be read or written is an :class:`OSError`, as everywhere in Python.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

__all__ = [
    "ArgumentError",
    "Error",
    "InternalError",
    "Place",
    "ProbeError",
    "Problem",
    "RenderError",
    "SceneError",
    "SceneWarning",
    "StoreError",
]


@dataclass(frozen=True)
class Place:
    """A place in a scene file: line and column from 1, and the text of the line."""

    line: int
    column: int
    text: str


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong with a scene.

    ``kind`` is ``"unreadable"``, ``"syntax"``, ``"unknown-key"``, ``"missing-key"``, ``"wrong-type"``, ``"value"`` or
    ``"warning"``; ``path`` names the thing concerned, such as ``sphere[0].radius``; ``help`` says what is allowed.
    """

    kind: str
    path: str
    message: str
    help: str | None = None
    place: Place | None = None

    def __post_init__(self) -> None:
        if isinstance(self.place, tuple):
            object.__setattr__(self, "place", Place(*self.place))

    @property
    def line(self) -> int | None:
        """The line in the scene file, from 1; none where the scene was no text."""
        return None if self.place is None else self.place.line

    def __str__(self) -> str:
        return self.message if self.help is None else f"{self.message}; {self.help}"


class Error(Exception):
    """What all exceptions of the package are."""


class SceneError(Error, ValueError):
    """A scene that is not valid. ``problems`` has everything that is wrong with it."""

    problems: tuple[Problem, ...]

    def __init__(self, report: str, problems: Sequence[Problem] = ()) -> None:
        super().__init__(report)
        self.problems = tuple(problems)

    def __reduce__(self) -> tuple[type[SceneError], tuple[str, tuple[Problem, ...]]]:
        return type(self), (str(self), self.problems)


class ArgumentError(Error, ValueError):
    """An argument that makes no sense, or not for this scene."""


class ProbeError(Error, ValueError):
    """Points at which there is no value. ``indices`` has their places among the points that were asked for."""

    indices: tuple[int, ...]

    def __init__(self, message: str, indices: Sequence[int] = ()) -> None:
        super().__init__(message)
        self.indices = tuple(indices)

    def __reduce__(self) -> tuple[type[ProbeError], tuple[str, tuple[int, ...]]]:
        return type(self), (str(self), self.indices)


class RenderError(Error, RuntimeError):
    """A map that could not be computed."""


class StoreError(Error, RuntimeError):
    """A store that holds something else, is incomplete or damaged, or is being written."""


class InternalError(RenderError):
    """A fault of this program."""


class SceneWarning(UserWarning):
    """What is allowed in a scene but deserves a word."""
