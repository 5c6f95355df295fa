"""Cases of what drives an executor, and of what runs in it that is no timer and no message."""

from __future__ import annotations

import asyncio
import sys
import time
from typing import Any

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.task import Future
from std_msgs.msg import Int32
from test_msgs.srv import BasicTypes

from conformance.programs import (
    Adder,
    AddingNode,
    Beat,
    LoggedNode,
    Process,
    case,
    sum_of,
    wait_until,
    work_for_a_while,
)

#: How long the first request of a client may take to a server that has just been found, in seconds.
FIRST_REQUEST = 0.3
#: How much later things may come after work that takes no virtual time, in seconds.
BUSY = 0.6


class Caller(AddingNode):
    """Calls a service of its own process from a timer callback, and waits for the answer."""

    def __init__(self) -> None:
        super().__init__("caller", MutuallyExclusiveCallbackGroup())
        self.service = self.create_service(
            BasicTypes, "add", self.add, callback_group=MutuallyExclusiveCallbackGroup()
        )
        self.called = Future()
        self.once(0.5, self.call)

    def add(self, request: Any, response: Any) -> Any:
        self.note("adds")
        response.int64_value = request.int32_value + request.int64_value
        return response

    def call(self) -> None:
        self.note("calls")
        self.note_response(self.client.call(sum_of(2, 3)))
        self.called.set_result("all is done")


@case(1.6, tolerance=FIRST_REQUEST)
def threads_driven_by_spin_once() -> list[Process]:
    """A MultiThreadedExecutor in a loop around `spin_once` has its threads all the same."""

    def main() -> None:
        rclpy.init()
        node = Caller()
        executor = MultiThreadedExecutor(num_threads=4)
        executor.add_node(node)
        node.note("made")
        while not node.called.done():
            executor.spin_once(timeout_sec=0.2)
        node.note("has been called")

    return [Process(main=main)]


@case(1.6, tolerance=FIRST_REQUEST)
def threads_driven_until_a_future_is_done() -> list[Process]:
    """So it has in `spin_until_future_complete`."""

    def main() -> None:
        rclpy.init()
        node = Caller()
        executor = MultiThreadedExecutor(num_threads=4)
        executor.add_node(node)
        node.note("made")
        executor.spin_until_future_complete(node.called)
        node.note(f"result {node.called.result()}")

    return [Process(main=main)]


@case(1.6, tolerance=FIRST_REQUEST)
def threads_given_to_spin_until_future_complete() -> list[Process]:
    """So it has where `rclpy.spin_until_future_complete` is given the executor."""

    def main() -> None:
        rclpy.init()
        node = Caller()
        executor = MultiThreadedExecutor(num_threads=4)
        node.note("made")
        rclpy.spin_until_future_complete(node, node.called, executor)
        node.note(f"result {node.called.result()}")

    return [Process(main=main)]


@case(1.3)
def task_made_before_spin() -> list[Process]:
    """An executor runs the tasks that it was given before it spins, coroutines too."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("tasked")
        node.every(0.5)
        executor = SingleThreadedExecutor()
        executor.add_node(node)

        async def first() -> str:
            node.note("first task")
            return "first result"

        async def second() -> None:
            node.note(f"second task has the {await first_task}")

        first_task = executor.create_task(first)
        executor.create_task(second)
        executor.create_task(node.note, "third task")
        executor.spin()

    return [Process(main=main)]


@case(1.6)
def task_that_spin_waits_for() -> list[Process]:
    """`spin_until_future_complete` runs the task that it waits for, which awaits a timer."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("tasked")
        done = Future()
        node.once(0.6, lambda: done.set_result(7))
        executor = SingleThreadedExecutor()
        executor.add_node(node)

        async def work() -> int:
            node.note("works")
            result: int = await done
            return 2 * result

        task = executor.create_task(work)
        executor.spin_until_future_complete(task)
        node.note(f"result {task.result()}")

    return [Process(main=main)]


