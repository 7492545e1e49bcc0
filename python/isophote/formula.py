"""The bare formula, for callers with their own geometry."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _isophote
from ._convert import Invalid, word
from ._types import ConventionName, Quantities
from ._words import Named
from .errors import ArgumentError, ProbeError
from .lights import Ambient, AnyLight, Light
from .materials import Material
from .probing import numbers

__all__ = ["brightness"]


def brightness(
    normals: ArrayLike,
    positions: ArrayLike,
    lights: AnyLight | Sequence[AnyLight],
    material: Material,
    convention: ConventionName = "radiance",
    *,
    eye: ArrayLike = (0.0, 0.0, 0.0),
    ambient: Ambient | None = None,
    quantities: Quantities = "radiometric",
    where: ArrayLike | None = None,
) -> NDArray[np.float64]:
    """The brightness (3.1) to (3.12) at points with given unit normals, summed over the lights, without shadows.

    ``normals`` and ``positions``: arrays of any shape (…, 3), in metres; the result has the shape (…). ``eye``: one point
    (3,), or one per position. Light positions are in metres too. Normals must have length 1 to within 1e-6.
    ``where``: booleans of the shape (…): only there is the brightness computed, elsewhere it is 0, as in a map, and normals
    and positions may be anything. So ``brightness(m["normal"], m["position"], …, where=m.mask)`` takes a map's own arrays.
    """
    placed, directions, eyes = _vectors(positions, "positions"), _vectors(normals, "normals"), _vectors(eye, "eye")
    try:
        shape = np.broadcast_shapes(placed.shape, directions.shape)
    except ValueError:
        raise ProbeError(f"normals {directions.shape} and positions {placed.shape} do not fit together") from None
    placed, directions = (np.broadcast_to(array, shape).reshape(-1, 3) for array in (placed, directions))
    if eyes.shape not in ((3,), shape):
        raise ProbeError(f"eye has the shape {eyes.shape}; allowed: (3,), {shape}")
    eyes = eyes.reshape(-1, 3)
    # The indices of the points to compute, among all; errors name the latter.
    chosen = np.arange(len(placed)) if where is None else np.flatnonzero(_mask(where, shape[:-1]))
    if where is not None:
        placed, directions = placed[chosen], directions[chosen]
        eyes = eyes if len(eyes) == 1 else eyes[chosen]
    lengths = np.linalg.norm(directions, axis=1)
    # NaN is wrong too.
    wrong = np.flatnonzero(~(np.abs(lengths - 1.0) <= 1e-6))
    if wrong.size:
        length = lengths[wrong[0]]
        hint = "; where= leaves points out" if length == 0 and where is None else ""
        raise ProbeError(f"normal {chosen[wrong[0]]} has the length {length}; allowed: 1{hint}", chosen[wrong].tolist())
    for array, name in ((placed, "position"), (eyes, "eye")):
        wrong = np.flatnonzero(~(np.abs(array) <= _FARTHEST).all(axis=1))
        if wrong.size:
            value, numbered = array[wrong[0]].tolist(), wrong if len(array) == 1 else chosen[wrong]
            message = f"{name} {numbered[0]} is {value}; allowed: finite numbers up to {_FARTHEST:g} m"
            raise ProbeError(message, numbered.tolist())
    if not isinstance(material, Material):
        raise ArgumentError(f"material is {material!r}; allowed: a Material, such as Material(diffuse=0.5)")
    if ambient is not None and not isinstance(ambient, Ambient):
        raise ArgumentError(f"ambient is {ambient!r}; allowed: an Ambient, None")
    if not isinstance(lights, (Light, Iterable)):
        raise ArgumentError(f"lights is {lights!r}; allowed: a light, or a list of lights")
    of_scene = (lights,) if isinstance(lights, Light) else tuple(lights)
    for light in of_scene:
        if not isinstance(light, Light):
            raise ArgumentError(f"lights has {light!r} in it; allowed: lights")
    # The formula needs neither a camera nor shapes: the eye is given, and no rays are traced.
    written = {
        "version": 1,
        "length": "m",
        "convention": _word(convention, "convention"),
        "quantities": _word(quantities, "quantities"),
        "camera": {"eye": [0, 0, 0], "forward": [0, 0, 1], "screen": {"distance": 1, "x": [-1, 1], "y": [-1, 1]}},
        "material": {"material": material.to_dict()},
        "light": [light.to_dict() for light in of_scene],
        **({} if ambient is None else {"ambient": ambient.to_dict()}),
    }
    named = Named(lights=of_scene, materials={"material": material})
    core = named.checked(lambda: _isophote.Scene.from_json(json.dumps(written), ""))
    if core.has_color:
        raise ArgumentError("the bare formula takes single numbers; call it once for each component of a colour")
    values = _isophote.brightness(
        core, np.ascontiguousarray(placed), np.ascontiguousarray(directions), np.ascontiguousarray(eyes)
    )
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        raise ProbeError(f"position {chosen[wrong[0]]} is where a light or the eye is", chosen[wrong].tolist())
    if where is not None:
        computed, values = values, np.zeros(int(np.prod(shape[:-1])))
        values[chosen] = computed
    return values.reshape(shape[:-1])


_FARTHEST = 1e15
"""The largest distance allowed in a scene."""


def _mask(where: ArrayLike, shape: tuple[int, ...]) -> NDArray[np.bool_]:
    mask = np.asarray(where)
    if mask.dtype != np.bool_:
        raise ProbeError(f"where is of {mask.dtype}; allowed: booleans, such as the mask of a map")
    try:
        return np.broadcast_to(mask, shape)
    except ValueError:
        raise ProbeError(f"where has the shape {mask.shape}; allowed: {shape}") from None


def _word(value: str, name: str) -> str:
    try:
        return word(value)
    except Invalid as invalid:
        raise ArgumentError(f"{name} {invalid.message}; {invalid.allowed}") from None


def _vectors(values: ArrayLike, name: str) -> NDArray[np.float64]:
    array = numbers(values, name)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ProbeError(f"{name} has the shape {array.shape}; allowed: (…, 3)")
    return array.astype(np.float64)
