"""Maps larger than memory, in Zarr stores."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _isophote
from ._convert import Size
from ._progress import Progress, reporter
from .rendering import Channels, channel_names, positive, threads_of
from .scene import Scene

if TYPE_CHECKING:
    import distributed
    import xarray

__all__ = ["StoredMap", "render_to_zarr"]


@dataclass(frozen=True)
class StoredMap:
    """A store that is complete: how many pixels it has, how many see a surface, and how many of those are lit; and each
    channel's extremes with their columns and rows, and its mean: ``((min, [column, row]), (max, [column, row]), mean)``."""

    path: str
    pixels: int
    visible: int
    lit: int
    channels: Mapping[str, Any]

    def open(self) -> xarray.Dataset:
        """The store as an xarray Dataset, which reads what is asked of it."""
        import xarray
        import zarr

        with warnings.catch_warnings():
            # The picture and the records beside the arrays are none of Zarr's.
            warnings.simplefilter("ignore", zarr.errors.ZarrUserWarning)
            dataset: xarray.Dataset = xarray.open_zarr(self.path, chunks=None, consolidated=False)
        return dataset


def render_to_zarr(
    scene: Scene,
    size: Size | None,
    store: str | os.PathLike[str],
    *,
    channels: Channels = None,
    precision: str = "double",
    client: distributed.Client | None = None,
    threads: int | None = None,
    memory: int | None = None,
    shard_side: int | None = None,
    resume: bool = False,
    check: bool = True,
    progress: Progress = None,
) -> StoredMap:
    """Renders a map shard by shard into a Zarr store, whose bytes are those of the command line's.

    ``size``: columns and rows; the scene's own where it is ``None``.
    ``client``: a Dask client: its workers render, one shard each at a time, and write it themselves, whole. A shard whose
    worker died is rendered by another one. The workers must see the store under the same name.
    ``threads``, ``memory``: without a client, how many shards at a time, and in how many bytes.
    ``resume``: goes on with a store that holds a part of the same map. However an earlier run ended, what was done stays.
    ``check``: whether, in the end, every byte is read again and compared with its checksum.
    """
    if size is not None:
        scene = scene.with_resolution(size)
    path = os.path.abspath(os.fspath(store))
    names = channel_names(scene, channels)
    side = None if shard_side is None else positive(shard_side, "shard_side")
    plan = _Plan(scene, path, names, precision, side)
    due, count = _isophote.store_prepare(scene.core, path, names, precision, side, resume)
    with reporter(progress, "pixels" if client is None else "shards") as report:
        if client is None:
            bytes_of = None if memory is None else positive(memory, "memory")
            _isophote.store_render(scene.core, path, names, precision, side, None, threads_of(threads), bytes_of, report)
        else:
            _on_cluster(plan, due, count, client, report)
    merged = _isophote.store_merge(path, check)
    return StoredMap(path, **merged)


@dataclass(frozen=True)
class _Plan:
    """What is rendered into which store."""

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

    shared = client.scatter(plan, broadcast=True)
    futures = [client.submit(_work, shared, shard, count, pure=False, retries=3) for shard in due]
    try:
        for done, future in enumerate(distributed.as_completed(futures), start=1):
            future.result()
            if report is not None:
                report(done, len(futures))
    finally:
        client.cancel(futures)


def _work(plan: _Plan, shard: int, count: int) -> None:
    """What a cluster's worker does: one shard, rendered and written, or nothing that counts."""
    plan.render(shard, count)
