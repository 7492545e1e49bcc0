"""The observer: cameras, their windows, and how pixels are sampled."""

from __future__ import annotations

from dataclasses import dataclass

from ._convert import Pair, Size, Vector, number, pair, size, vector, whole, word
from ._part import Part, nested, optional, required

__all__ = ["Camera", "Sampling", "Screen", "Window"]


@dataclass(frozen=True, kw_only=True, repr=False)
class Screen(Part):
    """The window of a perspective camera: left and right edge ``x``, lower and upper edge ``y``, on the plane at
    ``distance`` from the eye."""

    distance: float = required(number)
    x: Pair = required(pair)
    y: Pair = required(pair)


@dataclass(frozen=True, kw_only=True, repr=False)
class Window(Part):
    """The window of an orthographic camera, on the plane through the eye."""

    x: Pair = required(pair)
    y: Pair = required(pair)


@dataclass(frozen=True, kw_only=True, repr=False)
class Camera(Part):
    """The observer.

    Looks along ``forward``, or at the point ``target``. ``projection`` is ``"perspective"`` (with a ``screen`` or a
    ``field_of_view`` in degrees), ``"orthographic"`` (with a ``window``), ``"fisheye-equidistant"`` or
    ``"fisheye-equal-area"`` (with a ``field_of_view``), or ``"panorama"`` (with ``longitude`` and ``latitude``).
    ``resolution`` is the number of columns and of rows.
    """

    eye: Vector = required(vector)
    forward: Vector | None = optional(vector)
    target: Vector | None = optional(vector)
    up: Vector = optional(vector, (0.0, 1.0, 0.0))
    projection: str = optional(word, "perspective")
    screen: Screen | None = optional(nested(Screen))
    field_of_view: float | None = optional(number)
    window: Window | None = optional(nested(Window))
    longitude: Pair | None = optional(pair)
    latitude: Pair | None = optional(pair)
    resolution: Size = optional(size, (800, 600))


@dataclass(frozen=True, kw_only=True, repr=False)
class Sampling(Part):
    """How many rays a pixel's value is made of: ``samples`` of them, or as many as a ``tolerance`` takes, which is the
    error that is allowed as a part of the largest brightness. ``filter`` is ``"box"``, ``"triangle"``, ``"gaussian"`` or
    ``"mitchell"``."""

    samples: int | None = optional(whole)
    tolerance: float | None = optional(number)
    filter: str = optional(word, "box")
