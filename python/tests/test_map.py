"""Maps as arrays, and their files."""

from __future__ import annotations

import copy
import gc
import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import REPOSITORY

import isophote as iso


def test_channels_are_views_of_the_maps_own_memory(lab_map):
    first, again = lab_map["brightness"], lab_map["brightness"]
    assert first.dtype == np.float64 and first.shape == (600, 800)
    assert lab_map["normal"].shape == (600, 800, 3)
    assert lab_map["shape"].dtype == np.int32
    assert first.ctypes.data == again.ctypes.data
    assert not first.flags.owndata
    for channel in lab_map:
        assert not lab_map[channel].flags.writeable
        with pytest.raises(ValueError, match=r"read-only|WRITEABLE"):
            lab_map[channel].flags.writeable = True
            lab_map[channel][0, 0] = 1
    assert iso.render(iso.scenes.lab(), precision="single")["brightness"].dtype == np.float32


def test_an_array_outlives_its_map(lab):
    array = iso.render(lab)["brightness"]
    expected = array.copy()
    gc.collect()
    more = [iso.render(lab.set({"light.lamp.intensity": 7.0}))["brightness"] for _ in range(3)]
    assert more[0].max() < array.max()
    np.testing.assert_array_equal(array, expected)


def test_statistics_are_those_of_the_visible_pixels(lab_map):
    values, mask = lab_map["brightness"], lab_map.mask
    assert mask.sum() == 32744
    assert lab_map.max() == values[mask].max() == values[lab_map.argmax()]
    assert lab_map.min() == values[mask].min() == values[lab_map.argmin()]
    assert lab_map.mean() == pytest.approx(values[mask].mean(), rel=1e-13)
    assert lab_map.max("depth") == lab_map["depth"][mask].max()
    np.testing.assert_array_equal(lab_map.shapes >= 0, mask)
    assert (values[~mask] == 0).all()


def test_a_part_of_the_image_is_the_part_of_its_map(lab, lab_map):
    part = iso.render(lab, region=(300, 200, 150, 100))
    assert part.region == (300, 200, 150, 100)
    np.testing.assert_array_equal(part["brightness"], lab_map["brightness"][200:300, 300:450])
    row, column = part.argmax()
    assert part["brightness"][row, column] == part.max()
    x, y = part.coordinates()
    whole_x, whole_y = lab_map.coordinates()
    np.testing.assert_allclose(x, whole_x[300:450], atol=1e-12)
    np.testing.assert_allclose(y, whole_y[200:300], atol=1e-12)


def test_units_and_coordinates(lab_map):
    assert lab_map.units["brightness"] == "W/m²"
    assert lab_map.units["position"] == "m"
    assert lab_map.units["normal"] == "1"
    x, y = lab_map.coordinates()
    assert x[0] == pytest.approx(-3.995) and x[-1] == pytest.approx(3.995)
    assert y[0] == pytest.approx(2.995) and y[-1] == pytest.approx(-2.995)
    assert lab_map.axes[0].label == "x, m"
    assert "800×600" in repr(lab_map) and "lab (3.3)" in repr(lab_map)
    assert "data:image/png;base64" in lab_map._repr_html_()


def test_each_lights_image_is_in_one_array():
    scene = iso.scenes.two_lights()
    images = iso.render(scene, channels=["irradiance", "lights"])
    assert images.lights == tuple(light.name for light in scene.lights)
    assert images.light_images().shape == (2, *images.shape)
    np.testing.assert_allclose(images.light_images().sum(axis=0), images["irradiance"], rtol=1e-14)


