"""Keep the list of `progress()` up to date in JupyterLab, also on a page that was not run.

The list is a widget whose id is always the same. JupyterLab stores an output with that id in the
page, and when it opens the page it asks the new kernel for its widgets. The course's kernel answers
with one of that id, so the stored output shows how far the learner is now. Nothing is loaded before
JupyterLab asks, and the exercises not before the list is drawn.

Where that does not work, the list stands there as it was stored: in other front ends, without a
kernel, and in a page that JupyterLab does not trust, of which it shows no widget.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from threading import Event, Lock, Thread
from typing import TYPE_CHECKING, Any

from rosbeat.workspace.location import page_file, steady_home

if TYPE_CHECKING:
    from rosbeat.exercises.progress_list import ProgressList

#: Seconds from one look at the file to the next, while a list is shown.
PERIOD = 1.0
_ID, _CONTROL = "rosbeat-progress", "jupyter.widget.control"
_HERE = Path(__file__).parent
#: One of two outputs is shown: the stored list, if the live one is not there.
_ONE_OF_THEM = """<style>
.rosbeat-progress-stored { animation: rosbeat-stored 2s; }
@keyframes rosbeat-stored { from, 99% { visibility: hidden; } }
.jp-OutputArea-child:has(.rosbeat-progress-stored):has(+ * .rosbeat-progress-live > *),
.jp-OutputArea-child:has(.rosbeat-progress-stored) + *:not(:has(.rosbeat-progress-live)) {
  display: none;
}
</style>
"""
_STORED = (
    "This is how far you were when this list was stored. Run this cell to bring it up to date."
)


def offer(shell: Any, make: Callable[[], ProgressList]) -> None:  # noqa: ANN401 - IPython's
    """Answer JupyterLab with the list when it asks for the widgets of a page that has one.

    Args:
        shell: The kernel's shell.
        make: Returns the list of the page.
    """
    manager = getattr(getattr(shell, "kernel", None), "comm_manager", None)
    if manager is None or steady_home() is not None or not _has_a_list(page_file()):
        return

    def answer(comm: Any, message: Any) -> None:  # noqa: ANN401 - a kernel's own kind of wire
        widgets = import_module("ipywidgets")  # which takes this function's place
        live(make)
        widgets.Widget.handle_control_comm_opened(comm, message)

    manager.register_target(_CONTROL, answer)


def stored(shown: ProgressList) -> list[dict[str, Any]]:
    """Return the two outputs of a cell with a list, as MIME bundles.

    Args:
        shown: The list.
    """
    html = (
        f'{_ONE_OF_THEM}<div class="rosbeat-progress-stored">{shown.html()}<p>{_STORED}</p></div>'
    )
    view = {"version_major": 2, "version_minor": 0, "model_id": _ID}
    return [
        {"text/html": html, "text/plain": shown.description},
        {"application/vnd.jupyter.widget-view+json": view, "text/plain": ""},
    ]


class LiveList:
    """Keep every list of this kernel up to date: one widget, and one thread.

    Checks of other pages run in other kernels, so what is watched is the file.

    Args:
        make: Returns the list that a page has stored, if it is drawn before its cell runs.
    """

    def __init__(self, make: Callable[[], ProgressList]) -> None:
        self._first = make
        self._lock = Lock()
        self._never = Event()
        self._thread: Thread | None = None
        self._make: Callable[[], str] | None = None
        self._widget = _widget(self._drawn)

    def show(self, shown: ProgressList) -> None:
        """Show a list, which takes the place of those shown before.

        Args:
            shown: The list.
        """
        with self._lock:
            self._make = shown.html
            self._widget.html = shown.html()
            if self._thread is None or not self._thread.is_alive():
                self._thread = Thread(target=self._run, name="rosbeat progress", daemon=True)
                self._thread.start()

    def _drawn(self) -> None:
        if self._make is None:
            self.show(self._first())

    def _run(self) -> None:
        while not self._never.wait(PERIOD):  # not `time.sleep`, which a session replaces
            with suppress(OSError), self._lock:  # the folder may be gone for a while
                if self._make is not None:
                    self._widget.html = self._make()


_LIVE: list[LiveList] = []


def live(make: Callable[[], ProgressList]) -> LiveList:
    """Return the live list of this kernel.

    Args:
        make: Returns the list of the page.
    """
    if not _LIVE:
        _LIVE.append(LiveList(make))
    return _LIVE[0]


def _widget(drawn: Callable[[], None]) -> Any:  # noqa: ANN401 - the widgets take a while to load
    """Return a widget with the text `html`, which JupyterLab finds by its id."""
    from anywidget import AnyWidget
    from IPython import get_ipython
    from traitlets import Unicode

    class ProgressWidget(AnyWidget):
        _esm = Unicode((_HERE / "progress.js").read_text(encoding="utf-8")).tag(sync=True)
        html = Unicode().tag(sync=True)

    made = ProgressWidget(model_id=_ID)
    # A message may come in a thread of its own, and what it leads to belongs between two cells.
    made.on_msg(lambda *_: get_ipython().kernel.io_loop.add_callback(drawn))
    return made


def _has_a_list(page: Path) -> bool:
    try:
        return "progress()" in page.read_text(encoding="utf-8")
    except (OSError, ValueError):
        return False
