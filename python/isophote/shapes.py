"""Shapes. Lengths are in the scene's unit, angles in degrees."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

from ._convert import Flag, Number, Vector, Word
from ._part import Part

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


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Rotation(Part):
    """A rotation by ``degrees`` about ``axis``, counter-clockwise when looking against the axis."""

    axis: Vector
    degrees: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Shape(Part):
    """The fields common to all shapes: a name, the name of a material, and whether they cast and receive shadows."""

    KEY: ClassVar[str]
    """The table in scene files for such shapes."""

    name: Word | None = None
    material: Word | None = None
    casts_shadow: Flag = True
    receives_shadow: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sphere(Shape):
    """A sphere (2.2)."""

    KEY = "sphere"
    center: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Ellipsoid(Shape):
    """An ellipsoid with radii along its own x, y and z."""

    KEY = "ellipsoid"
    center: Vector
    radii: Vector
    rotation: Rotation | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Box(Shape):
    """A box with sides along its own x, y and z."""

    KEY = "box"
    center: Vector
    size: Vector
    rotation: Rotation | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Cylinder(Shape):
    """A cylinder with both end caps, from the centre of one to the centre of the other."""

    KEY = "cylinder"
    # `from` is a keyword in Python.
    _KEYS = MappingProxyType({"start": "from", "end": "to"})
    start: Vector
    end: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Cone(Shape):
    """A cone with its base, truncated at the top if ``apex_radius`` is not 0."""

    KEY = "cone"
    base: Vector
    apex: Vector
    radius: Number
    apex_radius: Number = 0.0


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Plane(Shape):
    """An infinite plane."""

    KEY = "plane"
    point: Vector
    normal: Vector


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Rectangle(Shape):
    """A rectangle, visible from both sides; its height runs along ``up``."""

    KEY = "rectangle"
    center: Vector
    normal: Vector
    width: Number
    height: Number
    up: Vector = (0.0, 1.0, 0.0)


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Disk(Shape):
    """A disk, visible from both sides."""

    KEY = "disk"
    center: Vector
    normal: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Mesh(Shape):
    """A triangle mesh (2.5) from an OBJ, PLY, STL or binary glTF file; it is scaled, then rotated, then moved."""

    KEY = "mesh"
    file: Word
    scale: Vector = (1.0, 1.0, 1.0)
    rotation: Rotation | None = None
    position: Vector = (0.0, 0.0, 0.0)
    smooth: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Spheres(Shape):
    """Many spheres, from a CSV, NPY or PLY file of centres and radii."""

    KEY = "spheres"
    file: Word


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
"""All kinds of shapes, in the order in which a scene keeps them."""
