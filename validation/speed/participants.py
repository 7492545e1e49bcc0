"""Everybody who takes part, and the processes in which they do."""

import subprocess
from dataclasses import dataclass
from pathlib import Path

from contestants import PEERS, REFERENCE, Contestant, ours
from environment import Environment
from processes import Unavailable, Worker

WORKERS = Path(__file__).parent / "workers"


@dataclass(frozen=True)
class Effort:
    """How often everybody has a turn, and how many seconds one answer may take."""

    rounds: int
    limit: float


class Participants:
    """Starts the process of a contestant when it is first needed, and again when it had to be ended."""

    def __init__(self, environment: Environment, examples: Path):
        self.environment = environment
        self.folder = environment.folder
        self.speed_worker = examples / "speed_worker"
        listed = subprocess.run([self.speed_worker, "--list"], capture_output=True, text=True, check=True)
        self.contestants: list[Contestant] = [*map(ours, listed.stdout.split()), *PEERS]
        self.reference = Worker([str(self.speed_worker), REFERENCE], environment.variables())
        self._workers: dict[str, Worker] = {}
        self._expected: dict[Path, list[float]] = {}

    def require(self, contestant: Contestant) -> None:
        """Raises when a package that the contestant needs could not be had."""
        for package in contestant.packages:
            if reason := self.environment.missing.get(package):
                raise Unavailable(f"not available: {package}: {reason}")

    def expected(self, scene: Path, pixels: list[tuple[int, int]], limit: float) -> list[float]:
        """Our own values at pixels of a scene; they are computed once."""
        if scene not in self._expected:
            self.reference.ask(limit, do="load", scene=str(scene))
            self._expected[scene] = self.reference.ask(limit, do="values", pixels=pixels)["values"]
        return self._expected[scene]

    def worker(self, contestant: Contestant) -> Worker:
        self.require(contestant)
        worker = self._workers.get(contestant.name)
        if worker is None or not worker.is_alive():
            worker = Worker(self.command(contestant), self.environment.variables())
            self._workers[contestant.name] = worker
        return worker

    def command(self, contestant: Contestant) -> list[str]:
        """The command line of a worker; followed by a scene and an image it makes that one image and ends."""
        if contestant.is_ours:
            return [str(self.speed_worker), contestant.name]
        return [str(self.environment.python), str(WORKERS / "worker.py"), contestant.name]

    def close(self) -> None:
        for worker in [self.reference, *self._workers.values()]:
            if worker.is_alive():
                worker.close()
