"""Scenes."""

from __future__ import annotations

import dataclasses
import json
import os
import sys
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Any

import numpy as np

from . import _isophote
from ._convert import Flag, FrozenDict, Invalid, Number, Pair, Size, Vector, Word, word
from ._part import Part, converters
from ._paths import TABLES, Place, first_of, locate, rewritten
from ._types import ColorSpace, ConventionName, Handedness, LengthUnit, Quantities, Side
from ._words import Named
from .camera import Camera, Sampling
from .errors import ArgumentError, Problem, SceneError, SceneWarning
from .lights import Ambient, AnyLight, Light, light_from_dict
from .materials import Material
from .shapes import KINDS, AnyShape, Mesh, Shape, Spheres

__all__ = ["Area", "Grid", "Probe", "Scene"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Probe(Part):
    """A point on a surface whose values are reported.

    - ``at``: the point, in the scene's unit, each coordinate within ±1e15 m
    - ``name``: unique among the probes
    - ``published``: a value that has been published for it, in the unit of the brightness, any finite number
    """

    at: Vector
    name: Word | None = None
    published: Number | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Area(Part):
    """A circle or a rectangle whose largest, smallest and mean brightness are wanted; see :func:`areas`.

    - ``on``: the plane, rectangle or disk that it lies on; without it, it is on the screen
    - ``center``: its centre, a point of that shape, each coordinate within ±1e15 m
    - ``at``: its centre on the screen, (x, y) within ±1e15 m, or in degrees on the screen of a fisheye or a panorama
    - ``radius``: that of a circle, a length, 1e-12 to 1e15 m, or degrees above 0 on such a screen
    - ``size``: instead, width and height of a rectangle, likewise lengths, 1e-12 to 1e15 m
    - ``up``: the direction of a rectangle's height, on a shape; of any length but 0
    - ``name``: unique among the areas
    """

    on: Word | None = None
    center: Vector | None = None
    at: Pair | None = None
    radius: Number | None = None
    size: Pair | None = None
    up: Vector | None = None
    name: Word | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Grid(Part):
    """Points on a rectangle at which the irradiance is computed.

    - ``u``, ``v``: its edges, vectors at right angles in the scene's unit, at least 1e-12 m long, each coordinate within
      ±1e15 m
    - ``points``: their number along u and along v, 1 to 65,536 each
    - ``corner``: where both edges begin, a point, each coordinate within ±1e15 m
    - ``center``: instead, the centre of the rectangle, each coordinate within ±1e15 m
    - ``name``: unique among the grids
    - ``side``: ``"front"`` (towards u × v) or ``"back"``
    """

    u: Vector
    v: Vector
    points: Size
    corner: Vector | None = None
    center: Vector | None = None
    name: Word | None = None
    side: Annotated[Side, word] = "front"


def _several(kind: type[Part]) -> Any:
    def convert(value: Any) -> tuple[Part, ...]:
        if isinstance(value, (Part, str, Mapping)) or not isinstance(value, Iterable):
            raise Invalid(f"is {value!r}", f"allowed: a list of {kind.__name__}")
        items = tuple(value)
        for item in items:
            if not isinstance(item, kind):
                raise Invalid(f"has {item!r} in it", f"allowed: a list of {kind.__name__}")
        return items

    return convert


def _shapes(value: Any) -> tuple[Part, ...]:
    shapes = _several(Shape)(value)
    for shape in shapes:
        if type(shape) not in KINDS:
            raise Invalid(f"has {shape!r} in it", f"allowed: {', '.join(kind.__name__ for kind in KINDS)}")
    return tuple(sorted(shapes, key=lambda shape: KINDS.index(type(shape))))


def _materials(value: Any) -> Mapping[str, Material]:
    if not isinstance(value, Mapping):
        raise Invalid(f"is {value!r}", "allowed: a dictionary from names to Material")
    for name, material in value.items():
        if not isinstance(name, str) or not isinstance(material, Material):
            raise Invalid(f"has {name!r}: {material!r} in it", "allowed: a dictionary from names to Material")
    return FrozenDict(value)


def _directory(value: Any) -> str:
    return str(os.path.abspath(value))


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Scene(Part):
    """A scene: the camera, the shapes, their materials, and the lights.

    A scene is always valid: creating one checks everything, and :class:`~isophote.errors.SceneError` lists everything
    that is wrong. It is immutable: :meth:`replace` and :meth:`set` return modified copies.

    - ``length``: the unit of all lengths, ``"m"``, ``"cm"`` or ``"mm"``
    - ``camera``: the observer
    - ``title``: a line that says what the scene is, up to 10,000 bytes
    - ``convention``: the formula of the brightness, one of :class:`Convention`
    - ``handedness``: ``"right"`` or ``"left"``: which way x runs on the screen (2.3)
    - ``quantities``: ``"radiometric"`` (W) or ``"photometric"`` (lm)
    - ``color_space``: that of three-valued amounts, ``"rec709"``, ``"rec2020"``, ``"display-p3"`` or ``"aces-cg"``
    - ``shadows``: whether shapes block light from each other; several shapes in a scene that does not say so are a warning
    - ``sampling``: rays per pixel, one by default
    - ``materials``: a dictionary from names
    - ``shapes``: in the order of maps and probes, grouped by kind; up to 100,000
    - ``lights``: up to 100,000
    - ``ambient``: light from all around
    - ``probes``, ``grids``: points whose values are asked for; up to 100,000 and 1000
    - ``areas``: circles and rectangles whose extremes and mean are; up to 1000
    - ``directory``: where relative file names start
    """

    length: Annotated[LengthUnit, word]
    camera: Camera
    title: Word = ""
    convention: Annotated[ConventionName, word] = "radiance"
    handedness: Annotated[Handedness, word] = "right"
    quantities: Annotated[Quantities, word] = "radiometric"
    color_space: Annotated[ColorSpace, word] = "rec709"
    shadows: Flag | None = None
    sampling: Sampling | None = None
    materials: Annotated[Mapping[str, Material], _materials] = dataclasses.field(default_factory=dict)
    shapes: Annotated[Sequence[AnyShape], _shapes] = ()
    lights: Annotated[Sequence[AnyLight], _several(Light)] = ()
    ambient: Ambient | None = None
    probes: Annotated[Sequence[Probe], _several(Probe)] = ()
    areas: Annotated[Sequence[Area], _several(Area)] = ()
    grids: Annotated[Sequence[Grid], _several(Grid)] = ()
    directory: Annotated[str | os.PathLike[str], _directory] = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        self._check(None)

    def _check(self, earlier: Scene | None) -> None:
        """Lets the core check the scene, and keeps the checked scene."""
        written, directory = json.dumps(self.to_dict()), str(self.directory)
        before = None if earlier is None else earlier.core
        core = self.named.checked(lambda: _isophote.Scene.from_json(written, directory, before))
        object.__setattr__(self, "_core", core)
        object.__setattr__(self, "_plain_core", core)
        self._warn(earlier, in_python=True)

    @property
    def named(self) -> Named:
        """The parts that messages are about, private to the package."""
        return Named(self.shapes, self.lights, self.probes, self.areas, self.grids, self.materials)

    @property
    def core(self) -> _isophote.Scene:
        """The scene in the compiled part, private to the package."""
        core: _isophote.Scene = self._core  # type: ignore[attr-defined]
        return core

    def _warn(self, earlier: Scene | None = None, in_python: bool = False) -> None:
        """Issues the scene's warnings, except those already issued for an earlier scene."""
        known = set() if earlier is None else {_about(problem) for problem in earlier.core.warnings()}
        for problem in self.core.warnings():
            if _about(problem) not in known:
                message = str(self.named.of(problem) if in_python else problem)
                warnings.warn(message, SceneWarning, stacklevel=_callers_level())

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene file: JSON if the name ends in ``.json``, TOML otherwise."""
        # A file that cannot be opened raises the matching OSError.
        with open(path, "rb"):
            pass
        directory = os.path.dirname(os.path.abspath(os.fspath(path)))
        return cls.of_core(_isophote.Scene.from_file(os.fspath(path)), directory)

    @classmethod
    def from_toml(cls, text: str, *, directory: str | os.PathLike[str] = "", name: str = "the scene") -> Scene:
        """Reads a scene from TOML text; ``name`` stands for it in messages."""
        return cls.of_core(_isophote.Scene.from_text(text, False, name, os.fspath(directory)), directory)

    @classmethod
    def from_json(cls, text: str, *, directory: str | os.PathLike[str] = "", name: str = "the scene") -> Scene:
        """Reads a scene from JSON text; ``name`` stands for it in messages."""
        return cls.of_core(_isophote.Scene.from_text(text, True, name, os.fspath(directory)), directory)

    @classmethod
    def from_dict(cls, written: Mapping[str, Any], *, directory: str | os.PathLike[str] = "") -> Scene:
        """The scene described by these tables and keys, as in a scene file."""
        return cls.from_json(json.dumps(written, default=_plain), directory=directory)

    @classmethod
    def of_core(
        cls, core: _isophote.Scene, directory: str | os.PathLike[str], *, earlier: Scene | None = None, warns: bool = True
    ) -> Scene:
        """A scene that has already been checked, private to the package; its files may be large and are not read again."""
        scene = object.__new__(cls)
        for name, value in _fields(json.loads(core.to_json())).items():
            object.__setattr__(scene, name, value)
        object.__setattr__(scene, "directory", _directory(directory) if os.fspath(directory) else "")
        Part.__post_init__(scene)
        object.__setattr__(scene, "_core", core)
        if warns:
            scene._warn(earlier, in_python=earlier is not None)
        return scene

    def replace(self, **changes: Any) -> Scene:
        """A copy with some values changed. Files that it names are not read again."""
        fields = [field.name for field in dataclasses.fields(self)]
        unknown = [name for name in changes if name not in fields]
        if unknown:
            raise TypeError(f"a Scene has no {unknown[0]!r}; it has {', '.join(fields)}")
        scene = object.__new__(type(self))
        for name in fields:
            object.__setattr__(scene, name, changes.get(name, getattr(self, name)))
        Part.__post_init__(scene)
        scene._check(self)
        return scene

    def to_dict(self) -> dict[str, Any]:
        """The scene as in a file: tables and keys, without default values."""
        written: dict[str, Any] = {"version": 1}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if field.name in _LISTS or field.name == "directory" or value is None or value == field.default:
                continue
            written[field.name] = value.to_dict() if isinstance(value, Part) else value
        written["material"] = {name: material.to_dict() for name, material in self.materials.items()}
        for kind in KINDS:
            written[kind.KEY] = [shape.to_dict() for shape in self.shapes if type(shape) is kind]
        written["light"] = [light.to_dict() for light in self.lights]
        written["probe"] = [probe.to_dict() for probe in self.probes]
        written["area"] = [area.to_dict() for area in self.areas]
        written["grid"] = [grid.to_dict() for grid in self.grids]
        return {key: value for key, value in written.items() if value not in ([], {})}

    def to_toml(self) -> str:
        """The scene as scene file text."""
        return self.core.to_toml()

    def with_resolution(self, resolution: Size) -> Scene:
        """A copy of the scene with another number of columns and rows."""
        width, height = self.camera.replace(resolution=resolution).resolution
        if not (0 <= width < 2**32 and 0 <= height < 2**32):
            raise ArgumentError(f"resolution is {width}×{height}; allowed: 1 to 1000000 columns and rows")
        core = self.named.checked(lambda: self.core.with_resolution(int(width), int(height)))
        return self.of_core(core, self.directory, earlier=self)

    def set(self, values: Mapping[str, Any]) -> Scene:
        """A copy of the scene with other values at these paths.

        A path is that of a scene file, with the item's name in the middle: ``light.lamp.position``,
        ``material.clay.shininess``, ``sphere.ball.radius``, ``camera.eye``, ``camera.screen.distance``, ``convention``.
        Items without a name are numbered from 0: ``light[0].position``. ``None`` removes a value. A path may lead to a whole
        part: ``light.lamp``, ``material.clay``, ``sphere.ball``.
        """
        parts = rewritten((locate(self, path), value) for path, value in values.items())
        core = self.with_parts(parts)
        scene = object.__new__(type(self))
        for field in dataclasses.fields(self):
            object.__setattr__(scene, field.name, getattr(self, field.name))
        # The parts that stay are the same objects: there may be a hundred thousand of them.
        for place, written in parts.items():
            scene._read_again(place, written)
        object.__setattr__(scene, "_core", core)
        object.__setattr__(scene, "_plain_core", core)
        scene._warn(self, in_python=True)
        return scene

    def with_parts(self, parts: Mapping[Place, Any]) -> _isophote.Scene:
        """The scene in the compiled part, with these parts written anew; private to the package."""
        written = [
            (str(place[0]), place[1] if len(place) > 1 else None, None if part is None else json.dumps(part))
            for place, part in parts.items()
        ]
        try:
            return self._as_set.with_parts(written)
        except SceneError:
            # Read as a whole, the scene says what is wrong in its own words, and finds files that are new to it.
            whole: dict[Any, Any] = self.to_dict()
        for place, part in parts.items():
            *tables, key = place
            container = whole.setdefault(tables[0], {}) if tables else whole
            if part is None:
                container.pop(key, None)
            else:
                container[key] = part
        text, directory = json.dumps(whole), str(self.directory)
        return self.named.checked(lambda: _isophote.Scene.from_json(text, directory, self.core))

    @property
    def _as_set(self) -> _isophote.Scene:
        """The checked scene as Python writes it, without what a file says in vain: whatever way leads to a scene, its outputs
        are then the same."""
        if "_plain_core" not in self.__dict__:
            core = _isophote.Scene.from_json(json.dumps(self.to_dict()), str(self.directory), self.core)
            object.__setattr__(self, "_plain_core", core)
        plain: _isophote.Scene = self.__dict__["_plain_core"]
        return plain

    def _read_again(self, place: Place, written: Any) -> None:
        """Takes a part of a valid scene as it is written, while this one is being made."""
        table = str(place[0])
        if table == "material":
            materials = {name: material for name, material in self.materials.items() if name != place[1]}
            if written is not None:
                materials = {**self.materials, str(place[1]): Material.from_dict(written)}
            object.__setattr__(self, "materials", FrozenDict(materials))
            return
        if table in TABLES:
            name, kind = TABLES[table]
            items = list(getattr(self, name))
            number = first_of(kind, items) + int(place[1])
            items[number] = light_from_dict(written) if name == "lights" else type(items[number]).from_dict(written)
            object.__setattr__(self, name, tuple(items))
            return
        default = next(field.default for field in dataclasses.fields(self) if field.name == table)
        object.__setattr__(self, table, default if written is None else converters(type(self))[table](written))

    def unit(self, channel: str) -> str:
        """The unit of a channel of this scene's maps: ``"1"`` for pure numbers, ``""`` for indices."""
        return self.core.unit(channel)

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self.core.to_json(), self.directory)

    def __hash__(self) -> int:
        return hash(json.dumps(self.to_dict(), sort_keys=True))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self.to_dict() == other.to_dict() and self._files_start() == other._files_start()

    def _files_start(self) -> str:
        """The base directory for file names, if there are any; otherwise it makes no difference."""
        return str(self.directory) if any(isinstance(shape, (Mesh, Spheres)) for shape in self.shapes) else ""

    def __repr__(self) -> str:
        about = self.core.describe()
        length = self.length
        width, height = about["resolution"]
        lines = [
            f"<Scene {self.title!r}: lengths in {length}, brightness by {about['convention']} in {about['brightness_unit']}",
            f"  camera: {self.camera.projection}, eye at {_text(self.camera.eye)} {length}, {width}×{height} pixels",
        ]
        for name, material in list(self.materials.items())[:_SHOWN]:
            lines.append(f"  material {name!r}: {_body(material)}")
        lines.extend(_more(len(self.materials), "materials"))
        for name, shape in list(zip(about["shapes"], self.shapes))[:_SHOWN]:
            lines.append(f"  {type(shape).KEY} {name!r}: {_body(shape, length)}")
        lines.extend(_more(len(self.shapes), "shapes"))
        units = {"intensity": about["intensity_unit"], "power": about["power_unit"], "irradiance": about["irradiance_unit"]}
        for name, light in list(zip(about["lights"], self.lights))[:_SHOWN]:
            lines.append(f"  {type(light).__name__} {name!r}: {_body(light, length, units)}")
        lines.extend(_more(len(self.lights), "lights"))
        if self.ambient is not None:
            lines.append(f"  ambient: {_text(self.ambient.radiance)} {about['radiance_unit']}")
        counts = [
            f"{len(items)} {name}"
            for items, name in ((self.probes, "probes"), (self.areas, "areas"), (self.grids, "grids"))
            if items
        ]
        if counts:
            lines.append(f"  {', '.join(counts)}")
        return "\n".join(lines) + ">"

    def _repr_html_(self) -> str:
        from ._html import escaped

        return f"<pre>{escaped(repr(self)[1:-1])}</pre>"


