import json
import sys
import warnings

import numpy as np
import xarray
import zarr

# A reader that is in doubt about anything is a failure.
warnings.simplefilter("error")

store, expected = sys.argv[1], json.load(open(sys.argv[2]))

group = zarr.open_group(store, mode="r")
assert group.metadata.consolidated_metadata is not None
for open_group in (group, zarr.open_group(store, mode="r", use_consolidated=False)):
    for name, values in expected["channels"].items():
        array = open_group[name]
        values = np.array(values, dtype=array.dtype).reshape(array.shape)
        assert array.shape[:2] == (50, 70), array.shape
        assert np.array_equal(array[...], values), name
        assert array.shards is not None and array.chunks[:2] == (4, 4), array.chunks
assert group["shape"].dtype == np.int32 and group["shape"].fill_value == -1

with xarray.open_zarr(store) as data:
    assert data.attrs["title"] == expected["title"]
    assert data.attrs["statistics"]["channels"]["brightness"]["max"]["value"] == expected["max"]
    brightness = data["brightness"]
    assert brightness.dims == ("y", "x") and brightness.attrs["units"]
    assert float(brightness.max()) == expected["max"]
    assert not bool(brightness.isnull().any()), "a pixel without a surface is 0"
    assert data["x"].shape == (70,) and data["y"].shape == (50,) and data["x"].attrs["units"]
    assert bool((data["y"].diff("y") < 0).all()), "row 0 is on top"
