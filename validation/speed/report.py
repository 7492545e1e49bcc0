"""The tables, as people read them."""

from statistics import median

from cases import Case
from cold import JOBS, OURS, Result
from contestants import BASELINES, Contestant
from warm import Entry

# A run that was ended early has cases without times.
NOT_MEASURED = "not measured in this run"

Warm = dict[str, dict[str, Entry]]


def duration(seconds: float) -> str:
    """Three digits, in the unit that suits them."""
    for unit, size in (("s", 1.0), ("ms", 1e-3)):
        if seconds >= size or unit == "ms":
            number = seconds / size
            break
    digits = 2 if number < 10 else 1 if number < 100 else 0
    return f"{number:.{3 if number < 1 else digits}f} {unit}"


def ratio(number: float) -> str:
    return f"{number:.2g}" if number < 10 else f"{number:.0f}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def baselines(contestants: list[Contestant]) -> list[Contestant]:
    """Those of the baselines that take part."""
    by_name = {contestant.name: contestant for contestant in contestants}
    return [by_name[name] for name in BASELINES if name in by_name]


def warm_table(contestants: list[Contestant], cases: list[Case], warm: Warm) -> str:
    """Medians, and in brackets how many times ours they are: the median of the ratios of turns that followed each other."""
    head = ["program", "how", "formula", *(case.title for case in cases)]
    rows = []
    for contestant in contestants:
        cells = [_cell(contestant, contestants, warm[case.name]) for case in cases]
        rows.append([contestant.title, contestant.how, str(contestant.formula), *cells])
    return table(head, rows)


def _cell(contestant: Contestant, contestants: list[Contestant], entries: dict[str, Entry]) -> str:
    entry = entries[contestant.name]
    if entry.reason or not entry.turns:
        return entry.reason or NOT_MEASURED
    ratios = []
    for baseline in baselines(contestants):
        rounds = [theirs / ours for theirs, ours in zip(entry.medians, entries[baseline.name].medians)]
        ratios.append(f"×{ratio(median(rounds))}" if rounds else "–")
    return f"{duration(entry.median)} ({' / '.join(ratios)})"


def best_table(contestants: list[Contestant], cases: list[Case], warm: Warm) -> str:
    """The shortest time of all: what is left when nothing else disturbs."""
    head = ["program", "how", *(case.title for case in cases)]
    rows = []
    for contestant in contestants:
        entries = [warm[case.name][contestant.name] for case in cases]
        cells = [duration(entry.best) if entry.best and not entry.reason else "–" for entry in entries]
        rows.append([contestant.title, contestant.how, *cells])
    return table(head, rows)


def agreement_table(contestants: list[Contestant], cases: list[Case], warm: Warm) -> str:
    """How far everybody's values were from ours before they were timed."""
    rows = []
    for contestant in contestants:
        entries = [warm[case.name][contestant.name] for case in cases]
        found = [f"{entry.disagreement:.1e}" if entry.disagreement is not None else "–" for entry in entries]
        rows.append([contestant.title, contestant.how, f"{contestant.tolerance:.0e}", *found])
    return table(["program", "how", "allowed", *(case.name for case in cases)], rows)


def cold_table(cold: dict[str, dict[str, Result]]) -> str:
    head = ["program", "formula", *(job.title for job in JOBS)]
    if not cold:
        return NOT_MEASURED
    programs = {name: result for results in cold.values() for name, result in results.items()}
    rows = []
    for name, program in programs.items():
        cells = [_cold_cell(name, cold.get(job.case), job.suffix) for job in JOBS]
        rows.append([program.title, program.formula, *cells])
    return table(head, rows)


def _cold_cell(name: str, results: dict[str, Result] | None, suffix: str) -> str:
    if not results:
        return NOT_MEASURED
    result, ours = results[name], results[OURS]
    if result.reason or not result.seconds:
        return result.reason or NOT_MEASURED
    cell = duration(result.median)
    if ours.median:
        cell += f" (×{ratio(result.median / ours.median)})"
    return cell if result.suffix == suffix else f"{cell}, writes .{result.suffix}"


def ceilings_table(ceilings: dict) -> str:
    level, gflops, stores = ceilings["level"], ceilings["gflops"], ceilings["store_gb_per_s"]
    rows = [
        [f"FMAs in single precision ({level})", *(f"{gflops['f32'][t]:.0f} GFLOP/s" for t in "12")],
        [f"FMAs in double precision ({level})", *(f"{gflops['f64'][t]:.0f} GFLOP/s" for t in "12")],
        ["plain stores, a 3840×2160 frame of 32 bits", *(f"{stores[t]:.1f} GB/s" for t in "12")],
    ]
    return table(["ceiling", "1 thread", "2 threads"], rows)


def shares_table(shares: list[tuple[Contestant, float, float]]) -> str:
    rows = [[c.title, c.how, f"{rate:.1f} GFLOP/s", f"{share:.1%}"] for c, rate, share in shares]
    return table(["renderer", "how", "reaches", "of the ceiling"], rows)
