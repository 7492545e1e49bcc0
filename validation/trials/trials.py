#!/usr/bin/env python3
"""Tries the program as an attacker and as bad luck would: mutated files, kills, signals, full disks, files that are meant to
take long. `make trials`; about ten minutes. Every trial either ends with a known exit code and a message, or is a failure that is
printed with its seed and kept under the folder that is named at the end.

    trials.py PROGRAM [--seed N] [--count N] [TRIAL …]
"""

from __future__ import annotations

import argparse
import json
import os
import random
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Fine, failed, wrong arguments, invalid scene, interrupted.
KNOWN = {0, 1, 2, 3, 130}
# A file system and a computer are shared with others; what hangs takes much longer.
PATIENCE = 60.0
MEMORY = 4 << 30

LAB = (ROOT / "scenes" / "lab.toml").read_text()
STORE = "render lab.toml --size 400x300 --shard-side 20 -c brightness -c shape --quiet"


class Trials:
    """Runs the program and counts."""

    def __init__(self, program: Path, seed: int, count: int) -> None:
        self.program, self.count = program, count
        self.random = random.Random(seed)
        self.folder = Path(tempfile.mkdtemp(prefix="isophote-trials-"))
        self.runs = 0
        self.failures: list[str] = []

    def start(self, arguments: str | list[str], folder: Path, limits: Callable[[], None] | None = None) -> subprocess.Popen[bytes]:
        words = arguments.split() if isinstance(arguments, str) else arguments
        self.runs += 1
        return subprocess.Popen(
            [str(self.program), *words],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            preexec_fn=limits,
        )

    def run(self, arguments: str | list[str], folder: Path, limits: Callable[[], None] | None = None) -> tuple[int, str]:
        """The exit code and what was said; a failure if it is not one of those that the program has."""
        child = self.start(arguments, folder, limits or memory_limit)
        try:
            output, said = child.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            self.fail(folder, f"{arguments}: still running after {PATIENCE:.0f} s")
            return -1, ""
        text = (output + said).decode(errors="replace")
        if child.returncode not in KNOWN or "panicked" in text:
            self.fail(folder, f"{arguments}: exit code {child.returncode}: {text[-300:]}")
        return child.returncode, text

    def fail(self, folder: Path, what: str) -> None:
        kept = self.folder / f"failure{len(self.failures)}"
        shutil.copytree(folder, kept)
        self.failures.append(f"{what} (kept in {kept})")
        print(f"  FAILED {self.failures[-1]}", flush=True)

    def place(self) -> Path:
        """An empty folder with the lab's scene."""
        folder = self.folder / "here"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (folder / "lab.toml").write_text(LAB)
        return folder

    def mutated(self, content: bytes) -> bytes:
        """Some bytes changed, removed, repeated, or replaced by what is likely to be a boundary case."""
        pieces = [b"nan", b"-inf", b"1e308", b"-1", b"99999999999", b"[", b"]", b"\x00", b"\xff", b'"', b"\n", b"", b"{}", b"[[", b"#"]
        changed = bytearray(content)
        for _ in range(self.random.randint(1, 4)):
            start = self.random.randrange(len(changed) + 1)
            end = min(len(changed), start + self.random.choice([0, 1, 2, 8, 64]))
            piece = self.random.choice([*pieces, bytes(changed[start:end]) * 3, bytes([self.random.randrange(256)])])
            changed[start:end] = piece
        return bytes(changed)


def memory_limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def scenes(trials: Trials) -> None:
    """Mutated scene files: used, or refused with words."""
    texts = [path.read_bytes() for path in sorted((ROOT / "scenes").glob("*.toml")) if b"file =" not in path.read_bytes()]
    folder = trials.place()
    for _ in range(trials.count):
        (folder / "scene.toml").write_bytes(trials.mutated(trials.random.choice(texts)))
        trials.run("render scene.toml --size 8x6 --samples 1 -o map.npy --quiet", folder)


def meshes(trials: Trials) -> None:
    """Mutated meshes and clouds."""
    folder = trials.place()
    obj = (ROOT / "scenes" / "meshes" / "vase.obj").read_bytes()[:6000]
    cloud = next((ROOT / "scenes" / "points").iterdir())
    files = [("m.obj", obj), ("m.stl", stl([(1.0, 0.0, 0.0)] * 30)), ("m.ply", PLY), (f"p{cloud.suffix}", cloud.read_bytes())]
    head = LAB.split("[[sphere]]")[0] + "[[light]]\nposition = [5, 5, -10]\nintensity = 100\n"
    for _ in range(trials.count):
        name, content = trials.random.choice(files)
        (folder / name).write_bytes(trials.mutated(content))
        table = "spheres" if name.startswith("p") else "mesh"
        (folder / "scene.toml").write_text(f'{head}\n[[{table}]]\nfile = "{name}"\nmaterial = "clay"\n')
        trials.run("render scene.toml --size 8x6 -o map.npy --quiet", folder)


