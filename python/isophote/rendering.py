"""Rendering scenes to maps."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

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
    ``progress``: a function of two numbers, the pixels done and the total; or ``True`` for a progress bar.

    The interpreter's lock is released while rendering, and Ctrl-C stops it.
    """
    scene = scene_of(scene)
    if size is not None:
        scene = scene.with_resolution(size)
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
    return Map(core, scene)
