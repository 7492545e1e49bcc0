"""Shapes. Lengths are in the scene's unit, angles in degrees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ._convert import Vector, flag, number, vector, word
from ._part import Part, nested, optional, required

__all__ = [
    "Box",
    "Cone",
    "Cylinder",
    "Disk",
    "Ellipsoid",
    "Mesh",
    "Plane",
    "Rectangle",
    "Rotation",
    "Shape",
    "Sphere",
    "Spheres",
]


@dataclass(frozen=True, kw_only=True, repr=False)
class Rotation(Part):
    """A turn by ``degrees`` about ``axis``, counter-clockwise for who looks against the axis."""

    axis: Vector = required(vector)
    degrees: float = required(number)


@dataclass(frozen=True, kw_only=True, repr=False)
class Shape(Part):
    """What all shapes have: a name of their own, the name of a material, and what they have to do with shadows."""

    KEY: ClassVar[str]
    """The table of a scene file that holds such shapes."""

    name: str | None = optional(word)
    material: str | None = optional(word)
    casts_shadow: bool = optional(flag, True)
    receives_shadow: bool = optional(flag, True)


@dataclass(frozen=True, kw_only=True, repr=False)
class Sphere(Shape):
    """A sphere."""

    KEY = "sphere"
    center: Vector = required(vector)
    radius: float = required(number)


@dataclass(frozen=True, kw_only=True, repr=False)
class Ellipsoid(Shape):
    """An ellipsoid with its radii along its own x, y and z."""

    KEY = "ellipsoid"
    center: Vector = required(vector)
    radii: Vector = required(vector)
    rotation: Rotation | None = optional(nested(Rotation))


@dataclass(frozen=True, kw_only=True, repr=False)
class Box(Shape):
    """A box with its sides along its own x, y and z."""

    KEY = "box"
    center: Vector = required(vector)
    size: Vector = required(vector)
    rotation: Rotation | None = optional(nested(Rotation))


@dataclass(frozen=True, kw_only=True, repr=False)
class Cylinder(Shape):
    """A cylinder with both its ends, from the middle of one to the middle of the other."""

    KEY = "cylinder"
    # Python keeps `from` for itself.
    start: Vector = required(vector, key="from")
    end: Vector = required(vector, key="to")
    radius: float = required(number)


@dataclass(frozen=True, kw_only=True, repr=False)
class Cone(Shape):
    """A cone with its base, cut off at the top if ``apex_radius`` is not 0."""

    KEY = "cone"
    base: Vector = required(vector)
    apex: Vector = required(vector)
    radius: float = required(number)
    apex_radius: float = optional(number, 0.0)


@dataclass(frozen=True, kw_only=True, repr=False)
class Plane(Shape):
    """A plane without end."""

    KEY = "plane"
    point: Vector = required(vector)
    normal: Vector = required(vector)


@dataclass(frozen=True, kw_only=True, repr=False)
class Rectangle(Shape):
    """A rectangle, seen from both sides; its height runs along ``up``."""

    KEY = "rectangle"
    center: Vector = required(vector)
    normal: Vector = required(vector)
    width: float = required(number)
    height: float = required(number)
    up: Vector = optional(vector, (0.0, 1.0, 0.0))


@dataclass(frozen=True, kw_only=True, repr=False)
class Disk(Shape):
    """A disk, seen from both sides."""

    KEY = "disk"
    center: Vector = required(vector)
    normal: Vector = required(vector)
    radius: float = required(number)


@dataclass(frozen=True, kw_only=True, repr=False)
class Mesh(Shape):
    """A mesh of triangles from an OBJ, PLY, STL or binary glTF file, scaled, then turned, then moved."""

    KEY = "mesh"
    file: str = required(word)
    scale: Vector = optional(vector, (1.0, 1.0, 1.0))
    rotation: Rotation | None = optional(nested(Rotation))
    position: Vector = optional(vector, (0.0, 0.0, 0.0))
    smooth: bool = optional(flag, True)


@dataclass(frozen=True, kw_only=True, repr=False)
class Spheres(Shape):
    """Many spheres from a CSV, NPY or PLY file of centres and radii."""

    KEY = "spheres"
    file: str = required(word)


KINDS: tuple[type[Shape], ...] = (
    Sphere,
    Ellipsoid,
    Box,
    Cylinder,
    Cone,
    Plane,
    Rectangle,
    Disk,
    Mesh,
    Spheres,
)
"""All kinds, in the order that the shapes of a scene have."""
