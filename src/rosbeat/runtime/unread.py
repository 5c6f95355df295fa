"""How many messages have come into the queue of a subscription.

rcl tells it to whoever listens for new messages; rclpy has no function for that, so rcl's own is
called: `rcl_subscription_set_on_new_message_callback` (`rcl/subscription.h`). It calls from threads
of the middleware, which hold locks that a thread of Python may wait for while it holds Python's
own. So what it calls is no Python, but `eventfd_write` of the C library, which adds a number to a
counter of the operating system.
"""

from __future__ import annotations

import ctypes
import os
from contextlib import suppress
from types import TracebackType

from rclpy.subscription import Subscription


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
