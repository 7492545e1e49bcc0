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
from ._convert import amount
from ._paths import Pointer, locate
from ._progress import Progress, reporter
from ._xarray import COMPONENTS, attributes, needed
from .errors import ArgumentError, StoreError
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
    resume: bool = False,
    progress: Progress = None,
) -> xarray.Dataset:
    """The maps of a scene for each combination of the values of some parameters, as one xarray Dataset.

    ``parameters``: values by their paths in the scene (see :meth:`Scene.set`), such as ``{"light.lamp.position": positions,
    "material.clay.shininess": [5, 20, 80]}``. Each becomes a dimension, in this order. Values that are no single numbers or
    words are numbered along it, and stand in a coordinate of their own, ``light.lamp.position.value``.
    ``workers``: threads on this machine, as many as there are processors by default.
    ``client``: a Dask client: its workers render instead.
    ``store``: a Zarr store, which must not exist yet: maps go into it as they are done, a chunk each, and the Dataset reads
    them from there. A cluster's workers must see it under the same name. Its array ``rendered`` tells which maps are there.
    ``resume``: goes on with the store of the same sweep, however an earlier run ended.

    Where units or the places of pixels differ between the maps, ``<channel>.units`` has them, and pixels are counted.
    """
    needed("xarray")
    values = {path: list(several) for path, several in parameters.items()}
    for path, several in values.items():
        if not several:
            raise ArgumentError(f"{path!r} has no values")
    names = channel_names(scene, channels)
    count = (os.cpu_count() or 1) if workers is None else positive(workers, "workers")
    _refuse_what_is_no_client(client)
    place = None if store is None else os.path.abspath(store)
    if resume and place is None:
        raise ArgumentError("resume goes on with a store: say which")
    with reporter(progress, "maps") as report:
        sweep = _Sweep.of(scene, values, names, precision)
        # What it holds tells how all are held.
        first = sweep.task(0).render(threads=None)
        template = _template(sweep, values, Map(first, scene))
        into = _Memory(template) if place is None else _Store.prepare(place, template, resume)
        due = [number for number in range(sweep.count) if number not in into.done]
        if 0 in due:
            into.put(sweep.task(0).index, first)
        rest = [number for number in due if number != 0]
        finished = _on_threads(sweep, rest, count, into) if client is None else _on_cluster(sweep, rest, client, into)
        done = sweep.count - len(rest)
        if report is not None:
            report(done, sweep.count)
        for _ in finished:
            done += 1
            if report is not None:
                report(done, sweep.count)
    return into.dataset(template)


@dataclass(frozen=True)
class _Sweep:
    """All maps of a sweep, by their numbers."""

    scene: Scene
    cores: list[_isophote.Scene]
    sizes: tuple[int, ...]
    pointers: tuple[Pointer, ...]
    names: list[str]
    precision: str

    @classmethod
    def of(cls, scene: Scene, values: Mapping[str, Sequence[Any]], names: list[str], precision: str) -> _Sweep:
        """Every combination: what is wrong with any of them is known before the first map is rendered."""
        pointers = tuple(locate(scene, path) for path in values)
        for one, other in itertools.combinations(pointers, 2):
            if one.keys == other.keys:
                raise ArgumentError(f"{one.path!r} and {other.path!r} are the same")
        if any(pointer.keys in (("camera",), ("camera", "resolution")) for pointer in pointers):
            raise ArgumentError("a sweep cannot change the number of pixels; name what it changes, such as camera.eye")
        written = scene.to_dict()
        cores = []
        for combination in itertools.product(*values.values()):
            for pointer, value in zip(pointers, combination):
                pointer.put(written, value)
            cores.append(_isophote.Scene.from_json(json.dumps(written), str(scene.directory), scene.core))
        return cls(scene, cores, tuple(len(several) for several in values.values()), pointers, names, precision)

    @property
    def count(self) -> int:
        return len(self.cores)

    def task(self, number: int) -> _Task:
        index = tuple(int(place) for place in np.unravel_index(number, self.sizes)) if self.sizes else ()
        return _Task(self.cores[number], index, self.names, self.precision)


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


