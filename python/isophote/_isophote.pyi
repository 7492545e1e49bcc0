"""The compiled part, private to the package."""

import os
from collections.abc import Callable, Sequence
from typing import Any, Final, final

import numpy as np
from numpy.typing import NDArray

from .errors import Problem

__all__ = [
    "Map",
    "Scene",
    "__version__",
    "app_page",
    "areas",
    "brightness",
    "center_on_screen",
    "command",
    "conventions",
    "explain",
    "grid",
    "nice_levels",
    "panic_on_purpose",
    "probe_pixels",
    "probe_points",
    "probe_screen",
    "probe_values",
    "read_exr",
    "read_metadata",
    "render",
    "section",
    "starter",
    "store_merge",
    "store_prepare",
    "store_render",
    "surface",
]

__version__: Final[str]

_Progress = Callable[[int, int], Any] | None
_Place = tuple[float, Sequence[int]]

@final
class Scene:
    @staticmethod
    def from_json(text: str, directory: str | os.PathLike[str], earlier: Scene | None = None) -> Scene: ...
    @staticmethod
    def from_output(metadata: str, path: str | os.PathLike[str], name: str) -> Scene: ...
    @staticmethod
    def from_text(text: str, is_json: bool, name: str, directory: str | os.PathLike[str]) -> Scene: ...
    @staticmethod
    def from_file(path: str | os.PathLike[str]) -> Scene: ...
    def to_json(self) -> str: ...
    def to_toml(self) -> str: ...
    def with_resolution(self, width: int, height: int) -> Scene: ...
    def with_parts(self, parts: Sequence[tuple[str, int | str | None, str | None]]) -> Scene: ...
    def named(self, list: str, text: str) -> Sequence[tuple[int, str]]: ...
    def unit(self, channel: str) -> str: ...
    @property
    def directory(self) -> str | os.PathLike[str]: ...
    @property
    def has_color(self) -> bool: ...
    def warnings(self) -> list[Problem]: ...
    def describe(self) -> dict[str, Any]: ...

@final
class Map:
    @staticmethod
    def of(metadata: str, channels: Sequence[tuple[str, NDArray[Any]]], shapes: NDArray[np.int32]) -> Map: ...
    def units(self) -> list[tuple[str, str]]: ...
    def channel(self, name: str) -> NDArray[Any]: ...
    def shapes(self) -> NDArray[np.int32]: ...
    def visible(self) -> int: ...
    def statistics(self, name: str) -> tuple[_Place, _Place, float] | None: ...
    def region(self) -> Sequence[int]: ...
    def over_tolerance(self) -> int | None: ...
    def axes(self) -> list[tuple[str, str, str, Sequence[float]]]: ...
    def metadata(self) -> str: ...
    def isophotes(
        self, name: str, levels: Sequence[float]
    ) -> list[tuple[float, list[tuple[NDArray[np.float64], bool]]]]: ...
    def save(
        self,
        path: str | os.PathLike[str],
        name: str,
        range: Sequence[float] | None,
        normalize: str,
        gamma: float,
        bits: int,
        colormap: str | None,
    ) -> None: ...
    def copy_into(self, name: str | None, out: NDArray[Any]) -> None: ...
    def png(self, name: str, colormap: str | None) -> bytes: ...

def brightness(
    scene: Scene, positions: NDArray[np.float64], normals: NDArray[np.float64], eyes: NDArray[np.float64]
) -> NDArray[np.float64]: ...
def app_page() -> bytes | None: ...
def command(arguments: Sequence[str]) -> int: ...
def conventions() -> list[tuple[str, str, str]]: ...
def explain(
    scene: Scene,
    index: int,
    name: str,
    point: Sequence[float] | None,
    pixel: Sequence[int] | None,
    screen: Sequence[float] | None,
    snaps: bool,
) -> str: ...

_Extreme = tuple[float, Sequence[float], Sequence[float] | None, bool]

def areas(scene: Scene) -> list[tuple[str, tuple[_Extreme, _Extreme, float, float, float] | None]]: ...
def center_on_screen(scene: Scene, shape: str) -> list[float] | None: ...
def grid(scene: Scene, name: str, channels: Sequence[str]) -> Map: ...
def nice_levels(least: float, greatest: float, about: int) -> list[float]: ...
def panic_on_purpose(message: str) -> None: ...
def probe_pixels(
    scene: Scene, pixels: NDArray[np.uint32], elsewhere: str, per_light: bool, progress: _Progress
) -> dict[str, NDArray[Any]]: ...
def probe_points(
    scene: Scene, points: NDArray[np.float64], elsewhere: str, per_light: bool, progress: _Progress
) -> dict[str, NDArray[Any]]: ...
def probe_screen(
    scene: Scene, points: NDArray[np.float64], elsewhere: str, per_light: bool, progress: _Progress
) -> dict[str, NDArray[Any]]: ...
def probe_values(
    scene: Scene, points: NDArray[np.float64], snaps: bool, progress: _Progress
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int32], int] | None: ...
def read_exr(path: str | os.PathLike[str]) -> list[tuple[str, NDArray[np.float32]]]: ...
def read_metadata(path: str | os.PathLike[str]) -> str: ...
def render(
    scene: Scene,
    channels: Sequence[str],
    precision: str,
    region: Sequence[int] | None,
    threads: int | None,
    progress: _Progress,
) -> Map: ...
def section(
    scene: Scene,
    row: int | None,
    column: int | None,
    between: Sequence[Sequence[float]] | None,
    samples: int,
) -> dict[str, NDArray[Any]]: ...
def starter(name: str) -> str: ...
def store_merge(path: str | os.PathLike[str], check: bool) -> dict[str, Any]: ...
def store_prepare(
    scene: Scene,
    path: str | os.PathLike[str],
    channels: Sequence[str],
    precision: str,
    shard_side: int | None,
    resume: bool,
) -> tuple[list[int], int]: ...
def store_render(
    scene: Scene,
    path: str | os.PathLike[str],
    channels: Sequence[str],
    precision: str,
    shard_side: int | None,
    shard: Sequence[int] | None,
    threads: int | None,
    memory: int | None,
    progress: _Progress,
) -> None: ...
def surface(
    scene: Scene,
    shape: str,
    part: int,
    channels: Sequence[str],
    projection: str,
    side: str,
    axis: Sequence[float] | None,
    size: Sequence[int] | None,
) -> tuple[Map, float, dict[str, Any]]: ...