@case(1.6)
def task_of_the_global_executor() -> list[Process]:
    """The global executor has tasks as well."""

    def main() -> None:
        rclpy.init()
        node = Beat()
        task = rclpy.get_global_executor().create_task(lambda: node.note("task"))
        rclpy.spin_until_future_complete(node, task)
        node.note(f"done {task.done()}")

    return [Process(main=main)]


@case(2.4)
def spin_once_until_a_future_is_done() -> list[Process]:
    """`spin_once_until_future_complete` runs one callback, or waits for its timeout."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("looped")
        node.every(0.7)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        future = Future()
        for seconds in (0.4, 1.0, 0.4):
            executor.spin_once_until_future_complete(future, seconds)
            node.note(f"spun once for {seconds} s at most")
        future.set_result(None)
        executor.spin_once_until_future_complete(future, 0.6)
        node.note("spun with a future that is done")

    return [Process(main=main)]


class Asker(AddingNode):
    """Shuts ROS down when the answer has come, as the client of the official action tutorial."""

    def __init__(self) -> None:
        super().__init__("asker")
        self.client.wait_for_service()
        self.every(0.7)
        self.once(0.3, self.ask)

    def ask(self) -> None:
        self.note("asks")
        self.client.call_async(sum_of(2, 3)).add_done_callback(self.answered)

    def answered(self, future: Future) -> None:
        self.note_response(future.result())
        rclpy.shutdown()
        self.note(f"ok {rclpy.ok()}")


@case(2.0, from_first=True)
def shutdown_in_a_done_callback() -> list[Process]:
    """`rclpy.shutdown()` in a done callback ends `spin`, and the program."""

    def main() -> None:
        rclpy.init()
        rclpy.spin(Asker())

    return [Process((Adder,)), Process(main=main)]


@case(1.9)
def shutdown_in_a_guard_condition() -> list[Process]:
    """So it does in a guard condition; a loop that asks `rclpy.ok()` ends."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("guarded")

        def leave() -> None:
            node.note("shuts down")
            rclpy.shutdown()

        guard = node.create_guard_condition(leave)
        node.once(0.6, lambda: (node.note("triggers"), guard.trigger()))
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        while rclpy.ok():
            executor.spin_once()
            node.note("spun once")

    return [Process(main=main), Process((Beat,))]


@case(1.9)
def shutdown_in_a_task() -> list[Process]:
    """So it does in a task that a callback hands to the executor."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("tasked")
        node.every(0.45)

        async def leave() -> None:
            node.note("shuts down")
            rclpy.shutdown()

        node.once(0.6, lambda: node.executor.create_task(leave))
        rclpy.spin(node)

    return [Process(main=main), Process((Beat,))]


@case(2.0)
def surroundings_of_a_task() -> list[Process]:
    """A task, a done callback and a guard condition see the context and `sys.argv` of a program."""

    def main() -> None:
        rclpy.init()
        sys.argv.append("mine")
        node = LoggedNode("tasked")
        context = rclpy.get_default_context()

        def look(name: str) -> None:
            same = rclpy.get_default_context() is context
            node.note(f"{name}: {rclpy.ok()} {same} {sys.argv[-1]}")

        future = Future(executor=rclpy.get_global_executor())
        future.add_done_callback(lambda _: look("done callback"))
        guard = node.create_guard_condition(lambda: look("guard condition"))
        node.once(0.3, lambda: node.executor.create_task(look, "task"))
        node.once(0.6, lambda: future.set_result(None))
        node.once(0.9, guard.trigger)
        rclpy.spin(node)

    return [Process(main=main)]


@case(2.0, from_first=True)
def spin_once_counts_coroutines() -> list[Process]:
    """A coroutine that goes on is what a call of `spin_once` has done."""

    def main() -> None:
        rclpy.init()
        node = AddingNode("asker", ReentrantCallbackGroup())
        answered = []

        async def ask() -> None:
            node.note("asks")
            node.note_response(await node.client.call_async(sum_of(4, 5)))
            answered.append(True)

        node.client.wait_for_service()
        node.once(0.3, ask, node.client.callback_group)
        while not answered:
            rclpy.spin_once(node)
        node.note("has the answer")

    return [Process((Adder,)), Process(main=main)]


@case(2.0)
def spin_once_counts_tasks() -> list[Process]:
    """So is a task, and a guard condition's callback."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("looped")
        guard = node.create_guard_condition(lambda: node.note("guard condition"))
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.create_task(lambda: node.note("task"))
        executor.spin_once(timeout_sec=1.0)
        node.note("spun once")
        guard.trigger()
        executor.spin_once(timeout_sec=1.0)
        node.note("spun once more")

    return [Process(main=main)]


