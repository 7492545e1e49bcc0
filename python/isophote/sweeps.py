"""Many maps of one scene with other values in it."""

from __future__ import annotations

import itertools
import json
import os
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _isophote
from ._paths import locate
from ._progress import Progress, reporter
from ._xarray import COMPONENTS, attributes
from .errors import ArgumentError
from .map import Map
from .rendering import Channels, channel_names, positive
from .scene import Scene

if TYPE_CHECKING:
    import distributed
    import xarray

__all__ = ["sweep"]


def sweep(
    scene: Scene,
    parameters: Mapping[str, Iterable[Any]],
    *,
    channels: Channels = None,
    precision: str = "double",
    workers: int | None = None,
    client: distributed.Client | None = None,
    store: str | os.PathLike[str] | None = None,
    progress: Progress = None,
) -> xarray.Dataset:
    """The maps of a scene for each combination of the values of some parameters, as one xarray Dataset.

    ``parameters``: values by their paths in the scene (see :meth:`Scene.set`), such as ``{"light.lamp.position": positions,
    "material.clay.shininess": [5, 20, 80]}``. Each becomes a dimension, in this order. Values that are no single numbers or
    words are numbered along it, and stand in a coordinate of their own, ``light.lamp.position.value``.
    ``workers``: threads on this machine, as many as there are processors by default.
    ``client``: a Dask client: its workers render instead.
    ``store``: a Zarr store, which must not exist yet: maps go into it as they are done, a chunk each, and the Dataset reads
    them from there. A cluster's workers must see it under the same name.
    """
    import xarray

    values = {path: list(several) for path, several in parameters.items()}
    for path, several in values.items():
        if not several:
            raise ArgumentError(f"{path!r} has no values")
    names = channel_names(scene, channels)
    tasks = list(_tasks(scene, values, names, precision))
    # What it holds tells how all are held.
    first = tasks[0].render(threads=None)
    template = _template(values, Map(first, scene))
    into: _Memory | _Store = _Memory(template) if store is None else _Store.create(os.path.abspath(store), template)
    into.put(tasks[0].index, first)
    with reporter(progress, "maps") as report:
        rest = tasks[1:]
        finished = _on_threads(rest, workers, into) if client is None else _on_cluster(rest, client, into)
        for done, _ in enumerate(itertools.chain([None], finished), start=1):
            if report is not None:
                report(done, len(tasks))
    if isinstance(into, _Memory):
        return template.dataset(into.arrays)
    dataset: xarray.Dataset = xarray.open_zarr(into.path, chunks=None, consolidated=False)
    return dataset.assign_coords(template.dataset({}).coords)


@dataclass(frozen=True)
class _Task:
    """One map."""

    scene: _isophote.Scene
    index: tuple[int, ...]
    names: list[str]
    precision: str

    def render(self, threads: int | None = 1, stop: threading.Event | None = None) -> _isophote.Map:
        def listen(_done: int, _all: int) -> None:
            if stop is not None and stop.is_set():
                raise _Stopped

        return _isophote.render(self.scene, self.names, self.precision, None, threads, listen)


class _Stopped(Exception):
    """Another map failed, or the user stopped all of them."""


def _tasks(scene: Scene, values: Mapping[str, Sequence[Any]], names: list[str], precision: str) -> Iterator[_Task]:
    """Every combination: what is wrong with any of them is known before the first map is rendered."""
    pointers = [locate(scene, path) for path in values]
    if any(pointer.keys[:2] == ("camera", "resolution") for pointer in pointers):
        raise ArgumentError("a sweep cannot change the number of pixels")
    written = scene.to_dict()
    for index in itertools.product(*(range(len(several)) for several in values.values())):
        for pointer, several, number in zip(pointers, values.values(), index):
            pointer.put(written, several[number])
        core = _isophote.Scene.from_json(json.dumps(written), str(scene.directory))
        yield _Task(core, index, names, precision)


@dataclass(frozen=True)
class _Template:
    """The Dataset without its values."""

    parameters: int
    """How many of the dimensions, the first ones, are parameters."""
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

    def numbered(self) -> xarray.Dataset:
        """The same with numbers for words, which Zarr has no settled form for; the words are in the attribute ``labels``."""
        dataset = self.dataset({})
        for name, coordinate in dataset.coords.items():
            if coordinate.dtype.kind == "U":
                numbers = np.arange(coordinate.size)
                dataset = dataset.assign_coords({name: (coordinate.dims, numbers, {"labels": coordinate.values.tolist()})})
        return dataset


