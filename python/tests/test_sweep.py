"""Sweeps and stores, on this machine and on a cluster of two processes."""

from __future__ import annotations

import contextlib
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import xarray
from conftest import REPOSITORY

import isophote as iso

needs_zarr = pytest.mark.skipif(importlib.util.find_spec("zarr") is None, reason="zarr 3 is for Python from 3.11")

POSITIONS = [(5, 5, -10), (0, 5, -10), (-5, 5, -10)]
SHININESS = [5, 20.0, 80]
PARAMETERS = {"light.lamp.position": POSITIONS, "material.clay.shininess": SHININESS}


@pytest.fixture
def small(lab):
    return lab.with_resolution((80, 60))


@pytest.fixture(scope="module")
def client():
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, worker_dashboard_address=None
    )
    with cluster, distributed.Client(cluster) as client:
        yield client


def check(found, scene, names=("brightness",)):
    assert dict(found.sizes)["light.lamp.position"] == 3
    assert found["brightness"].dims == ("light.lamp.position", "material.clay.shininess", "y", "x")
    assert found["material.clay.shininess"].values.tolist() == SHININESS
    assert found["light.lamp.position.value"].values.tolist() == [list(position) for position in POSITIONS]
    assert found["brightness"].attrs["units"] == "W/m²"
    for i, position in enumerate(POSITIONS):
        for j, shininess in enumerate(SHININESS):
            changed = scene.set({"light.lamp.position": position, "material.clay.shininess": shininess})
            expected = iso.render(changed, channels=names)
            there = found.isel({"light.lamp.position": i, "material.clay.shininess": j})
            for name in names:
                np.testing.assert_array_equal(there[name].values, expected[name])
            np.testing.assert_array_equal(there["visible"].values, expected.mask)


def test_a_sweep_has_a_dimension_for_each_parameter(small):
    heard = []
    found = iso.sweep(small, PARAMETERS, progress=lambda done, total: heard.append((done, total)))
    check(found, small)
    assert heard == [(number, 9) for number in range(1, 10)]


@needs_zarr
def test_a_sweep_into_a_store_is_the_same(small, tmp_path):
    store = tmp_path / "sweep.zarr"
    found = iso.sweep(small, PARAMETERS, channels=["brightness", "normal"], store=store, workers=3)
    check(found, small, ("brightness", "normal"))
    again = xarray.open_zarr(store, consolidated=False, chunks=None)
    np.testing.assert_array_equal(again["brightness"].values, found["brightness"].values)
    assert again["axis"].attrs["labels"] == ["x", "y", "z"]
    with pytest.raises(iso.StoreError, match="exists already"):
        iso.sweep(small, PARAMETERS, store=store)


def test_a_sweep_over_words_and_colours(small):
    colours = [(0.1, 0.2, 0.3), 0.5]
    found = iso.sweep(small, {"convention": ["lab", "radiance"], "material.clay.diffuse": [0.2, 0.4]})
    assert found["convention"].values.tolist() == ["lab", "radiance"]
    with_colour = iso.sweep(small, {"material.clay.diffuse": [colours[0], colours[0]]}, channels=["color"])
    assert with_colour["component"].values.tolist() == ["red", "green", "blue"]
    assert with_colour["material.clay.diffuse.value"].dims == ("material.clay.diffuse", "component")
    assert with_colour["color"].dims == ("material.clay.diffuse", "y", "x", "component")
    none = iso.sweep(small, {})
    np.testing.assert_array_equal(none["brightness"].values, iso.render(small)["brightness"])


def test_paired_values_make_one_map_each(small):
    found = iso.sweep(small, PARAMETERS, paired=True)
    assert found["brightness"].dims == ("pair", "y", "x") and found.sizes["pair"] == 3
    assert found["material.clay.shininess"].values.tolist() == SHININESS
    assert found["light.lamp.position.value"].dims == ("pair", "axis")
    for number, (position, shininess) in enumerate(zip(POSITIONS, SHININESS)):
        scene = small.set({"light.lamp.position": position, "material.clay.shininess": shininess})
        np.testing.assert_array_equal(found["brightness"][number], iso.render(scene)["brightness"])
    for parameters in ({**PARAMETERS, "convention": ["lab"]}, {}):
        with pytest.raises(iso.ArgumentError, match="paired"):
            iso.sweep(small, parameters, paired=True)


