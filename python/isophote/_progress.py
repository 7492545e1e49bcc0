"""Progress of long-running work."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Progress = bool | Callable[[int, int], Any] | None
"""Called with the work done and the total, repeatedly and at the end; ``True`` for a tqdm bar, if tqdm is installed."""


@contextmanager
def reporter(progress: Progress, what: str) -> Iterator[Callable[[int, int], Any] | None]:
    """The progress function to call, or ``None``."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        with tqdm(unit=what, unit_scale=True) as bar:

            def show(done: int, total: int) -> None:
                bar.total = total
                bar.update(done - bar.n)

            yield show
    elif callable(progress):
        yield progress
    else:
        raise TypeError(f"progress is {progress!r}; allowed: a function of two numbers, True, None")
