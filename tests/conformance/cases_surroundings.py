"""Cases of what surrounds a node: Python's clocks and threads, log lines, and arguments."""

from __future__ import annotations

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from queue import Empty, Queue
from typing import Any

import rclpy
import rclpy.logging
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType, ROSClock
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.task import Future
from rclpy.time import Time
from std_msgs.msg import Int32

from conformance.helpers import sleep_in_a_helper
from conformance.programs import (
    Adder,
    AddingNode,
    Beat,
    LoggedNode,
    Process,
    case,
    sum_of,
)

#: How long the first request of a client may take to a server that has just been found, in seconds.
FIRST_REQUEST = 0.3

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


@case(1.9)
def drive_for_some_time() -> list[Process]:
    """A loop that drives for 0.7 s by `time.time()` sends as many commands."""

    class Driver(LoggedNode):
        def __init__(self) -> None:
            super().__init__("driver")
            self.publisher = self.create_publisher(Int32, "number", 10)
            self.once(0.3, self.drive)
            self.every(0.4)

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
            self.began = {}
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


@case(1.9)
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


# Threads and what blocks them.


@case(2.2)
def event_that_another_callback_sets() -> list[Process]:
    """`Event.wait` in a callback ends when another thread of the executor sets the event."""

    class Waiting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("waiting")
            group = ReentrantCallbackGroup()
            self.event = threading.Event()
            self.once(0.4, self.wait, group)
            self.once(1.0, lambda: (self.note("sets"), self.event.set()), group)

        def wait(self) -> None:
            self.note("waits")
            self.note(f"event {self.event.wait(5.0)}")
            self.event.clear()
            self.note(f"event {self.event.wait(0.5)}")

    return [Process((Waiting,), threads=4)]


class Worker(LoggedNode):
    """Publishes from a thread of its own."""

    def __init__(self) -> None:
        super().__init__("worker")
        self.publisher = self.create_publisher(Int32, "number", 10)
        self.thread = threading.Thread(target=self.work, daemon=True)
        self.once(0.3, self.thread.start)
        self.every(0.55)

    def work(self) -> None:
        for number in range(3):
            time.sleep(0.4)
            self.note(f"publishes {number}")
            self.publisher.publish(Int32(data=number))


class NumberListener(LoggedNode):
    """Writes down the numbers that it hears."""

    def __init__(self) -> None:
        super().__init__("listener")
        self.hear("number")


@case(2.0)
def worker_thread() -> list[Process]:
    """A node whose thread publishes is heard."""
    return [Process((Worker,)), Process((NumberListener,))]


@case(2.0)
def timer_of_threading() -> list[Process]:
    """`threading.Timer` calls back, unless it is canceled."""

    class Timed(LoggedNode):
        def __init__(self) -> None:
            super().__init__("timed")
            self.alarms = [
                threading.Timer(seconds, self.note, (f"timer of {seconds} s",))
                for seconds in (0.5, 0.8, 1.2)
            ]
            self.every(0.35)
            self.once(0.1, self.begin)

        def begin(self) -> None:
            for alarm in self.alarms:
                alarm.daemon = True
                alarm.start()
            time.sleep(0.1)
            self.alarms[1].cancel()

    return [Process((Timed,))]


@case(2.2)
def queue_between_threads() -> list[Process]:
    """A thread that gets jobs from a queue works while the executor goes on."""

    class Queued(LoggedNode):
        def __init__(self) -> None:
            super().__init__("queued")
            self.jobs: Queue[int] = Queue()
            self.count = 0
            self.create_timer(0.3, self.put)
            self.thread = threading.Thread(target=self.work, daemon=True)
            self.once(0.1, self.thread.start)

        def put(self) -> None:
            self.count += 1
            if self.count <= 3:
                self.note(f"puts {self.count}")
                self.jobs.put(self.count)

        def work(self) -> None:
            while True:
                try:
                    job = self.jobs.get(timeout=0.75)
                except Empty:
                    self.note("nothing to do")
                    return
                time.sleep(0.1)
                self.note(f"has done {job}")

    return [Process((Queued,))]


@case(2.2)
def condition_between_threads() -> list[Process]:
    """A condition with its lock, and `join`."""

    class Conditioned(LoggedNode):
        def __init__(self) -> None:
            super().__init__("conditioned")
            self.condition = threading.Condition()
            self.ready = 0
            self.once(0.4, self.wait)

        def work(self) -> None:
            for _ in range(2):
                time.sleep(0.3)
                with self.condition:
                    self.ready += 1
                    self.note(f"ready {self.ready}")
                    self.condition.notify()
            time.sleep(0.3)

        def wait(self) -> None:
            thread = threading.Thread(target=self.work)
            thread.start()
            with self.condition:
                self.note(f"condition {self.condition.wait_for(lambda: self.ready == 2, 3.0)}")
            thread.join(0.1)
            self.note(f"alive {thread.is_alive()}")
            thread.join()
            self.note(f"alive {thread.is_alive()}")

    return [Process((Conditioned, Beat))]


