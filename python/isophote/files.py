"""Reading map files."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _isophote
from .errors import ArgumentError
from .scene import Scene

__all__ = ["MapFile", "read"]


class MapFile(Mapping[str, NDArray[Any]]):
    """A file or store written by Isophote: its metadata, and its channels as arrays if the format holds them (EXR, NPZ,
    NPY, CSV and Zarr; a PNG is a picture, from which no values can be read)."""

    def __init__(self, path: str, directory: str | None = None) -> None:
        self.path = path
        # The working directory may have changed by the time the values are read.
        self._place = os.path.abspath(path)
        self._directory = None if directory is None else os.path.abspath(directory)
        self.metadata: dict[str, Any] = json.loads(_isophote.read_metadata(path))
        self._channels = {channel["name"]: channel for channel in self.metadata["channels"]}
        self._arrays: dict[str, NDArray[Any]] | None = None

    __hash__ = object.__hash__

    def __eq__(self, other: object) -> bool:
        return self is other

    @property
    def scene(self) -> Scene:
        """The scene that was rendered."""
        if self._directory is not None:
            return Scene.from_toml(self.metadata["scene"], directory=self._directory, name=self.path)
        core = _isophote.Scene.from_output(json.dumps(self.metadata), self._place, self.path)
        return Scene.of_core(core, core.directory)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each channel."""
        return {name: channel["unit"] for name, channel in self._channels.items()}

    @property
    def region(self) -> tuple[int, int, int, int]:
        """The part of the image that the file holds: first column, first row, columns, rows."""
        corner, size = self.metadata["region"]["corner"], self.metadata["region"]["size"]
        return corner["column"], corner["row"], size["width"], size["height"]

    def __iter__(self) -> Iterator[str]:
        return iter(self._channels)

    def __len__(self) -> int:
        return len(self._channels)

    def __getitem__(self, channel: str) -> NDArray[Any]:
        if channel not in self._channels:
            raise KeyError(f"{self.path} has no channel {channel!r}; it has {', '.join(self._channels)}")
        if self._arrays is None:
            self._arrays = self._read()
        return self._arrays[channel]

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
        arrays = {name: values[:, column].reshape(height, width) for column, name in enumerate(names)}
        return {name: self._joined(arrays, name) for name in self._channels}

    def __repr__(self) -> str:
        _, _, width, height = self.region
        return f"<MapFile {self.path}: {width}×{height}, {', '.join(self)}; {self.metadata['convention']}>"


def read(path: str | os.PathLike[str], *, directory: str | os.PathLike[str] | None = None) -> MapFile:
    """Opens a file or store written by Isophote, with its scene and its channels.

    ``directory``: the base directory for relative file names in the scene. By default the scene has the files that it was
    rendered from: small ones are in the file itself, others are looked for where they were; other contents are an error.
    """
    return MapFile(os.fspath(path), None if directory is None else os.fspath(directory))


def _npy(content: bytes) -> NDArray[Any]:
    array: NDArray[Any] = np.load(io.BytesIO(content), allow_pickle=False)
    return array


def _zarr_array(path: str, stored_as: list[str]) -> NDArray[Any]:
    import zarr

    array: NDArray[Any] = np.asarray(zarr.open_array(path, path=stored_as[0], mode="r"))
    return array
