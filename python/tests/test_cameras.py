"""Cameras of vision people: intrinsics and poses, against the pinhole model written out."""

from __future__ import annotations

import json

import numpy as np
import pytest

import isophote as iso

SIZE = (640, 480)
K = np.array([[812.5, 0, 301.25], [0, 790.0, 255.5], [0, 0, 1]])


def rotation(axis, degrees):
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


R = rotation((1, 2, -0.5), 25)
T = np.array([0.1, -0.2, 6.0])


@pytest.fixture
def scene():
    return iso.Scene(
        length="m",
        camera=iso.Camera.from_opencv(K, R, T, SIZE),
        materials={"clay": iso.Material(diffuse=0.7)},
        shapes=[iso.Sphere(center=(0.2, -0.1, 0.3), radius=1, material="clay")],
        lights=[iso.PointLight(position=(3, 3, -8), intensity=100)],
    )


def projected(points):
    """Pixels of points, with pixel centres at whole numbers."""
    camera = points @ R.T + T
    return (camera @ K.T)[..., :2] / camera[..., 2:]


def test_pixels_see_what_the_pinhole_model_projects_there(scene):
    m = iso.render(scene, channels=["position", "depth", "normal"])
    rows, columns = np.nonzero(m.mask)
    assert rows.size > 10000
    found = projected(m["position"][m.mask])
    assert np.abs(found - np.stack([columns, rows], axis=-1)).max() < 1e-10


