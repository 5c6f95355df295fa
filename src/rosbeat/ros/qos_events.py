"""Count deadlines and lifespans by the session's clock, and wait for stored messages."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from math import inf
from threading import get_ident
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration, Infinite
from rclpy.event_handler import (
    EventHandler,
    QoSOfferedDeadlineMissedInfo,
    QoSRequestedDeadlineMissedInfo,
)
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.qos import HistoryPolicy, QoSProfile

from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS
from rosbeat.ros.entities import Entry, NodeState, Work, callback_name, next_message, work_for

if TYPE_CHECKING:
    from rosbeat.ros.recording import PublisherTap
    from rosbeat.ros.world import World

# Deadlines and lifespans that the middleware never sees pass, because the session counts them.
#
# The middleware counts both by the wall clock, and in virtual time a minute takes milliseconds. So
# a publisher or a subscription is made with three years more than the learner wrote. What is added
# is the same for all: of two deadlines the shorter stays the shorter, and so the middleware
# connects what it would have connected, and tells of what does not fit. Liveliness and its lease
# are not touched: the middleware counts them by the wall clock.


#: What is added, in nanoseconds: three years. Fast DDS adds a lifespan to the time of the day, in
#: 32 bits of seconds that end in 2038; what goes beyond is dropped at once.
STRETCH = 100_000_000 * NANOSECONDS
#: From here on limits are no longer told apart, for the same reason.
_MOST = 100_000_000 * NANOSECONDS
_FOREVER: int = Infinite.nanoseconds
_LIMITS = ("deadline", "lifespan")
#: Where the quality of service stands among the arguments, by what is made.
_PLACES = {"publisher": 2, "subscription": 3}


def limit_ns(limit: Duration) -> int:
    """Return a deadline or a lifespan in nanoseconds; 0 if there is none, as ROS writes that."""
    found: int = limit.nanoseconds
    return found if found < _FOREVER else 0


@contextmanager
def stretched(
    kind: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> Iterator[tuple[tuple[Any, ...], Mapping[str, Any]]]:
    """Change the arguments with which an endpoint is made, so that the middleware counts nothing.

    The endpoint's `qos_profile` reads as it was written.

    Args:
        kind: What is made: `publisher`, `subscription` or anything else.
        args: The arguments of `create_publisher` or `create_subscription`.
        kwargs: Those with a name.
    """
    place = _PLACES.get(kind, len(args))
    given = args[place] if place < len(args) else kwargs.get("qos_profile")
    known = kind in _PLACES and isinstance(given, QoSProfile)
    if not known or not any(limit_ns(getattr(given, name)) for name in _LIMITS):
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
    """Return what the middleware tells of endpoints, with limits as the learner wrote them."""
    for info in infos:
        profile = info.qos_profile
        for name in _LIMITS:
            told = getattr(profile, name).nanoseconds
            if STRETCH <= told < _FOREVER:
                setattr(profile, name, Duration(nanoseconds=told - STRETCH))
    return infos


class _Stretched(QoSProfile):
    """A QoS profile of which the middleware gets longer limits."""

    __slots__ = ()

    @classmethod
    def of(cls, profile: QoSProfile) -> _Stretched:
        """Return a copy of a profile, stretched."""
        made = cls.__new__(cls)
        for slot in QoSProfile.__slots__:
            setattr(made, slot, getattr(profile, slot))
        return made

    def get_c_qos_profile(self) -> Any:  # noqa: ANN401 - a class of C code
        """Return the profile that the middleware is given."""
        given = {slot[1:]: getattr(self, slot) for slot in QoSProfile.__slots__}
        for name in _LIMITS:
            limit = limit_ns(given[name])
            if limit:
                given[name] = Duration(nanoseconds=STRETCH + min(limit, _MOST))
        return QoSProfile(**given).get_c_qos_profile()


# Events, which the middleware tells a node of.


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
    """Return the name of the event that a handler answers, such as `deadline`."""
    said: str = handler.event_type.name
    return next((name for end, name in _NAMES.items() if said.endswith(end)), said.lower())


def event_source(handler: EventHandler, topic: str) -> str:
    """Return the `source` with which a run of the handler's callback is recorded."""
    return f"{event_name(handler)} of {topic}"


