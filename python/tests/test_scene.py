"""Scenes and their parts."""

from __future__ import annotations

import copy
import dataclasses
import pickle
import warnings

import numpy as np
import pytest
from conftest import REPOSITORY, SCENES

import isophote as iso
from isophote._part import Part


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_every_scene_of_the_repository_survives_all_its_forms(path):
    scene = iso.Scene.from_file(path)
    directory = path.parent
    forms = [
        iso.Scene.from_dict(scene.to_dict(), directory=directory),
        iso.Scene.from_toml(scene.to_toml(), directory=directory),
        pickle.loads(pickle.dumps(scene)),
        copy.deepcopy(scene),
        scene.replace(),
    ]
    for form in forms:
        assert form == scene
        assert hash(form) == hash(scene)
    size = (40, 30)
    expected = iso.render(scene, size=size, channels="all")
    for form in forms:
        found = iso.render(form, size=size, channels="all")
        assert list(found) == list(expected)
        for channel in expected:
            np.testing.assert_array_equal(found[channel], expected[channel])


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_a_scene_of_parts_is_the_scene_of_the_file(lab):
    built = iso.Scene(
        title="Lab 4: one sphere, one light",
        length="m",
        handedness="left",
        convention=iso.Convention.LAB,
        camera=iso.Camera(
            eye=[0, 0, 0],
            forward=np.array([0, 0, 1]),
            up=[0, 1, 0],
            screen=iso.Screen(distance=5, x=(-4, 4), y=(-3, 3)),
        ),
        materials={"clay": iso.Material(diffuse=0.7, specular=0.3, shininess=20)},
        shapes=[iso.Sphere(name="ball", center=(0, 0, 5), radius=1, material="clay")],
        lights=[iso.PointLight(name="lamp", position=(5, 5, -10), intensity=np.float32(100))],
        probes=lab.probes,
    )
    assert built == lab
    assert built != built.replace(title="another")
    assert repr(built.shapes[0]) == "Sphere(name='ball', material='clay', center=(0.0, 0.0, 5.0), radius=1.0)"


def test_the_scene_shows_its_units(lab):
    text = repr(lab)
    assert "lengths in m, brightness by lab (3.3) in W/m²" in text
    assert "center (0, 0, 5) m, radius 1 m" in text
    assert "position (5, 5, -10) m, intensity 100 W/sr" in text
    assert "cd" in repr(iso.scenes.photometric())
    assert "<pre>" in lab._repr_html_()


def test_messages_about_areas_are_in_pythons_words(lab):
    with pytest.raises(iso.SceneError) as caught:
        lab.replace(areas=[iso.Area(name="ring", at=(0, 0), radius=-1)])
    assert caught.value.problems[0].message == "`areas[0].radius` (Area 'ring') is -1"


def test_nothing_in_a_scene_can_be_changed(lab):
    with pytest.raises(dataclasses.FrozenInstanceError):
        lab.title = "another"
    with pytest.raises(dataclasses.FrozenInstanceError):
        lab.shapes[0].radius = 2.0
    with pytest.raises(TypeError):
        lab.materials["clay"] = iso.Material(diffuse=1)
    before = iso.render(lab, size=(40, 30))["brightness"].copy()
    lights = [lab.lights[0]]
    scene = lab.replace(lights=lights)
    lights.clear()
    np.testing.assert_array_equal(iso.render(scene, size=(40, 30))["brightness"], before)


def test_every_mistake_is_reported_at_once():
    with pytest.raises(iso.SceneError) as caught:
        iso.Scene(
            length="m",
            camera=iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1), field_of_view=60),
            materials={"clay": iso.Material(diffuse=2)},
            shapes=[iso.Sphere(center=(0, 0, 5), radius=-1, material="cley")],
        )
    problems = caught.value.problems
    assert [problem.path for problem in problems] == ["material.clay.diffuse", "sphere[0].radius", "sphere[0].material"]
    assert problems[0].message == "`materials['clay'].diffuse` is 2"
    assert problems[1].message == "`shapes[0].radius` (Sphere) is -1"
    assert problems[0].help.startswith("allowed: 0 to 1:")
    assert problems[0].line is None
    assert "did you mean `clay`?" in str(caught.value)
    assert pickle.loads(pickle.dumps(caught.value)).problems == problems


