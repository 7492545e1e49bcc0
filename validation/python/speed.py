"""Measures the Python package, in one run: what a call costs beside the work itself, loading, many points, sweeps on one
thread and on two, and those beside a loop as an expert writes it with Numba. `make bench-python` starts it, with the package
as `pip install .` makes it. Medians of rounds in which everything has its turn."""

import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import isophote as iso
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "speed" / "workers"))
import numba_worker

ROUNDS = 15
MAPS = 1000


def main() -> None:
    lab = iso.scenes.lab()
    print(f"isophote {iso.__version__}, Python {sys.version.split()[0]}, NumPy {np.__version__}; medians of {ROUNDS} rounds")
    loading()
    calls(lab)
    points(lab)
    sweeps(lab)


def medians(jobs: dict[str, Callable[[], object]], rounds: int = ROUNDS) -> dict[str, float]:
    """The median time of each job, in seconds."""
    times: dict[str, list[float]] = {name: [] for name in jobs}
    for job in jobs.values():
        job()
    names = list(jobs)
    for round_ in range(rounds):
        # Each is first once: who comes first may find memory that the machine has to get back.
        shift = round_ % len(names)
        for name in names[shift:] + names[:shift]:
            job = jobs[name]
            start = time.perf_counter()
            job()
            times[name].append(time.perf_counter() - start)
    return {name: statistics.median(of) for name, of in times.items()}


def loading() -> None:
    """Each in a process of its own, which measures the import alone."""
    times: dict[str, list[float]] = {"import numpy": [], "import isophote": [], "import isophote; isophote.scenes.lab()": []}
    for _ in range(ROUNDS):
        for statement, of in times.items():
            program = f"import time; start = time.perf_counter(); {statement}; print(time.perf_counter() - start)"
            of.append(float(subprocess.run([sys.executable, "-c", program], capture_output=True, check=True).stdout))
    numpy, package, scene = (1e3 * statistics.median(of) for of in times.values())
    print(
        f"import isophote        {package:8.1f} ms; with a first scene {scene:.1f} ms, of which NumPy alone {numpy:.1f} ms"
    )


def calls(lab: iso.Scene) -> None:
    """A map of one pixel is hardly any work: what it takes is what a call costs."""

    def many(count: int, call: Callable[[], object]) -> Callable[[], None]:
        def calls() -> None:
            for _ in range(count):
                call()

        return calls

    found = medians(
        {
            "one pixel": many(500, lambda: iso.render(lab, region=(0, 0, 1, 1))),
            "lab": many(20, lambda: iso.render(lab)),
            "single": many(20, lambda: iso.render(lab, precision="single")),
        }
    )
    print(f"a call without work    {1e6 * found['one pixel'] / 500:8.1f} µs (a map of one pixel)")
    print(f"lab, 800×600, double   {1e3 * found['lab'] / 20:8.3f} ms; single {1e3 * found['single'] / 20:.3f} ms")


def points(lab: iso.Scene) -> None:
    directions = np.random.default_rng(0).normal(size=(1_000_000, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    places = directions + [0, 0, 5]
    material = lab.materials["clay"]
    found = medians(
        {
            "probe": lambda: iso.probe(lab, at=places),
            "formula": lambda: iso.brightness(directions, places, lab.lights, material, "lab"),
        }
    )
    print(f"a million probes       {1e3 * found['probe']:8.1f} ms; the bare formula {1e3 * found['formula']:.1f} ms")


def sweeps(lab: iso.Scene) -> None:
    angles = np.linspace(0, 2 * np.pi, MAPS, endpoint=False)
    positions = np.stack([5 * np.cos(angles), 5 * np.sin(angles), np.full(MAPS, -10.0)], axis=1)
    values = {"light.lamp.position": positions}
    material, sphere, screen = lab.materials["clay"], lab.shapes[0], lab.camera.screen

    def numba() -> None:
        for position in positions:
            lights = np.array([[*position, lab.lights[0].intensity]])
            numba_worker.render(
                800, 600, screen.x[1], screen.y[1], screen.distance, tuple(sphere.center), sphere.radius,
                material.diffuse, material.specular, material.shininess, lights,
            )  # fmt: skip

    scenes = [lab.set({"light.lamp.position": position}) for position in positions]

    def dropped(precision: str, workers: int) -> None:
        """The same maps, none of which is kept: what they take without the memory for all of them."""
        with ThreadPoolExecutor(workers) as pool:
            for _ in pool.map(
                lambda part: [iso.render(one, precision=precision, threads=1).shape for one in part],
                [scenes[start::workers] for start in range(workers)],
            ):
                pass

    jobs: dict[str, Callable[[], object]] = {
        f"{precision} {workers}": lambda precision=precision, workers=workers: iso.sweep(
            lab, values, precision=precision, workers=workers
        )
        for precision in ("double", "single")
        for workers in (2,)
    }
    dropping: dict[str, Callable[[], object]] = {
        f"{precision} {workers} dropped": lambda precision=precision, workers=workers: dropped(precision, workers)
        for precision in ("double", "single")
        for workers in (1, 2)
    }
    found = medians({**jobs, **dropping, "numba": numba}, rounds=5)
    print(f"{MAPS} lab maps, ms a map; an expert's loop with Numba, double, maps dropped: {1e3 * found['numba'] / MAPS:.3f}")
    for precision in ("double", "single"):
        one, two = (1e3 * found[f"{precision} {workers} dropped"] / MAPS for workers in (1, 2))
        ratios = f"{one / two:.2f}× on two threads; {1e3 * found['numba'] / MAPS / two:.1f}× the loop"
        kept = 1e3 * found[f"{precision} 2"] / MAPS
        print(
            f"  {precision}: maps dropped, one thread {one:.3f}, two {two:.3f}: {ratios}; a sweep that keeps all {kept:.3f}"
        )


if __name__ == "__main__":
    main()
