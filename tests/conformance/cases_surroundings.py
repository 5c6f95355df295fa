"""Cases of what surrounds a node: Python's clocks, log lines, arguments, and its end."""

from __future__ import annotations

import time
from typing import Any

import rclpy
import rclpy.logging
from rclpy.clock import Clock, ClockType, ROSClock
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import Int32

from conformance.helpers import sleep_in_a_helper
from conformance.programs import (
    Beat,
    LoggedNode,
    Process,
    case,
    wait_until,
)

# Clocks.


class Watchdog(LoggedNode):
    """Stops when it has not heard a number for 0.5 s, by a clock of Python's."""

    def __init__(self, clock: Any) -> None:
        super().__init__("watchdog")
        self.clock = clock
        self.heard = 0.0
        self.tripped = True
        self.create_subscription(Int32, "number", self.on_number, 10)
        self.create_timer(0.1, self.look)

    def on_number(self, message: Int32) -> None:
        self.note(f"number {message.data}")
        self.heard, self.tripped = self.clock(), False

    def look(self) -> None:
        if not self.tripped and self.clock() - self.heard > 0.55:
            self.tripped = True
            self.note("stops")


class TwoNumbers(LoggedNode):
    """Publishes at 0.3 s and at 1.5 s."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.publish_at(0.3, "number", 1)
        self.publish_at(1.53, "number", 2)


@case(1.9)
def watchdog_by_the_monotonic_clock() -> list[Process]:
    """A watchdog that looks at `time.monotonic()` trips."""
    return [Process((lambda: Watchdog(time.monotonic),)), Process((TwoNumbers,))]


@case(1.9)
def watchdog_by_wall_time() -> list[Process]:
    """So does one that looks at `time.time()`."""
    return [Process((lambda: Watchdog(time.time),)), Process((TwoNumbers,))]


@case(1.9)
def watchdog_by_the_performance_counter() -> list[Process]:
    """So does one that looks at `time.perf_counter_ns()`."""

    def clock() -> float:
        return time.perf_counter_ns() / 1e9

    return [Process((lambda: Watchdog(clock),)), Process((TwoNumbers,))]


@case(1.65)
def drive_for_some_time() -> list[Process]:
    """A loop that drives for 0.7 s by `time.time()` sends as many commands."""

    class Driver(LoggedNode):
        def __init__(self) -> None:
            super().__init__("driver")
            self.publisher = self.create_publisher(Int32, "number", 10)
            self.once(0.3, self.drive)
            self.every(0.9)

        def drive(self) -> None:
            start = time.time()
            self.note("drives")
            count = 0
            while time.time() - start < 0.75:
                count += 1
                self.publisher.publish(Int32(data=count))
                time.sleep(0.2)
            self.note(f"has sent {count}")

    return [Process((Driver,))]


@case(2.2)
def clocks_of_a_program() -> list[Process]:
    """A program's own `Clock()` and `ROSClock()` go as fast as the node's."""

    class Clocks(LoggedNode):
        def __init__(self) -> None:
            super().__init__("clocks")
            self.clocks = {
                "ROS": ROSClock(),
                "system": Clock(),
                "steady": Clock(clock_type=ClockType.STEADY_TIME),
            }
            self.began: dict[str, Time] = {}
            self.once(0.3, self.begin)
            self.once(0.8, self.look)

        def begin(self) -> None:
            self.began = {name: clock.now() for name, clock in self.clocks.items()}

        def look(self) -> None:
            time.sleep(0.5)
            for name, clock in self.clocks.items():
                seconds = (clock.now() - self.began[name]).nanoseconds / 1e9
                self.note(f"{name}: about {round(2 * seconds) / 2} s")

    return [Process((Clocks,))]


@case(2.0)
def sleep_in_a_module_of_ones_own() -> list[Process]:
    """`from time import sleep` in a helper module sleeps as `time.sleep` does."""

    class Helped(LoggedNode):
        def __init__(self) -> None:
            super().__init__("helped")
            self.every(0.45)
            self.once(0.3, self.work)

        def work(self) -> None:
            self.note("asks for help")
            sleep_in_a_helper(0.8)
            self.note("was helped")

    return [Process((Helped,))]


@case(1.4)
def long_ago_is_zero() -> list[Process]:
    """The clock is not near zero at the start, so that zero is long ago, as much code has it."""

    class Patient(LoggedNode):
        def __init__(self) -> None:
            super().__init__("patient")
            self.warned = 0.0
            self.stamp = Time(clock_type=ClockType.ROS_TIME)
            self.once(0.2, self.tell)
            self.create_timer(0.4, self.look)

        def tell(self) -> None:
            self.note(f"use_sim_time {self.get_parameter('use_sim_time').value}")

        def look(self) -> None:
            now = self.get_clock().now()
            if now.nanoseconds / 1e9 - self.warned > 5.0:
                self.warned = now.nanoseconds / 1e9
                self.note("warns")
            if (now - self.stamp).nanoseconds > 10_000_000_000:
                self.stamp = now
                self.note("has never had a stamp")

    return [Process((Patient,))]


# Log lines.


@case(1.6, logs=True)
def loggers_of_no_node() -> list[Process]:
    """Lines of `rclpy.logging.get_logger` are log lines as those of a node."""

    def main() -> None:
        logger = rclpy.logging.get_logger("module")
        logger.info("before init")
        rclpy.init()
        node = LoggedNode("logging")
        logger.warning("after init")
        logger.get_child("child").error("of a child")
        logger.debug("is not shown")
        node.once(0.5, lambda: (logger.info("in a callback"), node.get_logger().info("own")))
        node.once(0.9, rclpy.shutdown)
        rclpy.spin(node)
        logger.info("after shutdown")

    return [Process(main=main)]


@case(1.9, tolerance=0.6, misfits=True, logs=True)
def warnings_of_incompatible_qos() -> list[Process]:
    """Both sides of a topic with incompatible QoS are warned by rclpy."""
    volatile = QoSProfile(depth=10, durability=DurabilityPolicy.VOLATILE)
    best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.lossy = self.create_publisher(Int32, "number", best_effort)
            self.volatile = self.create_publisher(Int32, "stored", volatile)

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.hear("number")

    class LateListener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("late")
            self.hear("stored", QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))

    # The first two have found each other before the case begins, and are warned when they spin.
    return [Process((Talker,)), Process((Listener,)), Process((LateListener,), start=0.6)]


@case(2.4, logs=True)
def throttled_lines() -> list[Process]:
    """The first throttled line comes at once, and so does a line with `once`."""

    class Throttled(LoggedNode):
        def __init__(self) -> None:
            super().__init__("throttled")
            self.count = 0
            self.create_timer(0.2, self.tell)

        def tell(self) -> None:
            self.count += 1
            logger = self.get_logger()
            logger.info(f"throttled {self.count}", throttle_duration_sec=0.7)
            logger.info(f"once {self.count}", once=True)
            logger.info(f"skipped first {self.count}", skip_first=True, throttle_duration_sec=0.7)
            if self.count > 2:
                logger.info(f"both {self.count}", once=True, throttle_duration_sec=0.5)

    return [Process((Throttled,))]


# Arguments.


@case(2.0, logs=True, from_first=True)
def arguments_given_to_init() -> list[Process]:
    """`rclpy.init(args=...)` remaps, names, sets parameters and log levels."""

    def main() -> None:
        rclpy.init(
            args=[
                "--ros-args",
                *("-r", "__node:=renamed", "-r", "number:=other", "-p", "limit:=5"),
                *("--log-level", "warn"),
            ]
        )
        node = LoggedNode("original")
        publisher = node.create_publisher(Int32, "number", 10)
        wait_until(publisher.get_subscription_count)
        node.declare_parameter("limit", 1)
        node.note(f"limit {node.get_parameter('limit').value}")
        node.note(f"topic {publisher.topic_name}")
        node.get_logger().info("is not shown")
        node.get_logger().warning("is shown")
        node.once(0.5, lambda: publisher.publish(Int32(data=1)))
        rclpy.spin(node)

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.hear("other")

    return [Process(main=main), Process((Listener,))]


# The end of a process.


def _leaving(leave: Any) -> list[Process]:
    def main() -> None:
        rclpy.init()
        node = LoggedNode("leaving")
        node.every(0.35)
        node.once(0.6, leave)
        rclpy.spin(node)

    return [Process(main=main), Process((Beat,))]


@case(1.5, tolerance=0.5)
def exit_in_a_callback() -> list[Process]:
    """`exit()` ends its own process."""
    return _leaving(lambda: exit())


@case(1.5, tolerance=0.5)
def quit_in_a_callback() -> list[Process]:
    """So does `quit()`, with an exit code."""
    return _leaving(lambda: quit(3))


@case(1.5, tolerance=0.5)
def exit_in_a_thread_of_the_executor() -> list[Process]:
    """With an executor of its own it is the same."""

    def main() -> None:
        rclpy.init()
        node, executor = LoggedNode("leaving"), SingleThreadedExecutor()
        done = Future()
        node.once(0.6, lambda: exit("no more"))
        executor.add_node(node)
        executor.spin_until_future_complete(done)

    return [Process(main=main), Process((Beat,))]