def topic_of(handler: EventHandler, node: Node) -> str:
    """Return the full name of the topic that an event of a node is about."""
    for end in (*node.publishers, *node.subscriptions):
        if handler in end.event_handlers:
            return str(end.topic_name)
    return "?"  # its endpoint has just been destroyed


def is_alive(handle: Any) -> bool:  # noqa: ANN401 - rclpy's handles share no base class
    """Return whether rclpy's handle of something has not been destroyed."""
    try:
        with handle:
            return True
    except InvalidHandle:
        return False


# Deadlines.
#
# A deadline is the longest time from one message to the next. Whoever has one and an event callback
# for it is called each time it passes: a publisher's counts from what it has published, a
# subscription's from what has arrived there from any publisher that it is connected to. Nothing is
# missed before the first message has come; then one is missed in each period of silence, even when
# no publisher is left. A node that is busy or paused is told afterwards, of all that were missed,
# in one event. Fast DDS does the same by the wall clock, and a test compares the two.
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
        entry: What its callback is to the executor.
        due: When it will be missed next, in nanoseconds; None before the first message.
    """

    entry: Entry

    def __init__(self, handler: EventHandler, endpoint: Any, period_ns: int) -> None:  # noqa: ANN401
        self.endpoint, self._callback = endpoint.handle, handler.callback
        self._info = _Offered if "PUBLISHER" in handler.event_type.name else _Requested
        self._period = period_ns
        self.due: int | None = None
        self._total = self._untold = 0

    def heard(self, now: int) -> None:
        """Begin a new period: a message has come."""
        self.due = now + self._period

    def forget(self) -> None:
        """Wait for a message before anything is missed again."""
        self.due, self._untold = None, 0

    def miss(self) -> None:
        """Count a period that has passed, and begin the next one."""
        assert self.due is not None
        self.due += self._period
        self._total += 1
        self._untold += 1

    def take(self, _: Entry, __: object) -> Work | None:
        """Return the callback with the misses that it has not been told of; see `entities`."""
        if not self._untold:
            return None
        info = self._info()
        info.total_count, info.total_count_change = self._total, self._untold
        self._untold = 0
        return self._callback, (info,)


class Deadlines(list[Deadline]):
    """The deadlines of a session, which are few: each has a callback of a learner's."""

    def next_due(self) -> int | None:
        """Return when the next one passes, in nanoseconds; None if none will."""
        self[:] = [one for one in self if not one.entry.state.ended and is_alive(one.endpoint)]
        return min((one.due for one in self if one.due is not None), default=None)

    def pass_next(self) -> Entry:
        """Let the next one pass; `next_due` has just been asked. Return whose callback is due."""
        _, _, deadline = min((one.due, one.entry.number, one) for one in self if one.due)
        deadline.miss()
        return deadline.entry

    def forget(self) -> None:
        """Count nothing until further messages come: real time has taken over, or has ended."""
        for deadline in self:
            deadline.forget()


# Lifespans.
#
# A lifespan says how old a message may get, counted from when it was published, in the queue of the
# endpoint that has it. A subscription's own one drops what waits in the subscription's queue. A
# publisher's one drops what it has stored for late-joining subscriptions, and nothing else: what
# has reached the queue of a subscription stays there. That is how Fast DDS does it by the wall
# clock, and a test compares the two.
#
# What was dropped is recorded as a callback of the kind `expired`, which says that none ran.


#: Fast DDS keeps times in fractions of a second that are no whole nanoseconds.
_SLACK_NS = 1_000


class Sent:
    """When one publisher published each of its messages.

    Args:
        past: When it published what it has published already, in nanoseconds of the session.
        lifespan_ns: How long it stores a message; 0 without a limit.

    Attributes:
        messages: For each message when it was published, and the wall clock just after. The latter
            tells messages of several publishers from one another; infinity if it was not noted.
    """

    def __init__(self, past: Sequence[int], lifespan_ns: int) -> None:
        self.lifespan_ns = lifespan_ns
        self.messages: list[tuple[int, float]] = [(at, inf) for at in past]


