"""Shapes. Lengths are in the scene's unit, each above 0 (1e-12 to 1e15 m); coordinates up to ±1e15 m; angles in degrees."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar

from ._convert import File, Flag, MaterialName, Number, Triples, Vector, Vectors, Word
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
    """A rotation, counter-clockwise when looking against the axis.

    - ``axis``: a direction of any length but 0
    - ``degrees``: by how much, any finite number
    """

    axis: Vector
    degrees: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Shape(Part):
    """The fields common to all shapes.

    - ``name``: unique among the shapes; by default the kind and a number
    - ``material``: its name among the scene's ``materials``; may be left out if there is only one
    - ``casts_shadow``, ``receives_shadow``: where the scene has ``shadows``
    """

    KEY: ClassVar[str]
    """The table in scene files for such shapes."""

    name: Word | None = None
    material: MaterialName | None = None
    casts_shadow: Flag = True
    receives_shadow: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sphere(Shape):
    """A sphere (2.2).

    - ``center``: a point, each coordinate within ±1e15 m
    - ``radius``: a length, 1e-12 to 1e15 m
    """

    KEY: ClassVar[str] = "sphere"
    center: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Ellipsoid(Shape):
    """An ellipsoid.

    - ``center``: a point, each coordinate within ±1e15 m
    - ``radii``: three lengths, along its own x, y and z, 1e-12 to 1e15 m each
    - ``rotation``: by which it is turned
    """

    KEY: ClassVar[str] = "ellipsoid"
    center: Vector
    radii: Vector
    rotation: Rotation | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Box(Shape):
    """A box.

    - ``center``: a point, each coordinate within ±1e15 m
    - ``size``: three lengths, along its own x, y and z, 1e-12 to 1e15 m each
    - ``rotation``: by which it is turned
    """

    KEY: ClassVar[str] = "box"
    center: Vector
    size: Vector
    rotation: Rotation | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Cylinder(Shape):
    """A cylinder with both end caps.

    - ``start``, ``end``: the centres of the caps (``from`` and ``to`` in scene files), points at least 1e-12 m apart, each
      coordinate within ±1e15 m
    - ``radius``: a length, 1e-12 to 1e15 m
    """

    KEY: ClassVar[str] = "cylinder"
    # `from` is a keyword in Python.
    _KEYS = MappingProxyType({"start": "from", "end": "to"})
    start: Vector
    end: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Cone(Shape):
    """A cone with its base.

    - ``base``, ``apex``: the centre of the base and the tip, points at least 1e-12 m apart, each coordinate within ±1e15 m
    - ``radius``: of the base, a length, 1e-12 to 1e15 m
    - ``apex_radius``: 0, or a length, 1e-12 to 1e15 m: then the cone is truncated and has a cap there too
    """

    KEY: ClassVar[str] = "cone"
    base: Vector
    apex: Vector
    radius: Number
    apex_radius: Number = 0.0


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Plane(Shape):
    """An infinite plane.

    - ``point``: any of its points, each coordinate within ±1e15 m
    - ``normal``: a direction of any length but 0
    """

    KEY: ClassVar[str] = "plane"
    point: Vector
    normal: Vector


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Rectangle(Shape):
    """A rectangle, visible from both sides.

    - ``center``: a point, each coordinate within ±1e15 m
    - ``normal``: the direction to its front, of any length but 0
    - ``width``, ``height``: lengths, 1e-12 to 1e15 m
    - ``up``: the direction along which its height runs, of any length but 0, not parallel to the normal
    """

    KEY: ClassVar[str] = "rectangle"
    center: Vector
    normal: Vector
    width: Number
    height: Number
    up: Vector = (0.0, 1.0, 0.0)


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Disk(Shape):
    """A disk, visible from both sides.

    - ``center``: a point, each coordinate within ±1e15 m
    - ``normal``: the direction to its front, of any length but 0
    - ``radius``: a length, 1e-12 to 1e15 m
    """

    KEY: ClassVar[str] = "disk"
    center: Vector
    normal: Vector
    radius: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Mesh(Shape):
    """A triangle mesh (2.5); it is scaled, then rotated, then moved.

    - ``file``: an OBJ, PLY, STL or binary glTF file, by its path from the scene's ``directory``
    - ``vertices``: instead, the points of the mesh, n × 3 finite numbers; once placed, within ±1e15 m
    - ``faces``: with them, the three corners of each triangle, m × 3, as indices of vertices, 0 to n − 1; counter-clockwise as
      seen from outside
    - ``normals``: with them, a direction at each vertex for smooth shading, n × 3, of any length but 0
    - ``scale``: a factor along each of its own axes, 1e-12 to 1e12
    - ``rotation``: by which it is turned
    - ``position``: where the file's origin goes, a point, each coordinate within ±1e15 m
    - ``smooth``: whether the file's normals are used, if it has any
    """

    KEY: ClassVar[str] = "mesh"
    file: File | None = None
    vertices: Vectors | None = None
    faces: Triples | None = None
    normals: Vectors | None = None
    scale: Vector = (1.0, 1.0, 1.0)
    rotation: Rotation | None = None
    position: Vector = (0.0, 0.0, 0.0)
    smooth: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Spheres(Shape):
    """Many spheres.

    - ``file``: a CSV, NPY or PLY file of centres and radii, by its path from the scene's ``directory``
    """

    KEY: ClassVar[str] = "spheres"
    file: File


AnyShape = Sphere | Ellipsoid | Box | Cylinder | Cone | Plane | Rectangle | Disk | Mesh | Spheres
"""Any kind of shape."""

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
