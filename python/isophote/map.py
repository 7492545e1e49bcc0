"""Maps: images of channels with units."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import NDArray

from . import _html, _isophote
from ._convert import FrozenDict, Invalid, number
from ._types import Colormap, Normalization
from ._xarray import NOT_SCALAR
from .errors import ArgumentError

if TYPE_CHECKING:
    import matplotlib.axes
    import xarray
    from typing_extensions import Self

    from .scene import Scene

__all__ = ["Axis", "Isophote", "Map"]


@dataclass(frozen=True)
class Axis:
    """One direction of a map.

    - ``name``: of the xarray dimension
    - ``title``: for figures
    - ``unit``: ``"1"`` for pure numbers
    - ``edges``: the first and the last, in this unit
    """

    name: str
    title: str
    unit: str
    edges: tuple[float, float]

    @property
    def label(self) -> str:
        """The axis label in figures."""
        return self.title if self.unit in ("", "1") else f"{self.title}, {self.unit}"


@dataclass(frozen=True)
class Isophote:
    """A contour.

    - ``level``: in the channel's unit
    - ``lines``: arrays of x and y, n × 2, in the units of the map's axes; closed lines end at their first point
    """

    level: float
    lines: tuple[NDArray[np.float64], ...]


class Map(Mapping[str, NDArray[Any]]):
    """A map: a dictionary from channel names to arrays.

    The arrays are views of the map's own memory, float64 (float32 in single precision, int32 for ``shape`` and
    ``material``), of shape height × width, or height × width × 3 for ``position``, ``normal``, ``camera-normal`` and
    ``color``. Row 0 is at the top. They are read-only. Where no surface is seen they are 0 (``shape`` and ``material`` are
    −1); :attr:`mask`, which ``m["mask"]`` gives too, tells these pixels from dark ones.

    Maps are copied and pickled with their values, so they can be sent to other processes. They never change.
    """

    def __init__(self, core: _isophote.Map, scene: Scene) -> None:
        self._core = core
        self._scene = scene
        self._units = FrozenDict(core.units())

    def __hash__(self) -> int:
        return object.__hash__(self)

    def __eq__(self, other: object) -> bool:
        return self is other

    @overload
    def __getitem__(self, channel: Literal["position", "normal", "camera-normal", "color"]) -> NDArray[np.float64]: ...
    @overload
    def __getitem__(self, channel: Literal["shape", "material"]) -> NDArray[np.int32]: ...
    @overload
    def __getitem__(self, channel: Literal["mask"]) -> NDArray[np.bool_]: ...
    @overload
    def __getitem__(self, channel: str) -> NDArray[Any]: ...
    def __getitem__(self, channel: str) -> NDArray[Any]:
        if channel in self.units:
            return self._array(channel)
        if channel == "mask":
            return self.mask
        raise KeyError(self._missing(channel))

    def _array(self, channel: str) -> NDArray[Any]:
        array: NDArray[Any] = self._core.channel(channel)
        return array

    def _missing(self, channel: str) -> str:
        return f"this map has no channel {channel!r}; it has {', '.join(self)}: ask for others with channels=[…]"

    def __iter__(self) -> Iterator[str]:
        return iter(self.units)

    def __len__(self) -> int:
        return len(self.units)

    def __contains__(self, channel: object) -> bool:
        return channel in self.units or channel == "mask"

    def _ipython_key_completions_(self) -> list[str]:
        return [*self, "mask"]

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, _memo: dict[int, Any]) -> Self:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        state = {name: value for name, value in self.__dict__.items() if name != "_core"}
        channels = [(name, self[name]) for name in self]
        return _unpickle, (type(self), state, json.dumps(self.metadata), channels, self.shapes)

    @property
    def scene(self) -> Scene:
        """The scene that was rendered."""
        return self._scene

    @property
    def units(self) -> Mapping[str, str]:
        """The unit of each channel: ``"1"`` for pure numbers, ``""`` for indices."""
        return self._units

    @property
    def shape(self) -> tuple[int, int]:
        """The number of rows and columns."""
        _, _, width, height = self.region
        return height, width

    @property
    def region(self) -> tuple[int, int, int, int]:
        """The part of the image that the map holds: first column, first row, columns, rows."""
        column, row, width, height = self._core.region()
        return column, row, width, height

    @property
    def over_tolerance(self) -> int | None:
        """The number of pixels in which the allowed number of rays does not assure the tolerance (2.6): their
        ``sampling-error`` exceeds it. ``None`` for a scene without a tolerance."""
        return self._core.over_tolerance()

    @property
    def shapes(self) -> NDArray[np.int32]:
        """The index of the shape at each pixel, −1 where no surface is seen."""
        return self._core.shapes()

    @property
    def has_mask(self) -> bool:
        """Whether it is known where a surface is seen: always, except for some files."""
        return True

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Where a surface is seen."""
        return self.shapes >= 0

    @property
    def metadata(self) -> dict[str, Any]:
        """The metadata of the map, as stored in its files."""
        metadata: dict[str, Any] = json.loads(self._core.metadata())
        return metadata

    @property
    def axes(self) -> tuple[Axis, Axis]:
        """The axis from left to right, and the axis from bottom to top."""
        return axes_of(self._core)

    def coordinates(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The positions of the centres of columns and rows, in the units of the axes."""
        height, width = self.shape
        x, y = self.axes
        columns = (np.arange(width) + 0.5) / width
        rows = (np.arange(height) + 0.5) / height
        # Row 0 is at the top.
        return _between(*x.edges, columns), _between(y.edges[1], y.edges[0], rows)

    @property
    def lights(self) -> tuple[str, ...]:
        """The lights whose individual irradiance the map holds."""
        return tuple(name.removeprefix("light.") for name in self.units if name.startswith("light."))

    def light_images(self) -> NDArray[Any]:
        """The irradiance from each of the :attr:`lights` alone: lights × height × width."""
        if not self.lights:
            raise ArgumentError('this map has no image of a light; render it with channels=["lights"]')
        return np.stack([self[f"light.{name}"] for name in self.lights])

    def _main(self, channel: str | None) -> str:
        """The given channel, or by default the first scalar one."""
        if channel is not None:
            if channel not in self.units:
                raise KeyError(self._missing(channel))
            return channel
        for name in self.units:
            if name not in NOT_SCALAR:
                return name
        raise ArgumentError(f"say which channel: none of {', '.join(self.units)} is one number a pixel")

    def _statistics(self, channel: str | None) -> tuple[Any, Any, float]:
        found = self._core.statistics(self._main(channel))
        if found is None:
            raise ArgumentError("no surface is seen: there is no extreme and no mean")
        return found

    def max(self, channel: str | None = None) -> float:
        """The maximum over the pixels that see a surface, by default of the first scalar channel."""
        return float(self._statistics(channel)[1][0])

    def min(self, channel: str | None = None) -> float:
        """The minimum over the pixels that see a surface."""
        return float(self._statistics(channel)[0][0])

    def mean(self, channel: str | None = None) -> float:
        """The mean over the pixels that see a surface."""
        return float(self._statistics(channel)[2])

    def argmax(self, channel: str | None = None) -> tuple[int, int]:
        """Row and column of the maximum; the first one if there are several."""
        column, row = self._statistics(channel)[1][1]
        return row, column

    def argmin(self, channel: str | None = None) -> tuple[int, int]:
        """Row and column of the minimum over the pixels that see a surface."""
        column, row = self._statistics(channel)[0][1]
        return row, column

    def isophotes(self, levels: int | Sequence[float] = 6, *, channel: str | None = None) -> list[Isophote]:
        """Contours of a channel, at the given levels or at about that many round ones. They stop at silhouettes."""
        channel = self._main(channel)
        if isinstance(levels, (int, np.integer)):
            if not 0 <= levels <= _MOST_LEVELS:
                raise ArgumentError(f"levels is {levels}; allowed: 0 to {_MOST_LEVELS}")
            levels = _isophote.nice_levels(self.min(channel), self.max(channel), int(levels)) if self.mask.any() else []
        if len(levels) > _MOST_LEVELS:
            raise ArgumentError(f"there are {len(levels)} levels; allowed: at most {_MOST_LEVELS}")
        found = self._core.isophotes(channel, [float(level) for level in levels])
        return [Isophote(level, tuple(_closed(line, is_closed) for line, is_closed in lines)) for level, lines in found]

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        channel: str | None = None,
        range: tuple[float, float] | None = None,
        normalize: Normalization | None = None,
        gamma: float | None = None,
        bits: int | None = None,
        colormap: Colormap | None = None,
    ) -> None:
        """Writes a file, completely or not at all: ``.exr``, ``.npz`` and ``.csv`` get all channels and ``shape``, from
        which :func:`~isophote.read` takes the mask; ``.npy`` gets one channel, ``.png`` is a picture of one.

        The other options are for pictures alone. ``normalize`` says how values v become levels: ``"max"``, the default,
        proportionally, v/max; ``"minmax"`` stretched from the minimum to the maximum, (v − min)/(max − min); ``"log"`` by the
        logarithm, over three decades up to the maximum. ``range`` sets the values of black and white itself, in the
        channel's unit; with ``"log"`` both must be above 0. Levels are raised to the power 1/``gamma`` (1; above 0), with 8
        or 16 ``bits`` (8), or shown in the colours of ``colormap``.
        """
        suffix = os.path.splitext(os.fspath(path))[1].lower()
        holds_all = suffix in (".exr", ".npz", ".csv")
        given = {"range": range, "normalize": normalize, "gamma": gamma, "bits": bits, "colormap": colormap}
        idle = [name for name, value in given.items() if value is not None and suffix in (".exr", ".npz", ".csv", ".npy")]
        if holds_all and channel is not None:
            idle.insert(0, "channel")
        if idle:
            allowed = "for .npy and .png" if idle[0] == "channel" else "for .png"
            raise ArgumentError(f"{idle[0]} has no effect on a {suffix} file; allowed: {allowed}")
        if channel is None:
            channel = (
                "color" if suffix == ".png" and "color" in self else next(iter(self)) if holds_all else self._main(None)
            )
        if channel not in self.units:
            raise KeyError(self._missing(channel))
        if channel == "color":
            shared = "whose components share one scale from 0 to the largest"
            for name, why in (("normalize", shared), ("gamma", _ENCODED), ("colormap", _ENCODED)):
                if given[name] is not None:
                    raise ArgumentError(f"{name} has no effect on the channel 'color', {why}")
        bounds = None
        if range is not None:
            bounds = [_number(bound, "range") for bound in range]
            if len(bounds) != 2:
                raise ArgumentError(f"range has {len(bounds)} numbers; allowed: the values of black and white")
        if bits not in (None, 8, 16):
            raise ArgumentError(f"bits is {bits!r}; allowed: 8, 16")
        power = 1.0 if gamma is None else _number(gamma, "gamma")
        depth = 8 if bits is None else int(bits)
        self._core.save(os.fspath(path), channel, bounds, normalize or "max", power, depth, colormap)

    def to_xarray(self) -> xarray.Dataset:
        """An xarray Dataset: dims ``("y", "x")`` with coordinates in their units, ``units`` in the attributes; vectors
        have a third dimension, and ``visible`` is true where a surface is seen."""
        from ._xarray import dataset

        return dataset(self)

    def plot(
        self,
        channel: str | None = None,
        *,
        isophotes: bool | int | Sequence[float] = 0,
        ax: matplotlib.axes.Axes | None = None,
        **imshow: Any,
    ) -> matplotlib.axes.Axes:
        """Draws a channel with matplotlib, with axes and a colour bar in units.

        ``isophotes``: levels, or about how many round ones; ``True`` for about six. They are labelled where there is room.
        ``ax``: where to draw; by default the current axes, or a new figure if these hold something already. Further
        options are passed to ``imshow``, except ``extent`` and ``origin``, which are the map's own.
        """
        from ._plots import plot_map

        return plot_map(self, channel, isophotes, ax, imshow)

    def __repr__(self) -> str:
        height, width = self.shape
        units = (f"{name} [{unit}]" if unit not in ("", "1") else name for name, unit in self.units.items())
        return f"<Map {width}×{height}: {', '.join(units)}; {self.metadata['convention']}, {self.metadata['renderer']}>"

    def _repr_html_(self) -> str:
        rows = [("map", repr(self)[1:-1])]
        thumbnail = ""
        name = next((name for name in self if name not in NOT_SCALAR), None)
        if name is not None and self.mask.any():
            unit = self.units[name]
            for what, value in (("max", self.max(name)), ("min", self.min(name)), ("mean", self.mean(name))):
                rows.append((f"{name}, {what}", f"{value:.6g} {unit}"))
            png = self._core.png("color", None) if "color" in self else self._core.png(name, "viridis")
            thumbnail = _html.image(png, name)
        rows.append(("visible", f"{self._core.visible()} of {self.shape[0] * self.shape[1]} pixels"))
        return f"{thumbnail}{_html.table(rows)}{self.scene._repr_html_()}"


def axes_of(core: _isophote.Map) -> tuple[Axis, Axis]:
    """The axes of a map of the compiled part."""
    x, y = (Axis(name, title, unit, (edges[0], edges[1])) for name, title, unit, edges in core.axes())
    return x, y


_MOST_LEVELS = 1000
_ENCODED = "which is encoded as sRGB"


def _unpickle(
    kind: type[Map],
    state: dict[str, Any],
    metadata: str,
    channels: list[tuple[str, NDArray[Any]]],
    shapes: NDArray[np.int32],
) -> Map:
    found = object.__new__(kind)
    found.__dict__.update(state, _core=_isophote.Map.of(metadata, channels, shapes))
    return found


def _number(value: float, name: str) -> float:
    try:
        return number(value)
    except Invalid as invalid:
        raise ArgumentError(f"{name} {invalid.message}; {invalid.allowed}") from None


def _between(first: float, last: float, part: NDArray[np.float64]) -> NDArray[np.float64]:
    return first * (1.0 - part) + last * part


def _closed(line: NDArray[np.float64], is_closed: bool) -> NDArray[np.float64]:
    return np.concatenate([line, line[:1]]) if is_closed else line
