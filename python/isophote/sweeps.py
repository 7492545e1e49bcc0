"""Many maps of one scene with varying values."""

from __future__ import annotations

import itertools
import os
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _isophote
from ._paths import WINDOW, Pointer, locate, rewritten
from ._progress import Progress, reporter
from ._sweep_data import Memory, Store, arrays_of, template
from ._types import Precision
from ._xarray import needed
from .errors import ArgumentError
from .map import Map
from .rendering import Channels, channel_names, positive
from .scene import Scene, SceneOrPath, scene_of

if TYPE_CHECKING:
    import distributed
    import xarray

__all__ = ["sweep"]


def sweep(
    scene: SceneOrPath | Sequence[SceneOrPath],
    parameters: Mapping[str, Iterable[Any]] | None = None,
    *,
    paired: bool = False,
    channels: Channels = None,
    precision: Precision = "double",
    workers: int | None = None,
    client: distributed.Client | None = None,
    store: str | os.PathLike[str] | None = None,
    resume: bool = False,
    progress: Progress = None,
) -> xarray.Dataset:
    """The maps of a scene for every combination of parameter values, as one xarray Dataset.

    ``parameters``: values by their paths in the scene (see :meth:`Scene.set`), such as ``{"light.lamp.position":
    positions, "material.clay.shininess": [5, 20, 80]}``. Each becomes a dimension, in this order. Values that are not
    single numbers or strings are numbered along it, and stored in a coordinate of their own,
    ``light.lamp.position.value``. A value may be a whole part: ``{"light.lamp": lights, "material.clay": materials}``.
    ``paired``: the first values of all parameters make the first map, the second ones the second, and so on: the only
    dimension is ``pair``. Instead of one scene and parameters, a list of scenes of the same size has the dimension ``scene``.
    ``workers``: threads on this machine, by default one per processor.
    ``client``: a Dask client: its workers render instead.
    ``store``: a Zarr store, which must not exist yet: each map is written to it when it is done, as one chunk, and the
    Dataset reads the maps from there. A cluster's workers must see it under the same path. Its array ``rendered`` records
    which maps are complete.
    ``resume``: continue the store of the same sweep, however an earlier run ended.

    If units or pixel positions differ between maps, ``<channel>.units`` holds the units, and pixels are numbered instead.
    """
    needed("xarray")
    scenes = None
    if not isinstance(scene, (Scene, str, os.PathLike)) and isinstance(scene, Iterable):
        scenes = [scene_of(one) for one in scene]
        if not scenes or parameters is not None or paired:
            raise ArgumentError("a list of scenes needs at least one, and goes without parameters and paired")
        scene = scenes[0]
    scene = scene_of(scene)
    if scenes is None and not isinstance(parameters, Mapping):
        raise ArgumentError(f"parameters is {parameters!r}; allowed: a dictionary from paths to lists of values")
    values = {path: list(several) for path, several in (parameters or {}).items()}
    for path, several in values.items():
        if not several:
            raise ArgumentError(f"{path!r} has no values")
    if paired and len({len(several) for several in values.values()}) != 1:
        counts = ", ".join(f"{path!r} has {len(several)}" for path, several in values.items()) or "there are no parameters"
        raise ArgumentError(f"paired parameters need equally many values: {counts}")
    names = channel_names(scene, channels)
    if client is not None and workers is not None:
        raise ArgumentError("workers has no effect with a client, which has its own")
    count = (os.cpu_count() or 1) if workers is None else positive(workers, "workers")
    _refuse_what_is_no_client(client)
    place = None if store is None else os.path.abspath(store)
    if resume and place is None:
        raise ArgumentError("resume goes on with a store: say which")
    with reporter(progress, "maps") as report:
        sweep = (
            Sweep.of(scene, values, names, precision, paired)
            if scenes is None
            else Sweep.of_scenes(scenes, names, precision)
        )
        # Its layout is that of all maps.
        first = sweep.task(0).render(threads=None)
        form = template(sweep, values, Map(first, scene))
        into = Memory(form) if place is None else Store.prepare(place, form, resume)
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
    return into.dataset(form)


