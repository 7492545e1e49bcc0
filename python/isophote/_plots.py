"""Figures drawn with matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ._xarray import NOT_SCALAR
from .errors import ArgumentError

if TYPE_CHECKING:
    import matplotlib.axes

    from .map import Map
    from .probing import Section


def _axes(ax: matplotlib.axes.Axes | None) -> matplotlib.axes.Axes:
    """The given axes, or else the current ones. Those that hold something already are left alone: a map hides what is
    under it, and the scales of two maps differ."""
    try:
        import matplotlib.axes
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("figures need matplotlib: pip install isophote[plot]") from error
    if ax is None:
        current = plt.gca()
        return plt.subplots()[1] if current.has_data() else current
    if not isinstance(ax, matplotlib.axes.Axes):
        raise ArgumentError(f"ax is {ax!r}; allowed: one Axes of matplotlib, None")
    return ax


def _refuse(options: dict[str, Any]) -> None:
    """Refuses the options that would move the picture away from its axes."""
    for name in ("extent", "origin"):
        if name in options:
            raise ArgumentError(f"{name} is {options[name]!r}; allowed: none, the axes are those of the map, in its units")


def plot_map(
    of: Map,
    channel: str | None,
    isophotes: bool | int | Sequence[float],
    ax: matplotlib.axes.Axes | None,
    options: dict[str, Any],
) -> matplotlib.axes.Axes:
    """See :meth:`isophote.Map.plot`."""
    if channel in NOT_SCALAR and channel != "color":
        raise ArgumentError(f"the channel {channel!r} is no picture; allowed: channels of one number a pixel, and color")
    _refuse(options)
    if isinstance(isophotes, (bool, np.bool_)):
        isophotes = 6 if isophotes else 0
    has_isophotes = not (isinstance(isophotes, (int, np.integer)) and isophotes == 0)
    if channel == "color" and has_isophotes:
        raise ArgumentError("isophotes has no effect on the channel 'color'; allowed: channels of one number a pixel")
    ax = _axes(ax)
    figure = ax.get_figure()
    horizontal, vertical = of.axes
    # Row 0 is at the top, whatever matplotlib's own settings say.
    placed: dict[str, Any] = {"extent": (*horizontal.edges, *vertical.edges), "origin": "upper"}
    ax.set_xlabel(horizontal.label)
    ax.set_ylabel(vertical.label)
    ax.set_title(of.metadata["title"])
    # No surface is not the same as dark: pixels that see no surface are hatched.
    ax.set_facecolor("0.93")
    ax.patch.set(hatch="///", edgecolor="0.75")
    mask = of.mask
    if channel == "color":
        colors = of["color"] / max(float(of["color"].max()), np.finfo(float).tiny)
        ax.imshow(np.dstack([_srgb(colors), mask.astype(float)]), **placed, **options)
        return ax
    name = of._main(channel)
    image = ax.imshow(np.ma.masked_where(~mask, of[name]), **placed, **options)
    about = f", {of.metadata['convention']}" if name in ("brightness", "diffuse", "specular") else ""
    unit = of.units[name]
    bar = figure.colorbar(image, ax=ax, fraction=0.046 * _height_by_width(of), pad=0.03)  # type: ignore[union-attr]
    bar.set_label(f"{name}{about}" + (f", {unit}" if unit not in ("", "1") else ""))
    if has_isophotes:
        _draw_isophotes(of, name, isophotes, ax, bar)
    return ax


def _height_by_width(of: Map) -> float:
    """The aspect ratio of the map, for a colour bar as high as the picture."""
    horizontal, vertical = of.axes
    return abs((vertical.edges[1] - vertical.edges[0]) / (horizontal.edges[1] - horizontal.edges[0]))


def _draw_isophotes(of: Map, name: str, levels: int | Sequence[float], ax: matplotlib.axes.Axes, bar: Any) -> None:
    from matplotlib.patheffects import withStroke

    labels: list[Any] = []
    for isophote in of.isophotes(levels, channel=name):
        for line in isophote.lines:
            ax.plot(line[:, 0], line[:, 1], color="white", linewidth=0.8)
        if isophote.lines:
            longest = max(isophote.lines, key=len)
            x, y = longest[len(longest) // 3]
            text = ax.annotate(f"{isophote.level:g}", (x, y), color="white", fontsize="small", ha="center", va="center")
            # Readable on any colour.
            text.set_path_effects([withStroke(linewidth=2, foreground="black")])
            box = text.get_window_extent()
            if any(box.overlaps(other) for other in labels):
                # In a small figure there is no room for all of them; the colour bar has a line for each.
                text.remove()
            else:
                labels.append(box)
            bar.ax.axhline(isophote.level, color="white", linewidth=0.8)


def _srgb(linear: Any) -> Any:
    """Encodes linear RGB as sRGB for the screen."""
    low = 12.92 * linear
    return np.clip(np.where(linear <= 0.0031308, low, 1.055 * np.power(np.maximum(linear, 0.0), 1 / 2.4) - 0.055), 0, 1)


def plot_section(
    of: Section, names: Sequence[str], ax: matplotlib.axes.Axes | None, options: dict[str, Any]
) -> matplotlib.axes.Axes:
    """See :meth:`isophote.probing.Section.plot`."""
    units = {of.units[name] for name in names}
    if len(units) != 1:
        raise ArgumentError(f"{', '.join(names)} have different units: {', '.join(sorted(units))}")
    ax = _axes(ax)
    screen = of["screen"]
    runs_along_x = np.ptp(screen[:, 0]) >= np.ptp(screen[:, 1])
    for name in names:
        ax.plot(screen[:, 0] if runs_along_x else screen[:, 1], of[name], label=name, **options)
    ax.set_xlabel(f"{'x' if runs_along_x else 'y'}, {of.units['screen']}")
    unit = units.pop()
    convention = f", {of.scene.core.describe()['convention']}" if "brightness" in names else ""
    ax.set_ylabel(f"{names[0] if len(names) == 1 else 'value'}{convention}" + (f", {unit}" if unit not in ("", "1") else ""))
    ax.set_title(of.scene.title)
    if len(names) > 1:
        ax.legend()
    return ax
