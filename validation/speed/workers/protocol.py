"""How a worker talks: one JSON request a line, one JSON answer a line, as our own `speed_worker` does."""

import json
import os
import sys
import time
from typing import Any, Protocol

# What takes longer than this needs no warming up by a render that is not timed.
LONG_SECONDS = 1.0


class Contestant(Protocol):
    """Another program, brought to the point where all that is left is to compute an image."""

    def load(self, scene: dict[str, Any]) -> None:
        """Takes a scene in: whatever can be done before an image is asked for."""

    def render(self) -> Any:
        """Computes the image, to the end: nothing may be left to be done lazily."""

    def brightness(self, image: Any) -> Any:
        """The image as rows from the top, each from the left, in the unit of our own maps."""


class InProcess(Contestant, Protocol):
    """A library of Python."""

    def save(self, image: Any, path: str) -> None:
        """Writes the image to a file, in the format that is usual for the program."""


class Command(Contestant, Protocol):
    """A program of its own."""

    def command(self, image: str) -> str:
        """The shell command that makes the image from the scene's files, all in the folder that it says first."""


def serve(contestant: Contestant) -> None:
    # Programs write to standard output as they like; the answers need it for themselves.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    last = 0.0
    for line in sys.stdin:
        try:
            request = json.loads(line)
            match request["do"]:
                case "load":
                    with open(request["scene"]) as file:
                        contestant.load(json.load(file))
                    last, answer = 0.0, {"loaded": sys.argv[1]}
                case "time":
                    seconds = _time(contestant, request["seconds"], warm_up=last < LONG_SECONDS)
                    last, answer = seconds[-1], {"seconds": seconds}
                case "command":
                    answer = {"command": contestant.command(request["image"])}
                case "values":
                    image, last = _timed(contestant)
                    rows = contestant.brightness(image)
                    answer = {"values": [float(rows[row][column]) for column, row in request["pixels"]]}
        except Exception as error:  # whatever goes wrong in a foreign program is an entry of the table
            answer = {"error": f"{type(error).__name__}: {error}"}
        print(json.dumps(answer), file=answers, flush=True)


def _time(contestant: Contestant, least: float, warm_up: bool) -> list[float]:
    if warm_up:
        contestant.render()
    start = time.perf_counter()
    seconds: list[float] = []
    while not seconds or time.perf_counter() - start < least:
        # The image of one turn is freed before the next begins, as in our own worker.
        seconds.append(_timed(contestant)[1])
    return seconds


def _timed(contestant: Contestant) -> tuple[Any, float]:
    start = time.perf_counter()
    image = contestant.render()
    return image, time.perf_counter() - start
