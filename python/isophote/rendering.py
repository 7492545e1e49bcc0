"""Rendering scenes to maps."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _isophote
from ._convert import Invalid, Size, whole
from ._progress import Progress, reporter
from ._types import Precision
from .errors import ArgumentError
from .map import Map
from .scene import Scene, SceneOrPath, scene_of

__all__ = ["Channels", "channel_names", "render"]

Channels = str | Sequence[str] | None
"""Channel names; ``"lights"`` stands for the irradiance from each light, ``"light-brightness"`` for the brightness from each,
``"all"`` for all available channels but the latter."""


def channel_names(scene: Scene, channels: Channels) -> list[str]:
    """The channel names, with ``"lights"`` and ``"all"`` expanded."""
    color = ["color"] if scene.core.has_color else []
    if channels is None:
        return ["brightness", *color]
    if not isinstance(channels, (str, Iterable)):
        raise ArgumentError(f"channels is {channels!r}; allowed: names of channels")
    about = scene.core.describe()
    lights = [f"light.{name}" for name in about["lights"]]
    common = ["brightness", *color, "irradiance", "diffuse", "specular", "depth", "position", "normal", "shape"]
    of_camera = ["z-depth", "cos_theta_o", "camera-normal", "material"]
    ambient = ["ambient", *(["ambient-error"] if scene.ambient is not None and scene.ambient.obstructed else [])]
    sampling = ["samples", "coverage"] if about["is_sampled"] else []
    if scene.sampling is not None and scene.sampling.tolerance is not None:
        sampling.append("sampling-error")
    everything = [*common, *(ambient if scene.ambient is not None else []), *sampling, *of_camera, *lights]
    words = {
        "all": everything,
        "lights": lights,
        "light-brightness": [f"brightness.{name}" for name in about["lights"]],
    }
    wanted: list[str] = []
    for name in [channels] if isinstance(channels, str) else channels:
        if not isinstance(name, str):
            raise ArgumentError(f"channels has {name!r} in it; allowed: names of channels")
        wanted.extend(words.get(name, [name]))
    if not wanted:
        raise ArgumentError("no channel is asked for")
    return list(dict.fromkeys(wanted))


def threads_of(threads: int | None) -> int | None:
    """A valid number of threads, or ``None``."""
    return None if threads is None else positive(threads, "threads")


def positive(value: int, name: str) -> int:
    """An integer of at least 1."""
    return counted(value, name, 1)


def counted(value: int, name: str, least: int = 0, bound: int = 2**31) -> int:
    """An integer within bounds."""
    try:
        number = whole(value)
    except Invalid as invalid:
        raise ArgumentError(f"{name} {invalid.message}; {invalid.allowed}") from None
    if not least <= number < bound:
        raise ArgumentError(f"{name} is {number}; allowed: whole numbers from {least}")
    return number


def render(
    scene: SceneOrPath,
    *,
    channels: Channels = None,
    size: Size | None = None,
    region: tuple[int, int, int, int] | None = None,
    precision: Precision = "double",
    threads: int | None = None,
    out: Mapping[str, NDArray[Any]] | None = None,
    progress: Progress = None,
) -> Map:
    """The map of a scene, or of a file that has one.

    ``channels``: names such as ``"brightness"`` (the default, with ``"color"`` if the scene has colours),
    ``"irradiance"``, ``"normal"``, ``"light.lamp"``; ``"lights"`` for every light separately, ``"all"`` for everything.
    ``"light-brightness"`` is the brightness from every light separately, ``brightness.lamp`` and so on; each takes the time of
    another map.
    ``size``: columns and rows, instead of the scene's resolution.
    ``region``: first column, first row, columns, rows: render only this part of the image.
    ``precision``: ``"double"``, or ``"single"`` at about twice the speed; docs/python/errors.md gives the error bounds.
    ``threads``: by default one per processor. The number never changes the result, not even by a bit.
    ``out``: arrays by channel, such as ``{"brightness": images[7]}``: the values are written there too, which saves a loop
    that collects images a copy of each. They must have the shape and the type of the map's own, and be contiguous; ``"mask"``
    is one of booleans. Without ``channels``, these are the channels.
    ``progress``: a function of two numbers, the pixels done and the total; or ``True`` for a progress bar.

    The interpreter's lock is released while rendering, and Ctrl-C stops it.
    """
    scene = scene_of(scene)
    if size is not None:
        scene = scene.with_resolution(size)
    if out is not None and not isinstance(out, Mapping):
        raise ArgumentError(f"out is {out!r}; allowed: a dictionary from channels to arrays")
    if channels is None and out is not None:
        channels = [name for name in out if name != "mask"] or None
    names = channel_names(scene, channels)
    bounds = None
    if region is not None:
        if not isinstance(region, Iterable) or isinstance(region, str):
            raise ArgumentError(f"region is {region!r}; allowed: first column, first row, columns, rows")
        bounds = [counted(value, "a number of region") for value in region]
        if len(bounds) != 4:
            raise ArgumentError(f"region has {len(bounds)} numbers; allowed: first column, first row, columns, rows")
    if not isinstance(precision, str):
        raise ArgumentError(f"precision is {precision!r}; allowed: double, single")
    with reporter(progress, "pixels") as report:
        core = _isophote.render(scene.core, names, precision, bounds, threads_of(threads), report)
    if out is not None:
        _fill(out, core)
    return Map(core, scene)


def _fill(out: Mapping[str, NDArray[Any]], core: _isophote.Map) -> None:
    """Writes the channels of a map into arrays; none of them is touched if one does not fit."""
    held = {name for name, _ in core.units()}
    for name, array in out.items():
        if name != "mask" and name not in held:
            raise ArgumentError(f"out has {name!r}, which is not rendered; allowed: {', '.join(sorted(held))}, mask")
        own = core.shapes() if name == "mask" else core.channel(name)
        kind = np.dtype(bool) if name == "mask" else own.dtype
        if not isinstance(array, np.ndarray) or array.shape != own.shape or array.dtype != kind:
            given = f"{array.dtype} {array.shape}" if isinstance(array, np.ndarray) else repr(array)
            raise ArgumentError(f"out[{name!r}] is {given}; allowed: an array of {kind} {own.shape}")
        if not (array.flags.c_contiguous and array.flags.writeable):
            raise ArgumentError(f"out[{name!r}] is read-only or has gaps; allowed: a contiguous array that can be written")
    for name, array in out.items():
        # Only pixels that see a surface are copied.
        array[...] = 0
        core.copy_into(None if name == "mask" else name, array)
