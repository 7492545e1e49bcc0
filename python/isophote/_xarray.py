"""Maps as xarray Datasets."""

from __future__ import annotations

import importlib
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray

    from .map import Map

COMPONENTS: dict[str, tuple[str, list[str]]] = {
    "position": ("axis", ["x", "y", "z"]),
    "normal": ("axis", ["x", "y", "z"]),
    "camera-normal": ("axis", ["x", "y", "z"]),
    "color": ("component", ["red", "green", "blue"]),
}
"""The third dimension of vectors, and its labels."""

NOT_SCALAR = ("shape", "material", *COMPONENTS)
"""The channels that are not one number a pixel: vectors and indices."""


def dataset(of: Map) -> xarray.Dataset:
    """See :meth:`isophote.Map.to_xarray`."""
    needed("xarray")
    import xarray

    horizontal, vertical = of.axes
    dims = (vertical.name, horizontal.name)
    columns, rows = of.coordinates()
    coordinates: dict[str, Any] = {
        horizontal.name: (horizontal.name, columns, {"units": horizontal.unit, "long_name": horizontal.title}),
        vertical.name: (vertical.name, rows, {"units": vertical.unit, "long_name": vertical.title}),
    }
    if of.has_mask:
        coordinates["visible"] = (dims, of.mask, {"long_name": "whether a surface is seen"})
    variables: dict[str, Any] = {}
    for name, unit in of.units.items():
        extra = COMPONENTS.get(name)
        if extra is not None:
            coordinates[extra[0]] = np.array(extra[1])
        variables[name] = (dims if extra is None else (*dims, extra[0]), of[name], {"units": unit})
    return xarray.Dataset(variables, coordinates, attributes(of.metadata))


def open_store(path: str) -> xarray.Dataset:
    """A Zarr store as a Dataset that reads data on demand."""
    needed("zarr")
    import xarray
    import zarr.errors

    with warnings.catch_warnings():
        # The picture and the records beside the arrays are not part of Zarr.
        warnings.simplefilter("ignore", zarr.errors.ZarrUserWarning)
        dataset: xarray.Dataset = xarray.open_zarr(path, chunks=None, consolidated=False)
    return dataset


def needed(module: str) -> Any:
    """Imports a module of another package, or says how to install it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs {module}: pip install isophote[all]") from error


def attributes(metadata: dict[str, Any]) -> dict[str, str]:
    """The metadata of a map as attributes."""
    return {
        name: metadata[name]
        for name in ("title", "convention", "renderer", "program", "scene", "color_space")
        if name in metadata
    }
