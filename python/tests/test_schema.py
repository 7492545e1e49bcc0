"""The schema and the classes of the package agree on every key of a scene, on defaults and on limits."""

from __future__ import annotations

import dataclasses
import json

import pytest
from conftest import REPOSITORY

import isophote as iso
from isophote import scene, shapes

SCHEMA = json.loads((REPOSITORY / "schema/scene.schema.json").read_text(encoding="utf-8"))
FILES = REPOSITORY / "crates/isophote/tests/files"

LIGHTS = [iso.PointLight, iso.LambertianLight, iso.SpotLight, iso.ParallelLight]
CLASSES = {
    "camera": [iso.Camera],
    "camera/screen": [iso.Screen],
    "camera/window": [iso.Window],
    "camera/intrinsics": [iso.Intrinsics],
    "camera/pose": [iso.Pose],
    "sampling": [iso.Sampling],
    "material": [iso.Material],
    "light": LIGHTS,
    "ambient": [iso.Ambient],
    "probe": [iso.Probe],
    "area": [iso.Area],
    "grid": [iso.Grid],
    **{kind.KEY: [kind] for kind in shapes.KINDS},
    "box/rotation": [iso.Rotation],
}
# Fields of a scene that are not one key with the same name.
SEVERAL = {
    "materials": ["material"],
    "shapes": [kind.KEY for kind in shapes.KINDS],
    "lights": ["light"],
    "probes": ["probe"],
    "areas": ["area"],
    "grids": ["grid"],
    "directory": [],
}


def resolved(rule):
    if "$ref" in rule:
        rule = SCHEMA["$defs"][rule["$ref"].rsplit("/", 1)[1]]
    inner = rule.get("items", rule.get("additionalProperties"))
    return resolved(inner) if isinstance(inner, dict) and "$ref" in inner else rule


def table(path):
    rule = SCHEMA
    for key in path.split("/"):
        rule = resolved(rule["properties"][key])
    return rule


@pytest.mark.parametrize("path", CLASSES)
def test_classes_have_the_keys_of_their_tables(path):
    rule, classes = table(path), CLASSES[path]
    keys = {kind.key_of(field.name) for kind in classes for field in dataclasses.fields(kind)}
    fixed = {key for kind in classes for key in kind._FIXED}
    assert keys | fixed == set(rule["properties"])
    for kind in classes:
        for field in dataclasses.fields(kind):
            key = kind.key_of(field.name)
            is_required = field.default is dataclasses.MISSING
            # Which keys a light must have depends on its emission, which the schema leaves to the program.
            assert is_required == (key in rule.get("required", [])) or classes is LIGHTS, key
            if not is_required and field.default is not None:
                default = list(field.default) if isinstance(field.default, tuple) else field.default
                assert default == rule["properties"][key]["default"], key


def test_every_table_has_a_class():
    def tables(rule, path=()):
        rule = resolved(rule)
        for key, inner in rule.get("properties", {}).items():
            if "properties" in resolved(inner):
                yield (*path, key)
                yield from tables(inner, (*path, key))

    paths = {"/".join(path) for path in tables(SCHEMA)}
    assert {path for path in paths if not path.endswith("/rotation")} | {"box/rotation"} == set(CLASSES)


def test_a_scene_has_the_keys_on_top():
    fields = [field.name for field in dataclasses.fields(iso.Scene)]
    keys = {key for name in fields for key in SEVERAL.get(name, [name])}
    assert keys | {"version"} == set(SCHEMA["properties"])


def written():
    """Scenes that have every key, and every limit within reach."""
    tomllib = pytest.importorskip("tomllib")
    world = tomllib.loads((FILES / "every-key.toml").read_text(encoding="utf-8"))
    for camera in tomllib.loads((FILES / "cameras.toml").read_text(encoding="utf-8"))["camera"]:
        yield {**world, "camera": camera}
    yield {**world, "camera": camera, "ambient": {**world["ambient"], "radiance": 1}}
    # Coefficients that are no albedos may be larger.
    yield {**world, "camera": camera, "convention": "course"}


def limits(rule, value, place=(), way=()):
    """The limits on each value: its place in the schema, the way to it, the limit."""
    if "$ref" in rule:
        rule = SCHEMA["$defs"][rule["$ref"].rsplit("/", 1)[1]]
    for choice in rule.get("anyOf", []):
        if (choice["type"] == "array") == isinstance(value, list):
            yield from limits(choice, value, place, way)
    if "anyOf" in rule:
        return
    for name in ("minimum", "exclusiveMinimum", "maximum"):
        if name in rule and "const" not in rule:
            yield (*place, name), way, rule[name]
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in items:
        if key in rule.get("properties", {}):
            yield from limits(rule["properties"][key], inner, (*place, key), (*way, key))
        else:
            several = rule.get("items") or rule["additionalProperties"]
            yield from limits(several, inner, (*place, "*"), (*way, key))


def just_beyond(name, limit):
    if name == "exclusiveMinimum":
        return limit
    outwards = 1 if name == "maximum" else -1
    return limit + outwards if isinstance(limit, int) else limit + outwards * (abs(limit) * 1e-6 or 1e-12)


def build(one):
    """The scene, made of the parts of the package."""
    return iso.Scene(**{**scene._fields(one), "directory": FILES})


def is_refused(scene_written, way, number):
    """Whether the table with this number is refused; what is wrong elsewhere because of it is no matter."""
    changed = json.loads(json.dumps(scene_written))
    inner = changed
    for key in way[:-1]:
        inner = inner[key]
    inner[way[-1]] = number
    name, part = way[:2]
    here = f"{name}[{part}]" if isinstance(part, int) else f"{name}.{part}" if name == "material" else name
    try:
        build(changed)
    except iso.SceneError as error:
        return any(problem.path.startswith(here) for problem in error.problems)
    return False


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_classes_take_what_is_within_the_limits_and_refuse_what_is_not():
    found = {}
    for one in written():
        build(one)
        for place, way, limit in limits(SCHEMA, one):
            found.setdefault((place, limit), []).append((one, way))
    assert len(found) > 50
    for (place, limit), where in found.items():
        allowed = limit + 1e-12 if place[-1] == "exclusiveMinimum" else limit
        assert not all(is_refused(one, way, allowed) for one, way in where), f"{place} at {limit}"
        assert all(is_refused(one, way, just_beyond(place[-1], limit)) for one, way in where), f"{place} beyond {limit}"
