"""Times the program on scenes of other shapes than spheres: meshes, a thousand solids, a plane with ten shapes.

    python3 validation/speed/any_scene.py [--rounds 5] [PROGRAM ...]

Each time is that of a whole run, from process start to the finished file. Maps have 1920×1080 pixels, shadows, one light or 16;
antialiased ones 800×600, those with occluded ambient light (64 directions) 320×240. Grids have 400×400 points, surfaces 720×360
cells, both with 16 lights. Programs take turns, so several builds can be compared; without one, `target/release/isophote` is
timed.
"""

import argparse
import statistics
import subprocess
import time
from pathlib import Path

from shapes import write_scenes

ROOT = Path(__file__).parent.parent.parent
FOLDER = ROOT / "target" / "any-scene"


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
    all_tasks = {scene.name: ["render", scene.toml.name, "--quiet"] for scene in write_scenes(FOLDER)}
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


if __name__ == "__main__":
    main()
