"""Brightness of surfaces lit by point, parallel and ambient light: maps, and exact values at points, with units.

>>> import isophote as iso
>>> scene = iso.scenes.lab()
>>> m = iso.render(scene)
>>> m["brightness"].shape, m.units["brightness"]
((600, 800), 'W/m²')
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._isophote import __version__

if TYPE_CHECKING:
    from . import errors, scenes
    from .analysis import AreaExtreme, AreaReading, GridMap, SurfaceMap, SurfaceTotals, areas, grid, surface
    from .camera import Camera, Intrinsics, Pose, Sampling, Screen, Window
    from .errors import (
        ArgumentError,
        Error,
        InternalError,
        ProbeError,
        Problem,
        RenderError,
        SceneError,
        SceneWarning,
        StoreError,
    )
    from .files import MapFile, read
    from .formula import brightness
    from .lights import Ambient, LambertianLight, Light, ParallelLight, PointLight, SpotLight
    from .map import Axis, Isophote, Map
    from .materials import Convention, Material
    from .notebook import app
    from .probing import Probes, Section, Values, probe, section
    from .rendering import render
    from .scene import Area, Grid, Probe, Scene
    from .shapes import (
        Box,
        Cone,
        Cylinder,
        Disk,
        Ellipsoid,
        Mesh,
        Plane,
        Rectangle,
        Rotation,
        Shape,
        Sphere,
        Spheres,
    )
    from .stores import ChannelStatistics, StoredMap, render_to_zarr
    from .sweeps import sweep

__all__ = [
    "Ambient",
    "Area",
    "AreaExtreme",
    "AreaReading",
    "ArgumentError",
    "Axis",
    "Box",
    "Camera",
    "ChannelStatistics",
    "Cone",
    "Convention",
    "Cylinder",
    "Disk",
    "Ellipsoid",
    "Error",
    "Grid",
    "GridMap",
    "InternalError",
    "Intrinsics",
    "Isophote",
    "LambertianLight",
    "Light",
    "Map",
    "MapFile",
    "Material",
    "Mesh",
    "ParallelLight",
    "Plane",
    "PointLight",
    "Pose",
    "Probe",
    "ProbeError",
    "Probes",
    "Problem",
    "Rectangle",
    "RenderError",
    "Rotation",
    "Sampling",
    "Scene",
    "SceneError",
    "SceneWarning",
    "Screen",
    "Section",
    "Shape",
    "Sphere",
    "Spheres",
    "SpotLight",
    "StoreError",
    "StoredMap",
    "SurfaceMap",
    "SurfaceTotals",
    "Values",
    "Window",
    "__version__",
    "app",
    "areas",
    "brightness",
    "errors",
    "grid",
    "probe",
    "read",
    "render",
    "render_to_zarr",
    "scenes",
    "section",
    "surface",
    "sweep",
]

# Modules are loaded on first use: importing NumPy alone takes longer than most commands run.
_NAMES = {
    "analysis": ("AreaExtreme", "AreaReading", "GridMap", "SurfaceMap", "SurfaceTotals", "areas", "grid", "surface"),
    "camera": ("Camera", "Intrinsics", "Pose", "Sampling", "Screen", "Window"),
    "errors": (
        "ArgumentError",
        "Error",
        "InternalError",
        "ProbeError",
        "Problem",
        "RenderError",
        "SceneError",
        "SceneWarning",
        "StoreError",
    ),
    "files": ("MapFile", "read"),
    "formula": ("brightness",),
    "lights": ("Ambient", "LambertianLight", "Light", "ParallelLight", "PointLight", "SpotLight"),
    "map": ("Axis", "Isophote", "Map"),
    "materials": ("Convention", "Material"),
    "notebook": ("app",),
    "probing": ("Probes", "Section", "Values", "probe", "section"),
    "rendering": ("render",),
    "scene": ("Area", "Grid", "Probe", "Scene"),
    "shapes": (
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
    ),
    "stores": ("ChannelStatistics", "StoredMap", "render_to_zarr"),
    "sweeps": ("sweep",),
}
_MODULES = {name: module for module, names in _NAMES.items() for name in names}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in ("errors", "scenes"):
        return import_module(f".{name}", __name__)
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_MODULES[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
