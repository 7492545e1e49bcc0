"""Maps without a camera, over a shape's own surface or over a grid of points; and areas of interest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _isophote
from ._convert import Invalid, Size, Vector, vector
from ._convert import size as two_whole
from ._types import Side, SurfaceProjection
from .errors import ArgumentError
from .map import Map
from .rendering import Channels, channel_names, counted
from .scene import Scene, SceneOrPath, scene_of

__all__ = ["AreaExtreme", "AreaReading", "GridMap", "SurfaceMap", "SurfaceTotals", "areas", "grid", "surface"]


@dataclass(frozen=True)
class SurfaceTotals:
    """Totals of a channel over a surface, each cell weighted by its exact area.

    - ``integral``: in the channel's unit times m²; for the irradiance, the flux in W or lm
    - ``min``, ``max``: in the channel's unit
    - ``area``: in m²
    """

    integral: float
    min: float
    max: float
    area: float

    @property
    def mean(self) -> float:
        """The integral divided by the area."""
        return self.integral / self.area


class SurfaceMap(Map):
    """A map over the surface of a shape. ``area`` is the surface area in m²; ``totals`` has the totals of each channel."""

    def __init__(self, core: _isophote.Map, scene: Scene, area: float, totals: dict[str, Any]) -> None:
        super().__init__(core, scene)
        self.area: float = area
        self.totals: dict[str, SurfaceTotals | None] = {
            name: None if of is None else SurfaceTotals(*of) for name, of in totals.items()
        }


class GridMap(Map):
    """A map over a grid of points."""

    @property
    def uniformity(self) -> float:
        """The minimum irradiance divided by the mean."""
        return self.min("irradiance") / self.mean("irradiance")


@dataclass(frozen=True)
class AreaExtreme:
    """The largest or smallest brightness in an area.

    - ``value``: in the scene's unit of brightness
    - ``point``: where it is, in the scene's length unit
    - ``screen``: its place on the screen, for an area there
    - ``seen``: whether the eye sees it
    """

    value: float
    point: tuple[float, float, float]
    screen: tuple[float, float] | None
    seen: bool


@dataclass(frozen=True)
class AreaReading:
    """The brightness over an area.

    - ``max``, ``min``: its extremes
    - ``mean``, ``mean_error``: its mean, and an estimate of the error of that
    - ``visible``: the fraction of an area on a surface that the eye sees; of one on the screen, that shows a surface
    """

    max: AreaExtreme
    min: AreaExtreme
    mean: float
    mean_error: float
    visible: float


def areas(scene: SceneOrPath) -> dict[str, AreaReading | None]:
    """The extremes and the mean of the brightness over each area of the scene, by its name, in double precision and
    whatever the resolution; ``None`` for an area that shows no surface."""
    return {name: None if numbers is None else _reading(*numbers) for name, numbers in _isophote.areas(scene_of(scene).core)}


def _reading(largest: Any, smallest: Any, mean: float, mean_error: float, visible: float) -> AreaReading:
    def extreme(value: float, point: Any, screen: Any, seen: bool) -> AreaExtreme:
        x, y, z = point
        return AreaExtreme(value, (x, y, z), None if screen is None else (screen[0], screen[1]), seen)

    return AreaReading(extreme(*largest), extreme(*smallest), mean, mean_error, visible)


def surface(
    scene: SceneOrPath,
    *,
    shape: str | int | None = None,
    part: int = 0,
    channels: Channels = ("irradiance", "position", "normal"),
    projection: SurfaceProjection = "equirectangular",
    side: Side = "front",
    axis: Vector | None = None,
    size: Size | None = None,
) -> SurfaceMap:
    """The map over the surface of a shape: a sphere, a rectangle, a disk or a cylinder.

    ``shape``: its name or index; may be omitted if there is only one. ``part``: which sphere of a cloud.
    ``projection``: ``"equirectangular"`` or ``"equal-area"``. ``side``: ``"front"`` or ``"back"``.
    ``axis``: where a sphere's latitude is 90°, +y by default. ``size``: columns and rows.
    """
    scene = scene_of(scene)
    names = scene.core.describe()["shapes"]
    core, area, totals = _isophote.surface(
        scene.core,
        _named(names, shape, "shape"),
        counted(part, "part"),
        channel_names(scene, channels),
        projection,
        side,
        _or_none(vector, axis, "axis"),
        None if size is None else [counted(side, "size", 1) for side in _or_none(two_whole, size, "size")],
    )
    return SurfaceMap(core, scene, area, totals)


def grid(scene: SceneOrPath, *, name: str | int | None = None, channels: Channels = ("irradiance", "position")) -> GridMap:
    """The map over a grid of the scene, given by name or index, which may be omitted if there is only one grid."""
    scene = scene_of(scene)
    names = scene.core.describe()["grids"]
    core = _isophote.grid(scene.core, _named(names, name, "grid"), channel_names(scene, channels))
    return GridMap(core, scene)


def _named(names: list[str], one: str | int | None, what: str) -> str:
    if isinstance(one, str):
        return one
    if one is None and len(names) == 1:
        return names[0]
    if isinstance(one, (int, np.integer)) and not isinstance(one, bool) and 0 <= one < len(names):
        return names[one]
    there_are = f"there are: {', '.join(names[:20])}" if names else "the scene has none"
    raise ArgumentError(f"say which {what}; {there_are}")


def _or_none(convert: Any, value: Any, name: str) -> Any:
    try:
        return None if value is None else convert(value)
    except Invalid as invalid:
        raise ArgumentError(f"{name} {invalid.message}; {invalid.allowed}") from None
