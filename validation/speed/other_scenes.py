"""Times Isophote beside other programs on the scenes of `any_scene.py`: the section "Other scenes" of docs/speed.md.

    python3 validation/speed/other_scenes.py [--rounds 3] [--limit 20] [--scene NAME ...] [PROGRAM]

PROGRAM is `target/dist/isophote` unless named; its renders alone are timed by the `examples/speed_worker` beside it, where
there is one. In every round everybody has a turn: a whole run, from process start to the finished file, and, of programs that
can stay in memory, renders alone for a tenth of a second (one at least), after one that does not count. Whoever takes longer
than `--limit` seconds is left out of that scene. Every time is in `target/compare/other-scenes.json`.
"""

import argparse
import datetime
import json
import math
import re
import subprocess
import sys
import textwrap
import time
from dataclasses import asdict, dataclass, field
from pathlib import Path
from statistics import mean, median

import environment
import machine
from processes import Unavailable, Worker, timed
from report import duration, ratio, table
from shapes import RESOLUTION, SceneFiles, write_scenes

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
TURN_SECONDS = 0.1
# The section, and the one that follows it.
HEADING, LATER = "## Other scenes\n", "## Hardware limits\n"
# A value counts as different when it is off by more than this part of the largest.
DIFFERENT = 0.01
# How many of the pixels may be different: those at the edges of shapes and of the shadow of each light. Facets of a mesh
# with smooth normals shade their neighbours where light grazes them, and every program has its own way to deal with that.
ALLOWED, ALLOWED_SMOOTH = 0.01, 0.1
ALLOWED_MEAN = 0.01


@dataclass(frozen=True)
class Program:
    """Another program: the name that `worker.py` knows, and what the tables say."""

    name: str
    title: str
    how: str
    packages: tuple[str, ...]
    suffix: str = ""  # of the file that it writes; Embree's bare rays write none
    is_command: bool = False
    picks_lights: bool = False  # at random, when there are several


MITSUBA = ("numpy", "mitsuba", "libllvm19")
EMBREE = ("numpy", "trimesh", "embreex")
PROGRAMS = [
    Program("scene-mitsuba-script", "Mitsuba, primary and shadow rays by a Dr.Jit script", "LLVM, single", MITSUBA, "exr"),
    Program("scene-mitsuba-direct", "Mitsuba, `direct`", "LLVM, single", MITSUBA, "exr", picks_lights=True),
    Program("scene-mitsuba-scalar", "Mitsuba, `direct`", "scalar, single", MITSUBA[:2], "exr", picks_lights=True),
    Program("scene-embree-primary", "Embree, bare primary rays", "single, 1 thread", EMBREE),
    Program("scene-embree-shadow", "Embree, bare shadow rays", "single, 1 thread", EMBREE),
    Program("scene-trimesh", "trimesh with Embree, shading by NumPy", "1 thread", EMBREE, "npy"),
    Program("scene-povray", "POV-Ray", "double inside, 2 threads", ("numpy", "povray"), "exr", is_command=True),
    Program(
        "scene-radiance-1", "Radiance, `rtrace`", "double inside, 1 process", ("numpy", "pyradiance"), "hdr",
        is_command=True,
    ),
]  # fmt: skip


@dataclass
class Times:
    """What came of a program in a scene."""

    whole: list[float] = field(default_factory=list)
    render: list[float] = field(default_factory=list)
    disagreement: float | None = None
    reason: str | None = None


class Isophote:
    def __init__(self, program: Path, surroundings: environment.Environment):
        self.program, self.folder, self.variables = program, surroundings.folder, surroundings.variables()
        worker = program.parent / "examples" / "speed_worker"
        self.worker = Worker([str(worker), "isophote-double-2"], self.variables) if worker.exists() else None

    def run(self, scene: SceneFiles, channel: str = "brightness") -> Path:
        image = self.folder / f"ours-{channel}.npy"
        command = [self.program, "render", scene.toml, "--quiet", "--threads", "2", "-c", channel, "-o", image]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return image

    def values(self, scene: SceneFiles, pixels: list[tuple[int, int]]) -> list[float]:
        """The diffuse part alone: nobody else has our highlight."""
        data = self.run(scene, "diffuse").read_bytes()
        # Ten bytes that end with the length of the header, the header, the numbers, and a description of the map.
        start = 10 + int.from_bytes(data[8:10], "little")
        numbers = memoryview(data[start : start + 8 * math.prod(RESOLUTION)]).cast("d")
        return [numbers[row * RESOLUTION[0] + column] for column, row in pixels]