@case(2.2)
def pool_of_threads() -> list[Process]:
    """A callback waits for two jobs of a ThreadPoolExecutor, which run side by side."""

    class Pooled(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pooled")
            self.pool = ThreadPoolExecutor(2)
            self.every(0.55)
            self.once(0.3, self.work)

        def job(self, seconds: float) -> float:
            time.sleep(seconds)
            self.note(f"has worked {seconds} s")
            return seconds

        def work(self) -> None:
            jobs = [self.pool.submit(self.job, seconds) for seconds in (0.7, 0.4)]
            self.note(f"in all {sum(job.result() for job in jobs):.1f} s")

    return [Process((Pooled,))]


@case(2.2)
def lock_between_callbacks() -> list[Process]:
    """A lock that one thread of the executor holds while it sleeps holds up another."""

    class Locked(LoggedNode):
        def __init__(self) -> None:
            super().__init__("locked")
            group = ReentrantCallbackGroup()
            self.lock = threading.Lock()
            self.once(0.3, lambda: self.work("first"), group)
            self.once(0.6, lambda: self.work("second"), group)
            self.every(0.45, group=group)

        def work(self, name: str) -> None:
            with self.lock:
                self.sleep(0.7, name)

    return [Process((Locked,), threads=4)]


@case(2.2, tolerance=FIRST_REQUEST)
def spin_in_a_thread() -> list[Process]:
    """`main` calls a service, and waits for the answer, while a thread spins."""

    def main() -> None:
        rclpy.init()
        node = AddingNode("asker")
        node.every(0.55)
        thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
        thread.start()
        time.sleep(0.8)
        node.note("calls")
        node.note_response(node.client.call(sum_of(2, 3)))
        time.sleep(0.7)
        rclpy.shutdown()
        thread.join()
        node.note("ends")

    return [Process((Adder,)), Process(main=main)]


@case(2.2)
def executor_that_spins_in_a_thread() -> list[Process]:
    """An executor in a thread, and a rate in `main`."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("rated")
        node.every(0.55)
        executor = MultiThreadedExecutor(num_threads=2)
        executor.add_node(node)
        thread = threading.Thread(target=executor.spin, daemon=True)
        thread.start()
        rate = node.create_rate(2.5)
        for number in range(3):
            rate.sleep()
            node.note(f"step {number + 1}")
        executor.shutdown()
        thread.join()
        node.note("ends")

    return [Process(main=main)]


@case(2.4)
def event_that_a_thread_sets() -> list[Process]:
    """In a single thread, a callback waits for a thread of the node: that is no deadlock."""

    class Waiting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("waiting")
            self.done = threading.Event()
            self.once(0.3, self.wait)

        def wait(self) -> None:
            threading.Thread(target=self.work, daemon=True).start()
            self.note("waits")
            self.done.wait()
            self.note("has waited")

        def work(self) -> None:
            time.sleep(0.9)
            self.note("is done")
            self.done.set()

    return [Process((Waiting,)), Process((Beat,))]


# Rates.


class Rated(LoggedNode):
    """Works in a loop with a rate that was made in the constructor."""

    def __init__(self, work: float) -> None:
        super().__init__("rated")
        self.rate = self.create_rate(2.5)
        self.work = work
        self.once(1.0, self.run, MutuallyExclusiveCallbackGroup())

    def run(self) -> None:
        for number in range(3):
            self.rate.sleep()
            self.note(f"step {number + 1}")
            time.sleep(self.work)


@case(3.2)
def rate_that_has_ticked() -> list[Process]:
    """A tick that came while nobody slept makes the next `sleep` return at once."""
    # Ticks at 0.4, 0.8, 1.2, 1.6, ...; the callback begins at 1.0.
    return [Process((lambda: Rated(0.05),), threads=3)]


@case(3.2)
def rate_that_is_slower_than_the_work() -> list[Process]:
    """So it does where the work takes longer than the period."""
    return [Process((lambda: Rated(0.5),), threads=3)]


@case(2.6)
def rate_that_has_ticked_in_a_single_thread() -> list[Process]:
    """The first `sleep` of a single thread returns, for a tick has passed; the second never."""
    return [Process((lambda: Rated(0.05),)), Process((Beat,))]


@case(2.6)
def rate_in_a_loop_of_main() -> list[Process]:
    """A loop around `spin_once` and `rate.sleep` goes on as long as the ticks come in between."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("looped")
        rate = node.create_rate(2.5)
        for number in range(4):
            rclpy.spin_once(node)
            rate.sleep()
            node.note(f"step {number + 1}")

    return [Process(main=main)]


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


@case(1.4, misfits=True, logs=True)
def warnings_of_incompatible_qos() -> list[Process]:
    """Both sides of a topic with incompatible QoS are warned by rclpy."""
    volatile = QoSProfile(depth=10, durability=DurabilityPolicy.VOLATILE)
    best_effort = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.one = self.create_publisher(Int32, "number", best_effort)
            self.other = self.create_publisher(Int32, "stored", volatile)

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
            logger.info(f"throttled {self.count}", throttle_duration_sec=0.75)
            logger.info(f"once {self.count}", once=True)
            logger.info(f"skipped first {self.count}", skip_first=True, throttle_duration_sec=0.75)
            if self.count > 2:
                logger.info(f"both {self.count}", once=True, throttle_duration_sec=0.5)

    return [Process((Throttled,))]


# Arguments.


@case(1.6, logs=True)
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
        node.declare_parameter("limit", 1)
        node.note(f"limit {node.get_parameter('limit').value}")
        publisher = node.create_publisher(Int32, "number", 10)
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


@case(1.6)
def exit_in_a_callback() -> list[Process]:
    """`exit()` ends its own process."""
    return _leaving(lambda: exit())  # noqa: PLR1722 - as learners write it


@case(1.6)
def quit_in_a_callback() -> list[Process]:
    """So does `quit()`, with an exit code."""
    return _leaving(lambda: quit(3))  # noqa: PLR1722 - as learners write it


@case(1.6)
def exit_in_a_thread_of_the_executor() -> list[Process]:
    """With an executor of its own it is the same."""

    def main() -> None:
        rclpy.init()
        node, executor = LoggedNode("leaving"), SingleThreadedExecutor()
        done = Future()
        node.once(0.6, lambda: exit("no more"))  # noqa: PLR1722 - as learners write it
        executor.add_node(node)
        executor.spin_until_future_complete(done)

    return [Process(main=main), Process((Beat,))]