def fresh_only(
    lifespan_ns: int,
    senders: Sequence[Sent],
    now: Callable[[], int],
    dropped: Callable[[], None],
) -> Callable[[Entry, object], Work | None]:
    """Return a function that takes messages from a subscription and drops those that expired.

    Args:
        lifespan_ns: The subscription's own lifespan; 0 without a limit.
        senders: The publishers of its topic; the list may grow.
        now: Nanoseconds since the session began. The subscription has just been made.
        dropped: Called for each message that was too old.
    """
    born = now()

    def is_too_old(info: dict[str, int]) -> bool:
        number, sent_ns = info["publication_sequence_number"], info["source_timestamp"]
        # Several publishers may have published one of that number.
        found = [
            (end, published, one.lifespan_ns)
            for one in senders
            for published, end in one.messages[number - 1 : number]
            if end >= sent_ns - _SLACK_NS
        ]
        if not found:
            return False  # published by nobody that the session knows
        _, published, stored_for = min(found)
        # What was published before the subscription was made has come from the publisher's store.
        if 0 < stored_for <= born - published:
            return True
        return 0 < lifespan_ns <= now() - published

    def take(entry: Entry, _: object) -> Work | None:
        while (taken := next_message(entry)) is not None:
            if not is_too_old(taken[1]):
                return work_for(entry, taken)
            dropped()
        return None

    return take


# Which deadlines and lifespans a session counts itself, and what has to be heard for that.
#
# Only in a private domain, and for what is made in virtual time. Where other processes listen, they
# shall see what the learner wrote, and what is made live is counted by the middleware, by the wall
# clock, as always. So is nothing of a private session while it is live: deadlines wait for the
# first message in virtual time.


class Limits:
    """The deadlines and lifespans of one session.

    Args:
        home: The session.
    """

    def __init__(self, home: World) -> None:
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
        qos = entry.entity.qos_profile
        lifespan = limit_ns(qos.lifespan)
        taps = [tap for one in self._home.states() for tap in one.taps if tap.topic == entry.name]
        stored = [tap for tap in taps if tap.stores_for(qos)]
        if lifespan or any(tap.lifespan_ns for tap in stored):
            self._keep_fresh(entry, lifespan, taps)
        heard = self._deadline_of(entry.state, entry.entity)
        if heard is None:
            return
        self._waiting.setdefault(entry.name, []).append((entry, heard))
        for tap in taps:
            if tap.fits(entry.entity):
                tap.listen(heard)
        if any(self._is_young(tap, lifespan) for tap in stored):
            heard()

    def _deadline_of(self, state: NodeState, endpoint: Any) -> Callable[[], None] | None:  # noqa: ANN401
        """Begin to count; return what is to be called at each message, or None if nobody asked."""
        period = limit_ns(endpoint.qos_profile.deadline)
        found = [one for one in endpoint.event_handlers if event_name(one) == "deadline"]
        if not (period and found):
            return None
        home, (handler,), topic = self._home, found, endpoint.topic_name
        deadline = Deadline(handler, endpoint, period)
        called, source = callback_name(handler.callback), event_source(handler, topic)
        label = home.recorder.label(state.name, "event", called, source)
        number = home.next_number()
        deadline.entry = Entry(number, state, "event", handler, topic, label, deadline.take)
        state.entries.append(deadline.entry)
        home.virtual.watch(deadline.entry)
        home.virtual.deadlines.append(deadline)
        return partial(self._heard, deadline)

    def _heard(self, deadline: Deadline) -> None:
        virtual = self._home.virtual
        if self._home.live is not None:
            return
        if get_ident() == self._thread:
            deadline.heard(virtual.now)
        else:  # a thread of a node's own
            virtual.elsewhere.append(lambda: deadline.heard(virtual.now))

    def _keep_fresh(self, entry: Entry, lifespan: int, taps: list[PublisherTap]) -> None:
        if entry.name in INFRASTRUCTURE_TOPICS:
            return  # what is sent there is not recorded
        if entry.name not in self._sent:
            self._sent[entry.name] = []
            for tap in taps:
                self._note_what_is_sent(tap)
        home, label = self._home, entry.label
        old = home.recorder.label(label.node, "expired", label.name, label.source)

        def dropped() -> None:
            home.recorder.add_callback(home.now(), old.number)

        entry.take = fresh_only(lifespan, self._sent[entry.name], home.now, dropped)

    def _note_what_is_sent(self, tap: PublisherTap) -> None:
        assert tap.channel is not None
        sent = Sent(self._home.recorder.sent(tap.channel), tap.lifespan_ns)
        self._sent[tap.topic].append(sent)
        tap.listen(lambda: sent.messages.append((self._home.now(), time.time_ns())))

    def _is_young(self, tap: PublisherTap, lifespan: int) -> bool:
        """Return whether the newest message that this publisher has stored has not expired."""
        if not tap.lifespan_ns or tap.channel is None:
            return True
        age = self._home.now() - self._home.recorder.sent(tap.channel)[-1]
        return all(not one or age < one for one in (tap.lifespan_ns, lifespan))


