"""The exceptions of the package, all of which are subclasses of :class:`Error`.

A file that cannot be read or written raises an :class:`OSError`, as everywhere in Python.
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
    """A position in a scene file.

    - ``line``, ``column``: counted from 1, columns in characters
    - ``text``: the line's text
    """

    line: int
    column: int
    text: str


@dataclass(frozen=True)
class Problem:
    """A single problem in a scene.

    - ``kind``: ``"unreadable"``, ``"syntax"``, ``"unknown-key"``, ``"missing-key"``, ``"wrong-type"``, ``"value"`` or
      ``"warning"``
    - ``path``: the item concerned, such as ``sphere[0].radius``
    - ``message``: what is wrong, with the value
    - ``help``: what is allowed
    - ``place``: where it stands in a file, if it was read from one
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
        """The line in the scene file, counted from 1; ``None`` if the scene was not text."""
        return None if self.place is None else self.place.line

    def __str__(self) -> str:
        return self.message if self.help is None else f"{self.message}; {self.help}"


class Error(Exception):
    """The base class of all exceptions of the package."""


class SceneError(Error, ValueError):
    """An invalid scene. ``problems`` lists everything that is wrong with it."""

    problems: tuple[Problem, ...]

    def __init__(self, report: str, problems: Sequence[Problem] = ()) -> None:
        super().__init__(report)
        self.problems = tuple(problems)

    def __reduce__(self) -> tuple[type[SceneError], tuple[str, tuple[Problem, ...]]]:
        return type(self), (str(self), self.problems)


class ArgumentError(Error, ValueError):
    """An argument that is invalid, in general or for this scene."""


class ProbeError(Error, ValueError):
    """Points that have no value. ``indices`` holds their indices among the requested points."""

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
    """A bug in this program."""


class SceneWarning(UserWarning):
    """Something that is allowed in a scene but worth a warning."""
