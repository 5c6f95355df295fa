"""When a frame may be sent: as fast as the browser answers, and hardly ever while it sleeps."""

from __future__ import annotations

#: Frames on their way at most, of which the browser has said nothing yet.
WINDOW = 6
#: Seconds after which a beat says that the kernel is there, if no frame may go; and for how long
#: an unanswered browser gets beats.
BEAT, BEATS_FOR = 1.0, 600.0
#: Seconds to wait for an answer before one more frame is tried; doubled each time.
FIRST_WAIT, LONGEST_WAIT = 0.5, 30.0


class Traffic:
    """Limit the number of frames in flight.

    Without a limit, a sleeping browser or a slow connection would let frames pile up in a queue for
    hours; with it, surplus frames are skipped. An acknowledgment may also be late because the
    kernel is busy with a cell and cannot receive it, so a frame is sent from time to time all the
    same, and beats in between: the browser takes a silence of seconds for a kernel that is gone.

    Attributes:
        asked: Whether the browser needs a whole frame, because it was just opened or missed one.
        number: Number of the last frame, from 1.
    """

    def __init__(self) -> None:
        self.asked = False
        self.number = 0
        self._heard = 0
        self._wait = FIRST_WAIT
        self._sent_at = self._beat_at = self._heard_at = 0.0
        self._is_watched = False

    def may_send(self, now: float) -> bool:
        """Return whether a frame may be sent.

        Args:
            now: Seconds of a monotonic clock.
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

    def beats(self, now: float) -> bool:
        """Return whether to send a beat, and note that it goes out.

        Args:
            now: Seconds of a monotonic clock.
        """
        due = now - max(self._sent_at, self._beat_at) >= BEAT
        if not (self._is_watched and due and now - self._heard_at < BEATS_FOR):
            return False
        self._beat_at = now
        return True

    def ask(self, now: float) -> None:
        """Note that the browser wants a whole frame now."""
        self._is_watched = self.asked = True
        self.heard(self.number, now)

    def heard(self, number: int, now: float) -> None:
        """Note that the browser has received the frame with this number.

        Args:
            number: The frame's number.
            now: Seconds of a monotonic clock.
        """
        if self._heard <= number <= self.number:
            self._heard, self._heard_at, self._wait = number, now, FIRST_WAIT
