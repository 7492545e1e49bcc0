"""The base class of all parts of a scene."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, TypeVar

from ._convert import Converter, Invalid
from .errors import ArgumentError, Problem, SceneError

PartType = TypeVar("PartType", bound="Part")


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Part:
    """A part of a scene. It is immutable; :meth:`replace` returns a modified copy."""

    _FIXED: ClassVar[Mapping[str, Any]] = MappingProxyType({})
    """Keys that have the same value in the scene file for every such part."""
    _KEYS: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Scene file keys of fields that are named differently."""

    def __post_init__(self) -> None:
        problems = []
        convert = converters(type(self))
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is None and field.default is None:
                continue
            try:
                object.__setattr__(self, field.name, convert[field.name](value))
            except Invalid as invalid:
                path = f"{type(self).__name__}.{field.name}"
                problems.append(Problem("wrong-type", path, f"`{path}` {invalid.message}", invalid.allowed))
        if problems:
            raise SceneError("\n".join(str(problem) for problem in problems), problems)

    def replace(self: PartType, **changes: Any) -> PartType:
        """A copy with some values changed."""
        return dataclasses.replace(self, **changes)

    def to_dict(self) -> dict[str, Any]:
        """The part as in a scene file, without default values."""
        written = dict(self._FIXED)
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is None or (field.default is not dataclasses.MISSING and value == field.default):
                continue
            if isinstance(value, Part):
                value = value.to_dict()
            elif isinstance(value, tuple):
                value = list(value)
            written[self.key_of(field.name)] = value
        return written

    @classmethod
    def key_of(cls, field: str) -> str:
        """The scene file key of a field."""
        return cls._KEYS.get(field, field)

    @classmethod
    def from_dict(cls: type[PartType], written: Mapping[str, Any]) -> PartType:
        """The part described by this table of a scene file."""
        names = {key: name for name, key in cls._KEYS.items()}
        for key, fixed in cls._FIXED.items():
            if written.get(key, fixed) != fixed:
                raise _wrong(cls, Invalid(f"has {key} {written[key]!r}", f"allowed: {fixed!r}"))
        fields = {names.get(key, key): value for key, value in written.items() if key not in cls._FIXED}
        known = [field.name for field in dataclasses.fields(cls)]
        for name in fields:
            if name not in known:
                raise _wrong(cls, Invalid(f"has no {name!r}", f"allowed: {', '.join(known)}"))
        return cls(**fields)

    def _values(self) -> tuple[Any, ...]:
        return tuple(getattr(self, field.name) for field in dataclasses.fields(self))

    # Defined once for all parts: a dataclass would compile them for every class.
    def __eq__(self, other: object) -> bool:
        return self._values() == other._values() if isinstance(other, Part) and type(other) is type(self) else NotImplemented

    def __hash__(self) -> int:
        return hash((type(self), self._values()))

    def __repr__(self) -> str:
        given = (
            f"{field.name}={shown(getattr(self, field.name))}"
            for field in dataclasses.fields(self)
            if field.default is dataclasses.MISSING or getattr(self, field.name) != field.default
        )
        return f"{type(self).__name__}({', '.join(given)})"


def shown(value: Any) -> str:
    """A value as code, except arrays of a mesh, which may have millions of rows."""
    is_rows = isinstance(value, tuple) and len(value) > 3
    return f"<{len(value)} × 3>" if is_rows else repr(value)


def _wrong(part: type[Part], invalid: Invalid) -> SceneError:
    problem = Problem("wrong-type", part.__name__, f"`{part.__name__}` {invalid.message}", invalid.allowed)
    return SceneError(str(problem), [problem])


def of_argument(convert: Converter, value: Any, name: str) -> Any:
    """The value of an argument, converted as fields of parts are."""
    try:
        return convert(value)
    except Invalid as invalid:
        raise ArgumentError(f"{name} {invalid.message}; {invalid.allowed}") from None


_KNOWN: dict[type[Part], dict[str, Converter]] = {}


def converters(part: type[Part]) -> dict[str, Converter]:
    """The converter of each field, by its declared type."""
    if part not in _KNOWN:
        hints = typing.get_type_hints(part, include_extras=True)
        _KNOWN[part] = {field.name: _converter(hints[field.name]) for field in dataclasses.fields(part)}
    return _KNOWN[part]


def _converter(hint: Any) -> Converter:
    for one in (hint, *typing.get_args(hint)):
        if typing.get_origin(one) is Annotated:
            converter: Converter = one.__metadata__[0]
            return converter
        if isinstance(one, type) and issubclass(one, Part):
            return _nested(one)
    raise TypeError(f"no field can be a {hint}")


def _nested(kind: type[Part]) -> Converter:
    """Converts a part within another one, which may be given as its dictionary."""

    def convert(value: Any) -> Part:
        if isinstance(value, kind):
            return value
        if isinstance(value, Mapping):
            return kind.from_dict(value)
        raise Invalid(f"is {value!r}", f"allowed: a {kind.__name__}")

    return convert