def test_messages_speak_of_classes_and_attributes(lab):
    box = iso.Box(name="crate", center=(9, 9, 9), size=(1, 1, 1), material="clay")
    tube = iso.Cylinder(name="tube", start=(7, 7, 7), end=(7, 7, 8), radius=0.1, material="clay")
    two = lab.replace(shapes=[*lab.shapes, box, tube], shadows=False)
    for change, message in (
        (
            lambda: two.replace(shapes=[*two.shapes[:2], tube.replace(radius=-1)]),
            "`shapes[2].radius` (Cylinder 'tube') is -1",
        ),
        (
            lambda: two.replace(lights=[lab.lights[0].replace(intensity=-1)]),
            "`lights[0].intensity` (PointLight 'lamp') is -1",
        ),
        (lambda: two.set({"light.lamp.intensity": -1}), "`lights[0].intensity` (PointLight 'lamp') is -1"),
        (lambda: lab.replace(camera=iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1))), "screen=Screen(distance=5, x=(-4, 4)"),
        (lambda: lab.replace(materials={}), "materials={'clay': Material(…)}"),
    ):
        with pytest.raises(iso.SceneError) as caught:
            change()
        assert message in str(caught.value)
        assert "[[" not in str(caught.value) and " = " not in str(caught.value)
    for parts, message in (({"lights": []}, "lights=[PointLight(…)]"), ({"shapes": [], "probes": []}, "shapes=[Sphere(…)]")):
        with pytest.warns(iso.SceneWarning) as warned:
            lab.replace(**parts)
        assert any(message in str(one.message) for one in warned)
    with pytest.raises(iso.SceneError, match=r"`sphere\[0\].radius` is -1"):
        iso.Scene.from_toml(lab.to_toml().replace("radius = 1", "radius = -1"))


def test_mistakes_in_a_text_have_their_lines():
    with pytest.raises(iso.SceneError) as caught:
        iso.Scene.from_toml('version = 1\nlength = "km"\n', name="mine.toml")
    problem = next(problem for problem in caught.value.problems if problem.path == "length")
    assert problem.line == 2
    assert problem.place.text == 'length = "km"'
    assert "mine.toml:2:10" in str(caught.value)


@pytest.mark.parametrize(
    "make",
    [
        lambda: iso.Sphere(center=(0, 0), radius=1),
        lambda: iso.Sphere(center=(0, 0, float("nan")), radius=1),
        lambda: iso.Sphere(center=(0, 0, 0), radius="one"),
        lambda: iso.Sphere(center="abc", radius=1),
        lambda: iso.Sphere(center=np.zeros((3, 1)), radius=1),
        lambda: iso.Sphere(center=(0, 0, 0), radius=True),
        lambda: iso.Sphere(center=(0, 0, 0), radius=1, casts_shadow="no"),
        lambda: iso.Material(diffuse=(1, 2)),
        lambda: iso.Material(diffuse=float("inf")),
        lambda: iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1), field_of_view=60, resolution=(10.5, 3)),
        lambda: iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1), screen=5),
        lambda: iso.scenes.lab().replace(lights=iso.PointLight(position=(0, 0, 0), power=1)),
        lambda: iso.scenes.lab().replace(shapes=[iso.Material(diffuse=1)]),
        lambda: iso.scenes.lab().replace(materials={"clay": 0.5}),
        lambda: iso.scenes.lab().replace(convention="phong"),
        lambda: iso.Sphere(center=(0, 0, 0), radius=10**400),
        lambda: iso.Material(diffuse=[[1], [2, 3]]),
        lambda: iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1), screen={"wrong": 2}),
        lambda: iso.scenes.lab().replace(shapes=[iso.Shape(name="nothing")]),
        lambda: iso.LambertianLight.from_dict({"emission": "spot", "position": (0, 0, 0)}),
        lambda: iso.scenes.lab().set({"light.lamp.position": (1, 2)}),
    ],
)
def test_a_wrong_value_is_a_scene_error_that_names_it(make):
    with pytest.raises(iso.SceneError) as caught:
        make()
    assert caught.value.problems
    assert all(problem.message for problem in caught.value.problems)


def test_what_is_odd_but_allowed_is_a_warning(lab):
    with pytest.warns(iso.SceneWarning, match="not square"):
        lab.with_resolution((800, 500))


def test_values_are_set_by_their_paths(lab):
    changed = lab.set(
        {
            "light.lamp.position": (1, 2, -3),
            "light[0].intensity": 50,
            "material.clay.shininess": 80,
            "camera.screen.distance": 4,
            "convention": "radiance",
        }
    )
    assert changed.lights[0] == lab.lights[0].replace(position=(1, 2, -3), intensity=50)
    assert changed.materials["clay"].shininess == 80
    assert changed.camera.screen.distance == 4
    assert changed.convention == "radiance"
    smaller = lab.replace(probes=()).set({"sphere.ball.radius": 0.5, "shape.ball.center": (0, 0, 6)})
    assert smaller.shapes[0].radius == 0.5
    assert smaller.shapes[0].center == (0, 0, 6)