def test_what_the_camera_sees_is_in_its_own_axes(lab, lab_map):
    m, mask = lab_map, lab_map.mask
    assert {"z-depth", "cos_theta_o", "camera-normal", "material"} <= set(m)
    # The eye is at the origin, forward is z, up is y, and x runs to the right in this left-handed scene.
    np.testing.assert_allclose(m["z-depth"][mask], m["position"][mask][:, 2], rtol=1e-14)
    np.testing.assert_allclose(m["camera-normal"][mask], m["normal"][mask] * [1, -1, 1], atol=1e-15)
    rows, columns = np.nonzero(mask)
    some = slice(None, None, 997)
    probes = iso.probe(lab, pixels=np.stack([columns, rows], axis=-1)[some])
    np.testing.assert_allclose(m["cos_theta_o"][mask][some], probes.cos_theta_o, atol=1e-14)
    np.testing.assert_array_equal(m["material"], np.where(mask, 0, -1))
    assert m.units["z-depth"] == "m" and m.units["camera-normal"] == "1" and m.units["material"] == ""
    for channel in ("z-depth", "cos_theta_o", "camera-normal"):
        assert (m[channel][~mask] == 0).all()
    with pytest.raises(iso.ArgumentError, match="no picture"):
        m.plot("camera-normal")
    assert m.to_xarray()["camera-normal"].dims == ("y", "x", "axis")


def test_material_is_the_index_of_its_name():
    scene = iso.scenes.two_lights()
    m = iso.render(scene, channels=["material", "shape"])
    names = sorted(scene.materials)
    for index in np.unique(m.shapes[m.mask]):
        assert (m["material"][m.shapes == index] == names.index(scene.shapes[index].material)).all()


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
@pytest.mark.parametrize("name", ["two-lights", "color", "shadows", "spot"])
@pytest.mark.parametrize("precision", ["double", "single"])
def test_the_brightness_of_the_lights_adds_up(name, precision):
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / f"{name}.toml").replace(ambient=None, sampling=None)
    m = iso.render(scene, size=(80, 60), channels=["brightness", "light-brightness"], precision=precision)
    parts = [channel for channel in m if channel.startswith("brightness.")]
    assert len(parts) == len(scene.lights)
    total = sum(m[channel].astype(float) for channel in parts)
    assert np.abs(total - m["brightness"]).max() <= (1e-12 if precision == "double" else 1e-5) * m.max("brightness")
    assert {m.units[channel] for channel in parts} == {m.units["brightness"]}
    first = scene.replace(lights=scene.lights[:1])
    np.testing.assert_allclose(m[parts[0]], iso.render(first, size=(80, 60), precision=precision)["brightness"], rtol=1e-6)
    with pytest.raises(iso.ArgumentError, match="no light named"):
        iso.render(scene, channels=["brightness.lump"])


def test_xarray_has_dimensions_coordinates_and_units(lab_map):
    dataset = lab_map.to_xarray()
    assert dataset["brightness"].dims == ("y", "x")
    assert dataset["normal"].dims == ("y", "x", "axis")
    assert dataset["brightness"].attrs["units"] == "W/m²"
    assert dataset["x"].attrs["units"] == "m"
    assert float(dataset["brightness"].where(dataset["visible"]).max()) == lab_map.max()
    assert iso.Scene.from_toml(dataset.attrs["scene"]) == lab_map.scene


def test_isophotes_lie_on_their_levels(lab_map):
    levels = lab_map.isophotes(6)
    assert len(levels) > 3
    x, y = lab_map.coordinates()
    for isophote in lab_map.isophotes([0.1, 0.2]):
        assert isophote.lines
        for line in isophote.lines:
            columns = np.interp(line[:, 0], x, np.arange(len(x)))
            rows = np.interp(-line[:, 1], -y, np.arange(len(y)))
            values = lab_map["brightness"][np.rint(rows).astype(int), np.rint(columns).astype(int)]
            assert np.abs(values - isophote.level).max() < 0.02
    for levels in ([float("nan")], -1, 10**5, [0.1] * 2000):
        with pytest.raises(iso.ArgumentError):
            lab_map.isophotes(levels)


