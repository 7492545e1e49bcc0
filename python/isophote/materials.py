"""Materials and the conventions of brightness."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from . import _isophote
from ._convert import Amount, Number
from ._part import Part

__all__ = ["Convention", "Material"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Material(Part):
    """What a surface is made of: the diffuse coefficient k_d, the specular one k_s (numbers, or one for each of red, green
    and blue), and the shininess n, which must be given where k_s is not 0."""

    diffuse: Amount
    specular: Amount = 0.0
    shininess: Number | None = None


class Convention(str, Enum):
    """Which formula turns irradiance into brightness. Scenes take its members and their names alike."""

    IRRADIANCE = "irradiance"
    LAMBERT = "lambert"
    LAB = "lab"
    COURSE = "course"
    COURSE_PI = "course-pi"
    RADIANCE = "radiance"

    @property
    def number(self) -> str:
        """The number of its formula in the documentation, such as ``"3.3"``."""
        return _FORMULAS[self.value][0]

    @property
    def formula(self) -> str:
        """Its formula, as a person writes it."""
        return _FORMULAS[self.value][1]


_FORMULAS = {name: (number, formula) for name, number, formula in _isophote.conventions()}
