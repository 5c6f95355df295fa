"""Count deadlines and lifespans by the session's clock, and wait for stored messages."""

from __future__ import annotations

import time
from _thread import get_ident
from bisect import bisect_left
from collections import deque
from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from rclpy.duration import Duration, Infinite
from rclpy.event_handler import (
    EventHandler,
    QoSOfferedDeadlineMissedInfo,
    QoSRequestedDeadlineMissedInfo,
)
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import HistoryPolicy, QoSCompatibility, QoSProfile, qos_check_compatible

from rosbeat.records import INFRASTRUCTURE_TOPICS, NANOSECONDS
from rosbeat.ros.processes import Entry, NodeState, callback_name
from rosbeat.ros.taking import Work, message_work

if TYPE_CHECKING:
    from rosbeat.ros.ports import LimitHost
    from rosbeat.ros.recording import Entity, PublisherTap

# The middleware counts deadlines and lifespans by the wall clock, and in virtual time a minute
# takes milliseconds. So a publisher or a subscription is made with three years more than the
# learner wrote. What is added is the same for all: of two deadlines the shorter stays the shorter,
# and so the middleware connects what it would have connected, and tells of what does not fit.
# Liveliness and its lease are not touched.


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


def fit(offered: QoSProfile, asked: QoSProfile) -> bool:
    """Return whether the middleware connects a publisher and a subscription of these profiles."""
    compatible, _ = qos_check_compatible(offered, asked)
    return bool(compatible != QoSCompatibility.ERROR)


def make_stretched(
    make: Callable[..., Any], kind: str, args: tuple[Any, ...], kwargs: Mapping[str, Any]
) -> Any:  # noqa: ANN401 - any entity
    """Make an entity for which the middleware counts nothing; its `qos_profile` reads as written.

    `kind` is `publisher`, `subscription` or anything else, and the arguments are those of `make`.
    """
    place = _PLACES.get(kind, len(args))
    given = args[place] if place < len(args) else kwargs.get("qos_profile")
    known = kind in _PLACES and isinstance(given, QoSProfile)
    if not known:
        return make(*args, **kwargs)
    if not any(limit_ns(getattr(given, name)) for name in _LIMITS):
        made = make(*args, **kwargs)
        # The middleware reads a profile once; what is assigned to it afterwards changes nothing.
        made.qos_profile = _copied(made.qos_profile)
        return made
    longer = _stretched(given)
    if place < len(args):
        made = make(*args[:place], longer, *args[place + 1 :], **kwargs)
    else:
        made = make(*args, **{**kwargs, "qos_profile": longer})
    made.qos_profile = _shortened(longer)  # parameters may have changed it meanwhile
    return made


def as_written(infos: list[Any]) -> list[Any]:
    """Return what the middleware tells of endpoints, with limits as the learner wrote them."""
    for info in infos:
        _shortened(info.qos_profile)
    return infos


def _stretched(profile: QoSProfile) -> QoSProfile:
    """Return a copy with longer limits, for the middleware."""
    longer = {}
    for name in _LIMITS:
        limit = limit_ns(getattr(profile, name))
        if limit:
            longer[name] = Duration(nanoseconds=STRETCH + min(limit, _MOST))
    return _copied(profile, **longer)


def _copied(profile: QoSProfile, **other: Duration) -> QoSProfile:
    """Return a copy of a profile, with some policies replaced."""
    given = {slot[1:]: getattr(profile, slot) for slot in QoSProfile.__slots__}
    return QoSProfile(**given | other)


def _shortened(profile: QoSProfile) -> QoSProfile:
    """Take off again what was added to the limits of a profile, and return it."""
    for name in _LIMITS:
        limit = getattr(profile, name).nanoseconds
        if STRETCH <= limit < _FOREVER:
            setattr(profile, name, Duration(nanoseconds=limit - STRETCH))
    return profile


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
# Whoever has a deadline and an event callback for it is called each time it passes: a publisher's
# counts from what it has published, a subscription's from what has arrived there from any publisher
# that it is connected to. Nothing is missed before the first message has come; then one is missed
# in each period of silence, even when no publisher is left. A node that is busy or paused is told
# afterwards, of all that were missed, in one event. A message that comes exactly at the deadline is
# in time. Fast DDS does the same by the wall clock, and a test compares the two.


# rclpy's two info objects can be filled in C only.
class _Offered(QoSOfferedDeadlineMissedInfo):
    total_count = total_count_change = 0


class _Requested(QoSRequestedDeadlineMissedInfo):
    total_count = total_count_change = 0


class Deadline:
    """Track the deadline of one publisher or subscription.

    Attributes:
        entry: The engine's entry for its callback.
        due: When it will be missed next, in nanoseconds; None before the first message.
    """

    entry: Entry

    def __init__(self, handler: EventHandler, endpoint: Entity, period_ns: int) -> None:
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
        """Return the callback with the misses that it has not been told of; see `taking`."""
        if not self._untold:
            return None
        info = self._info()
        info.total_count, info.total_count_change = self._total, self._untold
        self._untold = 0
        return self._callback, (info,)


class Deadlines(list[Deadline]):
    """Hold the deadlines of a session: few, because each needs a callback in a learner's code."""

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


# Which deadlines and lifespans a session counts itself, and what has to be heard for that.
#
# Only in a private session, and for what is made in virtual time. Where other processes listen,
# they shall see what the learner wrote, and what is made live is counted by the middleware. Nor is
# anything counted while a session is live: deadlines wait for the first message in virtual time.
#
# A subscription's lifespan drops what has waited too long in its queue. A publisher's drops what it
# has stored for late-joining subscriptions, and nothing that has reached a queue. That is how Fast
# DDS does it by the wall clock, and a test compares the two. What was dropped is recorded as a
# callback of the kind `expired`, which says that none ran.


