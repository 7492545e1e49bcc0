"""Times the program on scenes of other shapes than spheres: meshes, a thousand solids, a plane with ten shapes.

    python3 validation/speed/any_scene.py [--rounds 5] [PROGRAM ...]

Each time is that of a whole run, from process start to the finished file. Maps have 1920×1080 pixels, shadows, one light or 16;
antialiased ones 800×600, those with occluded ambient light (64 directions) 320×240. Grids have 400×400 points, surfaces 720×360
cells, both with 16 lights. Programs take turns, so several builds can be compared; without one, `target/release/isophote` is
timed.
"""

import argparse
import math
import random
import statistics
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
FOLDER = ROOT / "target" / "any-scene"
HEAD = """version = 1
length = "m"
convention = "radiance"
shadows = true

[camera]
eye = [0, 0, 3.2]
target = [0, 0, 0]
screen = { distance = 1, x = [-0.4, 0.4], y = [-0.225, 0.225] }
resolution = [1920, 1080]

[material.a]
diffuse = 0.6
specular = 0.3
shininess = 20
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5, help="how often every scene is rendered (default: 5)")
    parser.add_argument("programs", nargs="*", type=Path, default=[ROOT / "target" / "release" / "isophote"])
    arguments = parser.parse_args()
    programs = [program.resolve() for program in arguments.programs]
    for label, task in tasks().items():
        times: dict[Path, list[float]] = {program: [] for program in programs}
        for _ in range(arguments.rounds):
            for program in programs:
                times[program].append(time_of(program, task))
        medians = "  ".join(f"{statistics.median(each):6.3f}" for each in times.values())
        print(f"{label:28} {medians} s", flush=True)


def time_of(program: Path, task: list[str]) -> float:
    """Seconds of one run."""
    start = time.perf_counter()
    subprocess.run([program, *task, "-o", "map.npy"], cwd=FOLDER, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def tasks() -> dict[str, list[str]]:
    """The arguments of each run."""
    all_tasks = {scene.stem: ["render", scene.name, "--quiet"] for scene in write_scenes()}
    for name in ("mesh-100000", "plane-and-ten"):
        arguments = ["render", f"{name}-1.toml", "--quiet", "--size", "800x600", "--tolerance", "0.01"]
        all_tasks[f"{name}-antialiased"] = arguments
    for name in ("mesh-100000", "thousand-solids"):
        scene = with_part(f"{name}-1", "sky", "[ambient]\nradiance = 1\nobstructed = true\nsamples = 64\n")
        all_tasks[f"{name}-ambient"] = ["render", scene, "--quiet", "--size", "320x240"]
    grid = 'name = "g"\ncorner = [-1, -0.05, -1]\nu = [2, 0, 0]\nv = [0, 0, 2]\npoints = [400, 400]\nside = "back"\n'
    all_tasks["thousand-solids-grid"] = ["grid", with_part("thousand-solids-16", "grid", f"[[grid]]\n{grid}")]
    sphere = 'name = "s"\ncenter = [0, 0, 0]\nradius = 0.9\nmaterial = "a"\n'
    surface = with_part("thousand-solids-16", "surface", f"[[sphere]]\n{sphere}")
    all_tasks["thousand-solids-surface"] = ["surface", surface, "--shape", "s", "--size", "720x360"]
    return all_tasks


def with_part(scene: str, name: str, text: str) -> str:
    """The file name of a scene with something more."""
    path = FOLDER / f"{scene}-{name}.toml"
    path.write_text((FOLDER / f"{scene}.toml").read_text() + "\n" + text)
    return path.name


def write_scenes() -> list[Path]:
    """The scenes, each with one light and with 16."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    bumpy_ball(FOLDER / "flat.obj", is_smooth=False)
    bumpy_ball(FOLDER / "smooth.obj", is_smooth=True)
    shapes = {
        "mesh-100000": '[[mesh]]\nfile = "flat.obj"\nmaterial = "a"\n',
        "smooth-mesh-100000": '[[mesh]]\nfile = "smooth.obj"\nmaterial = "a"\n',
        "thousand-solids": thousand_solids(),
        "plane-and-ten": plane_and_ten(),
    }
    scenes = []
    for name, text in shapes.items():
        for count in (1, 16):
            scene = FOLDER / f"{name}-{count}.toml"
            scene.write_text(HEAD + lights(count) + text)
            scenes.append(scene)
    return scenes


def lights(count: int) -> str:
    draw = random.Random(1)
    places = [(draw.uniform(-4, 4), draw.uniform(-1, 4), draw.uniform(2, 5)) for _ in range(count)]
    return "".join(f"\n[[light]]\nposition = {point(place)}\nintensity = 20\n" for place in places)


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


def thousand_solids() -> str:
    """Boxes and cylinders in turn."""
    draw = random.Random(2)
    text = ""
    for number in range(1000):
        x, y, z = draw.uniform(-1.4, 1.4), draw.uniform(-0.8, 0.8), draw.uniform(-2, 0)
        if number % 2:
            size = [draw.uniform(0.05, 0.2) for _ in range(3)]
            text += f'\n[[box]]\ncenter = {point((x, y, z))}\nsize = {point(size)}\nmaterial = "a"\n'
        else:
            end = (x + draw.uniform(-0.1, 0.1), y + 0.1, z)
            text += f'\n[[cylinder]]\nfrom = {point((x, y, z))}\nto = {point(end)}\nradius = 0.05\nmaterial = "a"\n'
    return text


def plane_and_ten() -> str:
    """Spheres, boxes, cylinders and ellipsoids over a plane."""
    draw = random.Random(3)
    text = '\n[[plane]]\npoint = [0, -0.6, 0]\nnormal = [0, 1, 0]\nmaterial = "a"\n'
    for number in range(10):
        x, y, z = draw.uniform(-1, 1), draw.uniform(-0.4, 0.3), draw.uniform(-1, 0.5)
        place = point((x, y, z))
        text += (
            f"\n[[sphere]]\ncenter = {place}\nradius = 0.2\n",
            f"\n[[box]]\ncenter = {place}\nsize = [0.3, 0.2, 0.3]\n",
            f"\n[[cylinder]]\nfrom = {place}\nto = {point((x, y + 0.3, z))}\nradius = 0.15\n",
            f"\n[[ellipsoid]]\ncenter = {place}\nradii = [0.2, 0.1, 0.3]\n",
        )[number % 4] + 'material = "a"\n'
    return text


def point(coordinates) -> str:
    return "[" + ", ".join(f"{coordinate:.4f}" for coordinate in coordinates) + "]"


if __name__ == "__main__":
    main()