@pytest.mark.parametrize("name", ["map.exr", "map.npz", "map.csv", "map.npy"])
def test_files_hold_the_values_and_the_scene(lab_map, tmp_path, name):
    path = tmp_path / name
    lab_map.save(path)
    file = iso.read(path)
    assert file.scene == lab_map.scene
    assert file.region == lab_map.region
    assert list(file) == (["brightness"] if name.endswith("npy") else list(lab_map))
    for channel in file:
        assert file.units[channel] == lab_map.units[channel]
        if name.endswith("exr"):
            np.testing.assert_array_equal(file[channel], lab_map[channel].astype(np.float32))
        else:
            np.testing.assert_array_equal(file[channel], lab_map[channel])


@pytest.mark.parametrize("name", ["map.exr", "map.npz", "map.csv"])
def test_a_map_that_was_read_is_a_map(lab, tmp_path, name):
    of = iso.render(lab, channels=["brightness", "normal"])
    of.save(tmp_path / name)
    file = iso.read(tmp_path / name)
    assert isinstance(file, iso.Map)
    np.testing.assert_array_equal(file["mask"], of.mask)
    np.testing.assert_array_equal(file.mask, of.mask)
    np.testing.assert_array_equal(file.shapes, of.shapes)
    assert "mask" in file and "normal" in file and "depth" not in file
    assert "mask" in of and (of["mask"] == of.mask).all()
    assert file.max() == pytest.approx(of.max(), rel=1e-6) and file.argmax() == of.argmax()
    assert file.mean() == pytest.approx(of.mean(), rel=1e-6)
    assert file.shape == of.shape and file.axes == of.axes
    assert len(file.isophotes([0.2])[0].lines) == len(of.isophotes([0.2])[0].lines)
    data = file.to_xarray()
    np.testing.assert_array_equal(data["visible"], of.mask)
    assert data["brightness"].attrs["units"] == "W/m²"
    assert file.plot(isophotes=3).get_xlabel() == "x, m"
    for again in (pickle.loads(pickle.dumps(file)), copy.deepcopy(file)):
        np.testing.assert_array_equal(again["brightness"], file["brightness"])
    file.save(tmp_path / f"again{name}")
    if not name.endswith("csv"):
        np.testing.assert_array_equal(iso.read(tmp_path / f"again{name}")["brightness"], file["brightness"])
    with pytest.raises(KeyError, match="has no channel 'depth'"):
        file["depth"]


def test_a_file_without_a_mask_says_so(lab, lab_map, tmp_path):
    lab_map.save(tmp_path / "map.npy")
    file = iso.read(tmp_path / "map.npy")
    assert not file.has_mask and "brightness" in file
    for use in (lambda: file.mask, file.max, file.plot):
        with pytest.raises(iso.ArgumentError, match=r"no mask; save \.npz"):
            use()
    assert "visible" not in file.to_xarray().coords
    # A depth is never 0 on a surface.
    lab_map.save(tmp_path / "map.npy", channel="depth")
    np.testing.assert_array_equal(iso.read(tmp_path / "map.npy").mask, lab_map.mask)
    points = iso.Grid(center=(0, -1, 5), u=(2, 0, 0), v=(0, 0, 2), points=(5, 5))
    iso.grid(lab.replace(grids=[points])).save(tmp_path / "grid.exr")
    assert iso.read(tmp_path / "grid.exr").mask.all()


def test_maps_are_copied_and_pickled_with_their_values(lab, lab_map):
    surface = iso.surface(lab, size=(36, 18))
    for of in (lab_map, iso.render(lab, precision="single", region=(300, 200, 50, 40)), surface):
        for again in (pickle.loads(pickle.dumps(of)), copy.copy(of), copy.deepcopy(of)):
            assert type(again) is type(of) and list(again) == list(of) and again.scene == of.scene
            assert again.units == of.units and again.region == of.region and again.axes == of.axes
            np.testing.assert_array_equal(again.shapes, of.shapes)
            for channel in of:
                np.testing.assert_array_equal(again[channel], of[channel])
                assert again[channel].dtype == of[channel].dtype and not again[channel].flags.writeable
    assert pickle.loads(pickle.dumps(surface)).totals == surface.totals


