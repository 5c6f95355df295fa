"""The ROS context of a session."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import rclpy.utilities
from rclpy.context import Context
from rclpy.impl.implementation_singleton import rclpy_implementation

if TYPE_CHECKING:
    from rosbeat.runtime.hooks import Watcher

#: No node says anything on file descriptor 2: log lines are printed in the cell that ran the node,
#: the same in JupyterLab and in a test. Nor are log files written into the home directory.
SESSION_ARGUMENTS = ["--ros-args", "--disable-stdout-logs", "--disable-external-lib-logs"]


class SessionContext(Context):
    """A context whose nodes are watched.

    A learner's node calls `super().__init__("name")` without a context, so it lands in rclpy's
    default context. While a session is open its context is that default.

    Args:
        watcher: What is told of every node and entity made in this context.
        domain_id: The ROS domain to join.

    Attributes:
        watcher: As above; None when the session has ended, so that the context keeps nothing alive.
        ended: Whether `end` was called.
    """

    def __init__(self, watcher: Watcher, domain_id: int) -> None:
        super().__init__()
        self.watcher: Watcher | None = watcher
        self.ended = False
        # Always an older one, so that these references never form a circle.
        self._previous: Context | None = rclpy.utilities.g_default_context
        super().init(SESSION_ARGUMENTS, domain_id=domain_id)
        _configure_logging(self, rclpy.utilities.g_default_context)

    def init(self, args: Any = None, **_: Any) -> None:  # noqa: ANN401 - rclpy's own signature
        """Answer a learner's `rclpy.init()`: this context is running already."""
        if self.watcher is not None:
            self.watcher.explain_init()

    def shutdown(self) -> None:
        """Answer a learner's `rclpy.shutdown()`: the session goes on."""
        if self.watcher is not None:
            self._be_default()  # rclpy.shutdown() has just forgotten the default context
            self.watcher.explain_shutdown()

    def try_shutdown(self) -> None:
        """Answer a learner's `rclpy.try_shutdown()`: the session goes on."""
        if self.watcher is not None:
            self.watcher.explain_shutdown()

    def end(self) -> None:
        """Shut the context down for real and hand the default back."""
        self.ended = True
        self._previous = _living(self._previous)
        if rclpy.utilities.g_default_context is self:
            self.uninstall(self._previous)
        super().try_shutdown()
        self.watcher = None
        _configure_logging(self._previous, self._previous)

    def _call_on_shutdown_callbacks(self) -> None:
        """Call all that asked to be told, also if one of them raises: the end must be one.

        rclpy's own one for its global executor does, if the node that spun was broken off.
        """
        told: list[Callable[[], Any]] = self._callbacks
        self._callbacks: list[Callable[[], Any]] = []
        for reference in told:
            with suppress(Exception):
                callback = reference()  # a weak reference, or the function itself
                if callback is not None:
                    callback()

    def install(self) -> Context | None:
        """Become rclpy's default context; return the one that was, for `uninstall`."""
        before: Context | None = rclpy.utilities.g_default_context
        self._be_default()
        return before

    def uninstall(self, before: Context | None) -> None:
        """Make `before` the default again, or what came before it if its session has ended."""
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = _living(before)

    def _be_default(self) -> None:
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = self


def _living(context: Context | None) -> Context | None:
    while isinstance(context, SessionContext) and context.ended:
        context = context._previous
    return context


def _configure_logging(settings: Context | None, other: Context | None) -> None:
    """Make logging follow one context's arguments.

    rcl configures logging for the whole process, by the arguments of the first context. If that
    was a learner's own (`other`), every line of a session's nodes would also appear on file
    descriptor 2, so the session takes logging over and gives it back.
    """
    if settings is None or other is None or isinstance(other, SessionContext) or not other.ok():
        return
    rclpy_implementation.rclpy_logging_fini()
    rclpy_implementation.rclpy_logging_configure(settings.handle)
