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
    """The fields common to all lights.

    - ``name``: unique among the lights; by default ``light`` and a number
    - ``casts_shadows``: whether shapes block its light, where the scene has ``shadows``
    - ``on``: whether it is switched on
    """

    name: Word | None = None
    casts_shadows: Flag = True
    on: Flag = True


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class PointLight(Light):
    """A point that emits equally in all directions (3.1).

    - ``position``: a point, each coordinate within ±1e15 m, on no surface
    - ``intensity``: in W/sr or cd, 0 to 1e30
    - ``power``: instead, 4π times the intensity, in W or lm, 0 to 1e30
    """

    position: Vector
    intensity: Amount | None = None
    power: Amount | None = None


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class LambertianLight(Light):
    """A point that emits I₀ cosγ (3.1), with γ the angle from its axis.

    - ``position``: a point, each coordinate within ±1e15 m, on no surface
    - ``intensity``: I₀ in W/sr or cd, 0 to 1e30
    - ``power``: instead, π I₀, in W or lm, 0 to 1e30
    - ``axis``: where it is aimed, a direction of any length but 0
    - ``target``: instead, a point to aim at, each coordinate within ±1e15 m
    - ``tilt``: instead, the angle of the axis from −z in degrees, 0 to 180: 0 is straight down
    - ``azimuth``: with it, the way that the axis leans, from +x towards +y, in degrees, −360 to 360
    """

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
    """A point that emits its full intensity near its axis, and none far from it (3.7).

    - ``position``: a point, each coordinate within ±1e15 m, on no surface
    - ``inner_angle``: up to this angle from the axis all of the intensity, in degrees, 0 to 89.5
    - ``outer_angle``: beyond this one nothing, in degrees, 0.5 to 90 and at least 0.5 above the inner one; smooth in
      between
    - ``intensity``: on the axis, in W/sr or cd, 0 to 1e30
    - ``power``: instead, of the whole cone, in W or lm, 0 to 1e30
    - ``axis``: where it is aimed, a direction of any length but 0
    - ``target``: instead, a point to aim at, each coordinate within ±1e15 m
    - ``tilt``: instead, the angle of the axis from −z in degrees, 0 to 180: 0 is straight down
    - ``azimuth``: with it, the way that the axis leans, from +x towards +y, in degrees, −360 to 360
    """

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
    """Light from one direction without attenuation, like sunlight (3.8).

    - ``direction``: the one in which it travels, of any length but 0
    - ``tilt``: instead, the angle of that direction from −z in degrees, 0 to 180: 0 is straight down
    - ``azimuth``: with it, the way that it leans, from +x towards +y, in degrees, −360 to 360
    - ``irradiance``: on a plane perpendicular to it, in W/m² or lx, 0 to 1e30
    """

    _FIXED = MappingProxyType({"emission": "parallel"})
    direction: Vector | None = None
    irradiance: Amount
    tilt: Number | None = None
    azimuth: Number | None = None

    @property
    def position(self) -> None:
        """It has none: ``None``."""

    @property
    def intensity(self) -> None:
        """It has none: ``None``."""

    @property
    def power(self) -> None:
        """It has none: ``None``."""


AnyLight = PointLight | LambertianLight | SpotLight | ParallelLight
"""Any kind of light."""


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Ambient(Part):
    """Light from all around (3.9), the same from every direction.

    - ``radiance``: in W/(m²·sr) or cd/m², 0 to 1e30
    - ``obstructed``: whether shapes block it
    - ``samples``: then, in how many directions each point looks for them, 1 to 4096
    """

    radiance: Amount
    obstructed: Flag = False
    samples: Whole = 64


_BY_EMISSION: dict[Any, type[AnyLight]] = {
    None: PointLight,
    "isotropic": PointLight,
    "lambertian": LambertianLight,
    "spot": SpotLight,
    "parallel": ParallelLight,
}


def light_from_dict(written: dict[str, Any]) -> AnyLight:
    """The light described by this table of a scene file."""
    kind = _BY_EMISSION[written.get("emission")]
    return kind.from_dict({key: value for key, value in written.items() if key != "emission"})