@pytest.mark.parametrize(
    "name, options",
    [
        ("map.exr", {"gamma": 2.2}),
        ("map.exr", {"channel": "depth"}),
        ("map.npz", {"bits": 16}),
        ("map.csv", {"range": (0, 1)}),
        ("map.npy", {"colormap": "viridis"}),
        ("map.exr", {"normalize": "log"}),
        ("map.npy", {"normalize": "max"}),
    ],
)
def test_an_option_without_effect_is_refused(lab_map, tmp_path, name, options):
    with pytest.raises(iso.ArgumentError, match=f"{next(iter(options))} has no effect on a {name[3:]} file"):
        lab_map.save(tmp_path / name, **options)
    assert list(tmp_path.iterdir()) == []


def test_options_of_figures_and_colours_without_effect_are_refused(lab, tmp_path):
    of = iso.render(lab.set({"material.clay.diffuse": (0.1, 0.2, 0.3)}), size=(80, 60))
    for options in ({"gamma": 2.2}, {"colormap": "viridis"}, {"normalize": "minmax"}):
        with pytest.raises(iso.ArgumentError, match="has no effect on the channel 'color'"):
            of.save(tmp_path / "map.png", **options)
    with pytest.raises(iso.ArgumentError, match="isophotes has no effect"):
        of.plot("color", isophotes=5)


def test_a_picture_has_a_scene_and_no_values(lab_map, tmp_path):
    lab_map.save(tmp_path / "map.png", colormap="viridis")
    file = iso.read(tmp_path / "map.png")
    assert file.scene == lab_map.scene
    with pytest.raises(iso.ArgumentError, match="picture"):
        file["brightness"]


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
@pytest.mark.parametrize("suffix", ["npz", "exr", "png"])
def test_files_are_those_of_the_command_byte_for_byte(tmp_path, suffix):
    scene = REPOSITORY / "scenes" / "two-lights.toml"
    by_command, by_package = tmp_path / f"command.{suffix}", tmp_path / f"package.{suffix}"
    channels = ["brightness", "normal"]
    options = [word for channel in channels for word in ("-c", channel)]
    command = [sys.executable, "-m", "isophote", "render", "--quiet", str(scene), *options, "-o", str(by_command)]
    subprocess.run(command, check=True, capture_output=True)
    iso.render(iso.Scene.from_file(scene), channels=channels).save(by_package)
    assert by_command.read_bytes() == by_package.read_bytes()


@pytest.mark.parametrize("normalize", ["max", "minmax", "log"])
def test_normalized_pictures_are_those_of_the_command_byte_for_byte(lab, lab_map, tmp_path, normalize):
    by_command, by_package, by_file = (tmp_path / f"{name}.png" for name in ("command", "package", "file"))
    lab_map.save(tmp_path / "map.npz")
    (tmp_path / "lab.toml").write_text(lab.to_toml(), encoding="utf-8")
    options = ["--normalize", normalize, "-o", str(by_command)]
    command = [sys.executable, "-m", "isophote", "render", "--quiet", str(tmp_path / "lab.toml"), *options]
    subprocess.run(command, check=True, capture_output=True)
    lab_map.save(by_package, normalize=normalize)
    assert by_command.read_bytes() == by_package.read_bytes()
    iso.read(tmp_path / "map.npz").save(by_file, normalize=normalize)
    assert by_file.read_bytes() == by_package.read_bytes()
    assert iso.read(by_package).metadata["picture"].get("normalization", "max") == normalize


