"""Starter scenes, the same as those of the command ``isophote new``."""

from __future__ import annotations

from . import _isophote
from .scene import Scene

__all__ = ["course", "course_plane", "course_sphere", "lab", "photometric", "two_lights"]


def lab() -> Scene:
    """One sphere and one light: the lab's scene."""
    return _starter("lab")


def course() -> Scene:
    """A scene in millimetres with Lambertian lights."""
    return _starter("course")


def course_sphere() -> Scene:
    """The course's sphere, below a screen in the plane z = 0."""
    return _starter("course-sphere")


def course_plane() -> Scene:
    """The course's plane under a Lambertian lamp, with a circle of interest."""
    return _starter("course-plane")


def two_lights() -> Scene:
    """Two spheres and two lights, with the physically normalised radiance convention."""
    return _starter("two-lights")


def photometric() -> Scene:
    """A photometric scene: candela, lux and cd/m²."""
    return _starter("photometric")


def _starter(name: str) -> Scene:
    core = _isophote.Scene.from_text(_isophote.starter(name), False, f"scenes/{name}.toml", "")
    # Anything that would be warned about is intended.
    return Scene.of_core(core, "", warns=False)
