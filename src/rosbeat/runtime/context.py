"""The ROS context of a session."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import rclpy.utilities
from rclpy.context import Context

if TYPE_CHECKING:
    from rosbeat.runtime.hooks import Watcher

#: Every node is born into virtual time, and says nothing on file descriptor 2: log lines are
#: printed in the cell that ran the node, the same in JupyterLab and in a test.
SESSION_ARGUMENTS = ["--ros-args", "-p", "use_sim_time:=true", "--disable-stdout-logs"]


class SessionContext(Context):
    """A context whose nodes are watched.

    A learner's node calls `super().__init__("name")` without a context, so it lands in rclpy's
    default context. While a session is open its context is that default.

    Args:
        watcher: What is told of every node and entity made in this context.
        domain_id: The ROS domain to join.
    """

    def __init__(self, watcher: Watcher, domain_id: int) -> None:
        super().__init__()
        self.watcher = watcher
        self.ended = False
        self._previous: Context | None = None
        super().init(SESSION_ARGUMENTS, domain_id=domain_id)

    def init(self, args: Any = None, **_: Any) -> None:  # noqa: ANN401 - rclpy's own signature
        """Answer a learner's `rclpy.init()`: this context is running already."""
        self.watcher.explain_init()

    def shutdown(self) -> None:
        """Answer a learner's `rclpy.shutdown()`: the session goes on."""
        self._be_default()  # rclpy.shutdown() has just forgotten the default context
        self.watcher.explain_shutdown()

    def try_shutdown(self) -> None:
        """Answer a learner's `rclpy.try_shutdown()`: the session goes on."""
        self.watcher.explain_shutdown()

    def end(self) -> None:
        """Shut the context down for real and hand the default back."""
        self.ended = True
        self.retire()
        super().try_shutdown()

    def install(self) -> Context | None:
        """Become rclpy's default context; return the one that was, for `uninstall`."""
        before: Context | None = rclpy.utilities.g_default_context
        if before is not self and self._previous is None:
            self._previous = before
        self._be_default()
        return before

    def uninstall(self, before: Context | None) -> None:
        """Make `before` the default again."""
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = before

    def retire(self) -> None:
        """Stop being the default; the nearest earlier context that still lives takes over."""
        if rclpy.utilities.g_default_context is self:
            self.uninstall(self._living_predecessor())

    def _be_default(self) -> None:
        with rclpy.utilities.g_context_lock:
            rclpy.utilities.g_default_context = self

    def _living_predecessor(self) -> Context | None:
        earlier = self._previous
        while isinstance(earlier, SessionContext) and earlier.ended:
            earlier = earlier._previous
        return earlier