def _asyncio_program(timeout: float) -> Process:
    """Return a program whose `main` is an event loop in which a coroutine spins the node."""

    async def spinning(node: LoggedNode) -> None:
        while rclpy.ok():
            rclpy.spin_once(node, timeout_sec=timeout)
            await asyncio.sleep(0.01)

    async def work(node: LoggedNode) -> None:
        for seconds in (0.5, 0.6):  # between the beats
            await asyncio.sleep(seconds)
            node.note("step")

    async def run() -> None:
        node = Beat("looped")
        spin = asyncio.create_task(spinning(node))
        await work(node)
        spin.cancel()
        node.note("ends")

    def main() -> None:
        rclpy.init()
        asyncio.run(run())

    return Process(main=main)


@case(1.9)
def event_loop_that_polls() -> list[Process]:
    """A program that spins in a coroutine, without waiting, runs, ends, and holds up nobody."""
    return [_asyncio_program(0.0), Process((lambda: Beat("other"),))]


@case(1.9)
def event_loop_that_waits() -> list[Process]:
    """So does one whose `spin_once` waits a little."""
    return [_asyncio_program(0.02), Process((lambda: Beat("other"),))]


@case(2.3, from_first=True)
def event_loop_that_publishes() -> list[Process]:
    """An event loop needs no executor to publish, and other processes hear it."""

    def main() -> None:
        async def publish(node: LoggedNode) -> None:
            publisher = node.create_publisher(Int32, "number", 10)
            wait_until(publisher.get_subscription_count)
            for number in range(3):
                node.note(f"publishes {number}")
                publisher.publish(Int32(data=number))
                await asyncio.sleep(0.3)

        rclpy.init()
        asyncio.run(publish(LoggedNode("talker")))

    class Listener(LoggedNode):
        def __init__(self) -> None:
            super().__init__("listener")
            self.hear("number")

    return [Process(main=main), Process((Listener,))]


class LoopInACallback(LoggedNode):
    """Runs an event loop to its end in a callback."""

    def __init__(self) -> None:
        super().__init__("looped")
        self.every(0.35)
        self.once(0.5, self.run)

    def run(self) -> None:
        async def answer() -> int:
            await asyncio.sleep(0.4)
            return 42

        try:
            asyncio.get_running_loop()
        except RuntimeError as error:
            self.note(f"{error}")
        self.note(f"answer {asyncio.run(answer())}")


@case(1.9, in_kernel=True)
def event_loop_in_a_callback() -> list[Process]:
    """A callback is in no event loop, whatever the kernel is in, so it may run one."""
    return [Process((LoopInACallback,))]


@case(1.3, in_kernel=True)
def event_loop_in_main() -> list[Process]:
    """Nor is `main`."""

    def main() -> None:
        rclpy.init()
        node = LoggedNode("looped")
        node.every(0.5)

        async def look() -> None:
            node.note("in a loop of its own")

        asyncio.run(look())
        loop = asyncio.new_event_loop()
        loop.run_until_complete(look())
        loop.close()
        rclpy.spin(node)

    return [Process(main=main)]


@case(3.35, global_order=True)
def round_in_which_each_sleeps() -> list[Process]:
    """Timers that are due together keep their round when each of them sleeps."""

    class Three(LoggedNode):
        def __init__(self) -> None:
            super().__init__("three")
            for number in range(3):
                self.create_timer(0.3, lambda number=number: self.sleep(0.4, f"timer {number + 1}"))

    return [Process((Three,))]


