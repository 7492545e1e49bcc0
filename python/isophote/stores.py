"""Maps larger than memory, in Zarr stores."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from . import _isophote
from ._convert import Size
from ._progress import Progress, reporter
from ._types import Precision
from ._xarray import open_store
from .errors import ArgumentError
from .rendering import Channels, channel_names, counted, positive, threads_of
from .scene import Scene, SceneOrPath, scene_of

if TYPE_CHECKING:
    import distributed
    import xarray

__all__ = ["ChannelStatistics", "StoredMap", "render_to_zarr"]


@dataclass(frozen=True)
class ChannelStatistics:
    """Statistics of a channel over the pixels that see a surface, in the channel's unit.

    - ``min``, ``max``, ``mean``: the values
    - ``argmin``, ``argmax``: (row, column) of the first pixel that has the minimum, the maximum
    """

    min: float
    argmin: tuple[int, int]
    max: float
    argmax: tuple[int, int]
    mean: float


@dataclass(frozen=True)
class StoredMap:
    """A complete store.

    - ``path``: where it is
    - ``pixels``, ``visible``, ``lit``: how many there are, see a surface, and see one that light reaches
    - ``channels``: each channel's statistics; ``None`` if it is not a scalar, or if no surface is seen
    """

    path: str
    pixels: int
    visible: int
    lit: int
    channels: Mapping[str, ChannelStatistics | None] = field(hash=False)

    def open(self) -> xarray.Dataset:
        """The store as an xarray Dataset, which reads data on demand."""
        return open_store(self.path)


def render_to_zarr(
    scene: SceneOrPath,
    size: Size | None,
    store: str | os.PathLike[str],
    *,
    channels: Channels = None,
    precision: Precision = "double",
    client: distributed.Client | None = None,
    threads: int | None = None,
    memory: int | None = None,
    shard_side: int | None = None,
    resume: bool = False,
    check: bool = True,
    progress: Progress = None,
) -> StoredMap:
    """Renders a map shard by shard into a Zarr store, with the same bytes as from the command line.

    ``size``: columns and rows; ``None`` uses the scene's own.
    ``client``: a Dask client: its workers render one shard each at a time, and write it whole themselves. If a worker
    dies, its shard is rendered by another one. The workers must see the store under the same path.
    ``threads``, ``memory``: without a client, how many shards at a time, and the memory limit in bytes, the scene included; a
    scene is read before the limit is known, unlike in the command.
    ``resume``: continue a store that holds a part of the same map. However an earlier run ended, finished shards are kept.
    ``check``: whether to reread every byte at the end and compare it with its checksum.
    """
    scene = scene_of(scene)
    if size is not None:
        scene = scene.with_resolution(size)
    if client is not None and (threads is not None or memory is not None):
        raise ArgumentError("threads and memory are for this machine alone: the cluster's workers have their own")
    if client is not None and not hasattr(client, "submit"):
        raise ArgumentError(f"client is {client!r}; allowed: a Client of Dask")
    count_of_threads, bytes_of = threads_of(threads), None if memory is None else counted(memory, "memory", 1, 2**63)
    path = os.path.abspath(os.fspath(store))
    names = channel_names(scene, channels)
    side = None if shard_side is None else positive(shard_side, "shard_side")
    plan = _Plan(scene, path, names, precision, side)
    with reporter(progress, "pixels" if client is None else "shards") as report:
        due, count = _isophote.store_prepare(scene.core, path, names, precision, side, resume)
        if client is None:
            _isophote.store_render(scene.core, path, names, precision, side, None, count_of_threads, bytes_of, report)
        else:
            _on_cluster(plan, due, count, client, report)
    merged = _isophote.store_merge(path, check)
    statistics = {name: None if of is None else _statistics(of) for name, of in merged.pop("channels").items()}
    return StoredMap(path, channels=statistics, **merged)


def _statistics(of: Any) -> ChannelStatistics:
    (least, [least_column, least_row]), (greatest, [greatest_column, greatest_row]), mean = of
    return ChannelStatistics(least, (least_row, least_column), greatest, (greatest_row, greatest_column), mean)


@dataclass(frozen=True)
class _Plan:
    """What to render, and into which store."""

    scene: Scene
    path: str
    names: list[str]
    precision: str
    shard_side: int | None

    def render(self, shard: int, count: int) -> None:
        _isophote.store_render(
            self.scene.core, self.path, self.names, self.precision, self.shard_side, [shard, count], 1, None, None
        )


def _on_cluster(plan: _Plan, due: list[int], count: int, client: distributed.Client, report: Any) -> None:
    import distributed

    # The plan is small and is sent with each task: scattered data is lost with the workers that hold it.
    futures = [client.submit(_work, plan, shard, count, pure=False, retries=3) for shard in due]
    try:
        for done, future in enumerate(distributed.as_completed(futures), start=1):
            future.result()
            if report is not None:
                report(done, len(futures))
    finally:
        client.cancel(futures)


def _work(plan: _Plan, shard: int, count: int) -> None:
    """A cluster worker's task: render and write one shard, or leave nothing that counts."""
    plan.render(shard, count)