SceneOrPath = Scene | str | os.PathLike[str]
"""A scene, or the path of a file that has one."""


def scene_of(given: SceneOrPath) -> Scene:
    """The given scene, or that of a file: a scene file, or any other that Isophote has written."""
    if isinstance(given, Scene):
        return given
    if not isinstance(given, (str, os.PathLike)):
        raise ArgumentError(f"scene is {given!r}; allowed: a Scene, or the path of a scene file")
    path = os.fspath(given)
    if os.path.splitext(path)[1].lower() in (".toml", ".json"):
        return Scene.from_file(path)
    from .files import read

    return scene_of(read(path).scene)


_LISTS = ("materials", "shapes", "lights", "probes", "areas", "grids")
_SHOWN = 12
# fmt: off
_LENGTHS = frozenset({
    "apex", "apex_radius", "base", "center", "end", "height", "point", "position", "radii", "radius", "size", "start", "target",
    "width",
})
# fmt: on
_ANGLES = ("azimuth", "inner_angle", "outer_angle", "tilt")


def _unpickle(text: str, directory: str) -> Scene:
    # The warnings were issued when the scene was created.
    return Scene.of_core(_isophote.Scene.from_text(text, True, "the scene", directory), directory, warns=False)


def _about(problem: Problem) -> str:
    """What a warning is about. That pixels are not square is said once, not again for every camera and size."""
    return "pixels" if problem.message.startswith("pixels are not square") else str(problem)


