"""Measures how the cost grows with spheres and samples; writes docs/growth.md and its plot. `make growth` starts it."""

import argparse
import datetime
import json
import os
import statistics
import string
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
SCRATCH = ROOT / "target" / "growth"
PLOT = ROOT / "docs" / "images" / "growth.svg"
SAMPLES = {"one": "render 800×600, lanes, double", "tolerance": "samples 800×600/tolerance 0.01",
           "sixteen": "samples 800×600/16 everywhere"}


@dataclass(frozen=True)
class Case:
    """What the bench `clouds` renders."""

    spheres: int
    radius: float
    lights: int
    threads: int
    precision: str


@dataclass(frozen=True)
class Cost:
    """Medians over the rounds; the memory is the most of them."""

    read: float
    build: float
    render: float
    peak: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=3, help="how often every cloud is measured (default: 3)")
    rounds = parser.parse_args().rounds
    costs = clouds(rounds)
    samples = {name: median_of_criterion(bench) for name, bench in SAMPLES.items()}
    plot(growth_of(costs, same_radius=False), growth_of(costs, same_radius=True))
    page = string.Template((HERE / "template.md").read_text())
    (ROOT / "docs" / "growth.md").write_text(page.substitute(words(costs, samples, rounds)))


def clouds(rounds: int) -> dict[Case, Cost]:
    """Every cloud's cost."""
    seen: dict[Case, list[list[float]]] = {}
    for _ in range(rounds):
        for fields in (line.split() for line in bench("clouds").splitlines()):
            if len(fields) != 9 or not fields[0].isdigit():
                continue
            case = Case(int(fields[0]), float(fields[1]), int(fields[2]), int(fields[3]), fields[4])
            seen.setdefault(case, []).append([float(field) for field in fields[5:]])
    return {
        case: Cost(*(statistics.median(column) for column in columns[:3]), max(columns[3]))
        for case, columns in ((case, list(zip(*found))) for case, found in seen.items())
    }


def median_of_criterion(name: str) -> float:
    """A median of the bench `stages`, in ms."""
    bench("stages", name)
    estimates = ROOT / "target" / "criterion" / name / "new" / "estimates.json"
    return json.loads(estimates.read_text())["median"]["point_estimate"] / 1e6


def bench(name: str, *wanted: str) -> str:
    command = ["cargo", "bench", "--quiet", "-p", "isophote", "--bench", name, "--", *wanted]
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def growth_of(costs: dict[Case, Cost], *, same_radius: bool) -> dict[Case, Cost]:
    """The clouds under one light on two threads: those of one radius, or those that fill the same part of the box."""
    def belongs(case: Case) -> bool:
        radius = 0.02 if same_radius else 0.02 * (100_000 / case.spheres) ** (1 / 3)
        plain = (case.lights, case.threads, case.precision) == (1, 2, "single")
        return plain and abs(case.radius - radius) < 1e-4
    return {case: cost for case, cost in sorted(costs.items(), key=lambda item: item[0].spheres) if belongs(case)}


def words(costs: dict[Case, Cost], samples: dict[str, float], rounds: int) -> dict[str, str]:
    """What the template asks for."""
    dense, even = growth_of(costs, same_radius=True), growth_of(costs, same_radius=False)
    row = "| {:,} | {:.4f} | {} | {} | {} | {:.0f} |"
    rows = [
        row.format(case.spheres, case.radius, number(cost.read), number(cost.build), number(cost.render), cost.peak)
        for case, cost in even.items()
    ]
    first, *_, last = even.values()
    ways = {
        "one_thread": Case(100_000, 0.02, 1, 1, "single"),
        "double": Case(100_000, 0.02, 1, 2, "double"),
        "lights": Case(100_000, 0.02, 16, 2, "single"),
    }
    return {
        "date": datetime.date.today().strftime("%-d %B %Y"),
        "machine": machine(),
        "rounds": str(rounds),
        "rows": "\n".join(rows),
        "growth": f"{last.render / first.render:.1f}",
        "counts": " | ".join(f"{case.spheres:,}" for case in dense),
        "rules": "|".join("---:" for _ in dense),
        "dense": " | ".join(number(cost.render) for cost in dense.values()),
        **{name: number(costs[case].render) for name, case in ways.items()},
        **{name: number(time) for name, time in samples.items()},
    }


def number(value: float) -> str:
    """Two digits, or all before the point."""
    return f"{value:.0f}" if value >= 10 else f"{value:.2g}"


def machine() -> str:
    names = [line.split(":")[1] for line in Path("/proc/cpuinfo").read_text().splitlines() if line.startswith("model name")]
    return f"{os.cpu_count()} cores of {names[0].strip() if names else 'an unnamed processor'}"


def plot(even: dict[Case, Cost], dense: dict[Case, Cost]) -> None:
    """Draws both curves in an environment of its own."""
    python = SCRATCH / "python" / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", SCRATCH / "python"], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "matplotlib"], check=True)
    curves = {
        "the same part of the box": [[case.spheres, cost.render] for case, cost in even.items()],
        "radius 0.02 m": [[case.spheres, cost.render] for case, cost in dense.items()],
    }
    subprocess.run([python, HERE / "plot.py", PLOT], input=json.dumps(curves), text=True, check=True)


if __name__ == "__main__":
    main()
