import json

import numpy

with open("expected.json", encoding="utf-8") as file:
    expected = json.load(file)
archive = numpy.load("map.npz", allow_pickle=False)
assert sorted(archive.files) == sorted([*expected["channels"], "mask", "metadata"]), archive.files

for name, values in expected["channels"].items():
    kind = "<i4" if name == "shape" else "<f8"
    values = numpy.array(values, dtype=kind)
    values = values.reshape((2, 3, *values.shape[1:]))
    for array in (archive[name], numpy.load(f"{name}.npy"), numpy.load(f"{name}.npy", mmap_mode="r")):
        assert array.dtype.str == kind, (name, array.dtype)
        assert array.shape == values.shape, (name, array.shape)
        # Bytes, for 0 equals -0.
        assert array.tobytes() == values.tobytes(), (name, array, values)

assert archive["mask"].dtype == bool
assert (archive["mask"] == (archive["shape"] >= 0)).all()
assert archive["metadata"].shape == ()
metadata = json.loads(archive["metadata"].item())
stored_as = {channel.pop("stored_as")[0] for channel in metadata["channels"]}
for channel in expected["metadata"]["channels"]:
    channel.pop("stored_as", None)
assert stored_as == set(expected["channels"]), stored_as
assert metadata == expected["metadata"]
print("numpy", numpy.__version__, "read npy, npz", end="")

with open("map.csv", encoding="utf-8") as file:
    comments = sum(line.startswith("#") for line in file)
table = numpy.genfromtxt("map.csv", delimiter=",", names=True, skip_header=comments, encoding="utf-8")
assert table.shape == (6,)
assert (table["irradiance"] == numpy.array(expected["channels"]["irradiance"])).all()
assert (table["x"] == [-1, 0, 1] * 2).all() and (table["y"] == [-0.5] * 3 + [-1.5] * 3).all()
print(", csv")

try:
    import pandas
except ImportError:
    print("skipped: pandas")
else:
    # Its default parser may miss the last bit of a number; the columns and rows are what is compared here.
    frame = pandas.read_csv("visible.csv", comment="#", float_precision="round_trip")
    assert list(frame["column"]) == [1, 3, 1, 2] and list(frame["row"]) == [2, 2, 3, 3]
    values = [expected["channels"]["light.лампа"][index] for index in (0, 2, 3, 4)]
    assert list(frame["light.лампа"]) == values
    assert list(frame["light.a_ _b_ _/../c."]) == [0.25, 3.0, 4.0, 5e-324]
    print("pandas", pandas.__version__, "read csv")

try:
    import OpenEXR
except ImportError:
    print("skipped: OpenEXR")
else:
    with OpenEXR.File("map.exr", separate_channels=True) as file:
        header, channels = file.header(), file.channels()
        assert json.loads(header["isophote"])["scene"] == expected["metadata"]["scene"]
        assert "light.лампа.Y: light.лампа, W/m²" in header["units"]
        assert [list(map(int, corner)) for corner in header["dataWindow"]] == [[1, 2], [3, 3]]
        assert [list(map(int, corner)) for corner in header["displayWindow"]] == [[0, 0], [4, 3]]
        for name, channel in (("brightness", "Y"), ("irradiance", "irradiance.Y"), ("light.лампа", "light.лампа.Y")):
            values = numpy.array(expected["channels"][name]).astype("<f4").reshape((2, 3))
            assert channels[channel].pixels.tobytes() == values.tobytes(), channel
        assert (channels["shape.index"].pixels == [[0, -1, 7], [0, 1, -1]]).all()
        print("OpenEXR", OpenEXR.OPENEXR_VERSION if hasattr(OpenEXR, "OPENEXR_VERSION") else "", "read exr")
