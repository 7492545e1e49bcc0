"""The scenes that everybody renders, and the files in which everybody gets them."""

import json
import random
from dataclasses import dataclass, replace
from pathlib import Path

EYE_TO_SCREEN = 5.0
LAB_WINDOW = (4.0, 3.0)
# Seen through this window the lab's sphere covers every pixel: its silhouette on the screen has radius 1.02 (5.6),
# the window's corners are 0.75 from the middle.
FILLED_WINDOW = (0.6, 0.45)


@dataclass(frozen=True)
class Scene:
    """The lab's scene (docs/physics.md, section 4) with another window, resolution or lights. Lengths in metres."""

    half_window: tuple[float, float]
    resolution: tuple[int, int]
    lights: tuple[tuple[float, float, float, float], ...]  # x, y, z, intensity in W/sr
    center: tuple[float, float, float] = (0.0, 0.0, 5.0)
    radius: float = 1.0
    diffuse: float = 0.7
    specular: float = 0.3
    shininess: int = 20

    def with_square_pixels(self) -> "Scene":
        """A window of the same area with the aspect of the image: as many pixels see the sphere, and all are square."""
        width, height = self.resolution
        area = self.half_window[0] * self.half_window[1]
        half_height = (area * height / width) ** 0.5
        return replace(self, half_window=(half_height * width / height, half_height))

    def to_json(self) -> str:
        """What the other programs get: the eye is the origin, x runs right, y up, z away from the viewer."""
        return json.dumps({**self.__dict__, "screen_distance": EYE_TO_SCREEN})

    def to_toml(self, convention: str) -> str:
        """What Isophote gets: the same numbers, under one of its conventions."""
        x, y = self.half_window
        lights = "".join(
            f"\n[[light]]\nposition = [{lx!r}, {ly!r}, {lz!r}]\nintensity = {intensity!r}\n"
            for lx, ly, lz, intensity in self.lights
        )
        return f"""version = 1
length = "m"
handedness = "left"
convention = "{convention}"

[camera]
eye = [0, 0, 0]
forward = [0, 0, 1]
screen = {{ distance = {EYE_TO_SCREEN!r}, x = [{-x!r}, {x!r}], y = [{-y!r}, {y!r}] }}
resolution = {list(self.resolution)}

[material.clay]
diffuse = {self.diffuse!r}
specular = {self.specular!r}
shininess = {self.shininess}

[[sphere]]
center = {list(self.center)}
radius = {self.radius!r}
material = "clay"
{lights}"""

    def pixels_to_check(self) -> list[tuple[int, int]]:
        """Pixels on a lattice: on the sphere where cosθ_o > 0.2, or clearly beside it. At the silhouette itself single
        precision and half a pixel make a difference that says nothing about the formula."""
        width, height = self.resolution
        lattice = [(c, r) for r in range(7, height, height // 40) for c in range(5, width, width // 50)]
        return [pixel for pixel in lattice if not 0.96 < self._miss(pixel) < 1.1]

    def covered_pixels(self) -> int:
        """How many pixels see the sphere."""
        width, height = self.resolution
        return sum(self._miss((c, r)) < 1.0 for r in range(height) for c in range(width))

    def _miss(self, pixel: tuple[int, int]) -> float:
        """The distance of the sphere's centre from the pixel's ray, in radii: sinθ_o where it is below 1."""
        (width, height), (half_x, half_y) = self.resolution, self.half_window
        x = (2 * (pixel[0] + 0.5) / width - 1) * half_x
        y = (1 - 2 * (pixel[1] + 0.5) / height) * half_y
        direction = (x, y, EYE_TO_SCREEN)
        along = sum(a * b for a, b in zip(direction, self.center))
        squared = sum(a * a for a in direction)
        return max(0.0, sum(a * a for a in self.center) - along * along / squared) ** 0.5 / self.radius


@dataclass(frozen=True)
class Case:
    """A scene with the name that the tables have for it."""

    name: str
    title: str
    scene: Scene


LAB_LIGHT = ((5.0, 5.0, -10.0, 100.0),)


def random_lights(count: int) -> tuple[tuple[float, float, float, float], ...]:
    """Lights in a box on the viewer's side of the sphere, together as strong as the lab's; the same on every machine."""
    generator = random.Random(count)
    place = lambda low, high: round(generator.uniform(low, high), 6)
    return tuple((place(-10, 10), place(-10, 10), place(-10, 0), 100.0 / count) for _ in range(count))


def all_cases() -> list[Case]:
    small, large = (800, 600), (3840, 2160)
    many = [
        Case(f"lights-{count}", f"{count} random lights, 800×600", Scene(LAB_WINDOW, small, random_lights(count)))
        for count in (16, 256, 4096)
    ]
    return [
        Case("lab", "lab scene, 1 light, 800×600", Scene(LAB_WINDOW, small, LAB_LIGHT)),
        Case("lab-4k", "lab scene, 1 light, 3840×2160", Scene(LAB_WINDOW, large, LAB_LIGHT)),
        Case("fill", "sphere fills the image, 1 light, 800×600", Scene(FILLED_WINDOW, small, LAB_LIGHT)),
        *many,
        Case("fill-256", "sphere fills the image, 256 lights, 800×600", Scene(FILLED_WINDOW, small, random_lights(256))),
    ]


@dataclass(frozen=True)
class SceneFiles:
    """Where a scene lies for the other programs, and for Isophote under each convention."""

    json: Path
    toml: dict[str, Path]


def write_scene(folder: Path, name: str, scene: Scene) -> SceneFiles:
    folder.mkdir(parents=True, exist_ok=True)
    files = SceneFiles(folder / f"{name}.json", {c: folder / f"{name}.{c}.toml" for c in ("lab", "lambert")})
    files.json.write_text(scene.to_json())
    for convention, path in files.toml.items():
        path.write_text(scene.to_toml(convention))
    return files
