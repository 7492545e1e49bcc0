"""Reading map files."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _html, _isophote
from ._convert import FrozenDict
from ._sweep_data import is_sweep, reopened
from ._xarray import open_store
from .errors import ArgumentError
from .map import Axis, Map, axes_of
from .scene import Scene

if TYPE_CHECKING:
    import xarray

__all__ = ["MapFile", "read"]


class MapFile(Map):
    """A map in a file or store written by Isophote: everything that a :class:`Map` has. Values are read when they are first
    used, from the formats that hold them (EXR, NPZ, NPY, CSV and Zarr; a PNG is a picture, from which no values can be
    read).

    The :attr:`mask` comes from the file's ``shape``, ``mask`` or another channel that is never 0 on a surface. A file that
    has none of these (an NPY file, say) has no mask, no extremes and no mean.
    """

    def __init__(self, path: str, directory: str | None = None) -> None:
        self.path = path
        # The working directory may have changed by the time the values are read.
        self._place = os.path.abspath(path)
        self._directory = None if directory is None else os.path.abspath(directory)
        self._about: dict[str, Any] = json.loads(_isophote.read_metadata(path))
        self._channels = {channel["name"]: channel for channel in self._about["channels"]}
        self._units = FrozenDict({name: channel["unit"] for name, channel in self._channels.items()})
        self._arrays: dict[str, NDArray[Any]] | None = None
        # What formats hold besides channels: `mask`, `shape`.
        self._extra: dict[str, NDArray[Any]] = {}
        self._built: _isophote.Map | None = None
        self._read_scene: Scene | None = None

    @property
    def metadata(self) -> dict[str, Any]:
        """The metadata of the file."""
        return self._about

    @property
    def scene(self) -> Scene:
        """The scene that was rendered."""
        if self._read_scene is None:
            if self._directory is not None:
                self._read_scene = Scene.from_toml(self._about["scene"], directory=self._directory, name=self.path)
            else:
                core = _isophote.Scene.from_output(json.dumps(self._about), self._place, self.path)
                self._read_scene = Scene.of_core(core, core.directory)
        return self._read_scene

    @property
    def region(self) -> tuple[int, int, int, int]:
        """The part of the image that the file holds: first column, first row, columns, rows."""
        corner, size = self._about["region"]["corner"], self._about["region"]["size"]
        return corner["column"], corner["row"], size["width"], size["height"]

    @property
    def axes(self) -> tuple[Axis, Axis]:
        """The axis from left to right, and the axis from bottom to top."""
        # Of a map of one pixel with the same edges, so that no values are read.
        region = {**self._about["region"], "size": {"width": 1, "height": 1}}
        frame = _isophote.Map.of(json.dumps({**self._about, "region": region}), [], np.full((1, 1), -1, np.int32))
        return axes_of(frame)

    @property
    def _core(self) -> _isophote.Map:  # type: ignore[override]
        """The map in the compiled part."""
        if self._built is None:
            _, _, width, height = self.region
            seen = self._shapes()
            shapes = np.where(self.mask, 0, -1) if seen is None else seen
            channels = [(name, _plain(self[name])) for name in self]
            self._built = _isophote.Map.of(json.dumps(self._about), channels, shapes.astype(np.int32).reshape(height, width))
        return self._built

    def _array(self, channel: str) -> NDArray[Any]:
        if self._arrays is None:
            self._arrays = self._read()
            for name in ("shape", "material"):
                if name in self._arrays:
                    # EXR and CSV have floats alone.
                    self._arrays[name] = self._arrays[name].astype(np.int32)
            for array in (*self._arrays.values(), *self._extra.values()):
                array.flags.writeable = False
        return self._arrays[channel]

    def _missing(self, channel: str) -> str:
        return f"{self.path} has no channel {channel!r}; it has {', '.join(self)}"

    def _shapes(self) -> NDArray[Any] | None:
        """The shape at each pixel, if the file has it."""
        if "shape" in self._channels:
            return self["shape"]
        self._array(next(iter(self._channels)))
        return self._extra.get("shape")

    @property
    def shapes(self) -> NDArray[np.int32]:
        """The index of the shape at each pixel, −1 where no surface is seen."""
        shapes = self._shapes()
        if shapes is None:
            raise ArgumentError(f"{self.path} does not say which shape is seen: it has no channel 'shape'")
        return shapes.astype(np.int32)

    def _mask(self) -> NDArray[np.bool_] | None:
        shapes = self._shapes()
        if shapes is not None:
            return np.asarray(shapes >= 0)
        if "mask" in self._extra:
            return self._extra["mask"]
        _, _, width, height = self.region
        if self._about["window"].get("coordinates") == "grid":
            return np.ones((height, width), bool)
        for name in ("depth", "samples", "coverage"):
            if name in self._channels:
                return np.asarray(self[name] > 0)
        return np.asarray(self["normal"].any(axis=-1)) if "normal" in self._channels else None

    @property
    def has_mask(self) -> bool:
        """Whether the file tells where a surface is seen."""
        return self._mask() is not None

    @property
    def mask(self) -> NDArray[np.bool_]:
        """Where a surface is seen."""
        mask = self._mask()
        if mask is None:
            held = "save .npz, .exr or .csv, or render the channel 'shape' too"
            raise ArgumentError(f"{self.path} does not tell where a surface is seen: it has no mask; {held}")
        return mask

    def to_xarray(self) -> xarray.Dataset:
        """An xarray Dataset, as of a :class:`Map`; that of a store reads data on demand."""
        if os.path.isdir(self._place):
            return open_store(self._place)
        return super().to_xarray()

    def __reduce__(self) -> tuple[Any, ...]:
        return _reopened, ({**self.__dict__, "_built": None},)

    def _read(self) -> dict[str, NDArray[Any]]:
        if os.path.isdir(self._place):
            return {name: _zarr_array(self._place, self._stored(name)) for name in self._channels}
        with open(self._place, "rb") as file:
            start = file.read(8)
        if start.startswith(b"\x76\x2f\x31\x01"):
            stored = dict(_isophote.read_exr(self._place))
            return {name: self._joined(stored, name) for name in self._channels}
        if start.startswith(b"PK\x03\x04"):
            # Modules that are slow to load are imported where they are needed.
            import zipfile

            with zipfile.ZipFile(self._place) as archive:
                stored = {entry[:-4]: _npy(archive.read(entry)) for entry in archive.namelist() if entry.endswith(".npy")}
            if "mask" in stored:
                self._extra["mask"] = stored["mask"]
            return {name: stored[self._stored(name)[0]] for name in self._channels}
        if start.startswith(b"\x93NUMPY"):
            with open(self._place, "rb") as file:
                return {next(iter(self._channels)): _npy(file.read())}
        if start.startswith(b"# isopho"):
            return self._table()
        raise ArgumentError(f"{self.path} is a picture, of which no values can be taken; render its .scene again")

    def _stored(self, name: str) -> list[str]:
        return self._channels[name].get("stored_as") or [name]

    def _joined(self, stored: Mapping[str, NDArray[Any]], name: str) -> NDArray[Any]:
        parts = [stored[part] for part in self._stored(name)]
        return parts[0] if len(parts) == 1 else np.stack(parts, axis=-1)

    def _table(self) -> dict[str, NDArray[Any]]:
        with open(self._place, encoding="utf-8", newline="") as file:
            lines = [line for line in file if not line.startswith("#")]
        _, _, width, height = self.region
        if len(lines) - 1 != width * height:
            raise ArgumentError(f"{self.path} has {len(lines) - 1} rows for {width * height} pixels: it is no whole table")
        names = next(csv.reader(lines[:1]))
        values = np.loadtxt(lines[1:], delimiter=",", ndmin=2)
        arrays: dict[str, NDArray[Any]] = {
            name: values[:, column].reshape(height, width) for column, name in enumerate(names)
        }
        if "shape" in arrays:
            self._extra["shape"] = arrays["shape"] = arrays["shape"].astype(np.int32)
        return {name: self._joined(arrays, name) for name in self._channels}

    def __repr__(self) -> str:
        _, _, width, height = self.region
        return f"<MapFile {self.path}: {width}×{height}, {', '.join(self)}; {self.metadata['convention']}>"

    def _repr_html_(self) -> str:
        return f"<pre>{_html.escaped(repr(self)[1:-1])}</pre>"


def _reopened(state: dict[str, Any]) -> MapFile:
    found = object.__new__(MapFile)
    found.__dict__.update(state)
    return found


def read(path: str | os.PathLike[str], *, directory: str | os.PathLike[str] | None = None) -> MapFile | xarray.Dataset:
    """Opens a file or store written by Isophote, with its scene and its channels. The store of a sweep is opened as the
    Dataset that the sweep returned; its variable ``rendered`` tells which maps are there, if some are missing.

    ``directory``: the base directory for relative file names in the scene. By default the scene has the files that it was
    rendered from: small ones are in the file itself, others are looked for where they were; other contents are an error.
    """
    if os.path.isdir(path) and is_sweep(os.fspath(path)):
        return reopened(os.fspath(path))
    return MapFile(os.fspath(path), None if directory is None else os.fspath(directory))


def _plain(array: NDArray[Any]) -> NDArray[Any]:
    """The array with a type that maps have."""
    return array.astype(np.float64) if array.ndim == 3 else array


def _npy(content: bytes) -> NDArray[Any]:
    array: NDArray[Any] = np.load(io.BytesIO(content), allow_pickle=False)
    return array


def _zarr_array(path: str, stored_as: list[str]) -> NDArray[Any]:
    import zarr

    array: NDArray[Any] = np.asarray(zarr.open_array(path, path=stored_as[0], mode="r"))
    return array