def _refuse_what_is_no_client(client: Any) -> None:
    if client is not None and not hasattr(client, "submit"):
        raise ArgumentError(f"client is {client!r}; allowed: a Client of Dask")


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

    def identity(self) -> str:
        """What makes it this sweep and no other."""
        coordinates = {name: coordinate.values.tolist() for name, coordinate in self.dataset({}).coords.items()}
        variables = {name: (dims, str(dtype)) for name, (dims, dtype, _) in self.variables.items()}
        return json.dumps([str(self.attributes.get("scene")), coordinates, variables], sort_keys=True, default=str)

    def numbered(self) -> xarray.Dataset:
        """The same with numbers for words, which Zarr has no settled form for; the words are in the attribute ``labels``."""
        dataset = self.dataset({})
        for name, coordinate in dataset.coords.items():
            if coordinate.dtype.kind == "U":
                numbers = np.arange(coordinate.size)
                dataset = dataset.assign_coords({name: (coordinate.dims, numbers, {"labels": coordinate.values.tolist()})})
        return dataset


def _template(sweep: _Sweep, values: Mapping[str, Sequence[Any]], first: Map) -> _Template:
    image = first.to_xarray()
    sizes = {path: len(several) for path, several in values.items()}
    coordinates: dict[str, Any] = {}
    for (path, several), pointer in zip(values.items(), sweep.pointers):
        coordinates.update(_coordinate(path, several, pointer))
    is_same_window = not any(_moves_pixels(pointer) for pointer in sweep.pointers)
    for axis, counted in zip(first.axes, ("column", "row")):
        # Where the maps do not lie in the same place, their pixels are counted.
        numbers = (axis.name, np.arange(image.sizes[axis.name]), {"units": "1", "long_name": f"{counted}, from 0"})
        coordinates[axis.name] = image[axis.name] if is_same_window else numbers
    for key, coordinate in image.coords.items():
        if key != "visible" and key not in coordinates:
            coordinates[str(key)] = coordinate
    sizes.update({str(dim): size for dim, size in image.sizes.items()})
    variables = {}
    for key, variable in {**image.data_vars, "visible": image["visible"]}.items():
        name = str(key)
        dims = (*values, *(str(dim) for dim in variable.dims))
        attrs = dict(variable.attrs)
        if name != "visible":
            units = [core.unit(name) for core in sweep.cores]
            if len(set(units)) > 1:
                # A unit of each map, beside the values that make it so.
                del attrs["units"]
                coordinates[f"{name}.units"] = (tuple(values), np.array(units).reshape(sweep.sizes))
        variables[name] = (dims, variable.dtype, attrs)
    about = attributes(first.metadata)
    if any(pointer.keys[0] in ("convention", "quantities") for pointer in sweep.pointers):
        del about["convention"]
    # The scene is that of the first map; what the others have instead is in the coordinates.
    return _Template(len(values), sizes, coordinates, variables, about)


def _moves_pixels(pointer: Pointer) -> bool:
    """Whether the places of pixels on the screen, or their unit, depend on a value."""
    within = ("screen", "field_of_view", "window", "longitude", "latitude", "projection")
    return pointer.keys[0] == "length" or (pointer.keys[0] == "camera" and pointer.keys[1] in within)


def _coordinate(path: str, several: Sequence[Any], pointer: Pointer) -> dict[str, Any]:
    """What stands along a dimension: the values themselves, or numbers and the values beside them."""
    plain = [pointer.convert(value) if value is not None else None for value in several]
    if all(isinstance(value, str) for value in plain):
        return {path: np.array(plain)}
    if all(isinstance(value, (int, float, np.number)) for value in several):
        return {path: np.array(several)}
    numbers: dict[str, Any] = {path: np.arange(len(plain))}
    if all(isinstance(value, tuple) and len(value) == 3 for value in plain):
        extra, labels = COMPONENTS["color" if pointer.convert is amount else "position"]
        return numbers | {extra: np.array(labels), f"{path}.value": ((path, extra), np.array(plain))}
    return numbers | {f"{path}.value": (path, np.array([repr(value) for value in plain]))}


