"""Exact values at points, and along lines."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _html, _isophote
from ._progress import Progress, reporter
from ._types import Elsewhere
from ._xarray import COMPONENTS, needed
from .errors import ArgumentError, ProbeError
from .rendering import counted, positive
from .scene import Scene, SceneOrPath, scene_of

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

__all__ = ["Probes", "Section", "Values", "probe", "section"]


class Values(Mapping[str, NDArray[Any]]):
    """Values at n points: a dictionary from names to arrays with n rows, which are also attributes.

    ``position`` and ``normal`` (n × 3), ``brightness``, ``irradiance``, ``ambient``, ``diffuse``, ``specular``,
    ``cos_theta_o``, ``shape`` and ``part`` (indices), ``seen`` (whether the eye sees the point). Where there is no surface
    they are NaN, and ``shape`` and ``part`` are −1.

    The keys are columns with one number for each point, so that ``pandas.DataFrame(dict(values))`` is a table: instead of
    ``position`` they have ``position.x``, ``position.y`` and ``position.z``, instead of ``lights`` ``light.NAME`` for each
    light. ``values["position"]`` is the whole array all the same.
    """

    position: NDArray[np.float64]
    normal: NDArray[np.float64]
    brightness: NDArray[np.float64]
    irradiance: NDArray[np.float64]
    ambient: NDArray[np.float64]
    diffuse: NDArray[np.float64]
    specular: NDArray[np.float64]
    cos_theta_o: NDArray[np.float64]
    color: NDArray[np.float64]
    shape: NDArray[np.int32]
    part: NDArray[np.int32]
    seen: NDArray[np.bool_]

    def __init__(self, scene: Scene, arrays: Mapping[str, NDArray[Any]], names: Sequence[str]) -> None:
        self._scene = scene
        self._arrays = dict(arrays)
        for array in self._arrays.values():
            array.flags.writeable = False
        self._names = list(names)

    def __hash__(self) -> int:
        return object.__hash__(self)

    def __eq__(self, other: object) -> bool:
        return self is other

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for array in self._arrays.values():
            array.flags.writeable = False

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self._held():
            return self._array(name)
        columns = self._columns
        if name not in columns:
            raise KeyError(f"there is no {name!r}; there are: {', '.join(self._held())}")
        array, number = columns[name]
        column: NDArray[Any] = self._array(array)[..., number]
        return column

    def __contains__(self, name: object) -> bool:
        return name in self._held() or name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def _held(self) -> Sequence[str]:
        """The names of the arrays."""
        return tuple(self._arrays)

    def _array(self, name: str) -> NDArray[Any]:
        return self._arrays[name]

    @functools.cached_property
    def _columns(self) -> dict[str, tuple[str, Any]]:
        """For each column the array that it is part of, and its index there; an array of numbers is a column itself."""
        columns: dict[str, tuple[str, Any]] = {}
        for name in self._held():
            if name == "lights":
                labels = [f"light.{light}" for light in self._scene.core.describe()["lights"]]
            elif name in COMPONENTS or name == "screen":
                components = ["x", "y"] if name == "screen" else COMPONENTS[name][1]
                labels = [f"{name}.{component}" for component in components]
            else:
                columns[name] = name, slice(None)
                continue
            columns.update({label: (name, number) for number, label in enumerate(labels)})
        return columns

    def __getattr__(self, name: str) -> NDArray[Any]:
        arrays: dict[str, NDArray[Any]] = self.__dict__.get("_arrays", {})
        if name in arrays:
            return arrays[name]
        raise AttributeError(f"there is no {name!r}; there are: {', '.join(arrays)}")

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._held()})

    def _ipython_key_completions_(self) -> list[str]:
        return list(dict.fromkeys((*self._held(), *self)))

    @property
    def scene(self) -> Scene:
        """The scene in which the values were computed."""
        return self._scene

    @property
    def count(self) -> int:
        """The number of points."""
        return int(self._arrays["shape"].size)

    def _rows(self, name: str) -> NDArray[Any]:
        """An array with one row per point, whatever the shape of the points' own array."""
        array = self._array(name)
        return array.reshape(self.count, *array.shape[self._arrays["shape"].ndim :])

    @property
    def units(self) -> dict[str, str]:
        """The unit of each array and column: ``"1"`` for pure numbers, ``""`` for indices and booleans."""
        arrays = {name: self._unit(name) for name in self._held()}
        return {**arrays, **{column: arrays[array] for column, (array, _) in self._columns.items()}}

    def _unit(self, name: str) -> str:
        if name in ("shape", "part", "seen"):
            return ""
        if name in ("normal", "cos_theta_o"):
            return "1"
        if name == "lights":
            return self._scene.unit("irradiance")
        return self._scene.unit(name)

    def to_dataframe(self) -> pandas.DataFrame:
        """A pandas DataFrame with a row for each point; vectors and lights are columns such as ``position.x``,
        ``color.red`` and ``light.lamp``."""
        needed("pandas")
        import pandas

        columns = {name: self._rows(array)[..., number] for name, (array, number) in self._columns.items()}
        return pandas.DataFrame(columns, index=list(self._names) or None)

    def _seen(self, indices: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Whether the eye sees these points."""
        seen: NDArray[np.bool_] = self._rows("seen")[indices]
        return seen

    def _table(self) -> list[str]:
        about = self._scene.core.describe()
        length = self._scene.length
        lines = []
        indices = np.flatnonzero(self._rows("shape") >= 0)
        for index, seen in zip(indices[:_SHOWN], self._seen(indices[:_SHOWN])):
            x, y, z = self._rows("position")[index]
            brightness, irradiance = self._rows("brightness")[index], self._rows("irradiance")[index]
            where = f"({x:.6g}, {y:.6g}, {z:.6g}) {length}"
            values = f"B = {brightness:.15g} {about['brightness_unit']}, E = {irradiance:.15g} {about['irradiance_unit']}"
            name = self._names[index] if index < len(self._names) else f"[{index}]"
            unseen = "" if seen else ", not seen from the eye"
            lines.append(f"  {name}: {where}: {values}{unseen}")
        if len(indices) > _SHOWN:
            lines.append(f"  … {len(indices) - _SHOWN} more points")
        if len(indices) < self.count:
            lines.append(f"  no surface at {self.count - len(indices)} points")
        return lines

    def __repr__(self) -> str:
        about = self._scene.core.describe()
        return "\n".join([f"<{type(self).__name__} of {self.count} points, {about['convention']}", *self._table()]) + ">"

    def _repr_html_(self) -> str:
        return f"<pre>{_html.escaped(repr(self)[1:-1])}</pre>"


_SHOWN = 10


class Probes(Values):
    """The result of :func:`probe`. For many points, some arrays are computed only when they are first used."""

    lights: NDArray[np.float64]

    def __init__(
        self,
        scene: Scene,
        arrays: Mapping[str, NDArray[Any]],
        names: Sequence[str],
        places: _Places,
        later: Sequence[str] = (),
    ) -> None:
        super().__init__(scene, arrays, names)
        self._places = places
        self._later = tuple(name for name in later if name not in arrays)

    def _array(self, name: str) -> NDArray[Any]:
        if name in self._later:
            self._complete()
        return super()._array(name)

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name in self.__dict__.get("_later", ()):
            self._complete()
        return super().__getattr__(name)

    def _held(self) -> Sequence[str]:
        return (*self._arrays, *self._later)

    def _seen(self, indices: NDArray[np.intp]) -> NDArray[np.bool_]:
        points = self._places.points
        if "seen" not in self._later or points is None:
            return super()._seen(indices)
        # Only of these points, not of all.
        some = _Places(points[indices], None, self._places.elsewhere, False, (len(indices),))
        seen: NDArray[np.bool_] = some.arrays(self._scene, None)["seen"]
        return seen

    def _complete(self) -> None:
        """Computes the arrays that were left out."""
        arrays = self._places.shaped(self._places.arrays(self._scene, None))
        for name in self._later:
            arrays[name].flags.writeable = False
            self._arrays[name] = arrays[name]
        self._later = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The probes' names, if they are the scene's own."""
        return tuple(self._names)

    def explain(self, index: int | None = None) -> str:
        """Every step of computing the value at a point, with formula numbers; for all points, if there are only a few."""
        if index is None and self.count > _SHOWN:
            raise ArgumentError(f"there are {self.count} points; say which: explain(0)")
        if index is None:
            return "\n".join(self._explain(number) for number in range(self.count))
        return self._explain(range(self.count)[index])

    def _explain(self, index: int) -> str:
        places = self._places
        name = self._names[index] if index < len(self._names) else f"point {index}"
        if self._rows("shape")[index] < 0:
            return f"{name}: no surface\n"
        if places.pixels is not None:
            column, row = (int(number) for number in places.pixels[index])
            return _isophote.explain(self._scene.core, index, f"pixel {column},{row}", None, [column, row], None, False)
        if places.screen is not None:
            x, y = (float(number) for number in places.screen[index])
            return _isophote.explain(self._scene.core, index, f"screen point {x:g},{y:g}", None, None, [x, y], False)
        assert places.points is not None
        point = [float(coordinate) for coordinate in places.points[index]]
        return _isophote.explain(self._scene.core, index, name, point, None, None, places.elsewhere == "nearest")


class _Places:
    """Where to compute values."""

    def __init__(
        self,
        points: NDArray[np.float64] | None,
        pixels: NDArray[np.uint32] | None,
        elsewhere: str,
        per_light: bool,
        shape: tuple[int, ...],
        screen: NDArray[np.float64] | None = None,
    ) -> None:
        self.shape = shape
        self.screen = screen
        self.points = points
        self.pixels = pixels
        self.elsewhere = elsewhere
        self.per_light = per_light

    def shaped(self, arrays: dict[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        """The arrays with the dimensions of the array of places, in which these have one row per point."""
        return {name: array.reshape(*self.shape, *array.shape[1:]) for name, array in arrays.items()}

    def arrays(self, scene: Scene, report: Any) -> dict[str, NDArray[Any]]:
        """All arrays, computed point by point."""
        if self.pixels is not None:
            return _isophote.probe_pixels(scene.core, self.pixels, self.elsewhere, self.per_light, report)
        if self.screen is not None:
            return _isophote.probe_screen(scene.core, self.screen, self.elsewhere, self.per_light, report)
        assert self.points is not None
        return _isophote.probe_points(scene.core, self.points, self.elsewhere, self.per_light, report)

    def values(self, scene: Scene, report: Any) -> dict[str, NDArray[Any]] | None:
        """Brightness and irradiance of many points at once; ``None`` if that is not possible or fails at some points."""
        if self.points is None or self.per_light or len(self.points) <= _MANY:
            return None
        found = _isophote.probe_values(scene.core, self.points, self.elsewhere == "nearest", report)
        if found is None or (found[3] > 0 and self.elsewhere != "nan"):
            return None
        brightness, irradiance, shape, _ = found
        return {"brightness": brightness, "irradiance": irradiance, "shape": shape}


_MANY = 1000
"""For up to this many points, the values are identical to the command's, to the last bit."""

_NAMES = (
    "position",
    "normal",
    "shape",
    "part",
    "seen",
    "cos_theta_o",
    "brightness",
    "irradiance",
    "ambient",
    "diffuse",
    "specular",
)


def probe(
    scene: SceneOrPath,
    *,
    at: ArrayLike | None = None,
    pixels: ArrayLike | None = None,
    screen: ArrayLike | None = None,
    elsewhere: Elsewhere = "error",
    per_light: bool = False,
    progress: Progress = None,
) -> Probes:
    """The exact values at points, to within 1e-12, independent of the map's resolution.

    More than a thousand points on a few spheres are computed several at a time, which may round the last bits
    differently, and only as needed: brightness and irradiance at once, the other arrays when they are first used.

    ``at``: points in the scene's unit, n × 3 or an array of any shape (…, 3), whose leading dimensions the results then
    have. ``pixels``: n × 2 or (…, 2), columns and rows: the points seen at their centres. ``screen``: (…, 2), points (x, y)
    of the screen in the units of a map's axes, of any fraction of a pixel and outside the window too: the points seen there,
    such as those of a lens with distortion. If none is given, the scene's own probes.
    ``elsewhere``: how to treat points that are not on a surface: ``"error"``, ``"nearest"`` (use the nearest point on a
    surface) or ``"nan"``.
    ``per_light``: whether to include the irradiance from each light: ``lights``, n × lights.
    """
    scene = scene_of(scene)
    if elsewhere not in ("error", "nearest", "nan"):
        raise ArgumentError(f"elsewhere is {elsewhere!r}; allowed: error, nearest, nan")
    if sum(place is not None for place in (at, pixels, screen)) > 1:
        raise ArgumentError("say where once: one of at, pixels and screen")
    names: list[str] = []
    if at is None and elsewhere == "nearest" and (pixels is not None or screen is not None):
        raise ArgumentError('elsewhere="nearest" has no effect on pixels and screen points; allowed: error, nan')
    if screen is not None:
        places_on = _pairs(screen, "screen")
        leading = places_on.shape[:-1]
        places = _Places(None, None, elsewhere, per_light, leading, places_on.reshape(-1, 2))
    elif pixels is not None:
        columns_and_rows = _pixels(pixels)
        leading = columns_and_rows.shape[:-1]
        places = _Places(None, columns_and_rows.reshape(-1, 2), elsewhere, per_light, leading)
    else:
        if at is None:
            names = list(scene.core.describe()["probes"])
            if not names:
                raise ArgumentError("the scene has no probes; say where: at=[(x, y, z), …] or pixels=[(column, row), …]")
            at = np.array([one.at for one in scene.probes])
        placed = points(at, "at")
        places = _Places(placed.reshape(-1, 3), None, elsewhere, per_light, placed.shape[:-1])
    with reporter(progress, "points") as report:
        values = places.values(scene, report)
        if values is not None:
            return Probes(scene, places.shaped(values), names, places, _NAMES)
        return Probes(scene, places.shaped(places.arrays(scene, report)), names, places)


def points(values: ArrayLike, name: str) -> NDArray[np.float64]:
    """An array (…, 3); a single point counts as 1 × 3."""
    array = numbers(values, name)
    if array.ndim == 1 and array.shape == (3,):
        array = array.reshape(1, 3)
    if array.size == 0 and array.ndim <= 2:
        array = array.reshape(0, 3)
    if array.ndim < 2 or array.shape[-1] != 3:
        raise ProbeError(f"{name} has the shape {array.shape}; allowed: n × 3, or (…, 3)")
    # A copy, so that arrays computed later are for the same points.
    return np.array(array, dtype=np.float64, order="C")


def numbers(values: ArrayLike, name: str) -> NDArray[Any]:
    """An array of real numbers."""
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise ProbeError(f"{name} is no array: {error}") from None
    if array.dtype.kind not in "iuf":
        raise ProbeError(f"{name} is of {array.dtype}; allowed: real numbers")
    return array


def _pairs(values: ArrayLike, name: str) -> NDArray[np.float64]:
    array = numbers(values, name)
    if array.ndim == 1 and array.shape == (2,):
        array = array.reshape(1, 2)
    if array.ndim < 2 or array.shape[-1] != 2:
        raise ProbeError(f"{name} has the shape {array.shape}; allowed: n × 2, or (…, 2)")
    return np.array(array, dtype=np.float64, order="C")


def _pixels(values: ArrayLike) -> NDArray[np.uint32]:
    array = numbers(values, "pixels")
    if array.ndim == 1 and array.shape == (2,):
        array = array.reshape(1, 2)
    if array.size == 0 and array.ndim <= 2:
        array = array.reshape(0, 2).astype(np.uint32)
    if array.ndim < 2 or array.shape[-1] != 2 or array.dtype.kind not in "iu":
        raise ProbeError(f"pixels has the shape {array.shape} of {array.dtype}; allowed: n × 2, or (…, 2), whole numbers")
    if array.size and (array.min() < 0 or array.max() >= 2**32):
        raise ProbeError("pixels has numbers out of bounds; allowed: columns and rows of the image, from 0")
    return np.ascontiguousarray(array, dtype=np.uint32)


class Section(Values):
    """The result of :func:`section`; ``screen`` holds the positions on the screen, n × 2."""

    screen: NDArray[np.float64]

    @property
    def distance(self) -> NDArray[np.float64]:
        """The distance of each point from the first one, on the screen."""
        steps: NDArray[np.float64] = self["screen"] - self["screen"][0]
        return np.hypot(steps[:, 0], steps[:, 1])

    def _unit(self, name: str) -> str:
        return self._scene.core.describe()["screen_unit"] if name == "screen" else super()._unit(name)

    def plot(self, *names: str, ax: matplotlib.axes.Axes | None = None, **options: Any) -> matplotlib.axes.Axes:
        """Draws values along the line with matplotlib, by default the brightness.

        ``ax``: where to draw; by default the current axes, or a new figure if these hold something already. Further
        options are passed to ``plot``.
        """
        from ._plots import plot_section

        return plot_section(self, names or ("brightness",), ax, options)


def section(
    scene: SceneOrPath,
    *,
    row: int | None = None,
    column: int | None = None,
    between: ArrayLike | None = None,
    x: float | None = None,
    y: float | None = None,
    through: str | None = None,
    vertical: bool = False,
    samples: int | None = None,
) -> Section:
    """The values along a line on the screen, each traced and summed in double precision: at the pixel centres of a
    ``row`` or ``column``, or at ``samples`` points (501): ``between`` two points (x, y) on the screen; from edge to edge of
    the image, upright at ``x`` or level at ``y``; or ``through`` the centre of the shape of that name, level or
    ``vertical``.

    If the image has an even number of rows, none runs through its middle: the nearest are half a pixel beside it."""
    scene = scene_of(scene)
    if sum(place is not None for place in (row, column, between, x, y, through)) != 1:
        raise ArgumentError("say where: one of row, column, between, x, y and through")
    if vertical and through is None:
        raise ArgumentError("vertical goes with through")
    ends = None
    if between is not None:
        ends = _ends(between)
    elif through is not None:
        place = _center(scene, through)
        ends = _across(scene, place[0], None) if vertical else _across(scene, None, place[1])
    elif x is not None or y is not None:
        ends = _across(scene, x, y)
    elif samples is not None:
        raise ArgumentError("samples has no effect on a row or a column, which has a point at each pixel centre")
    for name, value in (("row", row), ("column", column)):
        if value is not None:
            counted(value, name)
    arrays = _isophote.section(scene.core, row, column, ends, positive(501 if samples is None else samples, "samples"))
    return Section(scene, arrays, ())


def _center(scene: Scene, name: str) -> Sequence[float]:
    """Where the centre of a shape appears on the screen."""
    about = scene.core.describe()
    if name not in about["shapes"]:
        there_are = f"there are: {', '.join(about['shapes'][:20])}" if about["shapes"] else "the scene has none"
        raise ArgumentError(f"there is no shape {name!r}; {there_are}")
    place = _isophote.center_on_screen(scene.core, name)
    if place is None:
        raise ArgumentError(f"the eye does not see the centre of {name!r}, which is behind it")
    if not all(least <= coordinate <= greatest for coordinate, (least, greatest) in zip(place, about["extent"])):
        raise ArgumentError(f"the centre of {name!r} appears outside the image, at {tuple(place)} {about['screen_unit']}")
    return place


def _across(scene: Scene, x: float | None, y: float | None) -> list[list[float]]:
    """The ends of a line from edge to edge of the image, at this x or y."""
    (left, right), (low, high) = scene.core.describe()["extent"]
    if x is None:
        assert y is not None
        return _ends([(left, y), (right, y)])
    return _ends([(x, low), (x, high)])


def _ends(between: ArrayLike) -> list[list[float]]:
    array = numbers(between, "between")
    if array.shape != (2, 2) or not np.isfinite(array).all():
        raise ArgumentError("between needs two places (x, y), (x, y) of finite numbers")
    return [[float(number) for number in place] for place in array]
