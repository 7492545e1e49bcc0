"""Where the maps of a sweep go: a Dataset in memory, or a Zarr store."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _isophote
from ._convert import amount
from ._paths import Pointer
from ._xarray import COMPONENTS, attributes, needed
from .errors import StoreError
from .map import Map

if TYPE_CHECKING:
    import xarray

    from .sweeps import Sweep


@dataclass(frozen=True)
class Template:
    """The Dataset without its data."""

    parameters: int
    """The number of leading dimensions that are parameters."""
    sizes: dict[str, int]
    coordinates: dict[str, Any]
    variables: dict[str, tuple[tuple[str, ...], np.dtype[Any], dict[str, str]]]
    attributes: dict[str, str]

    def shape(self, name: str) -> tuple[int, ...]:
        return tuple(self.sizes[dim] for dim in self.variables[name][0])

    def dataset(self, arrays: Mapping[str, NDArray[Any]]) -> xarray.Dataset:
        import xarray

        variables = {name: (self.variables[name][0], array, self.variables[name][2]) for name, array in arrays.items()}
        return xarray.Dataset(variables, self.coordinates, self.attributes)

    def identity(self) -> str:
        """A string that identifies this sweep."""
        coordinates = {name: coordinate.values.tolist() for name, coordinate in self.dataset({}).coords.items()}
        variables = {name: (dims, str(dtype)) for name, (dims, dtype, _) in self.variables.items()}
        return json.dumps([str(self.attributes.get("scene")), coordinates, variables], sort_keys=True, default=str)

    def numbered(self) -> xarray.Dataset:
        """The Dataset with numbers for strings, for which Zarr has no settled format; the strings are in the attribute
        ``labels``."""
        dataset = self.dataset({})
        for name, coordinate in dataset.coords.items():
            if coordinate.dtype.kind == "U":
                numbers = np.arange(coordinate.size).reshape(coordinate.shape)
                attrs = {**coordinate.attrs, "labels": coordinate.values.tolist()}
                dataset = dataset.assign_coords({name: (coordinate.dims, numbers, attrs)})
        return dataset


def template(sweep: Sweep, values: Mapping[str, Sequence[Any]], first: Map) -> Template:
    image = first.to_xarray()
    sizes, dims_of_maps = dict(sweep.dims), tuple(sweep.dims)
    coordinates: dict[str, Any] = {}
    for (path, several), pointer in zip(values.items(), sweep.pointers):
        coordinates.update(_coordinate(path, path if path in sizes else dims_of_maps[0], several, pointer))
    for dim in sizes:
        if dim not in coordinates:
            coordinates[dim] = np.arange(sizes[dim])
    is_same_window = not sweep.moves_pixels
    for axis, counted in zip(first.axes, ("column", "row")):
        # If the maps cover different places, their pixels are numbered instead.
        numbers = (axis.name, np.arange(image.sizes[axis.name]), {"units": "1", "long_name": f"{counted}, from 0"})
        coordinates[axis.name] = image[axis.name] if is_same_window else numbers
    for key, coordinate in image.coords.items():
        if key != "visible" and key not in coordinates:
            coordinates[str(key)] = coordinate
    sizes.update({str(dim): size for dim, size in image.sizes.items()})
    variables = {}
    for key, variable in {**image.data_vars, "visible": image["visible"]}.items():
        name = str(key)
        dims = (*dims_of_maps, *(str(dim) for dim in variable.dims))
        attrs = dict(variable.attrs)
        if name != "visible":
            units = [core.unit(name) for core in sweep.cores]
            if len(set(units)) > 1:
                # One unit per map, indexed by the parameters that it depends on.
                del attrs["units"]
                coordinates[f"{name}.units"] = (dims_of_maps, np.array(units).reshape(sweep.sizes))
        variables[name] = (dims, variable.dtype, attrs)
    about = attributes(first.metadata)
    if any(pointer.keys[0] in ("convention", "quantities") for pointer in sweep.pointers) or sweep.changes_convention:
        del about["convention"]
    # The scene is that of the first map; the values in which the others differ are in the coordinates.
    return Template(len(dims_of_maps), sizes, coordinates, variables, about)


def _coordinate(path: str, dim: str, several: Sequence[Any], pointer: Pointer) -> dict[str, Any]:
    """The coordinate along a dimension: the values themselves, or numbers with the values beside them."""
    plain = [pointer.convert(value) if value is not None else None for value in several]
    if all(isinstance(value, str) for value in plain):
        return {path: (dim, np.array(plain))}
    if all(isinstance(value, (int, float, np.number)) for value in several):
        return {path: (dim, np.array(several))}
    numbers: dict[str, Any] = {path: (dim, np.arange(len(plain)))}
    if all(isinstance(value, tuple) and len(value) == 3 for value in plain):
        extra, labels = COMPONENTS["color" if pointer.convert is amount else "position"]
        return numbers | {extra: np.array(labels), f"{path}.value": ((dim, extra), np.array(plain))}
    return numbers | {f"{path}.value": (dim, np.array([repr(value) for value in plain]))}


class Memory:
    """Arrays in memory for all maps."""

    done: frozenset[int] = frozenset()

    def __init__(self, form: Template) -> None:
        # Pixels that no map sees are never written: untouched memory costs nothing.
        self.arrays = {name: np.zeros(form.shape(name), of[1]) for name, of in form.variables.items()}

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        for name, array in self.arrays.items():
            of.copy_into(None if name == "visible" else name, array[index])

    def dataset(self, form: Template) -> xarray.Dataset:
        return form.dataset(self.arrays)


RENDERED = "rendered"
"""The array of a store that records which maps are complete; written after the map itself."""


@dataclass(frozen=True)
class Store:
    """A Zarr store with one chunk per map and channel: every chunk has a single writer, which writes it whole."""

    path: str
    done: frozenset[int]

    @classmethod
    def prepare(cls, path: str, form: Template, resume: bool) -> Store:
        needed("zarr")
        if os.path.lexists(path):
            if not resume:
                raise StoreError(f"{path} exists already; resume=True goes on with it; or choose another name")
            return cls._found(path, form)
        return cls._made(path, form)

    @classmethod
    def _made(cls, path: str, form: Template) -> Store:
        import zarr

        form.numbered().to_zarr(path, mode="w-", zarr_format=3, consolidated=False)
        group = zarr.open_group(path, mode="r+")
        for name, (dims, dtype, attrs) in form.variables.items():
            shape = form.shape(name)
            chunks = (1,) * form.parameters + shape[form.parameters :]
            group.create_array(
                name, shape=shape, chunks=chunks, dtype=dtype, attributes=dict(attrs), dimension_names=list(dims)
            )
        parameters = form.variables["visible"][0][: form.parameters]
        sizes = tuple(form.sizes[dim] for dim in parameters)
        group.create_array(
            RENDERED,
            shape=sizes,
            chunks=(1,) * len(sizes),
            dtype=bool,
            attributes={"long_name": "whether the map is there", "sweep": form.identity()},
            dimension_names=list(parameters),
        )
        with warnings.catch_warnings():
            # Consolidated metadata are not part of Zarr 3 yet; without them xarray warns on every reading.
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(path)
        return cls(path, frozenset())

    @classmethod
    def _found(cls, path: str, form: Template) -> Store:
        import zarr

        try:
            rendered = zarr.open_array(path, path=RENDERED, mode="r")
        except (OSError, ValueError, KeyError) as error:
            raise StoreError(f"{path} is no store of a sweep: {error}") from None
        if rendered.attrs.get("sweep") != form.identity():
            raise StoreError(f"{path} holds another sweep; choose another name")
        return cls(path, frozenset(int(number) for number in np.flatnonzero(np.asarray(rendered))))

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        import zarr

        for name, array in {**arrays_of(of), RENDERED: np.array(True)}.items():
            stored = zarr.open_array(self.path, path=name, mode="r+")
            stored[index] = array

    def dataset(self, form: Template) -> xarray.Dataset:
        return reopened(self.path).assign_coords(form.dataset({}).coords)


def is_sweep(path: str) -> bool:
    """Whether a directory is the store of a sweep."""
    try:
        with open(os.path.join(path, RENDERED, "zarr.json"), encoding="utf-8") as file:
            about = json.load(file)
    except (OSError, ValueError):
        return False
    return isinstance(about, dict) and "sweep" in about.get("attributes", {})


def reopened(path: str) -> xarray.Dataset:
    """The Dataset of a store: with its strings instead of their numbers, and, if maps are missing, with ``rendered``."""
    import xarray

    needed("zarr")
    dataset: xarray.Dataset = xarray.open_zarr(path, chunks=None, consolidated=False)
    for name, coordinate in dataset.coords.items():
        if "labels" in coordinate.attrs:
            attrs = {key: value for key, value in coordinate.attrs.items() if key != "labels"}
            dataset = dataset.assign_coords({name: (coordinate.dims, np.array(coordinate.attrs["labels"]), attrs)})
    return dataset.drop_vars(RENDERED) if bool(dataset[RENDERED].all()) else dataset


def arrays_of(of: _isophote.Map) -> dict[str, NDArray[Any]]:
    return {**{name: of.channel(name) for name, _ in of.units()}, "visible": of.shapes() >= 0}
