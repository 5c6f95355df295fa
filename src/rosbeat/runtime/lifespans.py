"""Messages that are too old when their turn comes, by the session's clock.

A lifespan says how old a message may get, counted from when it was published, in the queue of the
endpoint that has it. A subscription's own one drops what waits in the subscription's queue. A
publisher's one drops what it has stored for late joiners, and nothing else: what has reached the
queue of a subscription stays there. That is how Fast DDS does it by the wall clock, and a test
compares the two.

What was dropped is recorded as a callback of the kind `expired`, which says that none ran.
"""

from __future__ import annotations

import time
from array import array
from collections.abc import Callable, Sequence
from typing import Any

from rosbeat.runtime.direct import next_message, work_for
from rosbeat.runtime.entities import Entry

Work = tuple[Callable[..., Any], tuple[Any, ...]]

#: Fast DDS keeps times in fractions of a second that are no whole nanoseconds.
_SLACK_NS = 1_000


class Sent:
    """When one publisher published each of its messages, by the session's clock.

    Args:
        past: The times of what it has published already.
        lifespan_ns: How long it stores a message; 0 without a limit.
    """

    def __init__(self, past: Sequence[int], lifespan_ns: int) -> None:
        self.lifespan_ns = lifespan_ns
        self._times = array("q", past)
        # By the wall clock, just after; it tells messages of the same number from one another.
        self._ends = array("q", [0] * len(past))

    def heard(self, now: int) -> None:
        """It has just published a message."""
        self._ends.append(time.time_ns())
        self._times.append(now)

    def end_of(self, number: int, sent_ns: int) -> float | None:
        """When its message of this number had been sent, if it may have been sent at a time.

        Args:
            number: Which message, counted from 1.
            sent_ns: When, by the wall clock.

        Returns:
            The time by the wall clock, just after; infinity if that was not noted; None if the
            message is not this publisher's.
        """
        if not 0 < number <= len(self._times):
            return None
        end = self._ends[number - 1]
        return end if end >= sent_ns - _SLACK_NS else float("inf") if not end else None

    def time_of(self, number: int) -> int:
        """When its message of this number was published, in nanoseconds of the session."""
        return self._times[number - 1]


class FreshOnly:
    """Takes messages from a subscription and drops those that are too old.

    Args:
        entry: The subscription, just made.
        lifespan_ns: Its own lifespan; 0 without a limit.
        senders: The publishers of its topic; the list may grow.
        now: Nanoseconds since the session began.
        dropped: Called for each message that was too old.
    """

    def __init__(
        self,
        entry: Entry,
        lifespan_ns: int,
        senders: Sequence[Sent],
        now: Callable[[], int],
        dropped: Callable[[], None],
    ) -> None:
        self._lifespan, self._senders = lifespan_ns, senders
        self._now, self._dropped = now, dropped
        self._born = now()

    def take(self, entry: Entry, _: object) -> Work | None:
        """One message that is young enough, with the callback; see `direct`."""
        while True:
            taken = next_message(entry)
            if taken is None:
                return None
            if not self._is_too_old(taken[1]):
                return work_for(entry, taken)
            self._dropped()

    def _is_too_old(self, info: dict[str, int]) -> bool:
        number = info["publication_sequence_number"]
        sender = self._sender(number, info["source_timestamp"])
        if sender is None:
            return False  # published by nobody that the session knows
        published = sender.time_of(number)
        # What was published before the subscription was made has come from the publisher's store.
        if 0 < sender.lifespan_ns <= self._born - published:
            return True
        return 0 < self._lifespan <= self._now() - published

    def _sender(self, number: int, sent_ns: int) -> Sent | None:
        """Who published a message; several may have published one of that number."""
        found = [(one.end_of(number, sent_ns), k) for k, one in enumerate(self._senders)]
        ends = [(end, k) for end, k in found if end is not None]
        return self._senders[min(ends)[1]] if ends else None
