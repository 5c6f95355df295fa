"""Let widgets of exercises act in the kernel: between cells, in the main thread.

A click comes in the main thread or, from ipykernel 7 on, in a thread of its own (a subshell). A
check needs the main thread, where Python runs signal handlers, and it is not to run in the middle
of a cell. So an action waits in the kernel's event loop until the cell that runs has ended.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import redirect_stderr, redirect_stdout
from functools import partial
from io import StringIO
from pathlib import Path
from signal import SIGINT, default_int_handler, signal
from threading import current_thread, main_thread
from typing import Any

from anywidget import AnyWidget
from IPython import get_ipython
from IPython.display import display
from traitlets import Bool, Int, Unicode

from rosbeat.errors import RosbeatError
from rosbeat.exercises.cards import OPEN, framed, words

_HERE = Path(__file__).parent
#: What a click leads to: it gets what the browser sent, and returns words to show beside the widget
#: or an empty text.
Action = Callable[[Mapping[str, Any]], str]


class ExerciseWidget(AnyWidget):
    """Offer something below an exercise, and carry out what is clicked.

    Args:
        actions: What can be clicked; the browser names it as `do`.
        kind: Which widget it is, `check` or `predict`.
        traits: The other values that the browser gets.
    """

    _esm = Unicode((_HERE / "widgets.js").read_text(encoding="utf-8")).tag(sync=True)
    _css = Unicode((_HERE / "widgets.css").read_text(encoding="utf-8")).tag(sync=True)
    kind = Unicode().tag(sync=True)
    exercise = Unicode().tag(sync=True)
    #: Whether all is done, so that there is nothing more to click.
    passed = Bool().tag(sync=True)
    has_answer = Bool().tag(sync=True)
    #: How a prediction is written.
    form = Unicode().tag(sync=True)
    #: What was said last: HTML for a check, and a text for a prediction.
    said = Unicode().tag(sync=True)
    #: Counts what was carried out, so that the browser knows when a click is done.
    done = Int().tag(sync=True)

    def __init__(self, actions: Mapping[str, Action], kind: str, **traits: object) -> None:
        super().__init__(kind=kind, **traits)
        self._actions = actions
        self.on_msg(lambda _widget, content, _buffers: self._hear(content))

    def close(self) -> None:
        """Close the wire, and the one of the layout that every widget brings along."""
        if self.comm is not None:
            layout = self.layout
            super().close()
            layout.close()

    def show(self) -> None:
        """Display the widget; in files there is nothing in its place."""
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        mime = "application/vnd.jupyter.widget-view+json"
        display({mime: view, "text/plain": ""}, raw=True)

    def _hear(self, content: Mapping[str, Any]) -> None:
        action = self._actions.get(str(content.get("do")))
        if action is not None:
            run_between_cells(lambda: self._carry_out(action, content))

    def _carry_out(self, action: Action, content: Mapping[str, Any]) -> None:
        said = told(lambda: action(content))
        with self.hold_sync():
            self.said = said
            self.done += 1


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


def told(action: Callable[[], str]) -> str:
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
