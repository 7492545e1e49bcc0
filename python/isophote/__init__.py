"""Brightness of surfaces lit by point lights, parallel and ambient light: maps, exact values at points, with units.

>>> import isophote as iso
>>> scene = iso.scenes.lab()
>>> m = iso.render(scene)
>>> m["brightness"].shape, m.units["brightness"]
((600, 800), 'W/m²')
"""

from __future__ import annotations

from . import errors, scenes
from ._isophote import __version__
from .analysis import GridMap, SurfaceMap, SurfaceTotals, grid, surface
from .camera import Camera, Sampling, Screen, Window
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
from .probing import Probes, Section, Values, probe, section
from .rendering import render
from .scene import Grid, Probe, Scene
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
