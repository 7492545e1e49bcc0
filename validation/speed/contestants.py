"""Who takes part: our renderers and the programs that people use instead."""

import re
from dataclasses import dataclass
from enum import Enum


class Formula(Enum):
    """What a program computes. Its value is the convention by which our own reference values are computed."""

    LAB = "lab"
    LAMBERT = "lambert"

    def __str__(self) -> str:
        return {Formula.LAB: "(3.3)", Formula.LAMBERT: "(3.2), Lambert"}[self]


class Agreement(Enum):
    """In what sense a program must agree with us before it is timed."""

    PIXEL = "largest difference at a pixel, in units of the peak"
    MEAN = "difference of the means"


@dataclass(frozen=True)
class Contestant:
    """A program as the tables have it."""

    name: str
    title: str
    formula: Formula
    how: str
    tolerance: float
    packages: tuple[str, ...] = ()
    # With more than one light it draws lights at random, so that only its means can agree.
    is_random_with_many_lights: bool = False
    has_square_pixels_only: bool = False
    takes_part_in_cold: bool = True
    is_ours: bool = False
    is_command: bool = False


LAB, LAMBERT = Formula.LAB, Formula.LAMBERT
NUMBA = ("numpy", "numba")
# Single precision, where the tangent of a highlight's slope is about n, and positions have 24 bits.
SINGLE = 1e-4

PEERS = [
    Contestant("numpy", "NumPy, vectorised", LAB, "double, 1 thread", 1e-12, ("numpy",)),
    Contestant("numba-expert", "Numba, as an expert writes it", LAB, "double, 2 threads, general n", 1e-12, NUMBA),
    Contestant("numba-tuned-double", "Numba, tuned", LAB, "double, 2 threads, n = 20 compiled in", 1e-12, NUMBA),
    Contestant("numba-tuned-single", "Numba, tuned", LAB, "single, 2 threads, n = 20 compiled in", SINGLE, NUMBA),
    Contestant(
        "numba-tuned-single-reuse", "Numba, tuned", LAB, "single, 2 threads, n = 20 compiled in, memory reused", SINGLE,
        NUMBA, takes_part_in_cold=False,
    ),
    Contestant("drjit-double", "Dr.Jit", LAB, "double, 2 threads, frozen kernel", 1e-12, ("numpy", "drjit", "libllvm19")),
    Contestant(
        "mitsuba-llvm-blinn", "Mitsuba, `llvm_ad_mono`, our BSDF", LAB, "single, 2 threads", SINGLE,
        ("numpy", "mitsuba", "libllvm19"), has_square_pixels_only=True,
    ),
    Contestant(
        "mitsuba-llvm-lambert", "Mitsuba, `llvm_ad_mono`, `diffuse`", LAMBERT, "single, 2 threads", SINGLE,
        ("numpy", "mitsuba", "libllvm19"), has_square_pixels_only=True,
    ),
    Contestant(
        "mitsuba-scalar-lambert", "Mitsuba, `scalar_rgb`, `diffuse`", LAMBERT, "single, 2 threads", SINGLE,
        ("numpy", "mitsuba"), is_random_with_many_lights=True, has_square_pixels_only=True,
    ),
    Contestant(
        "radiance-1", "Radiance, `rtrace -n 1`, BRTDfunc", LAB, "double inside, 1 process", 1e-5, ("numpy", "pyradiance"),
        is_command=True,
    ),
    Contestant(
        "radiance-2", "Radiance, `rtrace -n 2`, BRTDfunc", LAB, "double inside, 2 processes", 1e-5, ("numpy", "pyradiance"),
        is_command=True,
    ),
    Contestant(
        "povray-lambert", "POV-Ray", LAMBERT, "double inside, 16-bit file, 2 threads", 1e-3, ("numpy", "povray"),
        is_command=True,
    ),
]  # fmt: skip

# What the ratios of the tables are counted in: the first of these that takes part.
BASELINES = ("isophote-single-2", "isophote-double-2")
# Whose values the others are held to: the renderer that the project's tests hold to 32 digits.
REFERENCE = "isophote-double-2"

# The bounds of the table of tolerances that our renderers keep, as seen at the pixels that are compared here.
OUR_TOLERANCES = {"double": 1e-12, "single": 1e-5}


def ours(name: str) -> Contestant:
    """One of our own renderers, from a name that `speed_worker --list` prints: isophote-PRECISION-THREADS[-reuse]."""
    match = re.fullmatch(r"isophote-(double|single)-(\d+)(-reuse)?", name)
    if not match:
        raise ValueError(f'renderer "{name}": must be called isophote-PRECISION-THREADS, with -reuse or without')
    precision, threads, reuse = match.groups()
    how = f"{precision}, {threads} thread{'s' if threads != '1' else ''}{', memory reused' if reuse else ''}"
    return Contestant(
        name, "**Isophote**", LAB, how, OUR_TOLERANCES[precision], takes_part_in_cold=False, is_ours=True
    )  # fmt: skip