def test_it_is_the_same_as_written_out_by_hand(scene):
    w, h = SIZE
    fx, fy, cx, cy = K[0, 0], K[1, 1], K[0, 2], K[1, 2]
    screen = iso.Screen(
        distance=1,
        x=((-0.5 - cx) / fx, (w - 0.5 - cx) / fx),
        y=(-(h - 0.5 - cy) / fy, (0.5 + cy) / fy),
    )
    by_hand = iso.Camera(eye=-R.T @ T, forward=R[2], up=-R[1], screen=screen, resolution=SIZE)
    with pytest.warns(iso.SceneWarning, match="not square"):
        other = scene.replace(camera=by_hand)
    ours, theirs = iso.render(scene, channels="all"), iso.render(other, channels="all")
    np.testing.assert_array_equal(ours.mask, theirs.mask)
    np.testing.assert_allclose(ours["brightness"], theirs["brightness"], rtol=1e-12, atol=1e-14)
    for camera in (scene.camera, by_hand):
        for found, given in zip(camera.to_opencv(), (K, R, T)):
            np.testing.assert_allclose(found, given, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("length", ["m", "mm"])
@pytest.mark.parametrize(
    "aim",
    [
        {"eye": (1, 2, 3), "target": (0, 0, 0)},
        {"eye": (1, 2, 3), "target": (0, 0, 0), "up": (0, 0, 1)},
        {"eye": (0, 3, 0), "forward": (0, -1, 0)},
        {"eye": (0.1, 0.2, 3), "tilt": 0},
        {"eye": (-1, -2, 3), "tilt": 37, "azimuth": 63.4},
    ],
)
def test_cameras_go_there_and_back(length, aim):
    field = iso.Camera(**aim, field_of_view=60, resolution=(64, 48))
    again = iso.Camera.from_opencv(*field.to_opencv(), size=(64, 48))
    parts = {
        "length": length,
        "materials": {"clay": iso.Material(diffuse=0.7)},
        "shapes": [iso.Sphere(center=(0, 0, 0), radius=1, material="clay")],
        "lights": [iso.PointLight(position=(3, 3, 8), intensity=100)],
    }
    first, second = (
        iso.render(iso.Scene(camera=camera, **parts), channels=["position", "depth"]) for camera in (field, again)
    )
    np.testing.assert_array_equal(first.mask, second.mask)
    np.testing.assert_allclose(first["position"], second["position"], atol=1e-12)
    for scene in (iso.Scene.from_toml(second.scene.to_toml()), iso.Scene.from_dict(second.scene.to_dict())):
        assert scene == second.scene


def test_a_distorted_lens_asks_for_points_of_the_screen(scene):
    """The distortion is the caller's; the screen points are those of the undistorted rays."""
    rows, columns = np.mgrid[200:280:8, 260:360:10]
    m = iso.render(scene, channels=["brightness"])
    x, y = m.coordinates()
    found = iso.probe(scene, screen=np.stack([x[columns], y[rows]], axis=-1))
    np.testing.assert_allclose(found.brightness, m["brightness"][rows, columns], rtol=1e-10)
    assert found.brightness.shape == rows.shape
    k1 = -0.2
    normalized = np.stack([x[columns], y[rows]], axis=-1)
    radius2 = (normalized**2).sum(axis=-1, keepdims=True)
    distorted = iso.probe(scene, screen=normalized * (1 + k1 * radius2))
    camera = distorted.position @ R.T + T
    np.testing.assert_allclose(camera[..., 0] / camera[..., 2], (normalized * (1 + k1 * radius2))[..., 0], atol=1e-12)
    assert "screen point" in distorted.explain(0)
    assert np.isnan(iso.probe(scene, screen=(5, 5), elsewhere="nan").brightness).all()
    for screen, error in (((5, 5), iso.ProbeError), ((np.nan, 0), iso.ProbeError), ((1, 2, 3), iso.ProbeError)):
        with pytest.raises(error):
            iso.probe(scene, screen=screen)


def test_what_is_no_calibration_is_refused(scene):
    mirrored = R * [[1], [1], [-1]]
    for arguments in ((K[:2], R, T, SIZE), (K + [[0, 3, 0], [0, 0, 0], [0, 0, 0]], R, T, SIZE), (K, R, T, (640,))):
        with pytest.raises(iso.ArgumentError):
            iso.Camera.from_opencv(*arguments)
    with pytest.raises(iso.SceneError, match="three rows"):
        iso.Camera.from_opencv(K, R[:2], T, SIZE)
    for camera, message in (
        (iso.Camera.from_opencv(K, mirrored, T, SIZE), "mirrors: its determinant is -1"),
        (iso.Camera.from_opencv(K, 2 * R, T, SIZE), "is no rotation"),
        (iso.Camera.from_opencv(K * [[-1], [1], [1]], R, T, SIZE), "intrinsics.fx` is -812.5"),
        (scene.camera.replace(eye=(0, 0, 0)), "both `pose` and `eye`"),
        (scene.camera.replace(field_of_view=60), "both `field_of_view` and `intrinsics`"),
        (scene.camera.replace(projection="panorama"), "camera.intrinsics"),
        (iso.Camera(forward=(0, 0, 1), field_of_view=60), "eye"),
    ):
        with pytest.raises(iso.SceneError) as caught:
            scene.replace(camera=camera)
        assert message in str(caught.value)
    with pytest.raises(iso.SceneError, match="right"):
        scene.replace(handedness="left")
    fisheye = iso.Camera(eye=(0, 0, 0), forward=(0, 0, 1), projection="fisheye-equidistant", field_of_view=180)
    for camera, options in ((fisheye, {}), (scene.camera, {"handedness": "left"})):
        with pytest.raises(iso.ArgumentError):
            camera.to_opencv(**options)


def test_a_mesh_of_arrays_is_the_mesh_of_its_file(tmp_path):
    vertices = np.array([(-1, -1, 0), (1, -1, 0), (0, 1, 0), (0, 0, -1)], np.float32)
    faces = np.array([(0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)])
    normals = vertices - vertices.mean(axis=0)
    lines = [*(f"v {x} {y} {z}" for x, y, z in vertices.tolist()), *(f"vn {x} {y} {z}" for x, y, z in normals.tolist())]
    lines += ["f " + " ".join(f"{corner + 1}//{corner + 1}" for corner in face) for face in faces.tolist()]
    (tmp_path / "mesh.obj").write_text("\n".join(lines))
    parts = {
        "length": "m",
        "camera": iso.Camera(eye=(0.5, 0.5, -5), target=(0, 0, 0), field_of_view=40, resolution=(64, 48)),
        "materials": {"clay": iso.Material(diffuse=0.7)},
        "lights": [iso.PointLight(position=(3, 3, -8), intensity=100)],
    }
    of_file = iso.Scene(shapes=[iso.Mesh(file="mesh.obj", material="clay")], directory=tmp_path, **parts)
    mesh = iso.Mesh(vertices=vertices, faces=faces, normals=normals, material="clay")
    of_arrays = iso.Scene(shapes=[mesh], **parts)
    expected = iso.render(of_file, channels=["brightness", "normal", "depth"])
    assert expected.mask.sum() > 100
    again = (
        of_arrays,
        iso.Scene.from_toml(of_arrays.to_toml()),
        of_arrays.replace(title="x"),
        of_arrays.set({"title": "y"}),
    )
    for scene in again:
        found = iso.render(scene, channels=["brightness", "normal", "depth"])
        for channel in expected:
            np.testing.assert_allclose(found[channel], expected[channel], rtol=1e-6, atol=1e-9)
    assert "<4 × 3>" in repr(mesh) and len(repr(of_arrays)) < 1000
    assert json.loads(json.dumps(of_arrays.to_dict()))["mesh"][0]["faces"] == faces.tolist()
    for change in (
        {"faces": [(0, 1, 4)]},
        {"faces": [(0, 0, 1)]},
        {"faces": None},
        {"vertices": None},
        {"normals": normals[:2]},
        {"file": "mesh.obj"},
        {"faces": [(0, 1, -1)]},
        {"faces": [(0.5, 1, 2)]},
        {"vertices": [(0, 0, np.nan)] * 4},
        {"vertices": np.zeros((4, 2))},
    ):
        with pytest.raises(iso.SceneError):
            of_arrays.replace(shapes=[mesh.replace(**change)])
