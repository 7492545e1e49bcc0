"""Workers: processes that live through the comparison, each with one contestant in it."""

import json
import os
import selectors
import shlex
import signal
import subprocess
import tempfile
import time
from typing import Any


class Unavailable(Exception):
    """A contestant that cannot be measured, with the reason that the table gives."""


class Worker:
    """A process that answers one line of JSON with another."""

    def __init__(self, command: list[str], variables: dict[str, str]):
        self.errors = tempfile.TemporaryFile(mode="w+")
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, env=variables,
            start_new_session=True,
        )  # fmt: skip
        self.said = b""

    def ask(self, within: float, **request: Any) -> dict[str, Any]:
        """Asks for something and waits for so many seconds; a worker that does not answer in time is ended."""
        try:
            self.process.stdin.write(json.dumps(request).encode() + b"\n")
            self.process.stdin.flush()
            answer = json.loads(self._line(within))
        except BrokenPipeError:
            raise Unavailable(self._last_words()) from None
        if "error" in answer:
            raise Unavailable(answer["error"])
        return answer

    def _line(self, within: float) -> bytes:
        with selectors.DefaultSelector() as selector:
            selector.register(self.process.stdout, selectors.EVENT_READ)
            while b"\n" not in self.said:
                if not selector.select(within):
                    end(self.process)
                    raise Unavailable(f"skipped: over {within:.0f} s")
                part = os.read(self.process.stdout.fileno(), 1 << 20)
                if not part:
                    raise Unavailable(self._last_words())
                self.said += part
        line, _, self.said = self.said.partition(b"\n")
        return line

    def _last_words(self) -> str:
        code = self.process.wait()
        self.errors.seek(0)
        lines = self.errors.read().strip().splitlines()
        return f"ended: {lines[-1]}" if lines else f"ended with exit code {code}"

    def is_alive(self) -> bool:
        return self.process.poll() is None

    def close(self) -> None:
        self.process.stdin.close()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            end(self.process)


def timed(command: list[str], variables: dict[str, str], limit: float) -> tuple[float, str]:
    """The seconds that a whole run takes, and what it says to its standard error."""
    start = time.perf_counter()
    process = subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True, env=variables
    )
    try:
        _, said = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        end(process)
        raise Unavailable(f"skipped: over {limit:.0f} s") from None
    seconds = time.perf_counter() - start
    if process.returncode != 0:
        lines = said.strip().splitlines()
        raise Unavailable(f"failed: {lines[-1] if lines else shlex.join(command)}")
    return seconds, said


def end(process: subprocess.Popen) -> None:
    """Ends a process that leads a session of its own, with the programs that it has started: they would go on computing
    and slow down everybody who comes after."""
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
