"""Random scenes against the formulas written once more, in NumPy."""

from __future__ import annotations

import numpy as np
import pytest
import reference
from hypothesis import given
from hypothesis import strategies as st

import isophote as iso

CONVENTIONS = [convention.value for convention in iso.Convention]


def numbers(low, high):
    return st.floats(low, high, allow_nan=False, allow_subnormal=False)


@st.composite
def scenes(draw):
    spheres = []
    for index in range(draw(st.integers(1, 4))):
        center = (draw(numbers(-2, 2)), draw(numbers(-1.5, 1.5)), draw(numbers(4, 9)))
        spheres.append(
            iso.Sphere(
                name=f"s{index}", center=center, radius=draw(numbers(0.2, 1.2)), material=f"m{draw(st.integers(0, 1))}"
            )
        )
    # Beside the spheres and before them, never within one.
    lights = [
        iso.PointLight(
            name=f"l{index}",
            position=(draw(numbers(-9, 9)), draw(numbers(4, 9)) * draw(st.sampled_from([-1, 1])), draw(numbers(-9, 1))),
            intensity=draw(numbers(1, 500)),
        )
        for index in range(draw(st.integers(1, 5)))
    ]
    material = st.builds(iso.Material, diffuse=numbers(0.05, 1), specular=numbers(0.05, 1), shininess=numbers(0.5, 200))
    return iso.Scene(
        length="m",
        convention=draw(st.sampled_from(CONVENTIONS)),
        handedness=draw(st.sampled_from(["left", "right"])),
        camera=iso.Camera(
            eye=(0, 0, 0),
            forward=(draw(numbers(-0.1, 0.1)), draw(numbers(-0.1, 0.1)), 1),
            screen=iso.Screen(distance=5, x=(-4, 4), y=(-3, 3)),
            resolution=(48, 36),
        ),
        materials={"m0": draw(material), "m1": draw(material)},
        shapes=spheres,
        lights=lights,
    )


def truth(scene, shape, normal, point):
    """Irradiance and brightness at points of these shapes."""
    lights = [(light.position, light.intensity) for light in scene.lights]
    irradiance, brightness = np.zeros(len(shape)), np.zeros(len(shape))
    for index, sphere in enumerate(scene.shapes):
        one = shape == index
        material = scene.materials[sphere.material]
        coefficients = (material.diffuse, material.specular, material.shininess)
        irradiance[one], brightness[one] = reference.brightness(
            normal[one], point[one], np.array(scene.camera.eye), lights, coefficients, scene.convention
        )
    return irradiance, brightness


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
@given(scenes())
def test_maps_probes_and_the_bare_formula_follow_the_formulas(scene):
    found = iso.render(scene, channels="all")
    eye, directions = reference.rays(scene.camera, scene.handedness)
    spheres = [(sphere.center, sphere.radius) for sphere in scene.shapes]
    shape, point, normal = reference.trace(eye, directions, spheres)
    # Within 1e-7 of a silhouette NumPy's doubles cannot tell what is seen.
    assert np.count_nonzero(shape != found["shape"]) <= 2
    view = -directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    clear = (shape == found["shape"]) & (shape >= 0) & (np.sum(normal * view, axis=-1) > 0.03)
    if not clear.any():
        return
    irradiance, brightness = truth(scene, shape[clear], normal[clear], point[clear])
    np.testing.assert_allclose(found["position"][clear], point[clear], rtol=0, atol=1e-10)
    np.testing.assert_allclose(found["normal"][clear], normal[clear], rtol=0, atol=1e-10)
    np.testing.assert_allclose(found["irradiance"][clear], irradiance, rtol=0, atol=1e-9 * max(irradiance.max(), 1e-30))
    np.testing.assert_allclose(found["brightness"][clear], brightness, rtol=0, atol=1e-9 * max(brightness.max(), 1e-30))

    rows, columns = np.nonzero(clear)
    probes = iso.probe(scene, pixels=np.stack([columns, rows], axis=1), per_light=True)
    scale = max(brightness.max(), 1e-30)
    np.testing.assert_allclose(probes.brightness, found["brightness"][clear], rtol=0, atol=2e-12 * scale)
    np.testing.assert_allclose(probes.lights.sum(axis=1), probes.irradiance, rtol=1e-12)
    np.testing.assert_array_equal(probes.shape, shape[clear])

    for index, sphere in enumerate(scene.shapes):
        one = shape[clear] == index
        bare = iso.brightness(
            normal[clear][one],
            point[clear][one],
            scene.lights,
            scene.materials[sphere.material],
            scene.convention,
            eye=scene.camera.eye,
        )
        np.testing.assert_allclose(bare, brightness[one], rtol=1e-11, atol=1e-13 * scale)