@case(2.25, global_order=True)
def round_with_two_threads() -> list[Process]:
    """With two threads the third of a round comes next, and not the first once more."""

    class Three(LoggedNode):
        def __init__(self) -> None:
            super().__init__("three")
            group = ReentrantCallbackGroup()
            for number, seconds in enumerate((0.7, 0.9, 0.5), start=1):
                self.create_timer(0.4, lambda n=number, s=seconds: self.work(n, s), group)

        def work(self, number: int, seconds: float) -> None:
            time.sleep(seconds)
            self.note(f"timer {number} has slept")

    # Both threads are busy from 0.4 on; the first is free at 1.1, and takes the third timer.
    return [Process((Three,), threads=2)]


@case(2.85, tolerance=BUSY, global_order=True)
def tie_of_a_timer_that_was_reset() -> list[Process]:
    """Of two timers that are due together, the one that was reset later is later."""

    class Pair(LoggedNode):
        def __init__(self) -> None:
            super().__init__("pair")
            self.first = self.every(1.0, "first")
            self.second = self.every(1.0, "second")
            self.once(0.9, self.reset)

        def reset(self) -> None:
            self.first.cancel()
            self.once(0.1, self.begin_anew)

        def begin_anew(self) -> None:
            work_for_a_while()
            self.first.reset()
            self.note("resets the first")

    # The second at 1.0 and 2.0; the first again at 2.0 and some hundredths.
    return [Process((Pair,))]


@case(2.2, tolerance=BUSY, global_order=True)
def tie_of_a_sleep_and_a_timer() -> list[Process]:
    """So it is with a sleep, and a timer of another process that was made later."""

    class Sleeper(LoggedNode):
        def __init__(self) -> None:
            super().__init__("sleeper")
            self.once(0.5, lambda: self.sleep(0.8))

    class Other(LoggedNode):
        def __init__(self) -> None:
            super().__init__("other")
            self.once(0.5, self.begin)

        def begin(self) -> None:
            work_for_a_while()
            self.once(0.8, lambda: self.note("timer"))

    return [Process((Sleeper,)), Process((Other,))]


@case(2.2, tolerance=BUSY, global_order=True)
def tie_of_a_timer_and_a_sleep() -> list[Process]:
    """And the other way round."""

    class Sleeper(LoggedNode):
        def __init__(self) -> None:
            super().__init__("sleeper")
            self.once(0.5, self.begin)

        def begin(self) -> None:
            work_for_a_while()
            self.sleep(0.8)

    class Other(LoggedNode):
        def __init__(self) -> None:
            super().__init__("other")
            self.once(1.3, lambda: self.note("timer"))

    return [Process((Sleeper,)), Process((Other,))]


@case(2.3)
def spin_once_in_a_callback_of_a_program() -> list[Process]:
    """`rclpy.spin_once` in a callback takes the node away from the program's executor for good."""

    class Spinner(LoggedNode):
        def __init__(self) -> None:
            super().__init__("spinner")
            self.every(0.35)
            self.once(0.9, self.spin)

        def spin(self) -> None:
            self.note("spins")
            rclpy.spin_once(self, timeout_sec=0.05)
            self.note("has spun")

    def main() -> None:
        rclpy.init()
        node, other = Spinner(), LoggedNode("other")
        other.every(0.5)
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        executor.add_node(other)
        executor.spin()

    return [Process(main=main)]


@case(2.4)
def spin_until_in_a_callback_with_threads() -> list[Process]:
    """A callback that spins until its answer has come leaves the server to the other threads."""

    class Nested(AddingNode):
        def __init__(self) -> None:
            super().__init__("asker", ReentrantCallbackGroup())
            self.once(0.6, self.ask)

        def ask(self) -> None:
            self.note("asks")
            future = self.client.call_async(sum_of(1, 2))
            rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)
            self.note_response(future.result())

    return [Process((Adder, Nested), threads=4)]
