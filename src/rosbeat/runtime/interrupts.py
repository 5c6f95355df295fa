"""Interrupts that must not get lost."""

from __future__ import annotations

import signal
import threading
from types import FrameType
from typing import Any


def show_briefly(interrupt: KeyboardInterrupt, text: str) -> None:
    """Let IPython show one line for an interrupt, and not the stack it happened to hit.

    Args:
        interrupt: The exception that is on its way.
        text: What to say.
    """
    lines = [f"KeyboardInterrupt: {text}"]
    interrupt._render_traceback_ = lambda: lines  # type: ignore[attr-defined] # IPython's protocol


class Interrupts:
    """Remembers, within a `with` block, that Interrupt was pressed.

    Python raises `KeyboardInterrupt` wherever it is, and that may be a line of Python that rclpy's
    C code has called, to convert a message say. Then something else comes out of C: measured, one
    interrupt in ten became `RuntimeError: Unable to convert call argument`. Whoever catches an
    exception in the block can ask here what it really was.

    Attributes:
        pressed: Whether Interrupt was pressed in this block.
    """

    def __init__(self) -> None:
        self.pressed = False
        self._original: Any = None

    def __enter__(self) -> Interrupts:
        self.pressed, self._original = False, None
        # Only the main thread is interrupted, and only it may ask to be told.
        if threading.current_thread() is threading.main_thread():
            original = signal.getsignal(signal.SIGINT)
            if callable(original):
                self._original = original
                signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._original is not None:
            signal.signal(signal.SIGINT, self._original)

    def insist(self) -> None:
        """Raise the interrupt if there was one.

        Raises:
            KeyboardInterrupt: If Interrupt was pressed.
        """
        if self.pressed:
            raise KeyboardInterrupt from None

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.pressed = True
        self._original(number, frame)
