"""Converts user input to what scenes hold: floats, tuples of floats, strings. Arrays become tuples, so that parts of
scenes never change and can be compared."""

from __future__ import annotations

import math
import operator
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from typing import Annotated, Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Converter = Callable[[Any], Any]
Key = TypeVar("Key")
Value = TypeVar("Value")


class FrozenDict(Mapping[Key, Value]):
    """A dictionary that never changes. (A ``MappingProxyType`` is neither copied nor pickled.)"""

    __slots__ = ("_held",)

    def __init__(self, held: Mapping[Key, Value] | Iterable[tuple[Key, Value]] = ()) -> None:
        self._held = dict(held)

    def __getitem__(self, key: Key) -> Value:
        return self._held[key]

    def __iter__(self) -> Iterator[Key]:
        return iter(self._held)

    def __len__(self) -> int:
        return len(self._held)

    def __repr__(self) -> str:
        return repr(self._held)

    def _ipython_key_completions_(self) -> list[Key]:
        return list(self._held)


class Invalid(Exception):
    """A value of the wrong type, or not finite: what is wrong, and what is allowed."""

    def __init__(self, message: str, allowed: str) -> None:
        super().__init__(message)
        self.message = message
        self.allowed = allowed


def number(value: Any) -> float:
    """A finite number."""
    if isinstance(value, (bool, np.bool_, str, bytes)):
        raise Invalid(f"is {value!r}", "allowed: a number")
    try:
        converted = float(value)
    except (TypeError, ValueError):
        raise Invalid(f"is {value!r}", "allowed: a number") from None
    except OverflowError:
        raise Invalid("is too large", "allowed: numbers that a double holds") from None
    if not math.isfinite(converted):
        raise Invalid(f"is {converted}", "allowed: finite numbers")
    return converted


def whole(value: Any) -> int:
    """An integer."""
    if isinstance(value, (bool, np.bool_)):
        raise Invalid(f"is {value!r}", "allowed: a whole number")
    try:
        return operator.index(value)
    except TypeError:
        raise Invalid(f"is {value!r}", "allowed: a whole number") from None


def _several(value: Any, count: int, convert: Converter, what: str) -> tuple[Any, ...]:
    if isinstance(value, (str, bytes, dict)) or not isinstance(value, (Iterable, np.ndarray)):
        raise Invalid(f"is {value!r}", f"allowed: {what}")
    if isinstance(value, np.ndarray) and value.shape != (count,):
        raise Invalid(f"has the shape {value.shape}", f"allowed: {what}")
    items = tuple(value)
    if len(items) != count:
        raise Invalid(f"has {len(items)} numbers", f"allowed: {what}")
    return tuple(convert(item) for item in items)


def vector(value: Any) -> tuple[float, ...]:
    """Three finite numbers."""
    return _several(value, 3, number, "three numbers (x, y, z)")


def pair(value: Any) -> tuple[float, ...]:
    """Two finite numbers."""
    return _several(value, 2, number, "two numbers")


def size(value: Any) -> tuple[int, ...]:
    """Two integers."""
    return _several(value, 2, whole, "two whole numbers (columns, rows)")


def matrix(value: Any) -> tuple[tuple[float, ...], ...]:
    """Three rows of three finite numbers."""
    return _several(value if not isinstance(value, np.ndarray) else value.tolist(), 3, vector, "three rows of three numbers")


def _rows(value: Any, is_allowed: str, what: str) -> NDArray[Any]:
    try:
        array = np.asarray(value)
    except ValueError:
        raise Invalid("is no array", f"allowed: {what}") from None
    if array.dtype.kind not in is_allowed or array.ndim != 2 or array.shape[1] != 3 or len(array) == 0:
        raise Invalid(f"is of {array.dtype} with the shape {array.shape}", f"allowed: {what}")
    return array


def vectors(value: Any) -> tuple[tuple[float, ...], ...]:
    """Rows of three finite numbers."""
    array = _rows(value, "iuf", "n × 3 numbers").astype(np.float64)
    wrong = np.flatnonzero(~np.isfinite(array).all(axis=1))
    if wrong.size:
        raise Invalid(f"has {array[wrong[0]].tolist()} in row {wrong[0]}", "allowed: finite numbers")
    return tuple(map(tuple, array.tolist()))


def triples(value: Any) -> tuple[tuple[int, ...], ...]:
    """Rows of three indices."""
    array = _rows(value, "iu", "n × 3 whole numbers")
    return tuple(map(tuple, array.tolist()))


def amount(value: Any) -> float | tuple[float, ...]:
    """A number, or three of them."""
    if isinstance(value, (list, tuple, np.ndarray)) and not (isinstance(value, np.ndarray) and value.ndim == 0):
        return _several(value, 3, number, "a number, or three of them (red, green, blue)")
    return number(value)


def word(value: Any) -> str:
    """A string; whether it is one of the allowed ones is checked with the scene."""
    if not isinstance(value, str):
        raise Invalid(f"is {value!r}", "allowed: a text")
    return str(value.value) if isinstance(value, Enum) else str(value)


def file(value: Any) -> str:
    """The path of a file."""
    if not isinstance(value, (str, os.PathLike)):
        raise Invalid(f"is {value!r}", "allowed: the path of a file")
    return str(os.fspath(value))


def material_name(value: Any) -> str:
    """The name of a material."""
    if not isinstance(value, str):
        raise Invalid(f"is {value!r}", "allowed: the name of a material, which is in the scene's materials")
    return word(value)


def flag(value: Any) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise Invalid(f"is {value!r}", "allowed: True, False")
    return bool(value)


# The declared types of part fields: the type, and the function that converts user input to it.
Number = Annotated[float, number]
Whole = Annotated[int, whole]
Word = Annotated[str, word]
File = Annotated[str | os.PathLike[str], file]
MaterialName = Annotated[str, material_name]
Flag = Annotated[bool, flag]
# Arrays and lists are accepted, and stored as tuples.
Vector = Annotated[tuple[float, float, float] | list[float] | NDArray[Any], vector]
Matrix = Annotated[Sequence[Sequence[float]] | NDArray[Any], matrix]
Vectors = Annotated[Sequence[Sequence[float]] | NDArray[Any], vectors]
Triples = Annotated[Sequence[Sequence[int]] | NDArray[Any], triples]
Pair = Annotated[tuple[float, float] | list[float] | NDArray[Any], pair]
Size = Annotated[tuple[int, int] | list[int] | NDArray[Any], size]
Amount = Annotated[float | tuple[float, float, float] | list[float] | NDArray[Any], amount]