@pytest.mark.parametrize(
    "path",
    [
        "light.lump.position",
        "light[1].position",
        "light.lamp.colour",
        "nothing",
        "",
        "camera.eye.x",
    ],
)
def test_a_path_that_leads_nowhere_says_so(lab, path):
    with pytest.raises(iso.ArgumentError):
        lab.set({path: 1})


def test_conventions_have_their_formulas():
    assert [convention.number for convention in iso.Convention] == [
        *("3.1", "3.2", "3.3", "3.4", "3.5", "3.6"),
        *("3.11", "3.12"),
    ]
    assert iso.Convention.LAB.formula == "B = Σ E_j (k_d cosθ_o + k_s (N·H_j)^n)"


def test_what_is_no_file_is_an_error_of_the_system(tmp_path):
    with pytest.raises(FileNotFoundError):
        iso.Scene.from_file(tmp_path / "missing.toml")
    with pytest.raises(IsADirectoryError):
        iso.Scene.from_file(tmp_path)
    with pytest.raises(FileNotFoundError):
        iso.read(tmp_path / "missing.exr")
    with pytest.raises(TypeError, match="no 'colour'"):
        iso.scenes.lab().replace(colour=1)


def test_numpys_numbers_are_numbers(lab):
    written = lab.to_dict()
    written["sphere"][0]["center"] = np.array(written["sphere"][0]["center"])
    written["camera"]["resolution"] = [np.int64(800), np.int64(600)]
    assert iso.Scene.from_dict(written) == lab
    with pytest.raises(TypeError):
        iso.Scene.from_dict({"version": object()})


def test_a_warning_is_given_once_and_where_the_caller_is():
    two = iso.scenes.two_lights()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        two.replace(title="another")
        two.set({"title": "a third one"})
        two.with_resolution((80, 60))
    assert caught == []
    written = two.to_dict()
    for make in (lambda: iso.Scene.from_dict(written), lambda: iso.Scene.from_toml(two.to_toml())):
        with pytest.warns(iso.SceneWarning, match="no shadows") as caught:
            make()
        assert [one.filename for one in caught] == [__file__]
    with pytest.warns(iso.SceneWarning, match="not square") as caught:
        iso.render(two, size=(80, 50))
    assert [one.filename for one in caught] == [__file__]


@pytest.mark.parametrize("names", [("lamp", "lamp.left"), ("lamp.left", "lamp"), ("лампа", " sp "), ('"', "a.b.c")])
def test_names_may_be_anything(lab, names, tmp_path):
    lights = [lab.lights[0].replace(name=name, intensity=10.0 * (number + 1)) for number, name in enumerate(names)]
    scene = lab.replace(lights=lights)
    for number, name in enumerate(names):
        changed = scene.set({f"light.{name}.intensity": 3})
        assert [light.intensity == 3 for light in changed.lights] == [one == number for one in range(2)]
    found = iso.render(scene, size=(40, 30), channels=["brightness", "lights"])
    assert found.lights == names
    for suffix in ("exr", "npz", "csv"):
        found.save(tmp_path / f"map.{suffix}")
        file = iso.read(tmp_path / f"map.{suffix}")
        for channel in found:
            np.testing.assert_allclose(file[channel], found[channel], rtol=1e-7)


def test_files_that_a_scene_names_are_found_again(tmp_path, monkeypatch):
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "mesh.toml")
    expected = iso.render(scene, size=(40, 30))
    expected.save(tmp_path / "mesh.npz")
    monkeypatch.chdir(tmp_path)
    again = [scene.replace(title="another"), scene.set({"light[0].casts_shadows": True}), pickle.loads(pickle.dumps(scene))]
    for form in again:
        np.testing.assert_array_equal(iso.render(form, size=(40, 30))["brightness"], expected["brightness"])
    file = iso.read("mesh.npz", directory=REPOSITORY / "scenes")
    monkeypatch.chdir(REPOSITORY)
    assert file.scene == scene.with_resolution((40, 30))
    np.testing.assert_array_equal(file["brightness"], expected["brightness"])
    # The file carries the mesh.
    carried = iso.read(tmp_path / "mesh.npz").scene
    np.testing.assert_array_equal(iso.render(carried)["brightness"], expected["brightness"])
    (tmp_path / "elsewhere").mkdir()
    with pytest.raises(iso.SceneError, match="vase.obj"):
        _ = iso.read(tmp_path / "mesh.npz", directory=tmp_path / "elsewhere").scene


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_a_path_stands_for_the_scene_in_its_file(lab, lab_map, tmp_path):
    path = REPOSITORY / "scenes" / "lab.toml"
    np.testing.assert_array_equal(iso.render(str(path))["brightness"], lab_map["brightness"])
    lab_map.save(tmp_path / "map.npz")
    np.testing.assert_array_equal(iso.render(tmp_path / "map.npz")["brightness"], lab_map["brightness"])
    assert iso.probe(path).names == iso.probe(lab).names
    assert iso.section(path, row=300).count == 800
    assert iso.surface(path, size=(8, 4)).shape == (4, 8)
    assert "brightness" in iso.sweep(path, {"light.lamp.intensity": [1, 2]})
    with pytest.raises(FileNotFoundError):
        iso.render(tmp_path / "missing.toml")