@dataclass(frozen=True)
class Sweep:
    """All maps of a sweep, by index."""

    scene: Scene
    cores: list[_isophote.Scene]
    dims: dict[str, int]
    """The dimensions that its parameters span, and their sizes."""
    pointers: tuple[Pointer, ...]
    names: list[str]
    precision: str
    places_differ: bool = False
    """Of scenes that are given one by one: whether their pixels are in different places of the screen."""

    @classmethod
    def of(cls, scene: Scene, values: Mapping[str, Sequence[Any]], names: list[str], precision: str, paired: bool) -> Sweep:
        """Every combination: anything wrong with any of them is found before the first map is rendered."""
        pointers = tuple(locate(scene, path) for path in values)
        for one, other in itertools.combinations(pointers, 2):
            if one.keys == other.keys:
                raise ArgumentError(f"{one.path!r} and {other.path!r} are the same")
            if one.keys[: len(other.keys)] == other.keys or other.keys[: len(one.keys)] == one.keys:
                raise ArgumentError(f"of {one.path!r} and {other.path!r} one is a part of the other")
        if any(pointer.keys in (("camera",), ("camera", "resolution")) for pointer in pointers):
            raise ArgumentError("a sweep cannot change the number of pixels; name what it changes, such as camera.eye")
        cores = []
        combinations = zip(*values.values()) if paired else itertools.product(*values.values())
        for combination in combinations:
            cores.append(scene.with_parts(rewritten(zip(pointers, combination))))
        sizes = {path: len(several) for path, several in values.items()}
        return cls(scene, cores, {"pair": len(cores)} if paired else sizes, pointers, names, precision)

    @classmethod
    def of_scenes(cls, scenes: Sequence[Scene], names: list[str], precision: str) -> Sweep:
        """One map of each of these scenes."""
        sizes = [scene.camera.resolution for scene in scenes]
        for number, size in enumerate(sizes):
            if size != sizes[0]:
                raise ArgumentError(f"scene {number} has {size} pixels, the first one {sizes[0]}; allowed: the same")
        windows = {(scene.length, *(getattr(scene.camera, name) for name in WINDOW)) for scene in scenes}
        cores = [scene.core for scene in scenes]
        return cls(scenes[0], cores, {"scene": len(cores)}, (), names, precision, len(windows) > 1)

    @property
    def sizes(self) -> tuple[int, ...]:
        return tuple(self.dims.values())

    @property
    def moves_pixels(self) -> bool:
        """Whether maps may cover different places, or in another unit."""
        return self.places_differ or any(pointer.moves_pixels for pointer in self.pointers)

    @property
    def changes_convention(self) -> bool:
        return len({core.describe()["convention"] for core in self.cores}) > 1

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
    """Another map failed, or the user stopped the sweep."""


def _refuse_what_is_no_client(client: Any) -> None:
    if client is not None and not hasattr(client, "submit"):
        raise ArgumentError(f"client is {client!r}; allowed: a Client of Dask")


def _on_threads(sweep: Sweep, numbers: Sequence[int], workers: int, into: Memory | Store) -> Iterator[None]:
    """Renders on threads of this process; each map uses one."""
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
            # After an error or Ctrl-C the other maps are no longer needed.
            stop.set()
            for future in futures:
                future.cancel()


def _on_cluster(sweep: Sweep, numbers: Sequence[int], client: distributed.Client, into: Memory | Store) -> Iterator[None]:
    """Renders on a cluster's workers. If a worker dies, another one takes over."""
    import distributed

    store = into if isinstance(into, Store) else None
    tasks = [sweep.task(number) for number in numbers]
    futures = [client.submit(_work, task, store, pure=False, retries=3) for task in tasks]
    index = {future.key: task.index for future, task in zip(futures, tasks)}
    try:
        for future in distributed.as_completed(futures):
            values = future.result()
            if isinstance(into, Memory):
                for name, array in into.arrays.items():
                    array[index[future.key]] = values[name]
            future.release()
            yield
    finally:
        client.cancel(futures)


def _work(task: _Task, store: Store | None) -> dict[str, NDArray[Any]] | None:
    """A cluster worker's task: render a map into the store, or return it."""
    of = task.render()
    if store is None:
        return arrays_of(of)
    store.put(task.index, of)
    return None
