"""Run the actions of exercise widgets in the kernel, between cells, in the main thread.

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
from traitlets import Bool, Int, List, Unicode

from rosbeat.errors import RosbeatError
from rosbeat.exercises.cells import cells_of
from rosbeat.exercises.outcome_display import OPEN, framed, words

_HERE = Path(__file__).parent
#: What a click leads to: it gets what the browser sent, and returns HTML to show below the buttons.
Action = Callable[[Mapping[str, Any]], str]


class ExerciseWidget(AnyWidget):
    """Offer something below an exercise, and carry out what is clicked.

    Args:
        actions: What can be clicked; the browser names it as `do`.
        kind: Which widget it is: `check`, `predict` or `quiz`.
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
    #: Of each question of a quiz its `id`, the `choices`, and the index of the one that was
    #: `chosen`, or None.
    questions: List[dict[str, Any]] = List().tag(sync=True)
    #: What was said last, as HTML: also for a page that is loaded anew while the kernel lives.
    said = Unicode().tag(sync=True)
    #: Count what was begun and what was carried out, so that the browser knows what it waits for.
    begun = Int().tag(sync=True)
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
        """Display the widget until its cell runs again; in files there is nothing in its place."""
        if (cells := cells_of()) is not None:
            cells.hold(self)
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        mime = "application/vnd.jupyter.widget-view+json"
        display({mime: view, "text/plain": ""}, raw=True)

    def _hear(self, content: Mapping[str, Any]) -> None:
        action = self._actions.get(str(content.get("do")))
        if action is None:
            return
        carry_out = partial(self._carry_out, partial(action, content))
        if current_thread() is main_thread():
            carry_out()
        else:
            get_ipython().kernel.io_loop.add_callback(carry_out)

    def _carry_out(self, action: Callable[[], str]) -> None:
        self.begun += 1
        said = _until_interrupt(partial(_said_by, action))
        with self.hold_sync():
            self.said = said
            self.done += 1


def _until_interrupt(action: Callable[[], str]) -> str:
    """Return what an action says; Interrupt ends it as it ends a cell.

    Between cells, a kernel passes Interrupt over.
    """
    before = signal(SIGINT, default_int_handler)
    try:
        return action()
    except KeyboardInterrupt:
        return framed(OPEN, words("You stopped it.", "strong"))
    finally:
        signal(SIGINT, before)


def _said_by(action: Callable[[], str]) -> str:
    """Return what an action says, or its error, as HTML; what it prints has no cell."""
    try:
        with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
            return action()
    except RosbeatError as error:
        return framed(OPEN, words(error.what, "strong"), words(error.means), words(error.to_try))
    except Exception as error:  # such as a NameError, for an answer that is gone
        return framed(
            OPEN,
            words(f"{type(error).__name__}: {error}", "strong"),
            words("Run the cell above again, and then the one with the check."),
        )
