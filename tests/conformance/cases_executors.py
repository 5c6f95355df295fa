"""Cases of executors: timers, sleep, order, threads, tasks and exceptions."""

from __future__ import annotations

from functools import partial
from typing import Any

from rclpy.callback_groups import (
    MutuallyExclusiveCallbackGroup,
    ReentrantCallbackGroup,
)
from rclpy.clock import Clock, ClockType
from rclpy.task import Future
from std_msgs.msg import Int32
from test_msgs.srv import BasicTypes

from conformance.programs import (
    Adder,
    AddingNode,
    Beat,
    Burst,
    LoggedNode,
    Process,
    case,
    other_beat,
    sum_of,
)


class SleeperAt700(LoggedNode):
    """Sleeps from 0.7 s to 1.7 s."""

    def __init__(self) -> None:
        super().__init__("sleeper")
        self.once(0.7, lambda: self.sleep(1.0))


@case(2.9)
def sleep_in_a_callback() -> list[Process]:
    """A callback that sleeps holds up its process, whose timers keep their grid, and no other."""
    return [Process((SleeperAt700, Beat)), Process((other_beat,))]


@case(4.0, global_order=True)
def overlapping_sleeps_in_two_processes() -> list[Process]:
    """Of two that sleep at once, the one that sleeps shorter wakes first."""

    class Long(LoggedNode):
        def __init__(self) -> None:
            super().__init__("long")
            self.once(0.5, lambda: self.sleep(3.0))

    class Short(LoggedNode):
        def __init__(self) -> None:
            super().__init__("short")
            self.once(1.0, lambda: self.sleep(0.5))

    return [Process((Long,)), Process((Short,))]


