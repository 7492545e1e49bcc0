"""Warm times: every contestant lives in its own process, and they take turns."""

import sys
from dataclasses import dataclass, field
from statistics import median

from cases import Case, SceneFiles, write_scene
from contestants import Agreement, Contestant
from participants import Participants
from processes import Unavailable

ROUNDS = 9
# A turn renders again and again for so long.
TURN_SECONDS = 0.12
# Whoever needs longer than this for one image gets fewer rounds; whoever needs longer than the limit, none.
LONG_SECONDS, LONG_ROUNDS = 2.0, 3
VERY_LONG_SECONDS, VERY_LONG_ROUNDS = 10.0, 1
LIMIT_SECONDS = 90.0


@dataclass
class Entry:
    """What came of a contestant in a case."""

    disagreement: float | None = None
    turns: list[list[float]] = field(default_factory=list)
    reason: str | None = None

    @property
    def medians(self) -> list[float]:
        """The median of each turn, in the order of the rounds."""
        return [median(turn) for turn in self.turns]

    @property
    def median(self) -> float | None:
        return median(self.medians) if self.turns else None

    @property
    def best(self) -> float | None:
        return min(map(min, self.turns)) if self.turns else None


def measure(participants: Participants, case: Case) -> dict[str, Entry]:
    """Brings the case to everybody, holds their values to ours, then goes round."""
    entries = {contestant.name: Entry() for contestant in participants.contestants}
    rounds = {}
    for contestant in participants.contestants:
        entry = entries[contestant.name]
        try:
            entry.disagreement = _check(participants, contestant, case)
            seconds = _turn(participants, contestant, least=0.0)[-1]
            rounds[contestant.name] = _rounds(seconds)
        except Unavailable as why:
            entry.reason = str(why)
        print(f"  {contestant.name}: {entry.reason or f'agrees within {entry.disagreement:.1e}'}", file=sys.stderr)
    for turn in range(ROUNDS):
        for contestant in participants.contestants:
            entry = entries[contestant.name]
            if entry.reason or turn >= rounds[contestant.name]:
                continue
            try:
                entry.turns.append(_turn(participants, contestant, TURN_SECONDS))
            except Unavailable as why:
                entry.reason = str(why)
    return entries


def _rounds(seconds: float) -> int:
    if seconds > VERY_LONG_SECONDS:
        return VERY_LONG_ROUNDS
    return LONG_ROUNDS if seconds > LONG_SECONDS else ROUNDS


def _turn(participants: Participants, contestant: Contestant, least: float) -> list[float]:
    return participants.worker(contestant).ask(LIMIT_SECONDS, do="time", seconds=least)["seconds"]


def _check(participants: Participants, contestant: Contestant, case: Case) -> float:
    """How far the contestant's values are from ours; one that computes something else is no peer."""
    scene, name = case.scene, case.name
    if contestant.has_square_pixels_only:
        scene, name = scene.with_square_pixels(), f"{name}-square"
    files = write_scene(participants.folder / "scenes", name, scene)
    pixels = scene.pixels_to_check()
    expected = _reference(participants, files, contestant, pixels)
    worker = participants.worker(contestant)
    worker.ask(LIMIT_SECONDS, do="load", scene=str(files.toml["lab"] if contestant.is_ours else files.json))
    values = worker.ask(LIMIT_SECONDS, do="values", pixels=pixels)["values"]

    by_mean = contestant.is_random_with_many_lights and len(scene.lights) > 1
    agreement = Agreement.MEAN if by_mean else Agreement.PIXEL
    allowed = RANDOM_TOLERANCE if by_mean else contestant.tolerance
    found = _disagreement(agreement, values, expected)
    if not found <= allowed:
        raise Unavailable(f"computes something else: {agreement.value} {found:.1e}, allowed {allowed:.1e}")
    return found


# The mean of a thousand pixels with a random light each, whose shares differ by a factor of a few.
RANDOM_TOLERANCE = 0.05


def _reference(participants: Participants, files: SceneFiles, contestant: Contestant, pixels: list[tuple[int, int]]) -> list[float]:
    reference = participants.reference
    reference.ask(LIMIT_SECONDS, do="load", scene=str(files.toml[contestant.formula.value]))
    return reference.ask(LIMIT_SECONDS, do="values", pixels=pixels)["values"]


def _disagreement(agreement: Agreement, values: list[float], expected: list[float]) -> float:
    match agreement:
        case Agreement.PIXEL:
            return max(abs(a - b) for a, b in zip(values, expected, strict=True)) / max(expected)
        case Agreement.MEAN:
            return abs(sum(values) / sum(expected) - 1)
