"""Stored messages, which a transient-local publisher hands to a subscription that comes late.

They come from a thread of Fast DDS, mostly at once, otherwise when the subscription asks for them,
0.07 s later (measured; `initialAcknackDelay`). Until then a reliable subscription holds back what
the same publisher publishes next: then not even a message of now would be there when `publish()`
has returned. So the session goes on only when all of them have arrived.
"""

from __future__ import annotations

import time
from collections.abc import Iterable

from rclpy.qos import QoSProfile

from rosbeat.runtime.taps import PublisherTap

#: Seconds. It takes as long only where another subscription of the publisher acknowledges nothing:
#: that of a process that was stopped, or one that keeps all and is full.
_LIMIT = 2.0
_STEP = 0.0005


def wait_for_stored(taps: Iterable[PublisherTap], qos: QoSProfile) -> None:
    """Wait until a new subscription has all messages that are stored for it.

    Args:
        taps: The publishers of its topic.
        qos: What it asks for.
    """
    end = time.monotonic() + _LIMIT
    for tap in taps:
        if not tap.stores_for(qos):
            continue
        # Asked again and again, since rclpy would wait without giving way to other threads.
        while not tap.has_delivered() and time.monotonic() < end:
            time.sleep(_STEP)