def test_a_list_of_scenes_is_swept(small, tmp_path):
    scenes = [small, small.replace(convention="radiance"), small.set({"camera.screen.distance": 4})]
    found = iso.sweep(scenes)
    assert found["brightness"].dims == ("scene", "y", "x")
    assert found["brightness.units"].values.tolist() == ["W/m²", "W/(m²·sr)", "W/m²"]
    for number, scene in enumerate(scenes):
        np.testing.assert_array_equal(found["brightness"][number], iso.render(scene)["brightness"])
    with pytest.raises(iso.ArgumentError, match="scene 1 has"):
        iso.sweep([small, small.with_resolution((40, 30))])
    for wrong in ([], [5]):
        with pytest.raises(iso.ArgumentError):
            iso.sweep(wrong)
    with pytest.raises(iso.ArgumentError):
        iso.sweep(small)


def test_whole_lights_and_materials_are_swept(small):
    lamp = small.lights[0]
    lights = [lamp, iso.LambertianLight(position=lamp.position, target=(0, 0, 5), intensity=100)]
    materials = [iso.Material(diffuse=value) for value in (0.2, 0.4)]
    found = iso.sweep(small, {"light.lamp": lights, "material.clay": materials})
    assert found.sizes["light.lamp"] == found.sizes["material.clay"] == 2
    assert found["material.clay.value"].values[0] == "Material(diffuse=0.2)"
    scene = small.set({"light.lamp": lights[1], "material.clay": materials[1]})
    np.testing.assert_array_equal(found["brightness"][1, 1], iso.render(scene)["brightness"])
    with pytest.raises(iso.ArgumentError, match="part of the other"):
        iso.sweep(small, {"light.lamp": lights, "light.lamp.position": POSITIONS})


@needs_zarr
def test_the_store_of_a_sweep_is_read_as_the_dataset_it_was(small, tmp_path):
    store = tmp_path / "sweep.zarr"
    parameters = {"convention": ["lab", "radiance"], "light.lamp.position": POSITIONS}
    found = iso.sweep(small, parameters, channels=["brightness", "normal"], store=store)
    again = iso.read(store)
    xarray.testing.assert_identical(again.load(), found.load())
    assert again["axis"].values.tolist() == ["x", "y", "z"] and again["convention"].values.tolist() == ["lab", "radiance"]
    # Warnings are errors in these tests.
    assert "brightness" in xarray.open_zarr(store)


def test_what_is_wrong_with_a_sweep_is_known_before_it_begins(small, tmp_path):
    store = tmp_path / "sweep.zarr"
    for parameters in (
        {"light.lamp.intensity": []},
        {"light.lump.intensity": [1]},
        {"light.lamp.intensity": [1, -1]},
        {"camera.resolution": [(80, 60), (40, 30)]},
        # Inside the sphere.
        {"light.lamp.position": [(0, 0, -10), (0, 0, 5)]},
    ):
        with pytest.raises((iso.ArgumentError, iso.SceneError)):
            iso.sweep(small, parameters, store=store)
    for options in ({"workers": 0}, {"progress": 3}, {"client": "tcp://x"}, {"channels": "colour"}):
        with pytest.raises((iso.ArgumentError, TypeError)):
            iso.sweep(small, PARAMETERS, store=store, **options)
        with pytest.raises((iso.ArgumentError, TypeError)):
            options = {"threads" if name == "workers" else name: value for name, value in options.items()}
            iso.render_to_zarr(small, None, store, **options)
    with pytest.raises(iso.ArgumentError, match="are the same"):
        iso.sweep(small, {"light.lamp.intensity": [1], "light[0].intensity": [2]})
    with pytest.raises(iso.ArgumentError, match="resume"):
        iso.sweep(small, PARAMETERS, resume=True)
    assert not store.exists()


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_units_and_places_that_differ_are_told(small):
    found = iso.sweep(small, {"convention": list(iso.Convention)[2:], "material.clay.diffuse": [0.2, 0.4]})
    assert "units" not in found["brightness"].attrs and "convention" not in found.attrs
    assert found["convention"].values.tolist() == [
        *("lab", "course", "course-pi", "radiance"),
        *("blinn-phong", "blinn-phong-pi"),
    ]
    units = found["brightness.units"]
    assert units.dims == ("convention", "material.clay.diffuse")
    assert units.values[:, 0].tolist() == ["W/m²", *["W/(m²·sr)"] * 5]
    zoomed = iso.sweep(small, {"camera.screen.x": [(-4, 4), (-2, 2)], "camera.screen.y": [(-3, 3), (-1.5, 1.5)]})
    assert zoomed["x"].values.tolist() == list(range(80)) and zoomed["x"].attrs["long_name"] == "column, from 0"
    same = iso.sweep(small, {"camera.eye": [(0, 0, 0), (0, 0, -1)]})
    assert same["x"].attrs["units"] == "m"