PLY = b"""ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 2
property list uchar int vertex_indices
end_header
0 0 4
1 0 4
0 1 4
1 1 5
3 0 1 2
3 1 3 2
"""


def stl(corners: list[tuple[float, float, float]]) -> bytes:
    """A binary STL whose triangles have these first corners."""
    facets = [struct.pack("<12fH", 0, 0, 0, *corner, 0, 1, 4, 1, 0, 5, 0) for corner in corners]
    return bytes(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def outputs(trials: Trials) -> None:
    """Outputs with mutated metadata, shown and rendered again."""
    folder = trials.place()
    names = ["map.png", "map.exr", "map.npy", "map.npz", "map.csv"]
    trials.run(["render", "lab.toml", "--size", "8x6", *(word for name in names for word in ("-o", name))], folder)
    trials.run("render lab.toml --size 8x6 -o map.zarr", folder)
    contents = {name: (folder / name).read_bytes() for name in names}
    group = (folder / "map.zarr" / "zarr.json").read_bytes()
    for _ in range(trials.count):
        name = trials.random.choice([*names, "map.zarr"])
        if name == "map.zarr":
            odd = trials.random.choice([b"[]", b'"x"', b"1", b'{"attributes":[]}', None, None, None, None])
            (folder / name / "zarr.json").write_bytes(odd if odd is not None else trials.mutated(group))
            trials.run("merge map.zarr", folder)
        else:
            (folder / name).write_bytes(trials.mutated(contents[name]))
        trials.run(f"show {name}", folder)
        trials.run(f"render {name} --size 4x3 -o again.npy --quiet", folder)


def arguments(trials: Trials) -> None:
    """Arguments put together at random."""
    words = "render probe section surface grid merge check new show lab.toml -o x.png x.csv x.zarr --size 4x3 0x0 --at 0,0,4 nan,0,0 "
    words += "--row 1 --line -1,0,1,0 --samples 2 --json --explain --region 0,0,2,2 --shard 1/2 --resume --memory 64M -c depth color "
    words += "--lights --figure x.svg --range 1,0 0,1 --gamma 0 2 --bits 16 --threads 1 --quiet --colormap viridis"
    known = words.split()
    for _ in range(trials.count):
        folder = trials.place()
        trials.run([trials.random.choice(known) for _ in range(trials.random.randint(1, 8))], folder)


def tree(folder: Path) -> dict[str, bytes]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def kills(trials: Trials) -> None:
    """A store that is killed at random moments resumes to the same bytes."""
    folder = trials.place()
    since = time.monotonic()
    trials.run(f"{STORE} -o whole.zarr", folder)
    duration = time.monotonic() - since
    whole = tree(folder / "whole.zarr")
    for number in range(max(1, trials.count // 10)):
        name = f"killed{number}.zarr"
        child = trials.start(f"{STORE} -o {name}", folder)
        time.sleep(trials.random.random() * duration)
        child.kill()
        child.communicate()
        trials.run(f"{STORE} -o {name} --resume", folder)
        if tree(folder / name) != whole:
            trials.fail(folder, f"{name} is not the whole store")
        shutil.rmtree(folder / name)


def signals(trials: Trials) -> None:
    """SIGINT and SIGTERM at random moments: it ends soon, and leaves complete files alone or none."""
    jobs = ["render lab.toml --size 3000x2000 -o map.exr -o map.csv --figure map.svg", f"{STORE} -o map.zarr", "section lab.toml --row 9"]
    for number in range(max(1, trials.count // 5)):
        folder = trials.place()
        child = trials.start(trials.random.choice(jobs), folder)
        time.sleep(trials.random.random() * 2.0)
        since = time.monotonic()
        child.send_signal(signal.SIGINT if number % 2 else signal.SIGTERM)
        try:
            _, said = child.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            trials.fail(folder, f"{child.args}: still running {PATIENCE:.0f} s after a signal")
            continue
        took = time.monotonic() - since
        # Before the handler is there, the signal itself ends the program.
        if child.returncode not in {0, 130, -signal.SIGINT, -signal.SIGTERM}:
            trials.fail(folder, f"{child.args}: exit code {child.returncode} after a signal: {said.decode(errors='replace')}")
        # A second for the program, and some for a busy computer.
        if took > 5.0:
            trials.fail(folder, f"{child.args}: {took:.1f} s after a signal")
        if any(path.name.endswith(".part") for path in folder.iterdir()):
            trials.fail(folder, f"{child.args}: something half-written was left")


def full_disks(trials: Trials) -> None:
    """Files may not grow beyond a random size: an error with the name of the file, and the old content stays."""
    jobs = ["render lab.toml --size 200x150 -o map.SUFFIX --quiet", f"{STORE} -o map.zarr"]
    for _ in range(max(1, trials.count // 5)):
        folder = trials.place()
        job = trials.random.choice(jobs).replace("SUFFIX", trials.random.choice(["png", "exr", "npy", "npz", "csv"]))
        most = int(10 ** trials.random.uniform(1, 6))

        def limits(most: int = most) -> None:
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

        code, said = trials.run(job, folder, limits)
        if code not in {0, 1} or (code == 1 and "cannot write" not in said):
            trials.fail(folder, f"{job} with files of {most} bytes: exit code {code}: {said[-300:]}")
        if job.startswith(STORE):
            trials.run(f"{job} --resume", folder)


def bounds(trials: Trials) -> None:
    """Files that are meant to take long or much: each ends with a message, or is used, within the patience of a user."""
    folder = trials.place()
    head = LAB.split("[[sphere]]")[0] + "[[light]]\nposition = [5, 5, -10]\nintensity = 100\n"
    mesh = head + '[[mesh]]\nfile = "FILE"\nmaterial = "clay"\n'
    sphere = "[[sphere]]\ncenter = [0, 0, 5]\nradius = 1\nmaterial = \"clay\"\n"
    files: dict[str, bytes | str] = {
        "equals.toml": "=\n" * 2_000_000,
        "deep.toml": "x = " + "[" * 100,
        "line.json": "{" + ", ".join(f'"k{number}": 1' for number in range(300_000)) + "}",
        "many.toml": head + "".join(
            f"[[sphere]]\ncenter = [{index % 300}, {index // 300}, 900]\nradius = 0.3\nmaterial = \"clay\"\n" for index in range(100_000)
        ) + "".join(f"[[light]]\nposition = [{index % 300}.5, {index // 300}, 0]\nintensity = 1\n" for index in range(99_999)),
        "properties.ply": "ply\nformat ascii 1.0\nelement vertex 1\n" + "".join(f"property float p{n}\n" for n in range(100_000)) + "end_header\n",
        "elements.ply": "ply\nformat ascii 1.0\n" + "".join(f"element e{n} 0\n" for n in range(100_000)) + "end_header\n",
        "colliding.stl": stl([(struct.unpack("<f", struct.pack("<I", 0x3F800000 + (n << 8)))[0], 0.0, 4.0) for n in range(60_000)]),
        "properties.toml": mesh.replace("FILE", "properties.ply"),
        "elements.toml": mesh.replace("FILE", "elements.ply"),
        "colliding.toml": mesh.replace("FILE", "colliding.stl"),
        "coincident.toml": head + sphere * 2000,
        "title.toml": LAB.replace('title = "', 'title = "' + "x" * 1_000_000),
    }
    for name, content in files.items():
        (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
    for name in files:
        if name.endswith((".toml", ".json")):
            trials.run(f"check {name} --quiet", folder)
    trials.run("render coincident.toml --size 64x48 -o map.npy --quiet", folder)
    trials.run("render lab.toml --size 16384x8192 -o map.npz", folder)
    trials.run("render lab.toml --size 8x6 -o map.zarr", folder)
    group = json.loads((folder / "map.zarr" / "zarr.json").read_text())
    for key in ("isophote", "isophote_plan"):
        group["attributes"][key]["full"] = {"width": 4_000_000_000, "height": 4_000_000_000}
    (folder / "map.zarr" / "zarr.json").write_text(json.dumps(group))
    trials.run("merge map.zarr", folder)


TRIALS = [scenes, meshes, outputs, arguments, kills, signals, full_disks, bounds]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--count", type=int, default=300, help="mutations of each kind; kills and signals are fewer")
    parser.add_argument("trials", nargs="*", metavar="TRIAL", help=", ".join(trial.__name__ for trial in TRIALS))
    arguments = parser.parse_args()
    chosen = [trial for trial in TRIALS if not arguments.trials or trial.__name__ in arguments.trials]
    trials = Trials(arguments.program.resolve(), arguments.seed, arguments.count)
    print(f"seed {arguments.seed}", flush=True)
    for trial in chosen:
        runs, failures, since = trials.runs, len(trials.failures), time.monotonic()
        trial(trials)
        took = time.monotonic() - since
        print(f"{trial.__name__:<12}{trials.runs - runs:>6} runs, {len(trials.failures) - failures} failures, {took:.0f} s", flush=True)
    if trials.failures:
        print(f"{len(trials.failures)} failures; seed {arguments.seed}; see {trials.folder}")
        return 1
    shutil.rmtree(trials.folder)
    print(f"{trials.runs} runs, no failure")
    return 0


if __name__ == "__main__":
    os.environ.pop("NO_COLOR", None)
    sys.exit(main())
