"""Deadlines and lifespans that the middleware never sees pass, because the session counts them.

The middleware counts both by the wall clock, and in virtual time a minute takes milliseconds. So a
publisher or a subscription is made with three years more than the learner wrote. What is added
is the same for all: of two deadlines the shorter stays the shorter, and so the middleware connects
what it would have connected, and tells of what does not fit. `deadlines` and `lifespans` count what
was really written.

Liveliness and its lease are not touched: the middleware counts them by the wall clock.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from rclpy.duration import Duration, Infinite
from rclpy.qos import QoSProfile

from rosbeat.records import NANOSECONDS

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