# Stored messages, which a transient-local publisher hands to a late-joining subscription.
#
# They come from a thread of Fast DDS, mostly at once, otherwise when the subscription asks for
# them, 0.07 s later (measured; `initialAcknackDelay`). Until then a reliable subscription holds
# back what the same publisher publishes next: then not even a message of now would be there when
# `publish()` has returned. So the session goes on only when all of them have arrived.
#
# The sign is that the publisher knows everything to be acknowledged. It is not given where another
# subscription never acknowledges: a volatile one that came after the publisher had dropped some of
# its messages. Then the messages are taken early and counted, and the executor gets them from here.


#: Seconds after which the sign is not to be expected any more.
_UNACKNOWLEDGED = 0.2
#: Seconds; it takes as long only where stored messages have expired, too, or the queue is shorter
#: than what is stored.
_LIMIT = 2.0
_STEP = 0.0005


def wait_for_stored(taps: Iterable[PublisherTap], entry: Entry) -> None:
    """Wait until a new subscription has all messages that are stored for it.

    Args:
        taps: The publishers of its topic.
        entry: The new subscription.
    """
    storing = [tap for tap in taps if tap.stores_for(entry.entity.qos_profile)]
    begin = time.monotonic()
    # Asked again and again, since rclpy would wait without giving way to other threads.
    while not all(tap.has_delivered() for tap in storing):
        waited = time.monotonic() - begin
        if waited > _UNACKNOWLEDGED:
            early = entry.handle if isinstance(entry.handle, TakenEarly) else TakenEarly(entry)
            if early.count() >= sum(tap.stored for tap in storing) or waited > _LIMIT:
                return
        time.sleep(_STEP)


class TakenEarly:
    """Stand in for a subscription's handle until the messages that were taken early are used up.

    Args:
        entry: The subscription.
    """

    def __init__(self, entry: Entry) -> None:
        self._entry, self._handle = entry, entry.handle
        subscription = entry.entity
        qos = subscription.qos_profile
        self._arguments = (subscription.msg_type, subscription.raw)
        limited = qos.history == HistoryPolicy.KEEP_LAST
        # It is a part of the queue, so both together hold no more than the queue.
        self._messages: deque[Any] = deque(maxlen=max(1, qos.depth) if limited else None)
        self._count = 0
        entry.handle = self

    def __enter__(self) -> None:
        self._handle.__enter__()

    def __exit__(self, *error: object) -> None:
        self._handle.__exit__(*error)

    def __len__(self) -> int:
        return len(self._messages)

    def count(self) -> int:
        """Take what has arrived, and return how many messages that were so far."""
        with self._handle:
            while (taken := self._handle.take_message(*self._arguments)) is not None:
                self._messages.append(taken)
                self._count += 1
        return self._count

    def take_message(self, *_: object) -> Any:  # noqa: ANN401 - a message with its info, or None
        """Return the oldest message."""
        self.count()
        if len(self._messages) <= 1:
            self._entry.handle = self._handle
        return self._messages.popleft() if self._messages else None
