"""Stored messages, which a transient-local publisher hands to a subscription that comes late.

They come from a thread of Fast DDS, mostly at once, otherwise when the subscription asks for them,
0.07 s later (measured; `initialAcknackDelay`). Until then a reliable subscription holds back what
the same publisher publishes next: then not even a message of now would be there when `publish()`
has returned. So the session goes on only when all of them have arrived.

Two signs tell it. The subscription has acknowledged everything: a publisher knows that only of all
its subscriptions together, and a volatile one that came late acknowledges in seconds or never. Or
as many messages have come into its queue as are stored for it, of which some are not counted where
the queue is shorter than that.
"""

from __future__ import annotations

import time
from collections.abc import Iterable

from rclpy.subscription import Subscription

from rosbeat.runtime.taps import PublisherTap
from rosbeat.runtime.unread import Unread

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
