"""The schema and the classes of the package agree on every key of a scene, on defaults and on limits."""

from __future__ import annotations

import dataclasses
import inspect
import json
import re
import typing

import pytest
from conftest import REPOSITORY

import isophote as iso
from isophote import _convert, scene, shapes

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


NUMBERS = {
    getattr(_convert, name)
    for name in ("Amount", "Matrix", "Number", "Pair", "Size", "Triples", "Vector", "Vectors", "Whole")
}
LENGTH, COORDINATES = "1e-12 to 1e15 m", "within ±1e15 m"
PARTS = sorted({kind for kinds in CLASSES.values() for kind in kinds}, key=lambda kind: kind.__name__)
PUBLIC = [getattr(iso, name) for name in iso.__all__ if inspect.isclass(getattr(iso, name))]


def listed(kind):
    """What the docstring of a class says of each of its fields."""
    said = {}
    for names, text in re.findall(r"^- ((?:``\w+``(?:, )?)+): (.*(?:\n  .*)*)", inspect.getdoc(kind), re.M):
        said.update(dict.fromkeys(re.findall(r"\w+", names), " ".join(text.split())))
    return said


def said_of(kind, name):
    return next(listed(base)[name] for base in kind.__mro__ if name in inspect.get_annotations(base))


@pytest.mark.parametrize("kind", [kind for kind in PUBLIC if dataclasses.is_dataclass(kind)], ids=lambda kind: kind.__name__)
def test_docstrings_list_the_fields_of_their_class(kind):
    own = [field.name for field in dataclasses.fields(kind) if field.name in inspect.get_annotations(kind)]
    assert sorted(listed(kind)) == sorted(own)


def test_docstrings_give_every_number_a_range():
    without = []
    for kind in PARTS:
        hints = typing.get_type_hints(kind, include_extras=True)
        for field in dataclasses.fields(kind):
            is_number = any(one in NUMBERS for one in (hints[field.name], *typing.get_args(hints[field.name])))
            if is_number and not re.search(
                r"\d to |above 0|within ±|any length but 0|any finite|orthonormal", said_of(kind, field.name)
            ):
                without.append(f"{kind.__name__}.{field.name}: {said_of(kind, field.name)}")
    assert without == []


def bounds_of(rule):
    """All limits of a value and of what is in it."""
    if "$ref" in rule:
        return
    yield from ((name, rule[name]) for name in ("minimum", "exclusiveMinimum", "maximum") if name in rule)
    for inner in (*rule.get("anyOf", []), *([rule["items"]] if "items" in rule else [])):
        yield from bounds_of(inner)


def numbers_in(text):
    plain = re.sub(r"(?<=\d),(?=\d{3})", "", text.replace("−", "-"))
    return {float(number) for number in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", plain)}


def test_ranges_in_docstrings_are_those_of_the_schema():
    wrong, compared = [], 0
    for path, kinds in CLASSES.items():
        properties = table(path)["properties"]
        for kind in kinds:
            for field in dataclasses.fields(kind):
                said = said_of(kind, field.name)
                for name, limit in set(bounds_of(properties[kind.key_of(field.name)])):
                    compared += 1
                    is_above_0 = name == "exclusiveMinimum" and (LENGTH in said or "above 0" in said)
                    if limit not in numbers_in(said) and not is_above_0:
                        wrong.append(f"{kind.__name__}.{field.name} has no {name} {limit}: {said}")
    assert wrong == [] and compared > 70


@pytest.mark.filterwarnings("ignore::isophote.SceneWarning")
def test_lengths_and_coordinates_in_docstrings_have_the_limits_of_the_core():
    """The schema has none for them: they depend on the scene's unit, here the metre."""
    tried = set()
    for one in written():
        for path, kinds in CLASSES.items():
            table_name, *inner = path.split("/")
            held = one.get(table_name, {})
            items = (
                enumerate(held) if isinstance(held, list) else held.items() if table_name == "material" else [(None, held)]
            )
            for number, item in items:
                way = (table_name, *(() if number is None else (number,)), *inner)
                for key in inner:
                    item = item.get(key, {})
                for kind in kinds:
                    for field in dataclasses.fields(kind):
                        key, said = kind.key_of(field.name), said_of(kind, field.name)
                        if key not in item or (LENGTH not in said and COORDINATES not in said):
                            continue
                        value = item[key]
                        place = (*way, key, 0) if isinstance(value, list) else (*way, key)
                        if isinstance(value, list) and isinstance(value[0], list):
                            continue
                        assert is_refused(one, place, 1.001e15), f"{kind.__name__}.{field.name}"
                        if LENGTH in said:
                            assert is_refused(one, place, 0.999e-12), f"{kind.__name__}.{field.name}"
                        tried.add((kind, field.name))
    assert len(tried) > 35
