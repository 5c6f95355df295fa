"""Let widgets of exercises act in the kernel: between cells, in the main thread.

A click comes in the main thread or, from ipykernel 7 on, in a thread of its own (a subshell). A
check needs the main thread, where Python runs signal handlers, and it is not to run in the middle
of a cell. So an action waits in the kernel's event loop until the cell that runs has ended.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from functools import partial
from io import StringIO
from signal import SIGINT, default_int_handler, signal
from threading import current_thread, main_thread
from typing import Any

from IPython import get_ipython
from IPython.display import display

from rosbeat.errors import RosbeatError
from rosbeat.exercises.cards import OPEN, framed, words

#: What a click leads to: HTML to show beside the widget.
Action = Callable[[], str]


def run_between_cells(action: Callable[[], None]) -> None:
    """Run an action in the main thread, once no cell runs; at once in the main thread.

    Args:
        action: What to run; it must not raise.
    """
    if current_thread() is main_thread():
        action()
    else:
        get_ipython().kernel.io_loop.add_callback(partial(_with_interrupt, action))


def _with_interrupt(action: Callable[[], None]) -> None:
    """Let Interrupt end an action as it ends a cell; between cells, a kernel passes it over."""
    before = signal(SIGINT, default_int_handler)
    try:
        action()
    finally:
        signal(SIGINT, before)


def told(action: Action) -> str:
    """Run an action and return what it says, or its error, as HTML.

    Args:
        action: What a click leads to. What it prints has no cell, and is dropped.
    """
    try:
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            return action()
    except RosbeatError as error:
        return framed(OPEN, words(error.what, "strong"), words(error.means), words(error.to_try))
    except KeyboardInterrupt:
        return framed(OPEN, words("You stopped it.", "strong"))
    except Exception as error:  # such as a NameError, for an answer that is gone
        said = f"{type(error).__name__}: {error}"
        return framed(
            OPEN,
            words(said, "strong"),
            words("Run the cell above again, and then the one with the check."),
        )


def show(widget: Any) -> None:  # noqa: ANN401 - ipywidgets carries no types
    """Display a widget; in files there is nothing in its place.

    Args:
        widget: The widget.
    """
    view = {"version_major": 2, "version_minor": 0, "model_id": widget.model_id}
    shown = {"application/vnd.jupyter.widget-view+json": view, "text/plain": ""}
    display(shown, raw=True)
