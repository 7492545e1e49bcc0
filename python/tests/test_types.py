"""What type checkers see: the examples of the documentation, and the closed sets of words."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args

import pytest
from conftest import REPOSITORY

import isophote as iso
from isophote import _types

PAGES = [
    REPOSITORY / "README.md",
    *(REPOSITORY / "docs" / name for name in ("tutorial.md", "conventions.md")),
    *sorted((REPOSITORY / "docs/python").glob("*.md")),
]
MORE = """
import isophote as iso
import numpy as np

scene = iso.scenes.lab()
light = scene.lights[0]
strength = light.intensity
if isinstance(light, iso.SpotLight):
    angle: float = light.inner_angle
shape = scene.shapes[0]
if isinstance(shape, iso.Sphere):
    radius: float = shape.radius
m = iso.render(scene, channels=["normal", "shape"], precision="single")
reveal_type(m["normal"])
reveal_type(m["shape"])
reveal_type(iso.probe(scene).brightness)
reveal_type(iso.probe(scene).seen)
reveal_type(scene.length)
iso.render(scene, precision="half")
iso.probe(scene, elsewhere="somewhere")
scene.replace(lights=[])
iso.Scene(length="km", camera=scene.camera)
"""


def code(page: Path) -> str:
    blocks = re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
    lines = []
    for line in "".join(blocks).splitlines():
        prompt = re.match(r"(?:>>>|\.\.\.) ?(.*)", line)
        if prompt:
            lines.append(prompt[1])
        elif ">>>" not in "".join(blocks):
            lines.append(line)
    return "\n".join(lines) + "\n"


def checked(folder: Path) -> str:
    mypy = pytest.importorskip("mypy")
    assert mypy
    options = ["--strict", "--ignore-missing-imports", "--no-error-summary", "--allow-untyped-defs", "--allow-untyped-calls"]
    config = [
        "--config-file",
        str(REPOSITORY / "python/pyproject.toml"),
        "--cache-dir",
        str(REPOSITORY / "python/.mypy_cache"),
    ]
    command = [sys.executable, "-m", "mypy", *config, *options, *(str(path) for path in sorted(folder.glob("*.py")))]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=REPOSITORY / "python").stdout


def checked_by_pyright(folder: Path) -> list[dict[str, Any]]:
    """What Pyright says of the files of a folder."""
    pytest.importorskip("basedpyright")
    config = {"include": ["."], "extraPaths": [str(REPOSITORY / "python")], "typeCheckingMode": "standard"}
    (folder / "pyrightconfig.json").write_text(json.dumps(config))
    command = [sys.executable, "-m", "basedpyright", "-p", str(folder), "--pythonpath", sys.executable, "--outputjson"]
    said = json.loads(subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder).stdout)
    assert said["summary"]["filesAnalyzed"] == len(list(folder.glob("*.py")))
    return said["generalDiagnostics"]


def write_examples(folder: Path) -> None:
    for page in PAGES:
        name = "_".join(page.relative_to(REPOSITORY).with_suffix("").parts)
        (folder / f"{name}.py").write_text(code(page), encoding="utf-8")


def test_the_examples_of_the_documentation_are_well_typed(tmp_path):
    write_examples(tmp_path)
    # Two examples are of errors, which a type checker finds as well.
    found = [line for line in checked(tmp_path).splitlines() if ": error:" in line]
    expected = ('Argument "radius" to "Sphere"', 'Argument "center" to "Sphere"')
    assert [line for line in found if not any(one in line for one in expected)] == []


def test_pyright_agrees(tmp_path):
    write_examples(tmp_path)
    (tmp_path / "more.py").write_text(MORE)
    said = checked_by_pyright(tmp_path)
    errors = [(Path(one["file"]).name, one["range"]["start"]["line"] + 1) for one in said if one["severity"] == "error"]
    of_more = [line for name, line in errors if name == "more.py"]
    assert of_more == [19, 20, 22]
    others = [one["message"] for one in said if one["severity"] == "error" and Path(one["file"]).name != "more.py"]
    expected = ('to parameter "radius"', 'to parameter "center"')
    assert [message for message in others if not any(one in message for one in expected)] == []
    revealed = [one["message"] for one in said if one["severity"] == "information"]
    for kind in ("float64", "_32Bit", "bool", "Literal['m'"):
        assert any(kind in message for message in revealed), (kind, revealed)


def test_types_are_as_precise_as_the_values(tmp_path):
    (tmp_path / "more.py").write_text(MORE)
    found = checked(tmp_path)
    for revealed in ("float64", "_32Bit", "bool", "Literal['m'"):
        assert re.search(rf"Revealed type is .*{re.escape(revealed)}", found), (revealed, found)
    errors = [line for line in found.splitlines() if ": error:" in line]
    assert [re.sub(r".*more\.py:(\d+): .*", r"\1", line) for line in errors] == ["19", "20", "22"], found


def test_literals_are_the_words_that_the_core_takes():
    schema = json.loads((REPOSITORY / "schema/scene.schema.json").read_text(encoding="utf-8"))

    def words(rule):
        rule = schema["$defs"][rule["$ref"].rsplit("/", 1)[1]] if "$ref" in rule else rule
        rule = rule["anyOf"][0] if "anyOf" in rule and "$ref" in rule["anyOf"][0] else rule
        if "$ref" in rule:
            return words(rule)
        return set(rule["enum"]) if "enum" in rule else {one["const"] for one in rule["oneOf"]}

    top = schema["properties"]
    for key, kind in (
        ("length", _types.LengthUnit),
        ("handedness", _types.Handedness),
        ("quantities", _types.Quantities),
        ("color_space", _types.ColorSpace),
    ):
        assert set(get_args(kind)) == words(top[key]), key
    assert set(get_args(get_args(_types.ConventionName)[0])) == {one.value for one in iso.Convention}
    camera = top["camera"]["properties"]
    assert set(get_args(_types.Projection)) == words(camera["projection"])
