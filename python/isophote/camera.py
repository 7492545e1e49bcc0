"""The observer: cameras, their windows, and how pixels are sampled."""

from __future__ import annotations

from dataclasses import dataclass

from ._convert import Number, Pair, Size, Vector, Whole, Word
from ._part import Part

__all__ = ["Camera", "Sampling", "Screen", "Window"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Screen(Part):
    """The window of a perspective camera.

    - ``distance``: of its plane from the eye, a length above 0 in the scene's unit
    - ``x``: its left and right edges in the scene's unit, the smaller first
    - ``y``: its lower and upper edges
    """

    distance: Number
    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Window(Part):
    """The window of an orthographic camera, on the plane through the eye.

    - ``x``: its left and right edges in the scene's unit, the smaller first
    - ``y``: its lower and upper edges
    """

    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Camera(Part):
    """The observer (2.1), (2.3).

    - ``eye``: a point
    - ``forward``: where it looks, a direction of any length but 0
    - ``target``: instead, a point to look at
    - ``up``: the direction that appears vertical, not parallel to the one of view
    - ``projection``: ``"perspective"`` (with a ``screen`` or a ``field_of_view``), ``"orthographic"`` (with a ``window``,
      2.7), ``"fisheye-equidistant"`` (2.8) or ``"fisheye-equal-area"`` (2.9; both with a ``field_of_view``), or
      ``"panorama"`` (with ``longitude`` and ``latitude``, 2.10)
    - ``screen``: the window of a perspective camera
    - ``field_of_view``: in degrees: across the width of a perspective image, below 180; across the circle of a fisheye, up
      to 360
    - ``window``: that of an orthographic camera
    - ``longitude``: left and right edges of a panorama, in degrees from the direction of view, −360 to 360
    - ``latitude``: its lower and upper edges, −90 to 90
    - ``resolution``: columns and rows, 1 to 1,000,000 each
    """

    eye: Vector
    forward: Vector | None = None
    target: Vector | None = None
    up: Vector = (0.0, 1.0, 0.0)
    projection: Word = "perspective"
    screen: Screen | None = None
    field_of_view: Number | None = None
    window: Window | None = None
    longitude: Pair | None = None
    latitude: Pair | None = None
    resolution: Size = (800, 600)


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sampling(Part):
    """How many rays make up a pixel's value (2.6).

    - ``samples``: the number of rays, 1 to 4096; with a tolerance, the most
    - ``tolerance``: instead, the allowed error as a fraction of the maximum brightness, 1e-4 to 1
    - ``filter``: ``"box"``, ``"triangle"``, ``"gaussian"`` or ``"mitchell"``
    """

    samples: Whole | None = None
    tolerance: Number | None = None
    filter: Word = "box"
