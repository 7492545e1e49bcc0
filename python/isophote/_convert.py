"""Converts user input to what scenes hold: floats, tuples of floats, strings. Arrays become tuples, so that parts of
scenes never change and can be compared."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Iterator, Mapping
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


def amount(value: Any) -> float | tuple[float, ...]:
    """A number, or three of them."""
    if isinstance(value, (list, tuple, np.ndarray)) and not (isinstance(value, np.ndarray) and value.ndim == 0):
        return _several(value, 3, number, "a number, or three of them (red, green, blue)")
    return number(value)


def word(value: Any) -> str:
    """A string; whether it is one of the allowed ones is checked with the scene."""
    if not isinstance(value, str):
        raise Invalid(f"is {value!r}", "allowed: a text")
    return str(value.value) if hasattr(value, "value") else str(value)


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
MaterialName = Annotated[str, material_name]
Flag = Annotated[bool, flag]
# Arrays and lists are accepted, and stored as tuples.
Vector = Annotated[tuple[float, float, float] | list[float] | NDArray[Any], vector]
Pair = Annotated[tuple[float, float] | list[float] | NDArray[Any], pair]
Size = Annotated[tuple[int, int] | list[int] | NDArray[Any], size]
Amount = Annotated[float | tuple[float, float, float] | list[float] | NDArray[Any], amount]
