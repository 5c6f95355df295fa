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
from IPython.display import display, update_display
from traitlets import Bool, Int, List, Unicode

from rosbeat.errors import RosbeatError
from rosbeat.exercises.cells import cells_of
from rosbeat.exercises.outcome_display import OPEN, framed, words

_HERE = Path(__file__).parent
#: What stands in the place of each kind of widget when its kernel is gone.
_GONE = {
    "check": "The buttons of this check went with the kernel. Run this cell again to get them.",
    "predict": "The field to predict went with the kernel. Run this cell again to get it.",
    "quiz": "The choices went with the kernel. Run this cell again to choose.",
}
#: JupyterLab shows an output whose widget is gone as an error or not at all, and one whose kernel
#: has started anew as if nothing had happened. So these words are an output of their own: hidden
#: while the widget below lives, also for the moment in which it loads, and hiding that error.
_ONE_OF_THEM = """<style>
.rosbeat-gone { animation: rosbeat-gone 3s; margin: 0; overflow: hidden; }
@keyframes rosbeat-gone { from, 99% { visibility: hidden; height: 0; } }
.jp-OutputArea-child:has(.rosbeat-gone):has(+ * .rosbeat-exercise:not(.rb-orphan)),
.jp-OutputArea-child:has(.rosbeat-gone) + *:not(:has(.rosbeat-exercise)) { display: none; }
</style>
"""
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
    #: Of each question of a quiz its `id`, `sign`, `text` and `choices`, the index of the one that
    #: was `chosen`, or None, and the `reason` why that is right or wrong; texts are HTML.
    questions: List[dict[str, Any]] = List().tag(sync=True)
    #: What was said last, as HTML: also for a page that is loaded anew while the kernel lives.
    said = Unicode().tag(sync=True)
    #: Count what was begun and what was carried out, so that the browser knows what it waits for.
    begun = Int().tag(sync=True)
    done = Int().tag(sync=True)

    def __init__(self, actions: Mapping[str, Action], kind: str, **traits: object) -> None:
        super().__init__(kind=kind, **traits)
        self._actions = actions
        self._stored = {"text/html": "", "text/plain": ""}
        self._display_id = f"rosbeat-gone-{self.model_id}"
        self._is_shown = False
        self.on_msg(lambda _widget, content, _buffers: self._hear(content))

    def close(self) -> None:
        """Close the wire, and the one of the layout that every widget brings along."""
        if self.comm is not None:
            layout = self.layout
            super().close()
            layout.close()

    def show(self) -> None:
        """Display the widget until its cell runs again, and what is said when its kernel is gone.

        Where everything is done, there is nothing to get back, and nothing is said.
        """
        if (cells := cells_of()) is not None:
            cells.hold(self)
        if self.kind != "predict" or not self.passed:
            display(self._gone(), raw=True, display_id=self._display_id)
            self._is_shown = True
        self.observe(lambda _: self._update(), "passed")
        view = {"version_major": 2, "version_minor": 0, "model_id": self.model_id}
        mime = "application/vnd.jupyter.widget-view+json"
        display({mime: view, "text/plain": ""}, raw=True)

    def keep(self, html: str, plain: str) -> None:
        """Keep what is to be read where the widget is not.

        Args:
            html: The same as HTML.
            plain: The same as text.
        """
        self._stored = {"text/html": html, "text/plain": plain}
        self._update()

    def _update(self) -> None:
        if self._is_shown:
            update_display(self._gone(), raw=True, display_id=self._display_id)

    def _gone(self) -> dict[str, str]:
        said = self._stored["text/html"]
        said += "" if self.passed else f"<p>{words(_GONE[self.kind])}</p>"
        html = f'{_ONE_OF_THEM}<div class="rosbeat-gone">{said}</div>' if said else ""
        return {**self._stored, "text/html": html}

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
