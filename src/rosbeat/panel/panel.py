"""The instrument panel of one session."""

from __future__ import annotations

import time
from contextlib import suppress
from threading import Event, RLock, Thread, current_thread, main_thread
from typing import TYPE_CHECKING, Any

from IPython.display import display

from rosbeat.panel import orders
from rosbeat.panel.sampling import Sampler
from rosbeat.panel.still import behind_a_view, is_for_a_browser, still, view
from rosbeat.panel.traffic import Traffic
from rosbeat.panel.widget import PanelWidget

if TYPE_CHECKING:
    from rosbeat.panel.instruments import SessionInstruments

#: Seconds from one look at the session to the next: 20 frames a second.
PERIOD = 0.05
#: Seconds that `close` waits for the look that is being taken.
_PATIENCE = 2.0


def next_look(last: float, now: float) -> float:
    """Return when to sample the session again; missed samples are skipped.

    Args:
        last: When the previous sample was due, in seconds of a monotonic clock.
        now: The clock's current reading.
    """
    return max(last + PERIOD, now)


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
        self._traffic = Traffic()
        self._lock = RLock()
        self._stopping = Event()
        self._notes: list[str] = []
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
        else:
            display(behind_a_view(picture), raw=True)
            display(view(self._widget.model_id), raw=True)

    def _run(self) -> None:
        due = time.monotonic()
        while not self._stopping.wait(max(0.0, due - time.monotonic())):
            due = next_look(due, time.monotonic())
            self._turn()

    def _turn(self) -> None:
        self._sampler.look()
        with self._lock:
            now = time.monotonic()
            if self._traffic.may_send(now):
                content = self._frame(now)
            elif self._traffic.beats(now):
                content = {"beat": True}
            else:
                return
        self._post(content)

    def _frame(self, now: float) -> dict[str, Any]:
        frame = self._sampler.frame(whole=self._traffic.asked)
        frame["number"] = self._traffic.sent(now)
        if self._notes:
            frame["note"] = self._notes.pop()
            self._notes.clear()
        return frame

    def _post(self, content: dict[str, Any]) -> None:
        assert self._widget is not None
        if self._widget.comm is not None:
            self._widget.send(content)

    def _heard(self, content: dict[str, Any]) -> None:
        now = time.monotonic()
        if "got" in content:
            with self._lock:
                self._traffic.heard(int(content["got"]), now)
        elif content.get("do") == "open":
            with self._lock:
                self._traffic.ask(now)
        else:
            note = orders.carry_out(content, self._instruments)
            with self._lock:
                self._notes.append(note)
