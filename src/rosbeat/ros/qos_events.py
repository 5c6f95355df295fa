"""Deadlines, lifespans and stored messages, by the session's clock."""

from __future__ import annotations

import ctypes
import os
import time
from array import array
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from heapq import heappop, heappush
from threading import get_ident
from types import TracebackType
from typing import TYPE_CHECKING, Any, Protocol

from rclpy.duration import Duration, Infinite
from rclpy.event_handler import (
    EventHandler,
    QoSOfferedDeadlineMissedInfo,
    QoSRequestedDeadlineMissedInfo,
)
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS
from rosbeat.ros.entities import Entry, NodeState, Work, callback_name, next_message, work_for
from rosbeat.ros.live import LiveExecutor

if TYPE_CHECKING:
    from rosbeat.ros.recording import PublisherTap, Recorder
    from rosbeat.ros.virtual_time import VirtualTimeExecutor


# The deadlines of publishers and subscriptions, counted by the session's clock.
#
# A deadline is the longest time from one message to the next. Whoever has one and an event callback
# for it is called each time it passes: a publisher's counts from what it has published, a
# subscription's from what has arrived there from any publisher that it is connected to. Nothing is
# missed before the first message has come; then one is missed in each period of silence, even when
# no publisher is left. Who is busy or paused is told afterwards, of all that were missed, in one
# event. Fast DDS does the same by the wall clock, and a test compares the two.
#
# A message that comes exactly at the deadline is in time: what timers do at an instant goes first.


class _Counted:
    """What rclpy's two info objects have, which can be written in C only."""

    total_count = 0
    total_count_change = 0


class _Offered(_Counted, QoSOfferedDeadlineMissedInfo):
    """What a publisher's callback is given."""


class _Requested(_Counted, QoSRequestedDeadlineMissedInfo):
    """What a subscription's callback is given."""


class Deadline:
    """The deadline of one publisher or subscription.

    Args:
        handler: What rclpy has made of the learner's callback.
        endpoint: The publisher or subscription.
        period_ns: The longest time from one message to the next.

    Attributes:
        due: When it will be missed next, in nanoseconds; None before the first message.
        total: How often it was missed.
        untold: How many of these its callback has not been told of.
    """

    def __init__(self, handler: EventHandler, endpoint: Any, period_ns: int) -> None:  # noqa: ANN401
        self._endpoint, self._callback = endpoint.handle, handler.callback
        self._info = _Offered if "PUBLISHER" in handler.event_type.name else _Requested
        self._period = period_ns
        self.due: int | None = None
        self.total = self.untold = 0

    def heard(self, now: int) -> None:
        """A message has come: begin to count."""
        self.due = now + self._period

    def forget(self) -> None:
        """Wait for a message before anything is missed again."""
        self.due, self.untold = None, 0

    def miss(self) -> None:
        """It has passed."""
        assert self.due is not None
        self.due += self._period
        self.total += 1
        self.untold += 1

    def is_alive(self) -> bool:
        """Whether its endpoint has not been destroyed."""
        try:
            with self._endpoint:
                return True
        except InvalidHandle:
            return False

    def take(self, _: Entry, __: object) -> Work | None:
        """What the callback has not been told of; see `entities`."""
        if not self.untold:
            return None
        info = self._info()
        info.total_count, info.total_count_change = self.total, self.untold
        self.untold = 0
        return self._callback, (info,)


class Deadlines:
    """The deadlines of a session, in order of (when they pass, order of creation).

    A message moves its deadline later, which costs no more than a number: the heap learns of it
    when the earlier time has come.
    """

    def __init__(self) -> None:
        self._heap: list[tuple[int, int, Entry, Deadline]] = []
        self._known: list[tuple[Entry, Deadline]] = []

    def __bool__(self) -> bool:
        return bool(self._known)

    def add(self, entry: Entry, deadline: Deadline) -> Callable[[int], None]:
        """Count a deadline from now on.

        Returns:
            What is to be called at each message, with the time.
        """
        self._known.append((entry, deadline))

        def heard(now: int) -> None:
            begins = deadline.due is None
            deadline.heard(now)
            if begins:
                self._push(entry, deadline)

        return heard

    def next_due(self) -> int | None:
        """When the next one passes, in nanoseconds; None if none will."""
        heap = self._heap
        while heap:
            at, _, entry, deadline = heap[0]
            if entry.state.ended or not deadline.is_alive():
                heappop(heap)
                self._known.remove((entry, deadline))
            elif deadline.due != at:  # a message came, or all was forgotten
                heappop(heap)
                self._push(entry, deadline)
            else:
                return at
        return None

    def pass_next(self) -> Entry:
        """The next one passes; `next_due` has just been asked. Return whose callback is due."""
        _, _, entry, deadline = heappop(self._heap)
        deadline.miss()
        self._push(entry, deadline)
        return entry

    def look_anew(self) -> None:
        """Put everything in order again: a run was broken off."""
        self._heap.clear()
        for entry, deadline in self._known:
            self._push(entry, deadline)

    def forget(self) -> None:
        """Count nothing until further messages come: real time has taken over, or has ended."""
        self._heap.clear()
        for _, deadline in self._known:
            deadline.forget()

    def _push(self, entry: Entry, deadline: Deadline) -> None:
        if deadline.due is not None:
            heappush(self._heap, (deadline.due, entry.number, entry, deadline))


