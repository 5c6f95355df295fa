"""Show the progress of grading."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TextIO

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)

#: Seconds between two lines where nobody watches a terminal.
_EVERY = 10.0
_STARTING = "preparing sandboxes, trying the first"


@contextmanager
def progress_bar(stream: TextIO | None = None) -> Iterator[Callable[[int, int], None]]:
    """Show a bar with the time that is left; in a log, a line now and then.

    Args:
        stream: Where to; by default the standard error.

    Yields:
        What is told how many answers are judged, of how many; the first time, before anything is
        judged, how many were judged in earlier runs.
    """
    stream = stream or sys.stderr
    if not stream.isatty():
        yield _Lines(stream)
        return
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    with Progress(*columns, TimeRemainingColumn(), console=Console(file=stream)) as shown:
        yield _Bar(shown)


def _announced(known: int, total: int) -> str:
    """Return what there is to do; equal answers are one."""
    earlier = f", {known} of them judged already" if known else ""
    return f"{total} different answer{'' if total == 1 else 's'}{earlier}"


class _Bar:
    """Show a bar, which runs to and fro until the first answer is judged."""

    def __init__(self, shown: Progress) -> None:
        self._shown = shown
        self._task: TaskID | None = None
        self._has_begun = False

    def __call__(self, done: int, total: int) -> None:
        if self._task is None:
            if done < total:
                self._shown.console.print(f"{_announced(done, total)}.", highlight=False)
                self._task = self._shown.add_task(_STARTING, total=None, completed=done)
            return
        if not self._has_begun:  # the time that is left is that of answers, not of preparing
            self._has_begun = True
            self._shown.reset(self._task, total=total, completed=done - 1, description="judging")
        self._shown.update(self._task, completed=done)


class _Lines:
    """Print a line at the beginning, one every few seconds, and one at the end."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._said = 0.0
        #: How many were judged before, and when the first of this run was: what goes before it is
        #: preparing, and says nothing about the time that is left.
        self._known: int | None = None
        self._first = 0.0

    def __call__(self, done: int, total: int) -> None:
        now = time.monotonic()
        if self._known is None:
            self._known, self._said = done, now
            if done < total:
                self._print(f"{_announced(done, total)}; {_STARTING} ...")
            return
        judged = done - self._known
        if judged == 1:
            self._first = now
        if now - self._said < _EVERY and done < total:
            return
        self._said = now
        left = (now - self._first) / (judged - 1) * (total - done) if judged > 1 else 0.0
        self._print(f"{done} of {total} judged" + (f", {left:.0f} s left" if left else ""))

    def _print(self, line: str) -> None:
        print(line, file=self._stream, flush=True)