class Comparison:
    """A scene with the programs that take part in it, each with its process."""

    def __init__(self, surroundings: environment.Environment, isophote: Isophote, scene: SceneFiles, limit: float):
        self.surroundings, self.isophote, self.scene, self.limit = surroundings, isophote, scene, limit
        self.times = {"isophote": Times(), **{program.name: Times() for program in PROGRAMS}}
        self.workers: dict[str, Worker] = {}

    def measure(self, rounds: int) -> dict[str, Times]:
        lattice = [(c, r) for r in range(2, RESOLUTION[1], 5) for c in range(2, RESOLUTION[0], 5)]
        expected = self.isophote.values(self.scene, lattice)
        if self.isophote.worker:
            self.isophote.worker.ask(self.limit, do="load", scene=str(self.scene.toml))
        for program in PROGRAMS:
            self._attempt(program, lambda program=program: self._check(program, lattice, expected))
        for number in range(rounds):
            self._our_turn()
            for program in PROGRAMS:
                self._attempt(program, lambda program=program: self._turn(program))
            print(f"  round {number + 1}, load {machine.load():.1f}", file=sys.stderr)
        for worker in self.workers.values():
            if worker.is_alive():
                worker.close()
        return self.times

    def _attempt(self, program: Program, action) -> None:
        times = self.times[program.name]
        if times.reason is None:
            try:
                action()
            except Unavailable as why:
                times.reason = str(why)
                print(f"  {program.name}: {why}", file=sys.stderr)

    def _check(self, program: Program, lattice: list[tuple[int, int]], expected: list[float]) -> None:
        """Only the same picture is timed."""
        for package in program.packages:
            if reason := self.surroundings.missing.get(package):
                raise Unavailable(f"not available: {package}: {reason}")
        worker = self.workers[program.name] = Worker(self._command(program), self.surroundings.variables())
        worker.ask(60, do="load", scene=str(self.scene.json))
        # The first time kernels may have to be compiled.
        found = worker.ask(self.limit + (0 if program.is_command else 60), do="values", pixels=lattice)["values"]
        if program.picks_lights and self.scene.lights > 1:
            disagreement, allowed = abs(mean(found) / mean(expected) - 1), ALLOWED_MEAN
        else:
            largest = max(expected)
            disagreement = mean(abs(a - b) > DIFFERENT * largest for a, b in zip(found, expected))
            allowed = ALLOWED_SMOOTH if self.scene.name.startswith("smooth") else ALLOWED
        self.times[program.name].disagreement = disagreement
        if not disagreement <= allowed:
            raise Unavailable(f"another picture: {disagreement:.2g} differ")
        print(f"  {program.name}: differs in {disagreement:.2g}", file=sys.stderr)

    def _command(self, program: Program) -> list[str]:
        return [str(self.surroundings.python), str(HERE / "workers" / "worker.py"), program.name]

    def _our_turn(self) -> None:
        times, start = self.times["isophote"], time.perf_counter()
        self.isophote.run(self.scene)
        times.whole.append(time.perf_counter() - start)
        if self.isophote.worker:
            self._render_alone(self.isophote.worker, times)

    def _turn(self, program: Program) -> None:
        worker, times = self.workers[program.name], self.times[program.name]
        if program.is_command:
            command = worker.ask(self.limit, do="command", image=f"whole.{program.suffix}")["command"]
            self._whole(["sh", "-c", command], times)
            return
        if program.suffix:
            image = self.surroundings.folder / f"whole.{program.suffix}"
            self._whole([*self._command(program), str(self.scene.json), str(image)], times)
        self._render_alone(worker, times)

    def _render_alone(self, worker: Worker, times: Times) -> None:
        times.render.append(median(worker.ask(3 * self.limit, do="time", seconds=TURN_SECONDS)["seconds"]))

    def _whole(self, command: list[str], times: Times) -> None:
        seconds, said = timed(command, self.surroundings.variables(), self.limit)
        times.whole.append(seconds)
        if found := re.search(r"Trace Time:.*?(?:\(([\d.]+) seconds\)|(\d+) microseconds)", said):
            times.render.append(float(found[1]) if found[1] else int(found[2]) / 1e6)


def main() -> None:
    arguments = parse_arguments()
    surroundings = environment.prepare(ROOT / "target" / "compare")
    raw = surroundings.folder / "other-scenes.json"
    scenes = [scene for scene in write_scenes(surroundings.folder / "other-scenes") if chosen(scene, arguments.scene)]
    if not arguments.page_only:
        isophote = Isophote(arguments.program.resolve(), surroundings)
        results = {"date": datetime.datetime.now(datetime.UTC).date().isoformat(), "load": [machine.load()], "times": {}}
        for scene in scenes:
            print(scene.name, file=sys.stderr)
            times = Comparison(surroundings, isophote, scene, arguments.limit).measure(arguments.rounds)
            results["times"][scene.name] = {name: asdict(each) for name, each in times.items()}
            results["load"].append(machine.load())
            raw.write_text(json.dumps({**results, "rounds": arguments.rounds, "limit": arguments.limit}, indent=1))
    results = json.loads(raw.read_text())
    if any(scene.name not in results["times"] for scene in scenes):
        sys.exit(f"{raw} lacks scenes: docs/speed.md stays as it is")
    if arguments.scene:
        print(section(scenes, results, surroundings))
    else:
        arguments.output.write_text(with_section(arguments.output.read_text(), section(scenes, results, surroundings)))


