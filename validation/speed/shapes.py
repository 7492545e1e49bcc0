"""The scenes of other shapes than spheres: a file for our program, and JSON for the others."""

import json
import math
import random
from dataclasses import dataclass
from pathlib import Path

EYE = [0.0, 0.0, 3.2]
HALF_WINDOW = [0.4, 0.225]
RESOLUTION = [1920, 1080]
DIFFUSE = 0.6
INTENSITY = 20.0
HEAD = f"""version = 1
length = "m"
convention = "radiance"
shadows = true

[camera]
eye = {EYE}
target = [0, 0, 0]
screen = {{ distance = 1, x = [-0.4, 0.4], y = [-0.225, 0.225] }}
resolution = {RESOLUTION}

[material.a]
diffuse = {DIFFUSE}
specular = 0.3
shininess = 20
"""

# A kind of our scene files, with its keys.
Shape = dict[str, str | float | list[float]]


@dataclass(frozen=True)
class SceneFiles:
    """A scene, `NAME-LIGHTS`, for our program and for the others."""

    name: str
    title: str
    lights: int
    toml: Path
    json: Path


def write_scenes(folder: Path) -> list[SceneFiles]:
    """Every scene with one light and with 16."""
    folder.mkdir(parents=True, exist_ok=True)
    bumpy_ball(folder / "flat.obj", is_smooth=False)
    bumpy_ball(folder / "smooth.obj", is_smooth=True)
    scenes = {
        ("mesh-100000", "mesh of 100,000 triangles"): [{"kind": "mesh", "file": "flat.obj"}],
        ("smooth-mesh-100000", "the same, smooth normals"): [{"kind": "mesh", "file": "smooth.obj"}],
        ("thousand-solids", "1000 boxes and cylinders"): thousand_solids(),
        ("plane-and-ten", "plane and ten shapes"): plane_and_ten(),
    }
    return [write_scene(folder, *names, shapes, count) for names, shapes in scenes.items() for count in (1, 16)]


def write_scene(folder: Path, stem: str, title: str, shapes: list[Shape], count: int) -> SceneFiles:
    name, places = f"{stem}-{count}", lights(count)
    files = SceneFiles(name, title, count, folder / f"{name}.toml", folder / f"{name}.json")
    text = "".join(f"\n[[light]]\nposition = {place}\nintensity = {INTENSITY}\n" for place in places)
    for shape in shapes:
        keys = "".join(f"{key} = {json.dumps(value)}\n" for key, value in shape.items() if key != "kind")
        text += f'\n[[{shape["kind"]}]]\n{keys}material = "a"\n'
    files.toml.write_text(HEAD + text)
    scene = {
        "folder": str(folder),
        "eye": EYE,
        "half_window": HALF_WINDOW,
        "resolution": RESOLUTION,
        "diffuse": DIFFUSE,
        "lights": [[*place, INTENSITY] for place in places],
        "shapes": shapes,
    }
    files.json.write_text(json.dumps(scene))
    return files


def lights(count: int) -> list[list[float]]:
    draw = random.Random(1)
    return [point(draw.uniform(-4, 4), draw.uniform(-1, 4), draw.uniform(2, 5)) for _ in range(count)]


def bumpy_ball(path: Path, is_smooth: bool, rows: int = 223, columns: int = 224) -> None:
    """About 100,000 triangles."""
    with path.open("w") as file:
        for row in range(rows + 1):
            for column in range(columns):
                polar, around = math.pi * (row + 0.5) / (rows + 1), 2 * math.pi * column / columns
                radius = 1 + 0.05 * math.sin(9 * around) * math.sin(7 * polar)
                place = (math.sin(polar) * math.cos(around), math.cos(polar), math.sin(polar) * math.sin(around))
                print("v", *(f"{radius * coordinate:.9g}" for coordinate in place), file=file)
                if is_smooth:
                    print("vn", *(f"{coordinate:.9g}" for coordinate in place), file=file)
        corner = (lambda index: f"{index + 1}//{index + 1}") if is_smooth else (lambda index: str(index + 1))
        for row in range(rows):
            for column in range(columns):
                here, right = row * columns + column, row * columns + (column + 1) % columns
                for triangle in ((here, right, here + columns), (right, right + columns, here + columns)):
                    print("f", *map(corner, triangle), file=file)


def thousand_solids() -> list[Shape]:
    """Boxes and cylinders in turn."""
    draw = random.Random(2)
    shapes: list[Shape] = []
    for number in range(1000):
        x, y, z = draw.uniform(-1.4, 1.4), draw.uniform(-0.8, 0.8), draw.uniform(-2, 0)
        if number % 2:
            size = point(*(draw.uniform(0.05, 0.2) for _ in range(3)))
            shapes.append({"kind": "box", "center": point(x, y, z), "size": size})
        else:
            end = point(x + draw.uniform(-0.1, 0.1), y + 0.1, z)
            shapes.append({"kind": "cylinder", "from": point(x, y, z), "to": end, "radius": 0.05})
    return shapes


def plane_and_ten() -> list[Shape]:
    """Spheres, boxes, cylinders and ellipsoids over a plane."""
    draw = random.Random(3)
    shapes: list[Shape] = [{"kind": "plane", "point": [0, -0.6, 0], "normal": [0, 1, 0]}]
    for number in range(10):
        x, y, z = draw.uniform(-1, 1), draw.uniform(-0.4, 0.3), draw.uniform(-1, 0.5)
        place = point(x, y, z)
        kinds: tuple[Shape, ...] = (
            {"kind": "sphere", "center": place, "radius": 0.2},
            {"kind": "box", "center": place, "size": [0.3, 0.2, 0.3]},
            {"kind": "cylinder", "from": place, "to": point(x, y + 0.3, z), "radius": 0.15},
            {"kind": "ellipsoid", "center": place, "radii": [0.2, 0.1, 0.3]},
        )
        shapes.append(kinds[number % 4])
    return shapes


def point(*coordinates: float) -> list[float]:
    return [round(coordinate, 4) for coordinate in coordinates]
