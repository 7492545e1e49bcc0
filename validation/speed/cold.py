"""Cold times: from the start of a process to a file that is written. What programs keep on the disk between two runs, as
compiled kernels, is there already."""

import sys
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

from cases import Case, write_scene
from contestants import Contestant
from participants import Effort, Participants
from processes import Unavailable, timed

OURS = "isophote render"


@dataclass(frozen=True)
class Job:
    """A picture or a file of numbers. Programs that cannot write it write what is usual for them."""

    case: str
    title: str
    suffix: str
    # What a library of Python writes that has no writer for it, and what Radiance writes.
    substitutes: dict[str, str]
    options: tuple[str, ...]


JOBS = [
    Job("lab", "lab scene, 800×600, to PNG", "png", {"radiance": "hdr"}, ()),
    Job(
        "lab-4k", "lab scene, 3840×2160, to EXR", "exr",
        {"radiance": "hdr", "numpy": "npy", "numba": "npy", "drjit": "npy"}, ("-c", "brightness"),
    ),
]  # fmt: skip


@dataclass
class Result:
    """What came of a program: the suffix of what it wrote, its times, or why there are none."""

    title: str
    formula: str
    suffix: str = ""
    seconds: list[float] = field(default_factory=list)
    reason: str | None = None

    @property
    def median(self) -> float | None:
        return median(self.seconds) if self.seconds else None


def measure(participants: Participants, isophote: Path, job: Job, case: Case, effort: Effort) -> dict[str, Result]:
    """Everybody once without the clock, then all in turn."""
    files = write_scene(participants.folder / "scenes", case.name, case.scene)
    ours = Result("**Isophote**, `isophote render`", "(3.3)", job.suffix)
    results, commands = {OURS: ours}, {OURS: _our_command(participants, isophote, job, files.toml["lab"])}
    for contestant in participants.contestants:
        if not contestant.takes_part_in_cold:
            continue
        result = results[contestant.name] = Result(contestant.title, str(contestant.formula))
        result.suffix = job.substitutes.get(contestant.name.split("-")[0], job.suffix)
        try:
            commands[contestant.name] = _command(participants, contestant, case, result.suffix, effort.limit)
        except Unavailable as why:
            result.reason = str(why)
    for turn in range(effort.rounds + 1):
        for name, command in commands.items():
            if results[name].reason is None:
                _run(participants, command, results[name], effort.limit, is_timed=turn > 0)
    for name, result in results.items():
        print(f"  {name}: {result.reason or f'{result.median:.3f} s'}", file=sys.stderr)
    return results


def _our_command(participants: Participants, isophote: Path, job: Job, scene: Path) -> list[str]:
    image = participants.folder / f"cold.{job.suffix}"
    return [str(isophote), "render", "--quiet", str(scene), "-o", str(image), *job.options]


def _command(participants: Participants, contestant: Contestant, case: Case, suffix: str, limit: float) -> list[str]:
    scene, name = case.scene, case.name
    if contestant.has_square_pixels_only:
        scene, name = scene.with_square_pixels(), f"{name}-square"
    json = write_scene(participants.folder / "scenes", name, scene).json
    if contestant.is_command:
        worker = participants.worker(contestant)
        worker.ask(limit, do="load", scene=str(json))
        return ["sh", "-c", worker.ask(limit, do="command", image=f"cold.{suffix}")["command"]]
    participants.require(contestant)
    return [*participants.command(contestant), str(json), str(participants.folder / f"cold.{suffix}")]


def _run(participants: Participants, command: list[str], result: Result, limit: float, is_timed: bool) -> None:
    try:
        seconds, _ = timed(command, participants.environment.variables(), limit)
    except Unavailable as why:
        result.reason = str(why)
        return
    if is_timed:
        result.seconds.append(seconds)
