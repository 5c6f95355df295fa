"""The widget: what the browser runs, and the wire to it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from anywidget import AnyWidget
from traitlets import Unicode

_HERE = Path(__file__).parent


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
