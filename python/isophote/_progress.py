"""How far long work has got."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Progress = bool | Callable[[int, int], Any] | None
"""Called with what is done and with all there is, in between and at the end; ``True`` for a bar by tqdm, if it is there."""


@contextmanager
def reporter(progress: Progress, what: str) -> Iterator[Callable[[int, int], Any] | None]:
    """The function to call, if one is wanted."""
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
