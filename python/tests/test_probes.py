"""Values at points and along lines; surfaces and grids."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pytest
from conftest import REPOSITORY

import isophote as iso


def test_the_labs_points_have_their_values(lab):
    reference = {"P1": 0.316677297547093, "P2": 0.137736208646845, "P3": 0.137736208646845, "P4": 0.260714199906064}
    probes = iso.probe(lab)
    assert probes.names == tuple(reference)
    np.testing.assert_allclose(probes.brightness, list(reference.values()), rtol=1e-12)
    assert probes.units["brightness"] == "W/m²"
    assert probes.seen.all()
    assert "P1: (0, 0, 4) m: B = 0.316677297547093 W/m²" in repr(probes)


def test_a_probe_explains_itself(lab):
    text = iso.probe(lab, at=[(0, 0, 4)]).explain()
    assert "(3.3)" in text and "0.316677297547093" in text
    probes = iso.probe(lab, pixels=[(400, 300), (418, 281)])
    assert "pixel 418,281" in probes.explain(1)
    with pytest.raises(IndexError):
        probes.explain(2)


def on_the_sphere(count):
    directions = np.random.default_rng(1).normal(size=(count, 3))
    return directions / np.linalg.norm(directions, axis=1, keepdims=True) + [0, 0, 5]


def test_a_million_points_in_one_call(lab):
    points = on_the_sphere(1_000_000)
    heard = []
    probes = iso.probe(lab, at=points, progress=lambda done, total: heard.append((done, total)))
    assert probes.brightness.shape == (1_000_000,)
    assert heard[-1] == (1_000_000, 1_000_000)
    some = slice(None, None, 99_991)
    np.testing.assert_allclose(iso.probe(lab, at=points[some]).brightness, probes.brightness[some], rtol=1e-12)
    assert not probes.brightness.flags.writeable


def test_points_of_every_kind_of_array(lab):
    expected = iso.probe(lab, at=[(0, 0, 4)]).brightness
    for at in ([0, 0, 4], np.array([[0, 0, 4]]), np.array([[0, 0, 4]], np.float32), np.zeros((1, 6))[:, ::2] + [0, 0, 4]):
        np.testing.assert_array_equal(iso.probe(lab, at=at).brightness, expected)
    wide = np.asfortranarray(on_the_sphere(50))
    np.testing.assert_array_equal(iso.probe(lab, at=wide).brightness, iso.probe(lab, at=wide.copy("C")).brightness)
    for empty in ([], np.zeros((0, 3))):
        probes = iso.probe(lab, at=empty)
        assert probes.brightness.shape == (0,) and probes.position.shape == (0, 3)
        assert "0 points" in repr(probes)
    assert iso.probe(lab, pixels=np.zeros((0, 2), int)).count == 0


@pytest.mark.parametrize("dtype", ["f2", ">f4", "f8", ">f8", "longdouble"])
def test_points_of_any_shape_and_float_type(lab, dtype):
    points = np.broadcast_to(np.array([0, 0, 4], dtype), (2, 3, 4, 3))[..., ::-1, :]
    probes = iso.probe(lab, at=points, per_light=True)
    assert probes.count == 24 and probes.position.shape == (2, 3, 4, 3) and probes.lights.shape == (2, 3, 4, 1)
    np.testing.assert_array_equal(probes.brightness, np.full((2, 3, 4), iso.probe(lab, at=(0, 0, 4)).brightness[0]))
    assert "24 points" in repr(probes) and "0.316677297547093" in probes.explain(23)


def test_an_images_pixels_are_probed_in_its_shape(lab, lab_map):
    rows, columns = np.mgrid[280:290, 395:405]
    found = iso.probe(lab, pixels=np.stack([columns, rows], axis=-1))
    np.testing.assert_allclose(found.brightness, lab_map["brightness"][280:290, 395:405], rtol=1e-10)
    many = iso.probe(lab, at=on_the_sphere(3000).reshape(30, 100, 3))
    assert many.brightness.shape == (30, 100) and many.normal.shape == (30, 100, 3)


def test_a_point_elsewhere_names_the_option_that_takes_it(lab):
    with pytest.raises(iso.ProbeError, match='elsewhere="nearest"'):
        iso.probe(lab, at=(0, 0, 4.5))


def test_points_elsewhere(lab):
    points = np.array([(0, 0, 4), (0.1, 0, 4), (0, 0, 0)])
    with pytest.raises(iso.ProbeError, match="point 1 is on no surface: it is 0.00498756 m outside") as caught:
        iso.probe(lab, at=points)
    assert caught.value.indices == (1, 2)
    gaps = iso.probe(lab, at=np.vstack([points, [np.nan, 0, 0], [1e300, 0, 0]]), elsewhere="nan")
    assert np.isnan(gaps.brightness).tolist() == [False, True, True, True, True]
    assert gaps.shape.tolist() == [0, -1, -1, -1, -1]
    assert gaps.part.tolist() == [0, -1, -1, -1, -1]
    assert gaps.part.dtype == np.int32
    background = iso.section(lab, between=((-4, 0), (-3, 0)), samples=3)
    assert background.part.tolist() == [-1, -1, -1]
    near = iso.probe(lab, at=points, elsewhere="nearest")
    np.testing.assert_allclose(np.linalg.norm(near.position - [0, 0, 5], axis=1), 1, rtol=1e-15)
    assert "P  " in near.explain(1)


@pytest.mark.parametrize(
    "options",
    [
        {"at": [(0, 0)]},
        {"at": [(0, 0, np.nan)]},
        {"at": [(0, 0, np.inf)]},
        {"at": "here"},
        {"at": np.zeros((1, 1, 3))},
        {"at": np.zeros((2, 2, 4))},
        {"pixels": np.zeros((2, 2, 3), int)},
        {"at": [(0, 0, 1j)]},
        {"at": [[0, 0, 4], [0, 0]]},
        {"pixels": [(0.5, 1)]},
        {"pixels": [(-1, 0)]},
        {"pixels": [(800, 0)]},
        {"pixels": [(0, 0)]},
        {"pixels": np.array([(2**40, 0)])},
    ],
)
def test_places_that_are_none_are_refused(lab, options):
    with pytest.raises(iso.ProbeError):
        iso.probe(lab, **options)


def test_arguments_that_contradict_each_other_are_refused(lab):
    for options in ({"at": [(0, 0, 4)], "pixels": [(0, 0)]}, {"at": [(0, 0, 4)], "elsewhere": "somewhere"}):
        with pytest.raises(iso.ArgumentError):
            iso.probe(lab, **options)
    with pytest.raises(iso.ArgumentError, match="no probes"):
        iso.probe(lab.replace(probes=()))
    with pytest.raises(iso.ArgumentError, match="samples has no effect"):
        iso.section(lab, row=1, samples=5)
    with pytest.raises(iso.ArgumentError, match="no effect on pixels"):
        iso.probe(lab, pixels=[(400, 300)], elsewhere="nearest")
    for options in ({}, {"row": 1, "column": 1}, {"row": 600}, {"row": -1}, {"between": ((0, 0), (1, np.nan))}):
        with pytest.raises(iso.ArgumentError):
            iso.section(lab, **options)


def test_a_section_runs_along_its_line(lab, lab_map):
    row = iso.section(lab, row=300)
    seen = lab_map.mask[300]
    np.testing.assert_array_equal(row.shape >= 0, seen)
    np.testing.assert_allclose(row.brightness[seen], lab_map["brightness"][300][seen], rtol=0, atol=1e-12)
    assert np.isnan(row.brightness[~seen]).all()
    np.testing.assert_allclose(row.screen[:, 0], lab_map.coordinates()[0], atol=1e-12)
    assert row.units["screen"] == "m"
    line = iso.section(lab, between=((-1, 0), (1, 0)), samples=11)
    np.testing.assert_allclose(line.distance, np.linspace(0, 2, 11))
    np.testing.assert_allclose(iso.section(lab, column=10).screen[:, 1], lab_map.coordinates()[1], atol=1e-12)


def test_the_flux_on_a_sphere_is_that_of_the_closed_form():
    """(5.3): 2πI (1 − √(1 − (R/d)²))."""
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "closed-form-5.1.toml")
    sphere, light = scene.shapes[0], scene.lights[0]
    distance = np.linalg.norm(np.subtract(light.position, sphere.center))
    flux = 2 * np.pi * light.intensity * (1 - np.sqrt(1 - (sphere.radius / distance) ** 2))
    errors = []
    for width in (180, 360):
        surface = iso.surface(scene, size=(width, width // 2), projection="equal-area")
        totals = surface.totals["irradiance"]
        errors.append(abs(totals.integral - flux) / flux)
        assert surface.area == pytest.approx(4 * np.pi * sphere.radius**2, rel=1e-14)
        assert totals.mean == pytest.approx(totals.integral / totals.area)
    assert errors[1] < 1e-4 and errors[1] < errors[0]
    assert iso.surface(scene, shape=0).axes[0].name == "longitude"
    assert iso.surface(scene).to_xarray()["irradiance"].dims == ("latitude", "longitude")


def test_a_grid_has_the_published_illuminances():
    """CIE 171:2006, test 5.2: (5.4)."""
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "grid.toml")
    found = iso.grid(scene, name=scene.grids[0].name)
    published = {(0, 0): 111.11, (0.5, 0): 105.21, (1, 0): 90.02, (1.5, 0): 71.11, (1, 1): 74.36, (1.5, 1.5): 49.39}
    for (x, z), illuminance in published.items():
        there = np.isclose(found["position"], [x, 0, z], atol=1e-9).all(axis=-1)
        assert found["irradiance"][there] == pytest.approx(1000 * 3**2 / (3**2 + x**2 + z**2) ** 2, rel=1e-12)
        assert found["irradiance"][there] == pytest.approx(illuminance, rel=5e-4)
    assert found.units["irradiance"] == "lx"
    assert found.uniformity == pytest.approx(found.min() / found.mean())
    with pytest.raises(iso.ArgumentError, match="no grid"):
        iso.grid(scene, name="nothing")


def test_surfaces_and_grids_that_are_not_there(lab):
    for call in (
        lambda: iso.surface(lab, shape="bell"),
        lambda: iso.surface(lab, shape=1),
        lambda: iso.surface(lab, part=1),
        lambda: iso.surface(lab, projection="mercator"),
        lambda: iso.surface(lab, size=(0, 5)),
        lambda: iso.surface(lab, axis=(0, 1)),
        lambda: iso.surface(lab, channels=["depth"]),
        lambda: iso.grid(lab),
    ):
        with pytest.raises(iso.ArgumentError):
            call()


def test_probes_of_a_scene_with_colours_have_components():
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "color.toml")
    probes = iso.probe(scene)
    assert probes.color.shape == (probes.count, 3)
    weights = [0.2126, 0.7152, 0.0722]
    np.testing.assert_allclose(probes.color @ weights, probes.brightness, rtol=1e-4)
    found = iso.render(scene, size=(80, 60))
    assert list(found) == ["brightness", "color"]
    assert found["color"].shape == (60, 80, 3)
    assert found.to_xarray()["color"].dims == ("y", "x", "component")


def test_the_packages_values_are_the_commands(lab):
    import subprocess
    import sys

    command = [sys.executable, "-m", "isophote", "probe", "--json"]
    answer = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    values = [probe["channels"]["brightness"]["value"] for probe in answer["probes"]]
    assert values == iso.probe(lab).brightness.tolist()


def test_explanations_leave_gaps(lab):
    probes = iso.probe(lab, at=[(0, 0, 4), (9, 9, 9), (np.nan, 0, 0)], elsewhere="nan")
    assert probes.explain(1) == "point 1: no surface\n"
    assert "point 2: no surface" in probes.explain()
    assert "0.316677297547093" in probes.explain()


def test_no_lights_have_an_array_too(lab):
    dark = lab.replace(lights=[], ambient=iso.Ambient(radiance=2), probes=())
    probes = iso.probe(dark, at=[(0, 0, 4)], per_light=True)
    assert probes.lights.shape == (1, 0)
    assert float(probes.irradiance[0]) == pytest.approx(2 * np.pi)


def test_many_points_are_those_of_single_ones_and_complete(lab):
    points = on_the_sphere(3000)
    many = iso.probe(lab, at=points)
    few = iso.probe(lab, at=points[:1000])
    first = ["brightness", "irradiance", "shape"]
    assert list(many) == [*first, *(name for name in few if name not in first)]
    assert sorted(many) == sorted(few) and "position.y" in many and "position" in many and "part" in many._later
    for name in (*few, "position", "normal"):
        np.testing.assert_allclose(many[name][:1000], few[name], rtol=1e-12, atol=1e-15)
        assert not many[name].flags.writeable
    points[:] = 0
    np.testing.assert_allclose(np.linalg.norm(many.position - [0, 0, 5], axis=1), 1, rtol=1e-14)
    with pytest.raises(iso.ProbeError, match="3000"):
        iso.probe(lab, at=points)
    near = iso.probe(lab, at=on_the_sphere(2000) * 1.01, elsewhere="nearest")
    np.testing.assert_allclose(np.linalg.norm(near.position - [0, 0, 5], axis=1), 1, rtol=1e-14)
    gaps = iso.probe(lab, at=np.vstack([on_the_sphere(2000), np.full((3, 3), np.nan)]), elsewhere="nan")
    assert np.isnan(gaps.brightness).sum() == 3
    unpickled = pickle.loads(pickle.dumps(gaps))
    np.testing.assert_array_equal(unpickled.brightness, gaps.brightness)
    assert not unpickled.brightness.flags.writeable


@pytest.mark.parametrize("count", [3, 2000])
def test_a_dictionary_of_values_has_columns_of_equal_length(lab, count):
    probes = iso.probe(lab, at=on_the_sphere(count), per_light=count < 1000)
    columns = dict(probes)
    assert {array.shape for array in columns.values()} == {(count,)}
    assert list(columns) == list(probes.keys()) and len(probes) == len(columns)
    np.testing.assert_array_equal(columns["normal.z"], probes["normal"][:, 2])
    np.testing.assert_array_equal(columns["position.x"], probes.position[:, 0])
    assert not columns["normal.z"].flags.writeable and "normal" not in columns
    assert probes.units["position.x"] == probes.units["position"] == "m" and probes.units["normal.y"] == "1"
    with pytest.raises(KeyError, match="there is no 'position.w'; there are: "):
        probes["position.w"]
    assert "position.w" not in probes
    if count < 1000:
        np.testing.assert_array_equal(columns["light.lamp"], probes.lights[:, 0])
        assert probes.units["light.lamp"] == "W/m²"
    pandas = pytest.importorskip("pandas")
    assert pandas.DataFrame(columns).equals(probes.to_dataframe())


def test_a_dictionary_of_a_section_has_columns_too(lab):
    section = iso.section(lab, row=300)
    columns = dict(section)
    assert {array.shape for array in columns.values()} == {(800,)}
    np.testing.assert_array_equal(columns["screen.y"], section.screen[:, 1])
    assert section.units["screen.x"] == "m"


def test_values_are_a_table_of_pandas(lab):
    pandas = pytest.importorskip("pandas")
    table = iso.probe(lab, per_light=True).to_dataframe()
    assert isinstance(table, pandas.DataFrame) and list(table.index) == ["P1", "P2", "P3", "P4"]
    assert table.loc["P2", "position.x"] == iso.probe(lab).position[1, 0]
    np.testing.assert_array_equal(table["light.lamp"], iso.probe(lab, per_light=True).lights[:, 0])
    section = iso.section(lab, row=300).to_dataframe()
    assert len(section) == 800 and {"screen.x", "normal.z", "brightness"} <= set(section.columns)
    many = iso.probe(lab, at=on_the_sphere(2000)).to_dataframe()
    assert len(many) == 2000 and "position.z" in many


def test_an_area_has_the_extremes_and_the_mean_of_the_closed_form():
    """(5.9): the lamp stands 1 m over the centre of a circle of 300 mm."""
    scene = iso.scenes.course_plane().set({"light.lamp.position": (0, 0, 1000)})
    assert scene == iso.Scene.from_toml(scene.to_toml()) and scene.areas[0].radius == 300
    found = iso.areas(scene)["circle"]
    assert found.max.value == pytest.approx(1000, rel=1e-14) and found.max.point == (0, 0, 0)
    assert found.min.value == pytest.approx(1000 / 1.09**2, rel=1e-13)
    assert found.mean == pytest.approx(1000 / 1.09, rel=1e-12)
    assert found.visible == 1 and found.max.seen and found.max.screen is None
    on_screen = iso.areas(scene.replace(areas=[iso.Area(name="all", at=(0, 0), size=(1000, 800))]))["all"]
    assert on_screen.max.screen == (0, 0) and on_screen.min.value < found.min.value


def test_sections_run_through_shapes_and_places(lab):
    level, upright = (iso.section(lab, through="ball", vertical=vertical, samples=5) for vertical in (False, True))
    assert level["screen"].tolist() == [[-4, 0], [-2, 0], [0, 0], [2, 0], [4, 0]]
    assert upright["screen"].tolist() == [[0, -3], [0, -1.5], [0, 0], [0, 1.5], [0, 3]]
    assert level["brightness"][2] == upright["brightness"][2] == pytest.approx(0.316677297547093, rel=1e-14)
    assert iso.section(lab, y=0.5, samples=2)["screen"].tolist() == [[-4, 0.5], [4, 0.5]]
    assert iso.section(lab, x=0.5, samples=2)["screen"].tolist() == [[0.5, -3], [0.5, 3]]
    for wrong in ({"through": "moon"}, {"x": 0, "y": 0}, {"row": 0, "vertical": True}):
        with pytest.raises(iso.ArgumentError):
            iso.section(lab, **wrong)


def test_points_that_the_eye_does_not_see_are_flagged(lab):
    told = repr(iso.probe(lab, at=[(0, 0, 4), (1, 0, 5)])).splitlines()
    assert "not seen" not in told[1] and told[2].rstrip(">").endswith(", not seen from the eye")