# Messages that are too old when their turn comes, by the session's clock.
#
# A lifespan says how old a message may get, counted from when it was published, in the queue of the
# endpoint that has it. A subscription's own one drops what waits in the subscription's queue. A
# publisher's one drops what it has stored for late joiners, and nothing else: what has reached the
# queue of a subscription stays there. That is how Fast DDS does it by the wall clock, and a test
# compares the two.
#
# What was dropped is recorded as a callback of the kind `expired`, which says that none ran.


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
        """One message that is young enough, with the callback; see `entities`."""
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


# Deadlines and lifespans that the middleware never sees pass, because the session counts them.
#
# The middleware counts both by the wall clock, and in virtual time a minute takes milliseconds. So
# a publisher or a subscription is made with three years more than the learner wrote. What is added
# is the same for all: of two deadlines the shorter stays the shorter, and so the middleware
# connects what it would have connected, and tells of what does not fit. `Deadlines` and `FreshOnly`
# count what was really written.
#
# Liveliness and its lease are not touched: the middleware counts them by the wall clock.


#: What is added, in nanoseconds: three years. Fast DDS adds a lifespan to the time of the day, in
#: 32 bits of seconds that end in 2038; what goes beyond is dropped at once.
STRETCH = 100_000_000 * NANOSECONDS
#: From here on limits are no longer told apart, for the same reason.
_MOST = 100_000_000 * NANOSECONDS
_FOREVER: int = Infinite.nanoseconds
#: Where the quality of service stands among the arguments, by what is made.
_PLACES = {"publisher": 2, "subscription": 3}


def limit_ns(limit: Duration) -> int:
    """A deadline or a lifespan in nanoseconds; 0 if there is none, as ROS writes that, too."""
    found: int = limit.nanoseconds
    return found if found < _FOREVER else 0


def is_limited(profile: QoSProfile) -> bool:
    """Whether there is a deadline or a lifespan to count."""
    return bool(limit_ns(profile.deadline) or limit_ns(profile.lifespan))


