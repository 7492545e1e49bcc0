"""Paths to values in a scene, such as ``light.lamp.position``."""

from __future__ import annotations

import bisect
import dataclasses
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ._convert import Converter, Invalid
from ._part import Part, converters
from .errors import ArgumentError, Problem, SceneError
from .lights import Light
from .materials import Material
from .shapes import KINDS, Shape

if TYPE_CHECKING:
    from .scene import Scene


WINDOW = ("projection", "screen", "intrinsics", "field_of_view", "window", "longitude", "latitude")
"""The fields of a camera that say where on the screen its pixels are."""


Place = tuple[str | int, ...]
"""Keys of a scene file: of a value on top, of an item by its table and number, of a material by its name."""


@dataclasses.dataclass(frozen=True)
class Pointer:
    """The location of a value in a scene's dictionary, and how it is converted."""

    path: str
    keys: Place
    convert: Converter
    part: Part | None = None
    """The item, the material or the table on top that the value is in; ``None`` for a value on top."""
    name: str | None = None
    """Of a whole light or shape, which keeps its name unless it is given another."""

    @property
    def place(self) -> Place:
        """The place of the part that the value is in."""
        return self.keys[: 2 if self.keys[0] in TABLES or self.keys[0] == "material" else 1]

    @property
    def moves_pixels(self) -> bool:
        """Whether the positions of pixels on the screen, or their unit, depend on the value."""
        return self.keys[0] == "length" or (self.keys[0] == "camera" and self.keys[1] in WINDOW)

    def put(self, written: Any, value: Any) -> Any:
        """What is written for the part after the value is set there; ``None`` removes it."""
        inner = self.keys[len(self.place) :]
        if value is None and not inner and self.keys[0] in TABLES:
            raise ArgumentError(f"{self.path!r} is None; allowed: a part; replace(lights=…, shapes=…) leaves some out")
        if inner and written is None:
            raise ArgumentError(f"{self.path!r}: what it is in is None by then")
        converted = None if value is None else self._converted(value)
        if not inner:
            return converted
        container = written
        for key in inner[:-1]:
            container = container[key]
        if converted is None:
            container.pop(inner[-1], None)
        else:
            container[inner[-1]] = converted
        return written

    def _converted(self, value: Any) -> Any:
        try:
            converted = self.convert(value)
        except Invalid as invalid:
            problem = Problem("wrong-type", self.path, f"`{self.path}` {invalid.message}", invalid.allowed)
            raise SceneError(str(problem), [problem]) from None
        if self.name is not None and converted.name is None:
            converted = converted.replace(name=self.name)
        return converted.to_dict() if isinstance(converted, Part) else converted


def rewritten(changes: Iterable[tuple[Pointer, Any]]) -> dict[Place, Any]:
    """What is written for each part after these values are set; ``None`` where nothing is left of it."""
    parts: dict[Place, Any] = {}
    for pointer, value in changes:
        if pointer.place not in parts:
            parts[pointer.place] = None if pointer.part is None else pointer.part.to_dict()
        parts[pointer.place] = pointer.put(parts[pointer.place], value)
    return parts


def locate(scene: Scene, path: str) -> Pointer:
    """The location that a path refers to in a scene."""
    match = re.fullmatch(r"(?P<table>\w+)(?:\[(?P<index>\d+)\])?(?:\.(?P<rest>.+))?", path, re.DOTALL)
    if match is None:
        example = "such as light.lamp.position, material.clay.shininess, camera.eye"
        raise ArgumentError(f"{path!r} is no path; allowed: {example}")
    table, index, rest = match["table"], match["index"], match["rest"]
    if table in _WHOLE and rest is None and index is None:
        return Pointer(path, (table,), converters(type(scene))[table])
    if table in _PARTS and rest is not None and index is None:
        part = getattr(scene, table)
        if part is None:
            raise ArgumentError(f"{path!r}: the scene has no {table}")
        return _within(part, (table,), rest.split("."), path, part)
    if table == "material" and rest is not None and index is None and rest in scene.materials:
        return Pointer(path, (table, rest), _part_of(Material), scene.materials[rest])
    if table == "material" and rest is not None and "." in rest:
        name, key = rest.rsplit(".", 1)
        if name not in scene.materials:
            raise ArgumentError(f"{path!r}: the scene has no material {name!r}; there are: {', '.join(scene.materials)}")
        return _within(scene.materials[name], ("material", name), [key], path, scene.materials[name])
    if table in TABLES and (rest is not None or index is not None):
        field, kind = TABLES[table]
        items: Sequence[Any] = getattr(scene, field)
        number, keys = _find(scene, field, table, kind, index, rest, path)
        item = items[number]
        if isinstance(item, Shape):
            table = item.KEY
            number -= first_of(type(item), items)
        if not keys:
            whole = Light if isinstance(item, Light) else type(item)
            return Pointer(path, (table, number), _part_of(whole), item, item.name)
        return _within(item, (table, number), keys, path, item)
    parts, tables = (f"{name}.…" for name in _PARTS), (f"{name}.NAME.…" for name in ("material", *TABLES))
    raise ArgumentError(f"{path!r} leads nowhere; allowed: {', '.join((*_WHOLE, *parts, *tables))}")


