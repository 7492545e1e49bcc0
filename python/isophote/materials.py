"""Materials and brightness conventions."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from . import _isophote
from ._convert import Amount, Number
from ._part import Part

__all__ = ["Convention", "Material"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Material(Part):
    """The material of a surface. Coefficients are numbers, or one for each of red, green and blue; their unit is that of
    the convention.

    - ``diffuse``: the diffuse coefficient k_d, 0 to 1 where the convention makes it an albedo, 0 to 1e6 elsewhere
    - ``specular``: the specular coefficient k_s, likewise 0 to 1 or 0 to 1e6
    - ``shininess``: n, above 0 and up to 100,000; required unless k_s is 0
    """

    diffuse: Amount
    specular: Amount = 0.0
    shininess: Number | None = None


class Convention(str, Enum):
    """The formula that turns irradiance into brightness. Scenes accept both its members and their names."""

    IRRADIANCE = "irradiance"
    LAMBERT = "lambert"
    LAB = "lab"
    COURSE = "course"
    COURSE_PI = "course-pi"
    RADIANCE = "radiance"
    BLINN_PHONG = "blinn-phong"
    BLINN_PHONG_PI = "blinn-phong-pi"

    @property
    def number(self) -> str:
        """The formula's number in the documentation, such as ``"3.3"``."""
        return _FORMULAS[self.value][0]

    @property
    def formula(self) -> str:
        """The formula in readable form."""
        return _FORMULAS[self.value][1]


_FORMULAS = {name: (number, formula) for name, number, formula in _isophote.conventions()}