@needs_zarr
def test_an_interrupted_sweep_goes_on(small, tmp_path):
    store = tmp_path / "sweep.zarr"

    def stop(done, _total):
        if done == 4:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        iso.sweep(small, PARAMETERS, store=store, workers=1, progress=stop)
    unfinished = xarray.open_zarr(store, consolidated=False, chunks=None)
    assert 4 <= int(unfinished["rendered"].sum()) < 9
    with pytest.raises(iso.StoreError, match="another sweep"):
        iso.sweep(small, {**PARAMETERS, "material.clay.shininess": [1, 2, 3]}, store=store, resume=True)
    heard = []
    found = iso.sweep(small, PARAMETERS, store=store, resume=True, progress=lambda done, total: heard.append(done))
    check(found, small)
    assert heard[0] >= 4 and heard[-1] == 9
    assert bool(xarray.open_zarr(store, consolidated=False, chunks=None)["rendered"].all())


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_a_mesh_is_read_once_for_all_maps(monkeypatch, tmp_path):
    scene = iso.Scene.from_file(REPOSITORY / "scenes" / "mesh.toml").with_resolution((16, 12))
    shutil.copytree(REPOSITORY / "scenes" / "meshes", tmp_path / "meshes")
    copy = iso.Scene.from_toml(scene.to_toml(), directory=tmp_path)
    shutil.rmtree(tmp_path / "meshes")
    path = f"light.{copy.core.describe()['lights'][0]}.casts_shadows"
    found = iso.sweep(copy, {path: [True, False]})
    np.testing.assert_array_equal(found["brightness"][0], iso.render(scene)["brightness"])


@needs_zarr
def test_a_cluster_sweeps_as_well(small, client, tmp_path):
    check(iso.sweep(small, PARAMETERS, client=client), small)
    found = iso.sweep(small, PARAMETERS, client=client, store=tmp_path / "sweep.zarr")
    check(found, small)


def files(store: Path) -> dict[str, bytes]:
    return {str(path.relative_to(store)): path.read_bytes() for path in sorted(store.rglob("*")) if path.is_file()}


def by_command(store: Path, scene: Path, *options: str) -> dict[str, bytes]:
    command = [sys.executable, "-m", "isophote", "render", "--quiet", str(scene), "-o", str(store), *options]
    subprocess.run(command, check=True, capture_output=True)
    return files(store)


LAB = REPOSITORY / "scenes" / "lab.toml"