def test_what_is_no_scene_and_no_material_is_an_error_of_the_package(lab):
    for use in (
        lambda: iso.render(5),
        lambda: iso.render({"version": 1}),
        lambda: iso.probe(None),
        lambda: iso.section(5, row=1),
        lambda: iso.surface(5),
        lambda: iso.grid(5),
        lambda: iso.sweep(5, {}),
        lambda: iso.render_to_zarr(5, None, "x.zarr"),
    ):
        with pytest.raises(iso.ArgumentError, match="scene is .*; allowed: a Scene, or the path of a scene file"):
            use()
    light = iso.PointLight(position=(0, 0, 0), intensity=1)
    clay = iso.Material(diffuse=0.5)
    point = ((0, 0, 1), (0, 0, -1))
    for use, name in (
        (lambda: iso.brightness(*point, light, 0.5), "material"),
        (lambda: iso.brightness(*point, 0.5, clay), "lights"),
        (lambda: iso.brightness(*point, light, clay, 5), "convention"),
        (lambda: iso.brightness(*point, light, clay, ambient=1), "ambient"),
    ):
        with pytest.raises(iso.ArgumentError, match=f"{name} is"):
            use()
    with pytest.raises(iso.SceneError, match="Material"):
        lab.replace(materials={"clay": 0.5})
    with pytest.raises(iso.SceneError, match="the name of a material"):
        iso.Sphere(center=(0, 0, 5), radius=1, material=0.5)


def test_scenes_and_what_they_hold_are_copied_and_pickled(lab):
    for thing in (lab, lab.materials, lab.shapes[0], lab.lights[0], lab.camera, iso.scenes.photometric()):
        for again in (copy.copy(thing), copy.deepcopy(thing), pickle.loads(pickle.dumps(thing))):
            assert again == thing


def test_whole_parts_are_set_by_their_paths(lab):
    spot = iso.SpotLight(position=(5, 5, -10), target=(0, 0, 5), inner_angle=5, outer_angle=10, intensity=7)
    mirror = iso.Material(diffuse=0, specular=0.5, shininess=80)
    ball = iso.Sphere(name="other", center=(0, 0, 5), radius=1, material="clay")
    changed = lab.set({"light.lamp": spot, "material.clay": mirror, "sphere.ball": ball})
    assert changed.lights == (spot.replace(name="lamp"),)
    assert changed.materials["clay"] == mirror and changed.shapes == (ball,)
    assert lab.set({"light[0]": spot}).lights == changed.lights
    for values in ({"light.lamp": 5}, {"material.clay": 1}, {"sphere.ball": spot}):
        with pytest.raises(iso.SceneError, match="allowed: a "):
            lab.set(values)
    with pytest.raises(iso.ArgumentError, match="None"):
        lab.set({"light.lamp": None})


def test_that_pixels_are_not_square_is_said_once(lab):
    with pytest.warns(iso.SceneWarning, match="not square") as caught:
        scene = lab.with_resolution((800, 500))
    assert len(caught) == 1
    # Warnings are errors in these tests.
    scene.with_resolution((800, 400)).set({"camera.screen.x": (-3, 3)}).replace(
        camera=lab.camera.replace(resolution=(10, 90))
    )