@case(2.4, global_order=True)
def timers_due_together() -> list[Process]:
    """Timers that are due together all run before a message that the first of them published."""

    class Node1(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            self.publisher = self.create_publisher(Int32, "number", 10)
            self.hear("number")
            for number, period in enumerate((1.0, 1.0, 0.5), start=1):
                self.create_timer(period, lambda number=number: self.publish(number))

        def publish(self, number: int) -> None:
            self.note(f"timer {number}")
            self.publisher.publish(Int32(data=number))

    return [Process((Node1,))]


class BurstListener(LoggedNode):
    """Subscribes in another order than the topics are published in."""

    def __init__(self) -> None:
        super().__init__("listener")
        for topic in ("c", "b", "a"):
            self.hear(topic)


class BurstTalker(LoggedNode):
    """Publishes to three topics."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.talkers = {name: self.create_publisher(Int32, name, 10) for name in "abc"}
        self.once(1.0, self.burst)

    def burst(self) -> None:
        for number, topic in enumerate("abcaab", start=1):
            self.note(f"publishes {number} to {topic}")
            self.talkers[topic].publish(Int32(data=number))


@case(2.4)
def burst_to_a_sleeping_process() -> list[Process]:
    """The same when the messages waited while a callback slept."""

    class SleepingListener(BurstListener):
        def __init__(self) -> None:
            super().__init__()
            self.once(0.6, lambda: self.sleep(1.0))

    return [Process((BurstTalker,)), Process((SleepingListener,))]


@case(2.9)
def order_of_kinds_after_a_sleep() -> list[Process]:
    """After a sleep: timers, messages, responses, requests, whatever was created first."""

    class Busy(AddingNode):
        def __init__(self) -> None:
            super().__init__("busy")
            self.service = self.create_service(BasicTypes, "own", self.answer)
            self.hear("number")
            self.once(0.4, self.call_and_sleep)
            self.once(1.1, lambda: self.note("timer"))

        def answer(self, _: Any, response: BasicTypes.Response) -> BasicTypes.Response:
            self.note("request")
            return response

        def call_and_sleep(self) -> None:
            future = self.client.call_async(sum_of(1, 2))
            future.add_done_callback(lambda done: self.note_response(done.result()))
            self.sleep(1.6)

    class Asker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.client = self.create_client(BasicTypes, "own")
            self.publish_at(0.8, "number", 7)
            self.once(1.2, self.ask)

        def ask(self) -> None:
            self.note("asks")
            self.client.call_async(BasicTypes.Request())

    return [Process((Busy,)), Process((Asker,)), Process((Adder,))]


@case(3.4)
def period_shorter_than_the_callback() -> list[Process]:
    """A timer that misses periods runs once for all of them, and then goes on on its grid."""

    class Slow(LoggedNode):
        def __init__(self) -> None:
            super().__init__("slow")
            self.create_timer(0.5, lambda: self.sleep(1.2))

    return [Process((Slow,))]


@case(3.2)
def timer_cancelled_and_reset() -> list[Process]:
    """A timer that is reset begins a new period there."""

    class Switch(LoggedNode):
        def __init__(self) -> None:
            super().__init__("switch")
            self.timer = self.every(0.4)
            self.once(1.0, lambda: (self.note("cancel"), self.timer.cancel()))
            self.once(1.75, lambda: (self.note("reset"), self.timer.reset()))

    return [Process((Switch,))]


@case(2.3)
def timer_destroyed_by_the_one_before() -> list[Process]:
    """A timer that is destroyed by another that was due with it does not run."""

    class Pair(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pair")
            self.once(1.0, self.destroy)
            self.second = self.create_timer(1.0, lambda: self.note("second"))
            self.third = self.create_timer(1.0, lambda: self.note("third"))

        def destroy(self) -> None:
            self.note("destroys the second")
            self.destroy_timer(self.second)

    return [Process((Pair,))]


@case(3.4)
def timer_period_changed() -> list[Process]:
    """A new period counts from the next call on."""

    class Change(LoggedNode):
        def __init__(self) -> None:
            super().__init__("change")
            self.timer = self.every(0.5)
            self.once(1.2, self.change)

        def change(self) -> None:
            self.note("changes")
            self.timer.timer_period_ns = 800_000_000

    return [Process((Change,))]


@case(1.9)
def timer_on_a_steady_clock() -> list[Process]:
    """A timer on a clock of its own."""

    class Steady(LoggedNode):
        def __init__(self) -> None:
            super().__init__("steady")
            self.clock = Clock(clock_type=ClockType.STEADY_TIME)
            self.create_timer(0.5, lambda: self.note("beat"), clock=self.clock)

    return [Process((Steady,))]


@case(2.6)
def timer_due_while_messages_are_handled() -> list[Process]:
    """What becomes ready while an executor works off what was ready waits until that is done."""

    class Busy(LoggedNode):
        def __init__(self) -> None:
            super().__init__("busy")
            for topic in "abc":
                self.create_subscription(Int32, topic, partial(self.on_number, topic), 10)
            self.once(0.4, lambda: self.sleep(0.5))
            self.once(1.05, lambda: self.note("timer"))

        def on_number(self, topic: str, message: Int32) -> None:
            self.sleep(0.3, f"{topic} {message.data}")

    class Talker(LoggedNode):
        def __init__(self) -> None:
            super().__init__("talker")
            for number, topic in enumerate("aabc"):
                self.publish_at(0.5 + 0.05 * number, topic, number)

    # Awake at 0.9: a 0.9-1.2, b 1.2-1.5, c 1.5-1.8, then the timer, then a 1.8-2.1.
    return [Process((Busy,)), Process((Talker,))]


@case(2.6)
def node_destroyed_in_a_callback() -> list[Process]:
    """A node that another one of its process destroys is silent; the process goes on."""
    made: list[LoggedNode] = []

    class Victim(LoggedNode):
        def __init__(self) -> None:
            super().__init__("victim")
            made.append(self)
            self.hear("number")
            self.every(0.4)

    class Destroyer(LoggedNode):
        def __init__(self) -> None:
            super().__init__("destroyer")
            self.publish_at(0.5, "number", 1)
            self.publish_at(1.5, "number", 2)
            self.once(1.05, lambda: (self.note("destroys"), made[-1].destroy_node()))

    return [Process((Victim, Destroyer))]


@case(2.4, global_order=True)
def threads_default_group() -> list[Process]:
    """Two callbacks of a node's default group do not overlap, however many threads there are."""

    class Pair(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pair")
            self.once(0.5, lambda: self.sleep(0.8, "first"))
            self.once(0.9, lambda: self.sleep(0.6, "second"))

    return [Process((Pair,), threads=4)]


@case(2.4, global_order=True)
def threads_two_groups() -> list[Process]:
    """Two callbacks in two groups overlap."""

    class Pair(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pair")
            groups = [MutuallyExclusiveCallbackGroup() for _ in range(2)]
            self.once(0.5, lambda: self.sleep(0.8, "first"), groups[0])
            self.once(0.9, lambda: self.sleep(0.8, "second"), groups[1])

    return [Process((Pair,), threads=4)]


@case(3.5, global_order=True)
def threads_reentrant_timer() -> list[Process]:
    """A timer in a reentrant group overlaps itself."""

    class Reentrant(LoggedNode):
        def __init__(self) -> None:
            super().__init__("reentrant")
            self.group = ReentrantCallbackGroup()
            self.runs = 0
            self.timer = self.create_timer(0.7, self.run, self.group)

        def run(self) -> None:
            self.runs += 1
            if self.runs == 3:
                self.timer.cancel()
            self.sleep(1.0, f"run {self.runs}")

    # 0.7-1.7, 1.4-2.4, 2.1-3.1.
    return [Process((Reentrant,), threads=4)]


@case(4.0, global_order=True)
def threads_more_ready_than_threads() -> list[Process]:
    """What finds no free thread waits for one, in the order in which it became ready."""

    class Four(LoggedNode):
        def __init__(self) -> None:
            super().__init__("four")
            group = ReentrantCallbackGroup()
            for number in range(4):
                self.once(
                    0.4 + 0.3 * number,
                    lambda number=number: self.sleep(1.35, f"run {number + 1}"),
                    group,
                )

    # Two threads: 0.4-1.75, 0.7-2.05, then 1.75-3.1, 2.05-3.4.
    return [Process((Four,), threads=2)]


class Raising(LoggedNode):
    """Raises in its third callback."""

    def __init__(self) -> None:
        super().__init__("raising")
        self.create_timer(0.5, self.count)
        self.number = 0

    def count(self) -> None:
        self.number += 1
        self.note(f"count {self.number}")
        if self.number == 3:
            raise ValueError("three is too many")


@case(2.7)
def exception_with_two_nodes() -> list[Process]:
    """An exception ends the whole process, with all its nodes, and other processes go on."""
    return [Process((Raising, Beat)), Process((other_beat,))]


@case(3.2, differs="In rclpy, a thread of the pool still runs what was just handed out.")
def exception_with_threads() -> list[Process]:
    """With threads the exception comes to light when the next callback is handed out."""

    class Other(LoggedNode):
        def __init__(self) -> None:
            super().__init__("other")
            self.every(0.7)

    # Raised at 1.5; the next callback of the process is the other's at 2.1.
    return [Process((Raising, Other), threads=4)]


@case(2.4)
def exception_in_a_service() -> list[Process]:
    """An exception in a service callback ends the server; the client waits."""

    class Refusing(LoggedNode):
        def __init__(self) -> None:
            super().__init__("adder")
            self.create_service(BasicTypes, "add", self.add)
            self.every(0.4)

        def add(self, request: Any, response: Any) -> Any:
            self.note("raises")
            raise ValueError("no sums today")

    class Asker(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker")
            self.every(0.7)
            self.once(0.9, self.ask)

        def ask(self) -> None:
            self.note("asks")
            future = self.client.call_async(sum_of(1, 1))
            future.add_done_callback(lambda done: self.note_response(done.result()))

    return [Process((Asker,)), Process((Refusing,))]


@case(2.4)
def await_a_future_of_a_timer() -> list[Process]:
    """An async callback awaits a future that a timer of another group completes."""

    class Awaiting(LoggedNode):
        def __init__(self) -> None:
            super().__init__("awaiting")
            self.future = Future()
            self.once(0.5, self.wait)
            self.once(1.2, self.complete, MutuallyExclusiveCallbackGroup())

        async def wait(self) -> None:
            self.note("awaits")
            self.note(f"result {await self.future}")

        def complete(self) -> None:
            self.note("completes")
            self.future.set_result(7)

    return [Process((Awaiting,))]


@case(2.4)
def task_of_an_executor() -> list[Process]:
    """A task that a callback hands to its executor runs before what else is ready."""

    class Tasked(LoggedNode):
        def __init__(self) -> None:
            super().__init__("tasked")
            self.once(0.5, self.hand_over)
            self.once(0.8, lambda: self.note("timer"))

        def hand_over(self) -> None:
            self.executor.create_task(lambda: self.note("first task"))
            self.executor.create_task(lambda: self.note("second task"))
            self.sleep(0.7)

    return [Process((Tasked,))]


@case(1.8)
def guard_condition() -> list[Process]:
    """A guard condition that a callback triggers twice calls back once."""

    class Guarded(LoggedNode):
        def __init__(self) -> None:
            super().__init__("guarded")
            self.guard = self.create_guard_condition(lambda: self.note("guard"))
            self.once(0.6, self.trigger)

        def trigger(self) -> None:
            self.note("triggers twice")
            self.guard.trigger()
            self.guard.trigger()

    return [Process((Guarded,))]


@case(2.6)
def subscription_destroyed_in_its_callback() -> list[Process]:
    """A subscription that its own callback destroys gets nothing more, not even what is queued."""

    class Once(LoggedNode):
        def __init__(self) -> None:
            super().__init__("once")
            self.subscription = self.create_subscription(Int32, "number", self.on_number, 10)
            self.once(0.5, lambda: self.sleep(0.7))

        def on_number(self, message: Int32) -> None:
            self.note(f"number {message.data}")
            self.destroy_subscription(self.subscription)

    return [Process((Burst,)), Process((Once,))]
