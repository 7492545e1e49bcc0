"""Measures Isophote beside what people use instead, in one run, and writes docs/speed.md. `make compare` starts it."""

import argparse
import datetime
import json
import os
import string
import subprocess
import sys
from dataclasses import asdict, fields
from pathlib import Path

import ceilings
import cold
import environment
import machine
import other_scenes
import report
import warm
from cases import Case, all_cases
from participants import Effort, Participants

HERE = Path(__file__).parent
ROOT = HERE.parent.parent
# Flags of the dist profile, as Cargo.toml has them; nothing is compiled for this processor alone.
OUR_FLAGS = "dist profile: optimisation level 3, thin LTO, 1 codegen unit, baseline instruction set of the target"


def main() -> None:
    arguments = parse_arguments()
    surroundings = environment.prepare(arguments.scratch)
    binaries = build()
    participants = Participants(surroundings, binaries / "examples")
    raw = arguments.scratch / "results.json"
    try:
        if not arguments.page_only:
            cases = [case for case in all_cases() if not arguments.case or case.name in arguments.case]
            measure(participants, cases, binaries, Effort(arguments.rounds, arguments.limit), raw)
    finally:
        participants.close()
    results = read(raw)
    if missing := [case.name for case in all_cases() if case.name not in results["warm"]]:
        print(f"{raw} lacks {', '.join(missing)}: docs/speed.md stays as it is", file=sys.stderr)
        return
    former = arguments.output.read_text() if arguments.output.exists() else ""
    text = page(participants, all_cases(), results, other_scenes.section_of(former))
    arguments.output.write_text(text)
    print(f"wrote {arguments.output}; every single time is in {raw}", file=sys.stderr)


def read(raw: Path) -> dict:
    """The results as they were measured."""
    results = json.loads(raw.read_text())
    for kind, entry in (("warm", warm.Entry), ("cold", cold.Result)):
        for by_name in results[kind].values():
            by_name.update({name: _restored(entry, found) for name, found in by_name.items()})
    return results


def _restored(entry: type, found: dict):
    return entry(**{field.name: found[field.name] for field in fields(entry)})


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--scratch", type=Path, default=ROOT / "target" / "compare", help="folder for everything else")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "speed.md", help="the page to write")
    names = [case.name for case in all_cases()]
    parser.add_argument("--case", action="append", choices=names, help="measure this case only; may be repeated")
    parser.add_argument("--rounds", type=int, default=9, help="turns that everybody has in a case (9)")
    parser.add_argument("--limit", type=float, default=90.0, help="seconds that one answer may take (90)")
    parser.add_argument("--page-only", action="store_true", help="write the page from the results that are there")
    arguments = parser.parse_args()
    arguments.scratch = arguments.scratch.resolve()
    return arguments


def build() -> Path:
    """Builds our side and says where it is."""
    cargo = os.environ.get("CARGO", "cargo")
    parts = ["--workspace", "--examples", "--bin", "isophote"]
    subprocess.run([cargo, "build", "--profile", "dist", "--quiet", *parts], cwd=ROOT, check=True)
    metadata = [cargo, "metadata", "--no-deps", "--format-version", "1"]
    described = subprocess.run(metadata, cwd=ROOT, capture_output=True, text=True, check=True)
    return Path(json.loads(described.stdout)["target_directory"]) / "dist"


def measure(participants: Participants, cases: list[Case], binaries: Path, effort: Effort, raw: Path) -> None:
    """Everything, in one run; what is there so far lies in the file `raw` after every step. The ceilings come first and
    last: what else the machine does may change in between."""
    start = datetime.datetime.now(datetime.UTC)
    rates = [ceilings.measure(binaries / "examples")]
    results = {
        "date": start.date().isoformat(),
        "rounds": effort.rounds,
        "load": {"start": machine.load()},
        "machine": machine.description(),
        "versions": {"rustc": machine.rustc().removeprefix("rustc "), **participants.environment.versions()},
        "missing": participants.environment.missing,
        "warm": {},
        "cold": {},
    }

    def save() -> None:
        results["minutes"] = (datetime.datetime.now(datetime.UTC) - start).total_seconds() / 60
        results["load"]["end"] = machine.load()
        results["ceilings"] = ceilings.best_of(rates)
        raw.write_text(json.dumps(results, default=asdict, indent=1))

    for case in cases:
        print(case.title, file=sys.stderr)
        results["warm"][case.name] = warm.measure(participants, case, effort)
        save()
    for job in cold.JOBS:
        for case in (case for case in cases if case.name == job.case):
            print(f"cold: {job.title}", file=sys.stderr)
            results["cold"][case.name] = cold.measure(participants, binaries / "isophote", job, case, effort)
            save()
    rates.append(ceilings.measure(binaries / "examples"))
    save()


def page(participants: Participants, cases: list[Case], results: dict, others: str) -> str:
    """The template, filled in; the section about other scenes stays as it was measured."""
    contestants, measured = participants.contestants, results["warm"]
    by_name = {case.name: case for case in cases}
    one_light = [case for case in cases if len(case.scene.lights) == 1]
    many_lights = [case for case in cases if len(case.scene.lights) > 1]
    filled = by_name[ceilings.CASE]
    shares = ceilings.shares(participants, filled, measured[filled.name], results["ceilings"])
    return string.Template((HERE / "template.md").read_text()).substitute(
        date=results["date"],
        rounds=results["rounds"],
        minutes=f"{results['minutes']:.0f}",
        load=f"{results['load']['start']:.1f} at the start, {results['load']['end']:.1f} at the end",
        **results["machine"],
        flags=OUR_FLAGS,
        versions=", ".join(f"{name} {version}" for name, version in results["versions"].items()),
        missing="; ".join(f"{name} ({why})" for name, why in results["missing"].items()) or "nothing",
        baselines=" / ".join(contestant.how for contestant in report.baselines(contestants)),
        one_light=report.warm_table(contestants, one_light, measured),
        many_lights=report.warm_table(contestants, many_lights, measured),
        best=report.best_table(contestants, cases, measured),
        cold=report.cold_table(results["cold"]),
        other_scenes=others,
        ceilings=report.ceilings_table(results["ceilings"]),
        flops=ceilings.FLOPS_PER_PIXEL_AND_LIGHT,
        shares=report.shares_table(shares),
        agreement=report.agreement_table(contestants, cases, measured),
    )


if __name__ == "__main__":
    main()
