"""The observer: cameras, their windows, and how pixels are sampled."""

from __future__ import annotations

from dataclasses import dataclass

from ._convert import Number, Pair, Size, Vector, Whole, Word
from ._part import Part

__all__ = ["Camera", "Sampling", "Screen", "Window"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Screen(Part):
    """The window of a perspective camera: left and right edges ``x``, lower and upper edges ``y``, on the plane at
    ``distance`` from the eye."""

    distance: Number
    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Window(Part):
    """The window of an orthographic camera, on the plane through the eye."""

    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Camera(Part):
    """The observer (2.1), (2.3).

    Looks along ``forward``, at the point ``target``, or in the direction of the angles ``tilt`` (from −z: 0 is straight
    down) and ``azimuth`` (from +x towards +y), in degrees. ``up`` is the top of the image: +y, unless the view is along it.
    ``projection`` is ``"perspective"`` (with a ``screen`` or a ``field_of_view`` in degrees), ``"orthographic"`` (with a
    ``window``, 2.7), ``"fisheye-equidistant"`` (2.8) or ``"fisheye-equal-area"`` (2.9; both with a ``field_of_view``), or
    ``"panorama"`` (with ``longitude`` and ``latitude``, 2.10). ``resolution`` is the number of columns and of rows.
    """

    eye: Vector
    forward: Vector | None = None
    target: Vector | None = None
    tilt: Number | None = None
    azimuth: Number | None = None
    up: Vector | None = None
    projection: Word = "perspective"
    screen: Screen | None = None
    field_of_view: Number | None = None
    window: Window | None = None
    longitude: Pair | None = None
    latitude: Pair | None = None
    resolution: Size = (800, 600)


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sampling(Part):
    """How many rays make up a pixel's value (2.6): ``samples`` rays, or as many as needed for ``tolerance``, which is the
    allowed error as a fraction of the maximum brightness. ``filter`` is ``"box"``, ``"triangle"``, ``"gaussian"`` or
    ``"mitchell"``."""

    samples: Whole | None = None
    tolerance: Number | None = None
    filter: Word = "box"
