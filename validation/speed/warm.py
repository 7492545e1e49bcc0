"""Warm times: every contestant lives in its own process, and they take turns."""

import math
import sys
from dataclasses import dataclass, field
from statistics import median

from cases import Case, write_scene
from contestants import Agreement, Contestant
from participants import Effort, Participants
from processes import Unavailable

# A turn renders again and again for so long.
TURN_SECONDS = 0.12
# Whoever needs longer than this for one image gets no more rounds than that.
LONG_SECONDS, LONG_ROUNDS = 2.0, 3
VERY_LONG_SECONDS, VERY_LONG_ROUNDS = 10.0, 1


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


def measure(participants: Participants, case: Case, effort: Effort) -> dict[str, Entry]:
    """Brings the case to everybody, holds their values to ours, then goes round."""
    entries = {contestant.name: Entry() for contestant in participants.contestants}
    rounds = {}
    for contestant in participants.contestants:
        entry = entries[contestant.name]
        try:
            entry.disagreement = _check(participants, contestant, case, effort.limit)
            seconds = _turn(participants, contestant, 0.0, effort.limit)[-1]
            rounds[contestant.name] = min(effort.rounds, _most_rounds(seconds))
        except Unavailable as why:
            entry.reason = str(why)
        print(f"  {contestant.name}: {entry.reason or f'agrees within {entry.disagreement:.1e}'}", file=sys.stderr)
    for turn in range(effort.rounds):
        for contestant in participants.contestants:
            entry = entries[contestant.name]
            if entry.reason or turn >= rounds[contestant.name]:
                continue
            try:
                entry.turns.append(_turn(participants, contestant, TURN_SECONDS, effort.limit))
            except Unavailable as why:
                entry.reason = str(why)
    return entries


def _most_rounds(seconds: float) -> float:
    if seconds > VERY_LONG_SECONDS:
        return VERY_LONG_ROUNDS
    return LONG_ROUNDS if seconds > LONG_SECONDS else math.inf


def _turn(participants: Participants, contestant: Contestant, least: float, limit: float) -> list[float]:
    return participants.worker(contestant).ask(limit, do="time", seconds=least)["seconds"]


def _check(participants: Participants, contestant: Contestant, case: Case, limit: float) -> float:
    """How far the contestant's values are from ours; one that computes something else is no peer."""
    scene, name = case.scene, case.name
    if contestant.has_square_pixels_only:
        scene, name = scene.with_square_pixels(), f"{name}-square"
    files = write_scene(participants.folder / "scenes", name, scene)
    pixels = scene.pixels_to_check()
    expected = participants.expected(files.toml[contestant.formula.value], pixels, limit)
    worker = participants.worker(contestant)
    worker.ask(limit, do="load", scene=str(files.toml["lab"] if contestant.is_ours else files.json))
    values = worker.ask(limit, do="values", pixels=pixels)["values"]

    by_mean = contestant.is_random_with_many_lights and len(scene.lights) > 1
    agreement = Agreement.MEAN if by_mean else Agreement.PIXEL
    allowed = RANDOM_TOLERANCE if by_mean else contestant.tolerance
    found = _disagreement(agreement, values, expected)
    if not found <= allowed:
        raise Unavailable(f"computes something else: {agreement.value} {found:.1e}, allowed {allowed:.1e}")
    return found


# The mean of a thousand pixels with a random light each, whose shares differ by a factor of a few.
RANDOM_TOLERANCE = 0.05


def _disagreement(agreement: Agreement, values: list[float], expected: list[float]) -> float:
    match agreement:
        case Agreement.PIXEL:
            return max(abs(a - b) for a, b in zip(values, expected, strict=True)) / max(expected)
        case Agreement.MEAN:
            return abs(sum(values) / sum(expected) - 1)