class Limits:
    """Count the missed deadlines and apply the lifespans of one session."""

    def __init__(self, core: LimitHost) -> None:
        self._core, self._thread = core, get_ident()
        # By topic: the subscriptions that have a deadline, and how they hear of a message.
        self._waiting: dict[str, list[tuple[Entry, Callable[[], None]]]] = {}
        # By topic, where a lifespan may matter: for each message the wall clock just after it was
        # published, the session's time, and the publisher.
        self._sent: dict[str, list[tuple[int, int, PublisherTap]]] = {}
        self._noted: set[PublisherTap] = set()

    def publisher_made(self, state: NodeState, publisher: Publisher, tap: PublisherTap) -> None:
        """Count what a new publisher offers, and let those that wait for messages hear it."""
        heard = self._deadline_of(state, publisher)
        if heard is not None:
            tap.listen(heard)
        for entry, told in self._waiting.get(tap.topic, ()):
            if tap.fits(entry.entity):
                tap.listen(told)
        if tap.stores or tap.topic in self._sent:
            self._note_what_is_sent(tap)

    def subscription_made(self, entry: Entry) -> None:
        """Count what a new subscription asks for."""
        qos, core = entry.entity.qos_profile, self._core
        lifespan = limit_ns(qos.lifespan)
        taps = [tap for one in core.nodes.states() for tap in one.taps if tap.topic == entry.name]
        stored = [tap for tap in taps if tap.stores_for(qos)]
        # What is sent on topics that every node has is not recorded.
        if entry.name not in INFRASTRUCTURE_TOPICS and (
            lifespan or any(tap.lifespan_ns for tap in stored)
        ):
            for tap in taps:
                self._note_what_is_sent(tap)
            entry.take = partial(self._take_fresh, lifespan, core.now())
        heard = self._deadline_of(entry.state, entry.entity)
        if heard is None:
            return
        self._waiting.setdefault(entry.name, []).append((entry, heard))
        for tap in taps:
            if tap.fits(entry.entity):
                tap.listen(heard)
        if stored:
            heard()

    def _deadline_of(self, state: NodeState, endpoint: Entity) -> Callable[[], None] | None:
        """Begin to count; return what is to be called at each message, or None if nobody asked."""
        period = limit_ns(endpoint.qos_profile.deadline)
        found = [one for one in endpoint.event_handlers if event_name(one) == "deadline"]
        if not (period and found):
            return None
        core, (handler,), topic = self._core, found, endpoint.topic_name
        deadline = Deadline(handler, endpoint, period)
        called, source = callback_name(handler.callback), f"deadline of {topic}"
        label = core.recorder.label(state.name, "event", called, source)
        number = core.next_number()
        deadline.entry = Entry(number, state, "event", handler, topic, label, deadline.take)
        state.entries.append(deadline.entry)
        core.virtual.watch(deadline.entry)
        core.virtual.deadlines.append(deadline)
        return partial(self._heard, deadline)

    def _heard(self, deadline: Deadline) -> None:
        virtual = self._core.virtual
        if self._core.live is not None:
            return
        if get_ident() == self._thread:
            deadline.heard(virtual.now)
        else:  # a thread of a node's own
            virtual.elsewhere.append(lambda: deadline.heard(virtual.now))

    def _note_what_is_sent(self, tap: PublisherTap) -> None:
        sent, core = self._sent.setdefault(tap.topic, []), self._core
        if tap not in self._noted:
            self._noted.add(tap)
            tap.listen(lambda: sent.append((time.time_ns(), core.now(), tap)))

    def _take_fresh(self, lifespan: int, born: int, entry: Entry, _: object) -> Work | None:
        """Take a message from a subscription, and drop those before it that have expired.

        The subscription has a lifespan of its own, or 0, and was made at `born`, in nanoseconds.
        """
        handle, subscription, now = entry.handle, entry.entity, self._core.now()
        sent = self._sent.get(entry.name, [])
        while True:
            with handle:
                taken = handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                return None
            # It is the message after whose publication the wall clock had first passed its stamp.
            place = bisect_left(sent, (taken[1]["source_timestamp"],))
            if place == len(sent):
                return message_work(entry, taken)  # published by nobody that the session knows
            _, published, tap = sent[place]
            # What was published before the subscription was made comes from the publisher's store.
            was_dropped = 0 < tap.lifespan_ns <= born - published
            if not was_dropped and not 0 < lifespan <= now - published:
                return message_work(entry, taken)
            recorder, label = self._core.recorder, entry.label
            expired = recorder.label(label.node, "expired", label.name, label.source)
            recorder.add_callback(now, expired.number)


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


#: Seconds after which the sign is hardly to be expected any more.
_UNACKNOWLEDGED = 0.02
#: Seconds; it takes as long only where stored messages have expired, too, or the queue is shorter
#: than what is stored.
_LIMIT = 2.0
_STEP = 0.0005


def wait_for_stored(taps: Iterable[PublisherTap], entry: Entry) -> None:
    """Wait until a new subscription has all messages that the publishers of its topic store."""
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
    """Stand in for a subscription's handle until the messages that were taken early are used up."""

    def __init__(self, entry: Entry) -> None:
        self._entry, self._handle = entry, entry.handle
        self._arguments = (entry.entity.msg_type, entry.entity.raw)
        qos = entry.entity.qos_profile
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