class _Memory:
    """Arrays for all maps."""

    done: frozenset[int] = frozenset()

    def __init__(self, template: _Template) -> None:
        # What no map sees is never written: memory that nobody touches costs nothing.
        self.arrays = {name: np.zeros(template.shape(name), of[1]) for name, of in template.variables.items()}

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        for name, array in self.arrays.items():
            of.copy_into(None if name == "visible" else name, array[index])

    def dataset(self, template: _Template) -> xarray.Dataset:
        return template.dataset(self.arrays)


_RENDERED = "rendered"
"""The array of a store that says of each map whether it is there; written after the map itself."""


@dataclass(frozen=True)
class _Store:
    """A Zarr store with a chunk for each map and channel: who writes a chunk writes all of it, and nobody else does."""

    path: str
    done: frozenset[int]

    @classmethod
    def prepare(cls, path: str, template: _Template, resume: bool) -> _Store:
        needed("zarr")
        if os.path.lexists(path):
            if not resume:
                raise StoreError(f"{path} exists already; resume=True goes on with it; or choose another name")
            return cls._found(path, template)
        return cls._made(path, template)

    @classmethod
    def _made(cls, path: str, template: _Template) -> _Store:
        import zarr

        template.numbered().to_zarr(path, mode="w-", zarr_format=3, consolidated=False)
        group = zarr.open_group(path, mode="r+")
        for name, (dims, dtype, attrs) in template.variables.items():
            shape = template.shape(name)
            chunks = (1,) * template.parameters + shape[template.parameters :]
            group.create_array(
                name, shape=shape, chunks=chunks, dtype=dtype, attributes=dict(attrs), dimension_names=list(dims)
            )
        parameters = template.variables["visible"][0][: template.parameters]
        sizes = tuple(template.sizes[dim] for dim in parameters)
        group.create_array(
            _RENDERED,
            shape=sizes,
            chunks=(1,) * len(sizes),
            dtype=bool,
            attributes={"long_name": "whether the map is there", "sweep": template.identity()},
            dimension_names=list(parameters),
        )
        return cls(path, frozenset())

    @classmethod
    def _found(cls, path: str, template: _Template) -> _Store:
        import zarr

        try:
            rendered = zarr.open_array(path, path=_RENDERED, mode="r")
        except (OSError, ValueError, KeyError) as error:
            raise StoreError(f"{path} is no store of a sweep: {error}") from None
        if rendered.attrs.get("sweep") != template.identity():
            raise StoreError(f"{path} holds another sweep; choose another name")
        return cls(path, frozenset(int(number) for number in np.flatnonzero(np.asarray(rendered))))

    def put(self, index: tuple[int, ...], of: _isophote.Map) -> None:
        import zarr

        for name, array in {**_arrays(of), _RENDERED: np.array(True)}.items():
            stored = zarr.open_array(self.path, path=name, mode="r+")
            stored[index] = array

    def dataset(self, template: _Template) -> xarray.Dataset:
        import xarray

        dataset: xarray.Dataset = xarray.open_zarr(self.path, chunks=None, consolidated=False)
        return dataset.drop_vars(_RENDERED).assign_coords(template.dataset({}).coords)


def _arrays(of: _isophote.Map) -> dict[str, NDArray[Any]]:
    return {**{name: of.channel(name) for name, _ in of.units()}, "visible": of.shapes() >= 0}


def _on_threads(sweep: _Sweep, numbers: Sequence[int], workers: int, into: _Memory | _Store) -> Iterator[None]:
    """Renders on threads of this process; each map takes one."""
    from concurrent.futures import ThreadPoolExecutor, as_completed

    stop = threading.Event()

    def work(number: int) -> None:
        task = sweep.task(number)
        into.put(task.index, task.render(stop=stop))

    with ThreadPoolExecutor(workers, thread_name_prefix="isophote") as pool:
        futures = [pool.submit(work, number) for number in numbers]
        try:
            for future in as_completed(futures):
                future.result()
                yield
        finally:
            # After an error, or Ctrl-C: nobody wants the others any more.
            stop.set()
            for future in futures:
                future.cancel()


def _on_cluster(sweep: _Sweep, numbers: Sequence[int], client: distributed.Client, into: _Memory | _Store) -> Iterator[None]:
    """Renders on a cluster's workers. One that dies is replaced by another."""
    import distributed

    store = into if isinstance(into, _Store) else None
    tasks = [sweep.task(number) for number in numbers]
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