def _template(values: Mapping[str, Sequence[Any]], first: Map) -> _Template:
    image = first.to_xarray()
    sizes = {path: len(several) for path, several in values.items()}
    coordinates: dict[str, Any] = {}
    for path, several in values.items():
        coordinates.update(_coordinate(path, several))
    for name, coordinate in image.coords.items():
        if name != "visible":
            coordinates[str(name)] = coordinate
    sizes.update({str(dim): size for dim, size in image.sizes.items()})
    variables = {}
    for name, variable in {**image.data_vars, "visible": image["visible"]}.items():
        dims = (*values, *(str(dim) for dim in variable.dims))
        variables[str(name)] = (dims, variable.dtype, dict(variable.attrs))
    about = attributes(first.metadata)
    # The scene is that of the first map; what the others have instead is in the coordinates.
    return _Template(len(values), sizes, coordinates, variables, about)


def _coordinate(path: str, several: Sequence[Any]) -> dict[str, Any]:
    """What stands along a dimension: the values themselves, or numbers and the values beside them."""
    if all(isinstance(value, (int, float, np.number, str)) for value in several):
        return {path: np.array(several)}
    numbers: dict[str, Any] = {path: np.arange(len(several))}
    try:
        array = np.array(several, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.empty(0)
    if array.ndim != 2 or array.shape[1] != 3:
        return numbers | {f"{path}.value": (path, np.array([repr(value) for value in several]))}
    extra, labels = COMPONENTS["position"]
    return numbers | {extra: np.array(labels), f"{path}.value": ((path, extra), array)}


class _Memory:
    """Arrays for all maps."""

    def __init__(self, template: _Template) -> None:
        # What no map sees is never written: memory that nobody touches costs nothing.
        self.arrays = {name: np.zeros(template.shape(name), of[1]) for name, of in template.variables.items()}

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        for name, array in self.arrays.items():
            of.copy_into(None if name == "visible" else name, array[index])


@dataclass(frozen=True)
class _Store:
    """A Zarr store with a chunk for each map and channel: who writes a chunk writes all of it, and nobody else does."""

    path: str

    @classmethod
    def create(cls, path: str, template: _Template) -> _Store:
        import zarr

        if os.path.lexists(path):
            raise ArgumentError(f"{path} exists already; choose another name, or remove it")
        template.numbered().to_zarr(path, mode="w-", zarr_format=3, consolidated=False)
        group = zarr.open_group(path, mode="r+")
        for name, (dims, dtype, attrs) in template.variables.items():
            shape = template.shape(name)
            chunks = (1,) * template.parameters + shape[template.parameters :]
            group.create_array(
                name, shape=shape, chunks=chunks, dtype=dtype, attributes=dict(attrs), dimension_names=list(dims)
            )
        return cls(path)

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        import zarr

        group = zarr.open_group(self.path, mode="r+")
        for name, array in _arrays(of).items():
            stored = group[name]
            assert isinstance(stored, zarr.Array)
            stored[index] = array


def _arrays(of: _isophote.Map) -> dict[str, NDArray[Any]]:
    return {**{name: of.channel(name) for name, _ in of.units()}, "visible": of.shapes() >= 0}


def _on_threads(tasks: Sequence[_Task], workers: int | None, into: _Memory | _Store) -> Iterator[None]:
    """Renders on threads of this process; each map takes one."""
    from concurrent.futures import ThreadPoolExecutor, as_completed

    count = (os.cpu_count() or 1) if workers is None else positive(workers, "workers")
    stop = threading.Event()

    def work(task: _Task) -> None:
        into.put(task.index, task.render(stop=stop))

    with ThreadPoolExecutor(count, thread_name_prefix="isophote") as pool:
        futures = [pool.submit(work, task) for task in tasks]
        try:
            for future in as_completed(futures):
                future.result()
                yield
        finally:
            # After an error, or Ctrl-C: nobody wants the others any more.
            stop.set()
            for future in futures:
                future.cancel()


def _on_cluster(tasks: Sequence[_Task], client: distributed.Client, into: _Memory | _Store) -> Iterator[None]:
    """Renders on a cluster's workers. One that dies is replaced by another."""
    import distributed

    store = into if isinstance(into, _Store) else None
    futures = [client.submit(_work, task, store, pure=False, retries=3) for task in tasks]
    index = {future.key: task.index for future, task in zip(futures, tasks)}
    try:
        for future in distributed.as_completed(futures):
            values = future.result()
            if isinstance(into, _Memory):
                for name, array in into.arrays.items():
                    array[index[future.key]] = values[name]
            future.release()
            yield
    finally:
        client.cancel(futures)


def _work(task: _Task, store: _Store | None) -> dict[str, NDArray[Any]] | None:
    """What a cluster's worker does: a map into the store, or into its answer."""
    of = task.render()
    if store is None:
        return _arrays(of)
    store.put(task.index, of)
    return None
