"""Lights. Positions and directions are in the scene's axes, lengths in its unit, angles in degrees.

Strengths are in W and W/sr, or in lm and cd in a photometric scene: a number, or one for each of red, green and blue.
"""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ._convert import Amount, Flag, Number, Vector, Whole, Word
from ._part import Part

__all__ = ["Ambient", "LambertianLight", "Light", "ParallelLight", "PointLight", "SpotLight"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Light(Part):
    """The fields common to all lights: a name, whether shapes block their light, and whether they are switched on."""

    name: Word | None = None
    casts_shadows: Flag = True
    on: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class PointLight(Light):
    """A point that emits equally in all directions (3.1): either ``intensity``, or ``power`` = 4π · ``intensity``."""

    position: Vector
    intensity: Amount | None = None
    power: Amount | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class LambertianLight(Light):
    """A point that emits I₀ cosγ (3.1), with γ the angle from its axis: either ``intensity`` I₀, or ``power`` = π I₀.

    It is aimed by its ``axis``, by the point ``target``, or by angles: ``tilt`` from −z, ``azimuth`` from +x towards +y."""

    _FIXED = MappingProxyType({"emission": "lambertian"})
    position: Vector
    intensity: Amount | None = None
    power: Amount | None = None
    axis: Vector | None = None
    target: Vector | None = None
    tilt: Number | None = None
    azimuth: Number | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class SpotLight(Light):
    """A point that emits its full intensity up to ``inner_angle`` from its axis, nothing beyond ``outer_angle``, and a
    smooth transition in between (3.7); aimed by its ``axis``, by the point ``target``, or by ``tilt``
    and ``azimuth``."""

    _FIXED = MappingProxyType({"emission": "spot"})
    position: Vector
    inner_angle: Number
    outer_angle: Number
    intensity: Amount | None = None
    power: Amount | None = None
    axis: Vector | None = None
    target: Vector | None = None
    tilt: Number | None = None
    azimuth: Number | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class ParallelLight(Light):
    """Light from one direction without attenuation, like sunlight (3.8): ``direction`` is the one in which it travels, which
    ``tilt`` and ``azimuth`` may say instead; ``irradiance`` is that on a plane perpendicular to it, in W/m² or lx."""

    _FIXED = MappingProxyType({"emission": "parallel"})
    direction: Vector | None = None
    irradiance: Amount
    tilt: Number | None = None
    azimuth: Number | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Ambient(Part):
    """Light from all around (3.9), with the same ``radiance`` (W/(m²·sr) or cd/m²) from every direction; with
    ``obstructed``, each point looks in ``samples`` directions for shapes that block it."""

    radiance: Amount
    obstructed: Flag = False
    samples: Whole = 64


_BY_EMISSION: dict[Any, type[Light]] = {
    None: PointLight,
    "isotropic": PointLight,
    "lambertian": LambertianLight,
    "spot": SpotLight,
    "parallel": ParallelLight,
}


def light_from_dict(written: dict[str, Any]) -> Light:
    """The light described by this table of a scene file."""
    kind = _BY_EMISSION[written.get("emission")]
    return kind.from_dict({key: value for key, value in written.items() if key != "emission"})
