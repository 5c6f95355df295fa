"""Show the instrument panel of a session: the widget and its thread, or a still picture."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from threading import Event, RLock, Thread, current_thread, main_thread
from typing import TYPE_CHECKING, Any

from anywidget import AnyWidget
from IPython import get_ipython
from IPython.display import display
from traitlets import Unicode

from rosbeat.panel.sampling import Sampler
from rosbeat.panel.session_adapter import carry_out
from rosbeat.records import GraphSnapshot

if TYPE_CHECKING:
    from rosbeat.panel.session_adapter import SessionInstruments

#: Seconds from one look at the session to the next: 20 frames a second.
POLL_PERIOD = 0.05
#: Seconds that `close` waits for the look that is being taken.
_PATIENCE = 2.0
#: Frames on their way at most, of which the browser has said nothing yet.
WINDOW = 6
#: Seconds between frames to a browser that does not answer, and for how long it gets them; then
#: seconds between tries to wake it up.
RETRY, RETRY_FOR, RARE_RETRY = 1.0, 600.0, 30.0
#: While pages are built and tested, outputs must be the same each time; a panel's own never are.
_STEADY = "ROSBEAT_STEADY_HOME"
_HEADING = "The instrument panel of this session."
_HOW = (
    "This is a still picture of the panel. For the live one, run this cell again; in a kernel that "
    "has started anew, choose Run, Run All Above Selected Cell in the menu first."
)
#: JupyterLab shows an output whose widget is gone as an error, and looks at no other form of it. So
#: the picture is an output of its own: hidden while the panel below it lives, and hiding the error
#: when it does not.
_ONE_OF_THEM = """<style>
.jp-OutputArea-child:has(.rosbeat-still):has(+ * .rosbeat-panel) { display: none; }
.jp-OutputArea-child:has(.rosbeat-still) + *:not(:has(.rosbeat-panel)) { display: none; }
</style>
"""
_HERE = Path(__file__).parent


class Panel:
    """Show live what a session does; a cell displays the panel.

    Open it with `ros.panel()`. It samples the session in its own thread, so it keeps updating while
    a cell runs.

    Args:
        instruments: The session's instruments.
    """

    def __init__(self, instruments: SessionInstruments) -> None:
        self._instruments = instruments
        self._sampler = Sampler(instruments)
        self._flow = FlowControl()
        self._lock = RLock()
        self._stopping = Event()
        self._note: str | None = None
        self._widget: PanelWidget | None = None
        self._thread = Thread(target=self._run, name="rosbeat panel", daemon=True)
        if is_for_a_browser():
            self._widget = PanelWidget(self._heard)
            self._thread.start()

    def __repr__(self) -> str:
        return f"Panel({'closed' if self._stopping.is_set() else 'open'})"

    def close(self) -> None:
        """End the panel and what it has added to the session; its picture stays on the page.

        At the end of the process the browser is told nothing: it notices that the kernel is gone.
        """
        if self._stopping.is_set():
            return
        self._stopping.set()
        if self._thread.is_alive() and current_thread() is not self._thread:
            self._thread.join(_PATIENCE)
        self._instruments.release()
        if self._widget is not None and main_thread().is_alive():
            with suppress(Exception):  # the kernel may be on its way out, and take no message
                self._post({"closed": True})
                self._widget.close()

    def _ipython_display_(self) -> None:
        picture = still(self._instruments.graph())
        if self._widget is None or self._stopping.is_set():
            display(picture, raw=True)
            return
        html = picture.get("text/html", f'<p class="rosbeat-still">{picture["text/plain"]}</p>')
        display({**picture, "text/html": _ONE_OF_THEM + html}, raw=True)
        view = {"version_major": 2, "version_minor": 0, "model_id": self._widget.model_id}
        display({"application/vnd.jupyter.widget-view+json": view}, raw=True)

    def _run(self) -> None:
        due = time.monotonic()
        while not self._stopping.wait(max(0.0, due - time.monotonic())):
            # Looks that were missed are not made up for.
            due = max(due + POLL_PERIOD, time.monotonic())
            self._turn()

    def _turn(self) -> None:
        self._sampler.look()
        with self._lock:
            now = time.monotonic()
            if not self._flow.may_send(now):
                return
            content = self._frame(now)
        self._post(content)

    def _frame(self, now: float) -> dict[str, Any]:
        frame = self._sampler.frame(whole=self._flow.asked)
        frame["number"] = self._flow.sent(now)
        if self._note is not None:
            frame["note"], self._note = self._note, None
        return frame

    def _post(self, content: dict[str, Any]) -> None:
        assert self._widget is not None
        if self._widget.comm is not None:
            self._widget.send(content)

    def _heard(self, content: dict[str, Any]) -> None:
        now = time.monotonic()
        if "got" in content:
            with self._lock:
                self._flow.heard(int(content["got"]), now)
        elif content.get("do") == "open":
            with self._lock:
                self._flow.ask(now)
        else:
            note = carry_out(content, self._instruments)
            with self._lock:
                self._note = note


class FlowControl:
    """Limit the number of frames in flight.

    Without a limit, a sleeping browser or a slow connection would let frames pile up in a queue for
    hours; with it, surplus frames are skipped. An acknowledgment may also be late because the
    kernel is busy with a cell and cannot receive it, so a frame is sent once a second all the same:
    the browser takes a silence of seconds for a kernel that is gone.

    Times are seconds of a monotonic clock.

    Attributes:
        asked: Whether the browser needs a whole frame, because it was just opened or missed one.
        number: Number of the last frame, from 1.
    """

    def __init__(self) -> None:
        self.asked = False
        self.number = 0
        self._heard = 0
        self._sent_at = self._heard_at = 0.0
        self._is_watched = False

    def may_send(self, now: float) -> bool:
        """Return whether a frame may be sent."""
        if not self._is_watched:
            return False
        wait = RETRY if now - self._heard_at < RETRY_FOR else RARE_RETRY
        return self.number - self._heard < WINDOW or now - self._sent_at >= wait

    def sent(self, now: float) -> int:
        """Note that a frame goes out; return its number."""
        self.number += 1
        self._sent_at, self.asked = now, False
        return self.number

    def ask(self, now: float) -> None:
        """Note that the browser wants a whole frame now."""
        self._is_watched = self.asked = True
        self.heard(self.number, now)

    def heard(self, number: int, now: float) -> None:
        """Note that the browser has received the frame with this number."""
        if self._heard <= number <= self.number:
            self._heard, self._heard_at = number, now


class PanelWidget(AnyWidget):
    """Send frames to the browser, which draws them, and receive what is clicked there.

    Args:
        heard: Called with each message from the browser, in whichever thread the kernel uses.
    """

    _esm = Unicode((_HERE / "panel.js").read_text(encoding="utf-8")).tag(sync=True)
    _css = Unicode((_HERE / "panel.css").read_text(encoding="utf-8")).tag(sync=True)

    def __init__(self, heard: Callable[[dict[str, Any]], None]) -> None:
        super().__init__()
        _hear_at_once(self.comm)
        self.on_msg(lambda _widget, content, _buffers: heard(content))

    def close(self) -> None:
        """Close the wire, and the one of the layout that every widget brings along."""
        if self.comm is None:
            return
        layout = self.layout
        super().close()
        layout.close()


def _hear_at_once(wire: Any) -> None:  # noqa: ANN401 - a kernel's own kind of wire
    """Let clicks go where the browser sends them: to a thread of their own (a subshell).

    From 7.4 on ipykernel takes them to whichever loop sent the last message instead, and that is
    the one of the cell that runs: a click would wait until the cell has ended. Where ipykernel does
    not route them, or has no subshells, this changes nothing.
    """
    if hasattr(wire, "_reply_subshell_for"):
        wire._reply_subshell_for = lambda _content, asked_for: asked_for


# Where no browser is.


def is_for_a_browser() -> bool:
    """Return whether a browser may be attached that can show a widget."""
    shell = get_ipython()
    return getattr(shell, "kernel", None) is not None and not os.environ.get(_STEADY)


def still(graph: GraphSnapshot) -> dict[str, str]:
    """Return the graph as a MIME bundle, which depends only on the graph."""
    from rosbeat.viz.graphs import graph as draw  # matplotlib takes a while to load

    if not any(graph.nodes):
        return {"text/plain": f"{_HEADING} There are no nodes yet."}
    picture = draw(graph)
    html = f'<div class="rosbeat-still">{picture.html()}\n<p>{_HOW}</p></div>'
    return {"text/html": html, "text/plain": f"{_HEADING} {picture.description}"}