def test_the_bare_formula_takes_arrays_of_any_shape(lab):
    material, lamp = lab.materials["clay"], lab.lights[0]
    one = iso.brightness([0, 0, -1], [0, 0, 4], lamp, material, "lab")
    assert one.shape == () and float(one) == pytest.approx(0.316677297547093, rel=1e-12)
    many = iso.brightness(np.tile([0, 0, -1], (4, 5, 1)), [0, 0, 4], [lamp], material, iso.Convention.LAB)
    assert many.shape == (4, 5) and (many == one).all()
    assert iso.brightness(np.zeros((0, 3)), np.zeros((0, 3)), lamp, material).shape == (0,)
    strided = np.zeros((10, 6))[:, ::2]
    strided[:] = [0, 0, -1]
    positions = np.asfortranarray(np.tile([0.0, 0.0, 4.0], (10, 1)))
    assert (iso.brightness(strided, positions, lamp, material, "lab") == one).all()
    eyes = np.zeros((10, 3))
    assert (iso.brightness(strided, positions, lamp, material, "lab", eye=eyes) == one).all()
    behind = iso.brightness([0, 0, 1], [0, 0, 6], lamp.replace(position=(0, 0, 20)), material, "lab")
    assert float(behind) == 0.0


@pytest.mark.parametrize(
    ("normals", "positions", "options"),
    [
        ([0, 0, 2], [0, 0, 4], {}),
        ([0, 0, 0], [0, 0, 4], {}),
        ([0, 0, np.nan], [0, 0, 4], {}),
        ([0, 0, -1], [0, 0, np.inf], {}),
        ([0, 0, -1], [5, 5, -10], {}),
        ([0, 0], [0, 0, 4], {}),
        (np.zeros((2, 3)) + [0, 0, -1], np.zeros((3, 3)), {}),
        ([0, 0, -1], [0, 0, 4], {"eye": np.zeros((2, 3))}),
        ("abc", [0, 0, 4], {}),
        (np.array([0, 0, -1j]), [0, 0, 4], {}),
    ],
)
def test_the_bare_formula_refuses_what_makes_no_sense(lab, normals, positions, options):
    with pytest.raises(iso.ProbeError):
        iso.brightness(normals, positions, lab.lights[0], lab.materials["clay"], "lab", **options)


def test_the_bare_formula_refuses_colours(lab):
    with pytest.raises(iso.ArgumentError, match="component"):
        iso.brightness([0, 0, -1], [0, 0, 4], lab.lights[0], iso.Material(diffuse=(0.1, 0.2, 0.3)), "lab")


def test_where_leaves_points_out(lab):
    m = iso.render(lab, size=(80, 60), channels=["brightness", "normal", "position"])
    clay, lamp = lab.materials["clay"], lab.lights[0]
    found = iso.brightness(m["normal"], m["position"], lamp, clay, "lab", where=m.mask)
    np.testing.assert_allclose(found, m["brightness"], rtol=1e-12, atol=1e-14)
    with pytest.raises(iso.ProbeError, match="where= leaves points out"):
        iso.brightness(m["normal"], m["position"], lamp, clay, "lab")
    for where in (m.mask.astype(int), m.mask[:5]):
        with pytest.raises(iso.ProbeError, match="where"):
            iso.brightness(m["normal"], m["position"], lamp, clay, "lab", where=where)
    wrong = np.array(m["normal"])
    wrong[30, 40] *= 2
    with pytest.raises(iso.ProbeError) as caught:
        iso.brightness(wrong, m["position"], lamp, clay, "lab", where=m.mask)
    assert caught.value.indices == (30 * 80 + 40,)
