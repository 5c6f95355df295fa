"""An interrupted cell says in one line what goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def told(say: Callable[[], str]) -> Iterator[None]:
    """Let an interrupt of the page pass, with one line instead of a stack.

    Args:
        say: Returns the line; called only when there is an interrupt.

    Raises:
        KeyboardInterrupt: If there was one.
    """
    try:
        yield
    except KeyboardInterrupt as interrupt:
        lines = [f"KeyboardInterrupt: {say()}"]
        interrupt._render_traceback_ = lambda: lines  # type: ignore[attr-defined] # IPython's
        raise
