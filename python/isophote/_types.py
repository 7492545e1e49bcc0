"""The closed sets of words, for type checkers; the core checks them when the program runs."""

from __future__ import annotations

from typing import Literal

from .materials import Convention

LengthUnit = Literal["m", "cm", "mm"]
Handedness = Literal["right", "left"]
Quantities = Literal["radiometric", "photometric"]
ColorSpace = Literal["rec709", "rec2020", "display-p3", "aces-cg"]
ConventionName = (
    Literal["irradiance", "lambert", "lab", "course", "course-pi", "radiance", "blinn-phong", "blinn-phong-pi"] | Convention
)
Projection = Literal["perspective", "orthographic", "fisheye-equidistant", "fisheye-equal-area", "panorama"]
Filter = Literal["box", "triangle", "gaussian", "mitchell"]
Side = Literal["front", "back"]
Precision = Literal["double", "single"]
Elsewhere = Literal["error", "nearest", "nan"]
SurfaceProjection = Literal["equirectangular", "equal-area"]
Normalization = Literal["max", "minmax", "log"]
Colormap = Literal["viridis", "cividis", "inferno", "batlow", "turbo"]