def test_a_file_is_written_whole_or_not_at_all(lab_map, tmp_path):
    with pytest.raises(OSError, match="no folder"):
        lab_map.save(tmp_path / "missing" / "map.exr")
    for options in (
        {"range": (None, 1)},
        {"range": (0,)},
        {"bits": 256},
        {"range": (1, 0)},
        {"gamma": -1},
        {"bits": 12},
        {"colormap": "jet"},
        {"channel": "normal"},
        {"normalize": "mean"},
        {"normalize": "log", "range": (0, 1)},
    ):
        with pytest.raises(iso.ArgumentError):
            lab_map.save(tmp_path / "map.png", **options)
    with pytest.raises(iso.ArgumentError, match="cannot tell the format"):
        lab_map.save(tmp_path / "map.bmp")
    with pytest.raises(KeyError):
        lab_map.save(tmp_path / "map.png", channel="nothing")
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "other.exr").write_bytes(b"something else")
    with pytest.raises(OSError, match="no PNG, EXR"):
        iso.read(tmp_path / "other.exr")


def test_figures_are_drawn_with_units(lab_map, lab):
    axes = lab_map.plot(isophotes=6)
    assert axes.get_xlabel() == "x, m"
    assert any("brightness, lab (3.3), W/m²" in one.get_ylabel() for one in axes.figure.axes)
    axes = iso.section(lab, row=300).plot("brightness", "diffuse")
    assert axes.get_ylabel().endswith("W/m²")
    with pytest.raises(iso.ArgumentError):
        lab_map.plot("normal")
    import matplotlib.pyplot as plt

    plt.close("all")


@pytest.fixture
def plt():
    import matplotlib.pyplot as plt

    plt.close("all")
    with plt.rc_context():
        yield plt
    plt.close("all")


@pytest.mark.parametrize("channel", ["brightness", "color"])
def test_row_0_is_drawn_at_the_top_whatever_matplotlib_is_set_to(plt, lab, channel):
    colored = lab.set({"material.clay.diffuse": (0.1, 0.2, 0.3)})
    of = iso.render(colored, size=(80, 60), channels=["brightness", "color"])
    plt.rcParams["image.origin"] = "lower"
    axes = of.plot(channel)
    image = axes.images[0]
    assert image.origin == "upper"
    assert axes.get_ylim() == (-3, 3) and tuple(image.get_extent()) == (-4, 4, -3, 3)
    for options in ({"origin": "lower"}, {"extent": (0, 1, 0, 1)}):
        with pytest.raises(iso.ArgumentError, match=next(iter(options))):
            of.plot(channel, **options)


def test_true_isophotes_are_about_six_and_labels_do_not_collide(plt, lab_map):
    _, (one, other, small) = plt.subplots(1, 3, figsize=(5, 2))
    lab_map.plot(isophotes=True, ax=one)
    lab_map.plot(isophotes=6, ax=other)
    assert len(one.lines) == len(other.lines) > 3
    lab_map.plot(isophotes=False, ax=small)
    assert not small.lines
    boxes = [text.get_window_extent() for text in one.texts]
    assert boxes and not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_figures_go_into_the_current_axes_if_they_are_empty(plt, lab_map, lab):
    _, (left, right) = plt.subplots(1, 2)
    plt.sca(left)
    assert lab_map.plot() is left
    plt.sca(right)
    assert lab_map.plot("depth") is right
    fresh = lab_map.plot()
    assert fresh not in (left, right) and len(left.images) == 1
    given = plt.figure().add_subplot()
    assert iso.section(lab, row=300).plot(ax=given) is given
    for ax in ([left, right], 5):
        with pytest.raises(iso.ArgumentError, match="ax is"):
            lab_map.plot(ax=ax)


