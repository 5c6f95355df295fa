"""The one clock of a session."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.time import Time

_POINT = rclpy_implementation.rcl_time_point_t


class SessionClock(ROSClock):
    """A ROS clock that only its session moves.

    Every node of a session uses this one object, so no node can read a time that another has
    already left. rclpy's time source would set a node's clock from the parameter `use_sim_time`
    and from `/clock` messages; both calls are accepted and change nothing.

    Attributes:
        sleeper: Waits in virtual time until an instant, in nanoseconds; None while the session is
            live.
    """

    sleeper: Callable[[int], None] | None = None

    def set_ros_time_override(self, time: Time) -> None:
        """Accept rclpy's call and keep the session's own time."""

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Accept rclpy's call; `follow_session` and `follow_wall` decide."""

    def follow_session(self, time_ns: int) -> None:
        """Show virtual time from now on, beginning at `time_ns`."""
        self.advance(time_ns)
        super()._set_ros_time_is_active(True)

    def follow_wall(self) -> None:
        """Show wall time from now on, as a clock does without `use_sim_time`."""
        super()._set_ros_time_is_active(False)

    def advance(self, time_ns: int) -> None:
        """Move virtual time to `time_ns` nanoseconds."""
        # Once an instant, so without the detour through `Time` and the method of rclpy's clock.
        handle = self.handle
        with handle:
            handle.set_ros_time_override(_POINT(time_ns, ClockType.ROS_TIME))

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock; see rclpy. `sleep_for` calls this, too."""
        if self.sleeper is None:
            return bool(super().sleep_until(until, context))
        self.sleeper(until.nanoseconds)
        return True


def make_clock() -> SessionClock:
    """Return a clock at virtual time zero."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = ROSClock()
    clock.__class__ = SessionClock
    clock.follow_session(0)
    made: SessionClock = clock
    return made
