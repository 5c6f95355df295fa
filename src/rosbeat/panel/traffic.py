"""When a frame may be sent: as fast as the browser answers, and hardly ever while it sleeps."""

from __future__ import annotations

#: Frames on their way at most, of which the browser has said nothing yet.
WINDOW = 6
#: Seconds to wait for an answer before one more frame is tried; doubled each time.
FIRST_WAIT, LONGEST_WAIT = 0.5, 30.0


class Traffic:
    """Counts the frames that are on their way.

    Without it, a browser that sleeps or a connection that is slow would collect frames in some
    queue, hours of them. With it the frames that would wait are skipped. An answer may also be late
    because the kernel is busy with a cell and cannot hear it; then a frame is tried now and then.

    Attributes:
        asked: Whether the browser wants a whole frame: it has just opened, or missed one.
        number: Number of the last frame, from 1.
    """

    def __init__(self) -> None:
        self.asked = False
        self.number = 0
        self._heard = 0
        self._wait = FIRST_WAIT
        self._sent_at = 0.0
        self._is_watched = False

    def may_send(self, now: float) -> bool:
        """Whether a frame may go out.

        Args:
            now: Seconds on a clock that never goes back.
        """
        if not self._is_watched:
            return False
        return self.number - self._heard < WINDOW or now - self._sent_at >= self._wait

    def sent(self, now: float) -> int:
        """Note that a frame goes out; return its number."""
        if self.number - self._heard >= WINDOW:
            self._wait = min(2 * self._wait, LONGEST_WAIT)
        self.number += 1
        self._sent_at, self.asked = now, False
        return self.number

    def ask(self) -> None:
        """The browser wants a whole frame now."""
        self._is_watched = self.asked = True
        self.heard(self.number)

    def heard(self, number: int) -> None:
        """The browser has got the frame of this number."""
        if self._heard <= number <= self.number:
            self._heard, self._wait = number, FIRST_WAIT