def test_a_loop_renders_into_its_own_arrays(lab):
    images = np.full((3, 60, 80), 7.0)
    masks, normals = np.ones((3, 60, 80), bool), np.full((60, 80, 3), 7.0)
    shapes = np.full((60, 80), 7, np.int32)
    for number in range(3):
        scene = lab.set({"light.lamp.intensity": 10.0 * (number + 1)})
        out = {"brightness": images[number], "mask": masks[number], "normal": normals, "shape": shapes}
        m = iso.render(scene, size=(80, 60), out=out)
        np.testing.assert_array_equal(images[number], m["brightness"])
        np.testing.assert_array_equal(masks[number], m.mask)
        np.testing.assert_array_equal(normals, m["normal"])
        np.testing.assert_array_equal(shapes, m["shape"])
    assert images[2].max() > images[0].max()
    before = images.copy()
    for wrong in (
        5,
        {"brightness": images},
        {"brightness": images[0].astype(np.float32)},
        {"brightness": np.zeros((80, 60)).T},
        {"brightness": images[0], "mask": images[1]},
        {"brightness": [1]},
        {"brightness": images[0], "depth": m["normal"]},
    ):
        with pytest.raises(iso.ArgumentError):
            iso.render(lab, size=(80, 60), out=wrong)
    with pytest.raises(iso.ArgumentError, match="not rendered"):
        iso.render(lab, size=(80, 60), channels="brightness", out={"depth": images[0]})
    np.testing.assert_array_equal(images, before)


def test_what_a_map_cannot_do_it_says(lab, lab_map):
    with pytest.raises(KeyError, match="this map has no channel 'coverage'"):
        lab_map["coverage"]
    for options in (
        {"channels": []},
        {"channels": ["brightnes"]},
        {"channels": ["light.lump"]},
        {"channels": "color"},
        {"channels": [1]},
        {"channels": 5},
        {"region": 5},
        {"precision": 5},
        {"size": (2**40, 3)},
        {"size": (-5, 3)},
        {"threads": 100_000},
        {"region": (0, 0, 801, 600)},
        {"region": (0, 0, 0, 0)},
        {"region": (-1, 0, 5, 5)},
        {"region": (0, 0, 5)},
        {"precision": "half"},
        {"threads": 0},
        {"threads": 1.5},
    ):
        with pytest.raises(iso.ArgumentError):
            iso.render(lab, **options)
    with pytest.raises(iso.ArgumentError, match="too large"):
        iso.render(lab, size=(10**6, 75 * 10**4))
    with pytest.raises(iso.SceneError):
        iso.render(lab, size=(10**7, 75 * 10**5))
    with pytest.raises(iso.ArgumentError, match="too large"):
        iso.render(lab, size=(60000, 45000))
    empty = iso.render(lab, region=(0, 0, 10, 10))
    assert not empty.mask.any()
    with pytest.raises(iso.ArgumentError, match="no surface"):
        empty.max()
    assert empty.isophotes() == []
    assert "visible" in empty._repr_html_()


def test_maps_of_vectors_alone_are_saved_too(lab, tmp_path):
    found = iso.render(lab, channels=["normal", "position"])
    for suffix in ("npz", "exr", "csv"):
        found.save(tmp_path / f"map.{suffix}")
        np.testing.assert_allclose(iso.read(tmp_path / f"map.{suffix}")["normal"], found["normal"], atol=1e-7)
    with pytest.raises(iso.ArgumentError):
        found.save(tmp_path / "map.png")


def test_the_error_of_the_means_is_bounded_and_pixels_over_the_tolerance_are_counted():
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "shadows.toml")
    scene = scene.set({"camera.resolution": (60, 45), "sampling": iso.Sampling(tolerance=0.01, samples=16)})
    m = iso.render(scene, channels=["brightness", "samples", "sampling-error"])
    error = m["sampling-error"]
    assert m.units["sampling-error"] == m.units["brightness"]
    assert error[m["samples"] <= 1].max() == 0
    # So small an image is itself the one that tells the largest brightness.
    peak = iso.render(scene.replace(sampling=None)).max()
    assert m.over_tolerance == (error > 0.01 * peak).sum() > 0
    assert iso.render(scene.set({"sampling.samples": 4096})).over_tolerance == 0
    assert iso.render(scene.replace(sampling=None)).over_tolerance is None
    assert "sampling-error" in iso.render(scene, channels="all")
    assert "sampling-error" not in iso.render(scene.replace(sampling=None), channels="all")
    with pytest.raises(iso.Error, match=r"`sampling\.tolerance`"):
        iso.render(scene.replace(sampling=None), channels="sampling-error")