_WHOLE = (
    "title",
    "convention",
    "handedness",
    "quantities",
    "color_space",
    "shadows",
    "length",
    "ambient",
    "sampling",
    "camera",
)
_PARTS = ("camera", "sampling", "ambient")
TABLES: Mapping[str, tuple[str, type[Part]]] = {
    "light": ("lights", Light),
    "probe": ("probes", Part),
    "area": ("areas", Part),
    "grid": ("grids", Part),
    "shape": ("shapes", Shape),
    **{kind.KEY: ("shapes", kind) for kind in KINDS},
}
"""The lists of a scene file, and ``shape`` for all shapes: the field of a scene that holds their parts, and which of the parts
there are theirs."""


def _find(
    scene: Scene, field: str, table: str, kind: type[Part], index: str | None, rest: str | None, path: str
) -> tuple[int, list[str]]:
    """The index of an item in its field, and the part of the path after its name or index."""
    items = getattr(scene, field)
    if index is not None:
        of_kind = of_kinds(kind, items)
        if int(index) >= len(of_kind):
            raise ArgumentError(f"{path!r}: the scene has {len(of_kind)} {table}, counted from 0")
        return of_kind[int(index)], rest.split(".") if rest else []
    assert rest is not None
    # Names may contain dots, and one name may be a prefix of another: the longest comes first.
    for number, name in scene.core.named(field, rest):
        if isinstance(items[number], kind):
            return number, rest[len(name) + 1 :].split(".") if len(rest) > len(name) else []
    of_kind, names = of_kinds(kind, items), scene.core.describe()[field]
    there_are = ", ".join(names[number] for number in of_kind[:20]) or "none"
    raise ArgumentError(f"{path!r}: the scene has no such {table}; there are: {there_are}")


def first_of(kind: type[Part], items: Sequence[Any]) -> int:
    """The number of the first shape of a kind, among shapes in the order of kinds; of a list of one kind, 0."""
    return bisect.bisect_left(items, KINDS.index(kind), key=lambda item: KINDS.index(type(item))) if kind in KINDS else 0


def of_kinds(kind: type[Part], items: Sequence[Any]) -> range:
    """The numbers of the items of a kind, which follow each other."""
    if kind not in KINDS:
        return range(len(items))
    after = bisect.bisect_right(items, KINDS.index(kind), key=lambda item: KINDS.index(type(item)))
    return range(first_of(kind, items), after)


def _part_of(kind: type[Part]) -> Converter:
    """Converts to a part that must be of this kind already."""

    def convert(value: Any) -> Part:
        if isinstance(value, kind):
            return value
        raise Invalid(f"is {value!r}", f"allowed: a {kind.__name__}")

    return convert


def _within(part: Part, keys: Place, names: list[str], path: str, whole: Part) -> Pointer:
    name, *rest = names
    fields = [field.name for field in dataclasses.fields(part)]
    if name not in fields:
        raise ArgumentError(f"{path!r}: a {type(part).__name__} has no {name!r}; it has {', '.join(fields)}")
    here = (*keys, part.key_of(name))
    if not rest:
        return Pointer(path, here, converters(type(part))[name], whole)
    inner = getattr(part, name)
    if not isinstance(inner, Part):
        raise ArgumentError(f"{path!r}: {name!r} has nothing in it to change")
    return _within(inner, here, rest, path, whole)