def chosen(scene: SceneFiles, names: list[str] | None) -> bool:
    return not names or scene.name in names


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3, help="turns that everybody has in a scene (3)")
    parser.add_argument("--limit", type=float, default=20.0, help="seconds that a run may take (20)")
    parser.add_argument("--scene", action="append", help="measure this scene only, as mesh-100000-16, and print the tables")
    parser.add_argument("--page-only", action="store_true", help="write the section from the results that are there")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "speed.md", help="the page that has the section")
    parser.add_argument("program", nargs="?", type=Path, default=ROOT / "target" / "dist" / "isophote")
    return parser.parse_args()


def section(scenes: list[SceneFiles], results: dict, surroundings: environment.Environment) -> str:
    """The text of the section."""
    found = {scene.name: {name: Times(**each) for name, each in results["times"][scene.name].items()} for scene in scenes}
    head = ["program", "how", *(f"{scene.title}, {_lights(scene)}" for scene in scenes)]
    ours = ("isophote", "**Isophote**", "double, 2 threads")
    everybody = [ours, *((program.name, program.title, program.how) for program in PROGRAMS)]

    def rows(cell) -> str:
        lines = [[title, how, *(cell(found[s.name], name) for s in scenes)] for name, title, how in everybody]
        return table(head, [line for line in lines if any(part != "–" for part in line[2:])])

    load = results["load"]
    versions = {name: version for name, version in surroundings.versions().items() if name in _packages()}
    missing = "; ".join(f"{name} ({why})" for name, why in surroundings.missing.items() if name in _packages())
    return (HERE / "other_scenes.md").read_text().format(
        date=results["date"],
        **machine.description(),
        load=f"{load[0]:.1f} at the start, {load[-1]:.1f} at the end",
        versions=", ".join(f"{name} {version}" for name, version in versions.items()),
        missing=missing or "nothing",
        rounds=results["rounds"],
        limit=f"{results['limit']:.0f}",
        verdict=verdict(scenes, found),
        whole=rows(lambda times, name: _cell(times, name, "whole")),
        render=rows(lambda times, name: _cell(times, name, "render")),
        agreement=rows(_agreement),
    ).rstrip()  # fmt: skip


def verdict(scenes: list[SceneFiles], found: dict[str, dict[str, Times]]) -> str:
    """Where somebody is faster than we are, in a sentence for each kind of time."""
    sentences = []
    for kind, name in (("whole", "From start to file"), ("render", "In the render alone")):
        faster = {}
        for program in (program for program in PROGRAMS if program.suffix):
            ratios = [_ratio(found[scene.name], program.name, kind) for scene in scenes]
            times = [1 / each for each in ratios if each is not None and each < 1]
            if times:
                faster[program] = (len(times), sum(each is not None for each in ratios), min(times), max(times))
        if not any(_ratio(found[scene.name], program.name, kind) for scene in scenes for program in PROGRAMS):
            continue
        parts = [
            f"{program.title} ({program.how}) in {count} of {all_count} scenes, "
            + (f"{ratio(low)} times" if ratio(low) == ratio(high) else f"{ratio(low)} to {ratio(high)} times")
            for program, (count, all_count, low, high) in faster.items()
        ]
        sentence = f"{name}, faster than Isophote: {'; '.join(parts) or 'none'}."
        sentences.append(textwrap.fill(sentence, 128, break_long_words=False, break_on_hyphens=False))
    return "\n\n".join(sentences)


def _packages() -> set[str]:
    return {package for program in PROGRAMS for package in program.packages}


def _lights(scene: SceneFiles) -> str:
    return "1 light" if scene.lights == 1 else f"{scene.lights} lights"


def _ratio(times: dict[str, Times], name: str, kind: str) -> float | None:
    """The median of the ratios within a round."""
    theirs, ours = getattr(times[name], kind), getattr(times["isophote"], kind)
    if times[name].reason or not theirs or not ours:
        return None
    return median(a / b for a, b in zip(theirs, ours))


def _cell(times: dict[str, Times], name: str, kind: str) -> str:
    seconds = getattr(times[name], kind)
    if (reason := times[name].reason) and reason.startswith("skipped"):
        return reason.removeprefix("skipped: ")
    if reason or not seconds:
        return "–"
    against = _ratio(times, name, kind)
    return duration(median(seconds)) + (f" (×{ratio(against)})" if against else "")


def _agreement(times: dict[str, Times], name: str) -> str:
    found = times[name].disagreement
    return "–" if found is None else f"{found:.2%}"


def with_section(page: str, text: str) -> str:
    """The page with this text in the place of the former section, or before the ceilings of the hardware."""
    former = section_of(page)
    return page.replace(former or LATER, text if former else f"{text}\n\n{LATER}", 1)


def section_of(page: str) -> str:
    """The section as the page has it, which another measurement of the rest keeps; nothing if there is none."""
    _, heading, after = page.partition(HEADING)
    return (heading + after.partition(LATER)[0]).rstrip()


if __name__ == "__main__":
    main()