@contextmanager
def stretched(
    kind: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> Iterator[tuple[tuple[Any, ...], Mapping[str, Any]]]:
    """The arguments with which an endpoint is made, so that the middleware counts nothing.

    The endpoint's `qos_profile` reads as it was written.

    Args:
        kind: What is made: `publisher`, `subscription` or anything else.
        args: The arguments of `create_publisher` or `create_subscription`.
        kwargs: Those with a name.
    """
    place = _PLACES.get(kind, len(args))
    given = args[place] if place < len(args) else kwargs.get("qos_profile")
    if kind not in _PLACES or not isinstance(given, QoSProfile) or not is_limited(given):
        yield args, kwargs
        return
    profile = _Stretched.of(given)
    try:
        if place < len(args):
            yield (*args[:place], profile, *args[place + 1 :]), kwargs
        else:
            yield args, {**kwargs, "qos_profile": profile}
    finally:
        profile.__class__ = QoSProfile  # only the middleware was to see more


def as_written(infos: list[Any]) -> list[Any]:
    """What the middleware tells of endpoints, with their limits as the learner wrote them."""
    for info in infos:
        profile = info.qos_profile
        for name in ("deadline", "lifespan"):
            told = getattr(profile, name).nanoseconds
            if STRETCH <= told < _FOREVER:
                setattr(profile, name, Duration(nanoseconds=told - STRETCH))
    return infos


class _Stretched(QoSProfile):
    """A QoS profile of which the middleware gets longer limits."""

    __slots__ = ()

    @classmethod
    def of(cls, profile: QoSProfile) -> _Stretched:
        """A copy of a profile, stretched."""
        made = cls.__new__(cls)
        for slot in QoSProfile.__slots__:
            setattr(made, slot, getattr(profile, slot))
        return made

    def get_c_qos_profile(self) -> Any:  # noqa: ANN401 - a class of C code
        """What the middleware is given."""
        given = {slot[1:]: getattr(self, slot) for slot in QoSProfile.__slots__}
        for name in ("deadline", "lifespan"):
            given[name] = _longer(given[name])
        return QoSProfile(**given).get_c_qos_profile()


def _longer(limit: Duration) -> Duration:
    found = limit_ns(limit)
    return Duration(nanoseconds=STRETCH + min(found, _MOST)) if found else limit


# What the middleware tells a node of: events of its publishers and subscriptions.


#: The end of rcl's name of an event, and the event's name as the learner writes it, as in
#: `SubscriptionEventCallbacks(deadline=...)`.
_NAMES = {
    "DEADLINE_MISSED": "deadline",
    "LIVELINESS_LOST": "liveliness",
    "LIVELINESS_CHANGED": "liveliness",
    "INCOMPATIBLE_QOS": "incompatible_qos",
    "INCOMPATIBLE_TYPE": "incompatible_type",
    "MESSAGE_LOST": "message_lost",
    "MATCHED": "matched",
}


def event_name(handler: EventHandler) -> str:
    """Which event a handler answers, such as `deadline`."""
    said: str = handler.event_type.name
    return next((name for end, name in _NAMES.items() if said.endswith(end)), said.lower())


def event_source(handler: EventHandler, topic: str) -> str:
    """What a run of the handler's callback is recorded to have answered."""
    return f"{event_name(handler)} of {topic}"


def topic_of(handler: EventHandler, node: Node) -> str:
    """The full name of the topic that an event of a node is about."""
    for end in (*node.publishers, *node.subscriptions):
        if handler in end.event_handlers:
            return str(end.topic_name)
    return "?"  # its endpoint has just been destroyed


# Which deadlines and lifespans a session counts itself, and what has to be heard for that.
#
# Only in a private domain, and for what is made in virtual time: see `stretched`. Where other
# processes listen, they shall see what the learner wrote, and what is made live is counted by the
# middleware, by the wall clock, as always. So is nothing of a private session while it is live:
# deadlines wait for the first message in virtual time.


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


# How many messages have come into the queue of a subscription.
#
# rcl tells it to whoever listens for new messages; rclpy has no function for that, so rcl's own is
# called: `rcl_subscription_set_on_new_message_callback` (`rcl/subscription.h`). It calls from
# threads of the middleware, which hold locks that a thread of Python may wait for while it holds
# Python's own. So what it calls is no Python, but `eventfd_write` of the C library, which adds a
# number to a counter of the operating system.


class Unread:
    """Counts what comes into a queue, with what is there already; nothing is taken out.

    A context manager. A subscription has one such listener at most. Where the operating system has
    no such counter (macOS), nothing is counted.

    Raises:
        OSError: If there are too many open files.
    """

    def __init__(self, subscription: Subscription) -> None:
        self._subscription = subscription
        self._count, self._counter = 0, -1
        if not hasattr(os, "eventfd"):
            return
        self._listen = ctypes.CDLL("librcl.so").rcl_subscription_set_on_new_message_callback
        self._listen.argtypes = (ctypes.c_void_p,) * 3
        self._add = ctypes.cast(ctypes.CDLL(None).eventfd_write, ctypes.c_void_p)

    def __enter__(self) -> Unread:
        if hasattr(os, "eventfd"):
            self._counter = os.eventfd(0, os.EFD_NONBLOCK | os.EFD_CLOEXEC)
            self._set(self._add, self._counter)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None
    ) -> None:
        """Stop listening: when rcl has returned, no thread of the middleware calls any more."""
        if self._counter >= 0:
            self._set(None, None)
            os.close(self._counter)

    def count(self) -> int:
        """Messages so far. One that was pushed out of a full queue may be left out."""
        if self._counter >= 0:
            with suppress(BlockingIOError):  # none since it was read last
                self._count += os.eventfd_read(self._counter)
        return self._count

    def _set(self, callback: ctypes.c_void_p | None, argument: int | None) -> None:
        handle = self._subscription.handle
        with handle:
            self._listen(handle.pointer, callback, argument)


# Stored messages, which a transient-local publisher hands to a subscription that comes late.
#
# They come from a thread of Fast DDS, mostly at once, otherwise when the subscription asks for
# them, 0.07 s later (measured; `initialAcknackDelay`). Until then a reliable subscription holds
# back what the same publisher publishes next: then not even a message of now would be there when
# `publish()` has returned. So the session goes on only when all of them have arrived.
#
# Two signs tell it. The subscription has acknowledged everything: a publisher knows that only of
# all its subscriptions together, and a volatile one that came late acknowledges in seconds or
# never. Or as many messages have come into its queue as are stored for it, of which some are not
# counted where the queue is shorter than that.


#: Seconds. It takes as long only where neither sign is given: another subscription acknowledges
#: nothing, and the queue is short, or messages have expired.
_LIMIT = 2.0
_STEP = 0.0005


def wait_for_stored(taps: Iterable[PublisherTap], subscription: Subscription) -> None:
    """Wait until a new subscription has all messages that are stored for it.

    Args:
        taps: The publishers of its topic.
        subscription: The new one. Nothing is taken out of its queue.
    """
    storing = [tap for tap in taps if tap.stores_for(subscription.qos_profile)]
    if _have_delivered(storing):
        return
    stored = sum(tap.stored for tap in storing)
    with Unread(subscription) as queue:
        end = time.monotonic() + _LIMIT
        # Asked again and again, since rclpy would wait without giving way to other threads.
        while queue.count() < stored and not _have_delivered(storing):
            if time.monotonic() > end:
                break
            time.sleep(_STEP)


def _have_delivered(taps: Iterable[PublisherTap]) -> bool:
    return all(tap.has_delivered() for tap in taps)
