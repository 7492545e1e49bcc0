"""Scenes to start from, the same as the command's ``isophote new``."""

from __future__ import annotations

from . import _isophote
from .scene import Scene

__all__ = ["course", "lab", "photometric", "two_lights"]


def lab() -> Scene:
    """One sphere and one light: the lab's scene."""
    return _starter("lab")


def course() -> Scene:
    """Millimetres and Lambertian lights."""
    return _starter("course")


def two_lights() -> Scene:
    """Two spheres and two lights, by physically normalised radiance."""
    return _starter("two-lights")


def photometric() -> Scene:
    """Candela, lux and cd/m²."""
    return _starter("photometric")


def _starter(name: str) -> Scene:
    core = _isophote.Scene.from_text(_isophote.starter(name), False, f"scenes/{name}.toml", "")
    # They are as they are on purpose.
    return Scene.of_core(core, "", warns=False)
