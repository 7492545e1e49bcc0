"""What the machine can do at most, and which share of it our kernel reaches."""

import json
import subprocess
from pathlib import Path

from cases import Case
from contestants import Contestant
from participants import Participants
from warm import Entry

# Operations on numbers that our kernel does for one isotropic light at one pixel by (3.3) with n = 20, as `light_term` in
# shade.rs has them; sqrt and division count as one each, an FMA as two, a maximum as one:
#   S − P 3, r² 5, r 1, N·(S − P) and its maximum 6, the part of r H across N 12, the part along it 2, the sum of their
#   squares 7, r³ 1, 1/(r³ · sum) 2, 1/sum and 1/r³ from it 2, E_j = I r cosθ_i / r³ 2, sin²θ_h 1, cos²θ_h 1, its 10th
#   power 4, both sums 3.
# The cheapest way that is known to us takes 39 (‖L + V‖² = 2 + 2 L·V), but loses digits where that is small.
FLOPS_PER_PIXEL_AND_LIGHT = 52

# The case with the most arithmetic for each value that is stored.
CASE = "fill-256"


def measure(examples: Path) -> dict:
    """The rates that the example program `ceilings` prints."""
    done = subprocess.run([examples / "ceilings"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def best_of(measured: list[dict]) -> dict:
    """The largest of each rate: a ceiling that another program's work has lowered is none."""
    largest = lambda *keys: max(_at(one, keys) for one in measured)
    return {
        "level": measured[0]["level"],
        "gflops": {p: {t: largest("gflops", p, t) for t in ("1", "2")} for p in ("f32", "f64")},
        "store_gb_per_s": {t: largest("store_gb_per_s", t) for t in ("1", "2")},
    }


def _at(value: dict, keys: tuple[str, ...]) -> float:
    for key in keys:
        value = value[key]
    return value


def shares(
    participants: Participants, case: Case, entries: dict[str, Entry], ceilings: dict
) -> list[tuple[Contestant, float, float]]:
    """For each of our renderers its GFLOP/s in the case, and the share of the ceiling that this is."""
    width, height = case.scene.resolution
    work = FLOPS_PER_PIXEL_AND_LIGHT * width * height * len(case.scene.lights)
    found = []
    for contestant in participants.contestants:
        seconds = entries[contestant.name].median
        if contestant.is_ours and seconds:
            precision, threads = contestant.name.split("-")[1:3]
            ceiling = ceilings["gflops"]["f32" if precision == "single" else "f64"][threads]
            found.append((contestant, work / seconds / 1e9, work / seconds / 1e9 / ceiling))
    return found
