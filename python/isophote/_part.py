"""What all parts of a scene have in common."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, ClassVar, TypeVar

from ._convert import Converter, Invalid
from .errors import Problem, SceneError

PartType = TypeVar("PartType", bound="Part")


def required(convert: Converter, key: str | None = None) -> Any:
    """A field that must be given; ``key`` is its name in scene files, if it has another one there."""
    return dataclasses.field(metadata={"convert": convert, "key": key})


def optional(convert: Converter, default: Any = None) -> Any:
    """A field that may be left out; one without a default is then left out of the scene too."""
    return dataclasses.field(default=default, metadata={"convert": convert})


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class Part:
    """A part of a scene. It never changes; :meth:`replace` gives another one."""

    _FIXED: ClassVar[Mapping[str, Any]] = {}
    """What the scene file says of every such part."""

    def __post_init__(self) -> None:
        problems = []
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            convert = field.metadata.get("convert")
            if convert is None or (value is None and field.default is None):
                continue
            try:
                object.__setattr__(self, field.name, convert(value))
            except Invalid as invalid:
                path = f"{type(self).__name__}.{field.name}"
                problems.append(Problem("wrong-type", path, f"`{path}` {invalid.message}", invalid.allowed))
        if problems:
            raise SceneError("\n".join(str(problem) for problem in problems), problems)

    def replace(self: PartType, **changes: Any) -> PartType:
        """The same with other values."""
        return dataclasses.replace(self, **changes)

    def to_dict(self) -> dict[str, Any]:
        """What a scene file says of it, without what is so by default."""
        written = dict(self._FIXED)
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if value is None or (field.default is not dataclasses.MISSING and value == field.default):
                continue
            if isinstance(value, Part):
                value = value.to_dict()
            elif isinstance(value, tuple):
                value = list(value)
            written[_key(field)] = value
        return written

    @classmethod
    def from_dict(cls: type[PartType], written: Mapping[str, Any]) -> PartType:
        """The part of which a scene file says this."""
        names = {_key(field): field.name for field in dataclasses.fields(cls)}
        return cls(**{names.get(key, key): value for key, value in written.items() if key not in cls._FIXED})

    def __repr__(self) -> str:
        given = (
            f"{field.name}={getattr(self, field.name)!r}"
            for field in dataclasses.fields(self)
            if field.default is dataclasses.MISSING or getattr(self, field.name) != field.default
        )
        return f"{type(self).__name__}({', '.join(given)})"


def _key(field: dataclasses.Field[Any]) -> str:
    return field.metadata.get("key") or field.name


def nested(kind: type[Part]) -> Converter:
    """A part within another one, which may be given as its dictionary."""

    def convert(value: Any) -> Part:
        if isinstance(value, kind):
            return value
        if isinstance(value, Mapping):
            return kind.from_dict(value)
        raise Invalid(f"is {value!r}", f"allowed: a {kind.__name__}")

    return convert