def test_numpys_scalars_and_paths_are_arguments_too(lab, tmp_path):
    of = iso.render(lab, size=(np.int64(80), np.int32(60)), threads=np.int64(1), precision=np.str_("double"))
    of.save(tmp_path / "map.png", gamma=np.float32(2.2), bits=np.int64(16), range=np.array([0, 1], np.float16))
    assert of.isophotes(np.int64(3)) and of.plot(isophotes=np.int64(3)) is not None
    assert iso.section(lab, between=((-1, 0), (1, 0)), samples=np.int16(5)).count == 5
    assert iso.surface(lab, shape=np.int64(0), size=(np.int64(8), 4)).shape == (4, 8)
    assert iso.Mesh(file=tmp_path / "mesh.obj").file == str(tmp_path / "mesh.obj")
    assert iso.Sphere(center=np.zeros(3, np.float16), radius=np.float32(0.5)).radius == 0.5
    with pytest.raises(iso.SceneError, match="path of a file"):
        iso.Mesh(file=5)


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_setting_a_value_reads_that_part_again_and_keeps_the_others(lab):
    tube = iso.Cylinder(name="tube", start=(7, 7, 7), end=(7, 7, 8), radius=0.1, material="clay")
    grid = iso.Grid(name="floor", center=(0, -1, 5), u=(2, 0, 0), v=(0, 0, 2), points=(5, 5))
    scene = lab.replace(shapes=[*lab.shapes, tube], grids=[grid], sampling=iso.Sampling(samples=4), shadows=True)
    for path, value in (
        ("light.lamp.intensity", 7),
        ("light.lamp.casts_shadows", False),
        ("light.lamp", iso.ParallelLight(direction=(0, 0, 1), irradiance=3)),
        ("material.clay.shininess", 7),
        ("sphere.ball.center", (0, 0, 5)),
        ("cylinder.tube.end", (7, 7, 9)),
        ("shape.tube", tube.replace(radius=0.2)),
        ("grid.floor.points", (3, 3)),
        ("probe.P1.published", None),
        ("camera.screen.distance", 4),
        ("camera.resolution", (8, 6)),
        ("sampling", None),
        ("sampling.samples", 9),
        ("ambient", iso.Ambient(radiance=1)),
        ("shadows", None),
        ("title", "x"),
        ("convention", iso.Convention.RADIANCE),
    ):
        changed = scene.set({path: value})
        again = iso.Scene.from_json(changed.core.to_json())
        assert changed == again, path
        for field in dataclasses.fields(changed):
            assert getattr(changed, field.name) == getattr(again, field.name) or field.name in ("materials", "directory"), (
                path
            )
        assert dict(changed.materials) == dict(again.materials)
        kept = [one is other for one, other in zip(changed.shapes + changed.lights, scene.shapes + scene.lights)]
        assert sum(kept) >= len(kept) - 1


def test_setting_one_value_leaves_all_other_parts_alone(lab, monkeypatch):
    """With ten thousand lights, all of which were written and read again, it took a third of a second."""
    more = [iso.PointLight(position=(5, 5, -10 - number), intensity=1) for number in range(999)]
    scene = lab.replace(lights=[*lab.lights, *more])
    touched = []
    for method in ("to_dict", "__post_init__"):
        original = getattr(Part, method)
        monkeypatch.setattr(
            Part, method, lambda part, original=original: (touched.append(type(part).__name__), original(part))[1]
        )
    changed = scene.set({"light.lamp.intensity": 7, "light[7].casts_shadows": False, "material.clay.shininess": 30})
    assert sorted(touched) == sorted(["PointLight", "PointLight", "Material"] * 2)
    assert changed.lights[0].intensity == 7 and not changed.lights[7].casts_shadows
    assert all(changed.lights[number] is scene.lights[number] for number in (1, 8, 999))
    monkeypatch.undo()
    assert changed == iso.Scene.from_json(changed.core.to_json())
    assert changed.core.to_json() == scene.replace(lights=changed.lights, materials=changed.materials).core.to_json()


def test_values_of_one_part_are_set_in_their_order(lab):
    changed = lab.set({"light.lamp": lab.lights[0].replace(intensity=1), "light.lamp.casts_shadows": False})
    assert (changed.lights[0].intensity, changed.lights[0].casts_shadows) == (1, False)
    with pytest.raises(iso.ArgumentError, match="is None by then"):
        lab.set({"sampling": iso.Sampling(samples=4)}).set({"sampling": None, "sampling.samples": 9})


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_a_material_that_nothing_is_made_of_may_be_left_out(lab):
    both = lab.replace(materials={**lab.materials, "chalk": iso.Material(diffuse=0.5)})
    assert both.set({"material.chalk": None}).materials == lab.materials
    with pytest.raises(iso.SceneError, match="chalk"):
        lab.replace(materials={"chalk": iso.Material(diffuse=0.5), **lab.materials}).set(
            {"sphere.ball.material": "chalk"}
        ).set({"material.chalk": None})