def _callers_level() -> int:
    """The stack level of the code that called the package."""
    package = os.path.dirname(__file__)
    # Start at the caller of this function; dataclasses generate frames of their own.
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and (frame.f_code.co_filename.startswith((package, "<string>"))):
        level, frame = level + 1, frame.f_back
    return level


def _plain(value: Any) -> Any:
    """NumPy values as plain Python values for JSON."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError(f"a scene holds numbers, texts, lists and dictionaries, and no {type(value).__name__}")


def _fields(written: dict[str, Any]) -> dict[str, Any]:
    """The fields of a scene from its tables in a file; missing ones have their defaults."""
    fields: dict[str, Any] = {}
    for field in dataclasses.fields(Scene):
        fields[field.name] = written.get(field.name, field.default)
    fields["materials"] = {name: Material.from_dict(one) for name, one in written.get("material", {}).items()}
    fields["shapes"] = [kind.from_dict(one) for kind in KINDS for one in written.get(kind.KEY, [])]
    fields["lights"] = [light_from_dict(one) for one in written.get("light", [])]
    fields["probes"] = [Probe.from_dict(one) for one in written.get("probe", [])]
    fields["areas"] = [Area.from_dict(one) for one in written.get("area", [])]
    fields["grids"] = [Grid.from_dict(one) for one in written.get("grid", [])]
    return fields


def _text(value: Any) -> str:
    if isinstance(value, tuple) and len(value) > 3:
        return f"{len(value)} × 3"
    if isinstance(value, tuple):
        return f"({', '.join(_text(item) for item in value)})"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _body(part: Part, length: str = "", units: Mapping[str, str] = MappingProxyType({})) -> str:
    """The values of a part, with units."""
    words = []
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if field.name == "name" or value is None or value == field.default:
            continue
        unit = length if field.name in _LENGTHS else "°" if field.name in _ANGLES else units.get(field.name, "")
        space = " " if unit not in ("", "°") else ""
        words.append(f"{field.name} {_text(value)}{space}{unit}")
    return ", ".join(words)


def _more(count: int, what: str) -> list[str]:
    return [f"  … {count - _SHOWN} more {what}"] if count > _SHOWN else []
