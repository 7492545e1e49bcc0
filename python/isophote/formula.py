"""The bare formula, for callers with their own geometry."""

from __future__ import annotations

import json
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _isophote
from ._convert import word
from .errors import ArgumentError, ProbeError
from .lights import Ambient, Light
from .materials import Convention, Material
from .probing import numbers

__all__ = ["brightness"]


def brightness(
    normals: ArrayLike,
    positions: ArrayLike,
    lights: Light | Sequence[Light],
    material: Material,
    convention: str | Convention = "radiance",
    *,
    eye: ArrayLike = (0.0, 0.0, 0.0),
    ambient: Ambient | None = None,
    quantities: str = "radiometric",
) -> NDArray[np.float64]:
    """The brightness (3.1) to (3.12) at points with given unit normals, summed over the lights, without shadows.

    ``normals`` and ``positions``: arrays of any shape (…, 3), in metres; the result has the shape (…). ``eye``: one point
    (3,), or one per position. Light positions are in metres too. Normals must have length 1 to within 1e-6.
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
    lengths = np.linalg.norm(directions, axis=1)
    # NaN is wrong too.
    wrong = np.flatnonzero(~(np.abs(lengths - 1.0) <= 1e-6))
    if wrong.size:
        raise ProbeError(f"normal {wrong[0]} has the length {lengths[wrong[0]]}; allowed: 1", wrong.tolist())
    for array, name in ((placed, "position"), (eyes, "eye")):
        wrong = np.flatnonzero(~(np.abs(array) <= _FARTHEST).all(axis=1))
        if wrong.size:
            where = array[wrong[0]].tolist()
            raise ProbeError(f"{name} {wrong[0]} is {where}; allowed: finite numbers up to {_FARTHEST:g} m", wrong.tolist())
    of_scene = (lights,) if isinstance(lights, Light) else tuple(lights)
    for light in of_scene:
        if not isinstance(light, Light):
            raise ArgumentError(f"lights has {light!r} in it; allowed: lights")
    # The formula needs neither a camera nor shapes: the eye is given, and no rays are traced.
    written = {
        "version": 1,
        "length": "m",
        "convention": word(convention),
        "quantities": word(quantities),
        "camera": {"eye": [0, 0, 0], "forward": [0, 0, 1], "screen": {"distance": 1, "x": [-1, 1], "y": [-1, 1]}},
        "material": {"material": material.to_dict()},
        "light": [light.to_dict() for light in of_scene],
        **({} if ambient is None else {"ambient": ambient.to_dict()}),
    }
    core = _isophote.Scene.from_json(json.dumps(written), "")
    if core.has_color:
        raise ArgumentError("the bare formula takes single numbers; call it once for each component of a colour")
    values = _isophote.brightness(
        core, np.ascontiguousarray(placed), np.ascontiguousarray(directions), np.ascontiguousarray(eyes)
    )
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        raise ProbeError(f"position {wrong[0]} is where a light or the eye is", wrong.tolist())
    return values.reshape(shape[:-1])


_FARTHEST = 1e15
"""The largest distance allowed in a scene."""


def _vectors(values: ArrayLike, name: str) -> NDArray[np.float64]:
    array = numbers(values, name)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ProbeError(f"{name} has the shape {array.shape}; allowed: (…, 3)")
    return array.astype(np.float64)
