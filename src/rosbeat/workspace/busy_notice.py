"""Say what a cell is waiting for, in a notebook that is open in a browser.

What is said stands in the cell's output only while it is true, and is gone afterwards. Where pages
are built, tested or graded, and in every other program, nothing is said.
"""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar, copy_context
from html import escape
from threading import Event, Thread
from typing import Any
from uuid import uuid4

from IPython.display import display, update_display

from rosbeat.workspace.location import STEADY

#: Seconds after which something takes long.
LONG = 2.0
_LOOK = 1.0
_STYLE = "color:var(--jp-content-font-color2, #616161);white-space:pre-wrap"
_step: ContextVar[Callable[[str], None] | None] = ContextVar("rosbeat_step", default=None)


def in_a_browser() -> bool:
    """Return whether a notebook in a browser runs this cell: it sends the cell's id."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    parent: Mapping[str, Any] = getattr(shell, "get_parent", dict)() or {}
    return bool((parent.get("metadata") or {}).get("cellId")) and not os.environ.get(STEADY)


class Note:
    """Hold one remark in the output of the cell that runs; a second one takes its place."""

    def __init__(self) -> None:
        self._display_id = f"rosbeat-note-{uuid4().hex}"
        self._is_live = in_a_browser()
        self._said: str | None = None

    def say(self, text: str) -> None:
        """Show a remark.

        Args:
            text: One line or more.
        """
        if not self._is_live or text == self._said:
            return
        show = display if self._said is None else update_display
        self._said = text
        page = f'<div role="status" style="{_STYLE}">{escape(text)}</div>' if text else ""
        show({"text/html": page, "text/plain": text}, raw=True, display_id=self._display_id)

    def clear(self) -> None:
        """Take the remark away."""
        if self._said:
            self.say("")


def step(text: str) -> None:
    """Say what a `counting` block does now; without one, nothing happens.

    Args:
        text: A few words, such as `building the package`.
    """
    add = _step.get()
    if add is not None:
        add(text)


@contextmanager
def counting(what: str) -> Iterator[None]:
    """Say what the block does and count the seconds, once it takes long.

    Args:
        what: A few words, such as `checking exercise 03a`.
    """
    if not in_a_browser():
        yield
        return
    steps, ended, note = [what], Event(), Note()
    began = time.monotonic()

    def count() -> None:
        pause = LONG
        while not ended.wait(pause):
            pause = _LOOK
            seconds = time.monotonic() - began
            *done, now = list(steps)
            rows = [f"\N{CHECK MARK} {one}" for one in done]
            note.say("\n".join([*rows, f"\N{HORIZONTAL ELLIPSIS} {now}, {seconds:.0f} s"]))

    reset = _step.set(steps.append)
    # What is displayed in a thread belongs to the cell of its context.
    thread = Thread(target=copy_context().run, args=(count,), name="rosbeat waiting", daemon=True)
    try:
        thread.start()
        yield
    finally:
        ended.set()
        _step.reset(reset)
        thread.join()
        note.clear()
