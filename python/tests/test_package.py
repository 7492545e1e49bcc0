"""The package as a whole."""

from __future__ import annotations

import sys

import pytest
from conftest import REPOSITORY

import isophote as iso

tomllib = pytest.importorskip("tomllib", reason="Python 3.11 has it")


def test_both_project_files_say_the_same():
    root, inner = (tomllib.loads((REPOSITORY / path).read_text()) for path in ("pyproject.toml", "python/pyproject.toml"))
    assert root["project"] == inner["project"]
    assert root["build-system"] == inner["build-system"]
    assert root["tool"]["maturin"]["module-name"] == inner["tool"]["maturin"]["module-name"]


def test_every_public_name_is_there_and_explained():
    for name in iso.__all__:
        thing = getattr(iso, name)
        assert name == "__version__" or (thing.__doc__ and thing.__doc__.strip())


def test_it_is_of_the_cores_version():
    cargo = tomllib.loads((REPOSITORY / "Cargo.toml").read_text())
    assert iso.__version__ == cargo["workspace"]["package"]["version"]


def test_importing_it_imports_nothing_heavy():
    import subprocess

    heavy = ("matplotlib", "xarray", "dask", "distributed", "zarr", "tqdm")
    for program, allowed in (
        ("import isophote", []),
        ("import isophote; isophote.render(isophote.scenes.lab())", ["numpy"]),
    ):
        loaded = f"{program}; import sys; print([name for name in {('numpy', *heavy)!r} if name in sys.modules])"
        done = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True, check=True)
        assert done.stdout.strip() == str(allowed)


def test_what_is_not_there_says_so():
    with pytest.raises(AttributeError, match="no attribute 'rendr'"):
        _ = iso.rendr
    assert set(iso.__all__) <= set(dir(iso))


@pytest.mark.parametrize("name", iso.__all__)
def test_a_docstring_lists_every_field(name):
    import dataclasses

    thing = getattr(iso, name)
    if dataclasses.is_dataclass(thing):
        inherited = {
            field.name for base in thing.__mro__[1:] if dataclasses.is_dataclass(base) for field in dataclasses.fields(base)
        }
        for field in dataclasses.fields(thing):
            if field.name not in inherited:
                assert f"``{field.name}``" in thing.__doc__, f"{name}.{field.name}"


def test_names_are_completed(lab, lab_map, tmp_path):
    assert lab_map._ipython_key_completions_() == [*lab_map, "mask"]
    probes = iso.probe(lab)
    assert "brightness" in probes._ipython_key_completions_() and "brightness" in dir(probes)
    assert lab.materials._ipython_key_completions_() == ["clay"]
    lab_map.save(tmp_path / "map.npz")
    assert "normal" in iso.read(tmp_path / "map.npz")._ipython_key_completions_()