@needs_zarr
def test_a_store_is_the_commands_byte_for_byte(tmp_path):
    scene = iso.Scene.from_file(LAB)
    expected = by_command(tmp_path / "command.zarr", LAB, "--size", "1000x750", "--shard-side", "256")
    stored = iso.render_to_zarr(scene, (1000, 750), tmp_path / "package.zarr", shard_side=256, threads=3)
    assert files(tmp_path / "package.zarr") == expected
    whole = iso.render(scene, size=(1000, 750))
    assert stored.pixels == 750_000 and stored.visible == whole.mask.sum()
    statistics = stored.channels["brightness"]
    assert (statistics.max, statistics.argmax) == (whole.max(), whole.argmax())
    assert (statistics.min, statistics.argmin) == (whole.min(), whole.argmin())
    assert hash(stored) == hash(stored)
    np.testing.assert_array_equal(stored.open()["brightness"].values, whole["brightness"])
    file = iso.read(tmp_path / "package.zarr")
    np.testing.assert_array_equal(file["brightness"], whole["brightness"])
    with pytest.raises(iso.StoreError, match="exists already"):
        iso.render_to_zarr(scene, (1000, 750), tmp_path / "package.zarr", shard_side=256)
    with pytest.raises(iso.StoreError, match="another map"):
        other = scene.set({"light.lamp.intensity": 99})
        iso.render_to_zarr(other, (1000, 750), tmp_path / "package.zarr", shard_side=256, resume=True)
    assert iso.render_to_zarr(scene, (1000, 750), tmp_path / "package.zarr", shard_side=256, resume=True) == stored


def test_an_interrupted_store_is_continued(tmp_path):
    scene = iso.Scene.from_file(LAB)
    expected = by_command(tmp_path / "command.zarr", LAB, "--size", "1200x900", "--shard-side", "128")

    def stop(done, total):
        if done > total // 4:
            raise InterruptedError

    options = {"shard_side": 128, "threads": 1}
    with contextlib.suppress(InterruptedError):
        iso.render_to_zarr(scene, (1200, 900), tmp_path / "package.zarr", progress=stop, **options)
    iso.render_to_zarr(scene, (1200, 900), tmp_path / "package.zarr", resume=True, **options)
    assert files(tmp_path / "package.zarr") == expected


@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_that_loses_a_worker_half_way_makes_the_same_bytes(tmp_path):
    distributed = pytest.importorskip("distributed")
    # Lights enough that a shard takes a while.
    text = LAB.read_text()
    text += "".join(f"\n[[light]]\nposition = [{0.01 * i}, 5, -9]\nintensity = 0.01\n" for i in range(300))
    path = tmp_path / "many.toml"
    path.write_text(text)
    expected = by_command(tmp_path / "command.zarr", path, "--size", "1600x1200", "--shard-side", "200")
    scene = iso.Scene.from_file(path)
    store = tmp_path / "cluster.zarr"
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, worker_dashboard_address=None
    )
    killed = []
    with cluster, distributed.Client(cluster) as client:
        pids = list(client.run(os.getpid).values())

        def kill(done, total):
            if done >= total // 3 and not killed:
                killed.append((done, total))
                os.kill(pids[0], signal.SIGKILL)

        stored = iso.render_to_zarr(scene, (1600, 1200), store, shard_side=200, client=client, progress=kill)
    assert killed and killed[0][0] < killed[0][1]
    assert stored.pixels == 1600 * 1200
    assert files(store) == expected


@needs_zarr
@pytest.mark.skipif(os.name != "posix", reason="SIGKILL")
@pytest.mark.filterwarnings("ignore")
def test_the_only_worker_may_die_too(tmp_path):
    distributed = pytest.importorskip("distributed")
    scene = iso.Scene.from_file(LAB)
    cluster = distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=True, dashboard_address=None, worker_dashboard_address=None
    )
    killed = []
    with cluster, distributed.Client(cluster) as client:
        pid = next(iter(client.run(os.getpid).values()))

        def kill(done, _total):
            if done >= 3 and not killed:
                killed.append(done)
                os.kill(pid, signal.SIGKILL)

        options = {"shard_side": 100, "client": client, "progress": kill}
        stored = iso.render_to_zarr(scene, (800, 600), tmp_path / "map.zarr", **options)
    assert killed
    np.testing.assert_array_equal(stored.open()["brightness"].values, iso.render(scene)["brightness"])
