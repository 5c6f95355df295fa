"""Give all nodes of a session clocks that show the same time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.clock import ClockType, ROSClock
from rclpy.context import Context
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.time import Time

if TYPE_CHECKING:
    from rosbeat.ros.virtual_time import VirtualTimeExecutor

_POINT = rclpy_implementation.rcl_time_point_t


class SessionClock(ROSClock):
    """Give a node a ROS clock that only its session moves.

    Each node has its own clock, because rcl visits all timers of a clock whenever the clock moves
    (`rcl_set_ros_time_override`): one shared clock for 10,000 timers made each step cost 0.2 ms.
    The clock moves when it is read and before one of its timers fires, so no node can read a time
    that another node has already passed.

    rclpy's time source would set a node's clock from the parameter `use_sim_time` and from
    `/clock` messages; both calls are accepted and change nothing.
    """

    _keeper: VirtualTimeExecutor
    _shown: int

    def set_ros_time_override(self, time: Time) -> None:
        """Accept rclpy's call and keep the session's own time."""

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Accept rclpy's call; `follow_session` and `follow_wall` decide."""

    def follow_session(self) -> None:
        """Show virtual time from now on."""
        self._shown = -1
        self.move()
        super()._set_ros_time_is_active(True)

    def follow_wall(self) -> None:
        """Show wall time from now on, as a clock does without `use_sim_time`."""
        super()._set_ros_time_is_active(False)

    def move(self) -> None:
        """Move to the session's time."""
        time_ns = self._keeper.now
        if time_ns != self._shown:
            self._shown = time_ns
            # Without the detour through `Time` and the method of rclpy's clock.
            handle = self.handle
            with handle:
                handle.set_ros_time_override(_POINT(time_ns, ClockType.ROS_TIME))

    def now(self) -> Time:
        """Return the time; see rclpy."""
        if not self._keeper.is_live:
            self.move()
        return super().now()

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Sleep until a time of this clock; see rclpy. `sleep_for` calls this, too."""
        if self._keeper.is_live:
            return bool(super().sleep_until(until, context))
        self._keeper.sleep_until(until.nanoseconds)
        return True


def make_clock(keeper: VirtualTimeExecutor) -> SessionClock:
    """Return a clock that shows the time of a session."""
    # ROSClock's constructor always returns a plain ROSClock, whatever class it is asked for.
    clock = ROSClock()
    clock.__class__ = SessionClock
    made: SessionClock = clock
    made._keeper = keeper
    made.follow_session()
    if keeper.is_live:
        made.follow_wall()
    return made
