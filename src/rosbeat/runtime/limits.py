"""Which deadlines and lifespans a session counts itself, and what has to be heard for that.

Only in a private domain, and for what is made in virtual time: see `stretching`. Where other
processes listen, they shall see what the learner wrote, and what is made live is counted by the
middleware, by the wall clock, as always. So is nothing of a private session while it is live:
deadlines wait for the first message in virtual time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from threading import get_ident
from typing import Any, Protocol

from rosbeat.records import INFRASTRUCTURE_TOPICS
from rosbeat.runtime.deadlines import Deadline
from rosbeat.runtime.entities import Entry, NodeState, callback_name
from rosbeat.runtime.events import event_name, event_source
from rosbeat.runtime.lifespans import FreshOnly, Sent
from rosbeat.runtime.live import LiveExecutor
from rosbeat.runtime.recorder import Recorder
from rosbeat.runtime.stretching import limit_ns
from rosbeat.runtime.taps import PublisherTap
from rosbeat.runtime.virtual_time import VirtualTimeExecutor


class Home(Protocol):
    """What is asked of a session."""

    recorder: Recorder
    virtual: VirtualTimeExecutor
    live: LiveExecutor | None

    def now(self) -> int:
        """Nanoseconds since the session began."""

    def states(self) -> list[NodeState]:
        """All nodes that have not been destroyed, in order of creation."""

    def next_number(self) -> int:
        """The place of a new entity in the order of creation."""


class Limits:
    """The deadlines and lifespans of one session.

    Args:
        home: The session.
    """

    def __init__(self, home: Home) -> None:
        self._home, self._thread = home, get_ident()
        # By topic: the subscriptions that have a deadline, and how they hear of a message; and
        # what was sent, where a lifespan makes that matter.
        self._waiting: dict[str, list[tuple[Entry, Callable[[], None]]]] = {}
        self._sent: dict[str, list[Sent]] = {}

    def publisher_made(self, state: NodeState, publisher: Any, tap: PublisherTap) -> None:  # noqa: ANN401
        """Count what a new publisher offers, and let those that wait for messages hear it."""
        heard = self._deadline_of(state, publisher)
        if heard is not None:
            tap.listen(heard)
        for entry, told in self._waiting.get(tap.topic, ()):
            if tap.fits(entry.entity):
                tap.listen(told)
        if tap.topic in self._sent:
            self._note_what_is_sent(tap)

    def subscription_made(self, entry: Entry) -> None:
        """Count what a new subscription asks for."""
        lifespan = limit_ns(entry.entity.qos_profile.lifespan)
        stored = [one for one in self._taps(entry.name) if one.stores_for(entry.entity.qos_profile)]
        if lifespan or any(one.lifespan_ns for one in stored):
            self._keep_fresh(entry, lifespan)
        heard = self._deadline_of(entry.state, entry.entity)
        if heard is None:
            return
        self._waiting.setdefault(entry.name, []).append((entry, heard))
        for tap in self._taps(entry.name):
            if tap.fits(entry.entity):
                tap.listen(heard)
        if any(self._is_young(tap, entry) for tap in stored):
            heard()

    # Deadlines.

    def _deadline_of(self, state: NodeState, endpoint: Any) -> Callable[[], None] | None:  # noqa: ANN401
        """Begin to count; what is to be called at each message, or None if nobody asked."""
        period = limit_ns(endpoint.qos_profile.deadline)
        found = [one for one in endpoint.event_handlers if event_name(one) == "deadline"]
        if not (period and found):
            return None
        home, (handler,) = self._home, found
        deadline = Deadline(handler, endpoint, period)
        called, source = callback_name(handler.callback), event_source(handler, endpoint.topic_name)
        label = home.recorder.label(state.name, "event", called, source)
        topic, take = endpoint.topic_name, deadline.take
        entry = Entry(home.next_number(), state, "event", handler, topic, label, take)
        state.entries.append(entry)
        home.virtual.watch(entry)
        return partial(self._heard, home.virtual.deadlines.add(entry, deadline))

    def _heard(self, moved: Callable[[int], None]) -> None:
        home = self._home
        if home.live is not None:
            return
        if get_ident() == self._thread:
            moved(home.virtual.now)
        else:  # a thread of a node's own
            home.virtual.elsewhere.append(lambda: moved(home.virtual.now))

    # Lifespans.

    def _keep_fresh(self, entry: Entry, lifespan: int) -> None:
        if entry.name in INFRASTRUCTURE_TOPICS:
            return  # what is sent there is not recorded
        if entry.name not in self._sent:
            self._sent[entry.name] = []
            for tap in self._taps(entry.name):
                self._note_what_is_sent(tap)
        home, label = self._home, entry.label
        old = home.recorder.label(label.node, "expired", label.name, label.source)
        fresh = FreshOnly(
            entry,
            lifespan,
            self._sent[entry.name],
            home.now,
            lambda: home.recorder.add_callback(home.now(), old.number),
        )
        entry.take = fresh.take

    def _note_what_is_sent(self, tap: PublisherTap) -> None:
        assert tap.channel is not None
        sent = Sent(self._home.recorder.sent(tap.channel), tap.lifespan_ns)
        self._sent[tap.topic].append(sent)
        tap.listen(lambda: sent.heard(self._home.now()))

    def _is_young(self, tap: PublisherTap, entry: Entry) -> bool:
        """Whether anything that this publisher has stored has not been dropped by now."""
        if not tap.lifespan_ns or tap.channel is None:
            return True
        newest = self._home.recorder.sent(tap.channel)[-1]
        limits = (tap.lifespan_ns, limit_ns(entry.entity.qos_profile.lifespan))
        return all(not one or self._home.now() - newest < one for one in limits)

    def _taps(self, topic: str) -> Iterator[PublisherTap]:
        return (tap for one in self._home.states() for tap in one.taps if tap.topic == topic)
