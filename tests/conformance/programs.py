"""Small programs that run against the wall clock and in virtual time, and do the same in both.

A case is a function that returns its processes; its docstring says what there is to see. Nodes
write what they do with `LoggedNode.note`. What has to come in order lies at least 0.1 s apart, or
follows from what came before it in the same process, so that rclpy's own executors give the same
sequence in every run.

This file is imported by both sides, so it does not import rosbeat, which patches rclpy.
"""

from __future__ import annotations

import inspect
import json
import os
import re
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.timer import Timer
from std_msgs.msg import Int32
from test_msgs.srv import BasicTypes

MakeNode = Callable[[], Node]


@dataclass(frozen=True)
class Process:
    """A process of a case: nodes and the executor that spins them, or a `main` of its own.

    Attributes:
        nodes: What makes its nodes, in order.
        threads: 1 for a SingleThreadedExecutor, more for a MultiThreadedExecutor.
        start: When it is started, in seconds.
        main: What it runs instead.
    """

    nodes: tuple[MakeNode, ...] = ()
    threads: int = 1
    start: float = 0.0
    main: Callable[[], None] | None = None


@dataclass(frozen=True)
class Case:
    """A program, and how it is compared.

    Attributes:
        name: The name of the function that returned its processes.
        about: What there is to see.
        processes: Its processes.
        seconds: How long it runs; nothing happens in the last tenth of a second.
        tolerance: How far the times of an event may lie apart, in seconds.
        global_order: Whether the order of all events is defined, and not only that of each node.
        from_first: Whether times count from the first event: two processes may need a second to
            find each other when one of them starts while the case runs.
        misfits: Whether it has endpoints that do not fit each other, and never find each other.
        logs: Whether the log lines of its processes are compared, too: those of nodes, of loggers
            that no node made, and rclpy's own.
        in_kernel: Whether the session runs within a running event loop, as in a notebook.
        differs: Why virtual time does something else, on purpose.
    """

    name: str
    about: str
    processes: tuple[Process, ...]
    seconds: float
    tolerance: float = 0.15
    global_order: bool = False
    from_first: bool = False
    misfits: bool = False
    logs: bool = False
    in_kernel: bool = False
    differs: str = ""


@dataclass(frozen=True)
class Entry:
    """A line of a node's log.

    Attributes:
        time: Seconds since the case began, by the node's own clock.
        node: The node's name; `main 2` for the end of the third process, and `log listener` for
            what a logger wrote.
        text: What it did.
    """

    time: float
    node: str
    text: str


@dataclass
class Journal:
    """Where the nodes of this process write what they do.

    Attributes:
        entries: Nanoseconds of the node's own clock, its name, and the text.
        file: A file that is given each entry at once, so that it outlives a process that is killed.
        now: The time, in nanoseconds, where there is no node to ask.
    """

    entries: list[tuple[int, str, str]] = field(default_factory=list)
    file: int | None = None
    now: Callable[[], int] = time.time_ns

    def write(self, nanoseconds: int, node: str, text: str) -> None:
        """Add an entry; may be called from any thread."""
        self.entries.append((nanoseconds, node, text))
        if self.file is not None:
            os.write(self.file, json.dumps([nanoseconds, node, text]).encode() + b"\n")


JOURNAL = Journal()

#: How far times may lie apart where a `main` calls `rclpy.init` after the case has begun.
START_OF_MAIN = 0.4

CASES: dict[str, Case] = {}


Build = Callable[[], list[Process]]


def case(seconds: float, **options: Any) -> Callable[[Build], Build]:
    """Add what a function returns to the cases; see `Case` for the options."""

    def register(build: Build) -> Build:
        about = inspect.cleandoc(build.__doc__ or "")
        processes = tuple(build())
        if any(process.main is not None for process in processes):
            options.setdefault("tolerance", START_OF_MAIN)
        CASES[build.__name__] = Case(build.__name__, about, processes, seconds, **options)
        return build

    return register


#: The line of rcl's C code that noticed an error.
_PLACE_IN_C = re.compile(r", at \S+:\d+$")


def run_main(number: int, main: Callable[[], Any]) -> None:
    """Run the `main` of a process, and write down how it ends, unless it is killed."""
    text = "returns"
    try:
        main()
    except BaseException as error:
        text = "" if type(error).__name__ == "GreenletExit" else "raises " + error_line(error)
        raise
    finally:
        if text:
            JOURNAL.write(JOURNAL.now(), f"main {number}", text)


def error_line(error: BaseException) -> str:
    """Return the last line of an exception's traceback."""
    line = traceback.format_exception_only(type(error), error)[-1].strip()
    return _PLACE_IN_C.sub("", line)


def wait_until(has_found: Callable[[], object]) -> None:
    """Wait until a `main` that has just begun has found another process; in virtual time it has."""
    while not has_found():
        time.sleep(0.01)


def work_for_a_while() -> None:
    """Keep the processor busy for longer than a busy machine is late; it takes no virtual time."""
    end = time.thread_time() + 0.07
    while time.thread_time() < end:
        pass


class LoggedNode(Node):
    """A node that writes down what it does."""

    def note(self, text: str) -> None:
        """Write a line with the time of the node's own clock."""
        JOURNAL.write(self.get_clock().now().nanoseconds, self.get_name(), text)

    def once(
        self, seconds: float, callback: Callable[[], Any], group: CallbackGroup | None = None
    ) -> Timer:
        """Call back once, after some seconds."""
        if inspect.iscoroutinefunction(callback):

            async def run_async() -> None:
                timer.cancel()
                await callback()

            timer = self.create_timer(seconds, run_async, group)
        else:

            def run() -> None:
                timer.cancel()
                callback()

            timer = self.create_timer(seconds, run, group)
        return timer

    def sleep(self, seconds: float, name: str = "sleep") -> None:
        """Sleep as a callback would, with a line before and after."""
        self.note(f"{name} begins")
        time.sleep(seconds)
        self.note(f"{name} ends")

    def every(
        self, seconds: float, name: str = "beat", group: CallbackGroup | None = None
    ) -> Timer:
        """Write a numbered line each period."""
        count = 0

        def beat() -> None:
            nonlocal count
            count += 1
            self.note(f"{name} {count}")

        return self.create_timer(seconds, beat, group)

    def publish_at(self, seconds: float, topic: str, *numbers: int) -> None:
        """Publish numbers, one after the other, after some seconds."""
        publisher = self.create_publisher(Int32, topic, 10)

        def publish() -> None:
            for number in numbers:
                self.note(f"publishes {number}")
                publisher.publish(Int32(data=number))

        self.once(seconds, publish)

    def hear(self, topic: str, qos: QoSProfile | int = 10, **options: Any) -> Any:
        """Write down each number that comes."""
        return self.create_subscription(
            Int32, topic, lambda message: self.note(f"{topic} {message.data}"), qos, **options
        )


class Beat(LoggedNode):
    """Beats five times a second."""

    def __init__(self, name: str = "beat") -> None:
        super().__init__(name)
        self.every(0.2)


def other_beat() -> Beat:
    """Make a node that beats in another process."""
    return Beat("other")


class Burst(LoggedNode):
    """Publishes five numbers at 0.9 s, and one at 2.3 s."""

    def __init__(self) -> None:
        super().__init__("talker")
        self.publish_at(0.9, "number", 1, 2, 3, 4, 5)
        self.publish_at(2.3, "number", 6)


class Adder(LoggedNode):
    """A server that adds two numbers, as that of the official tutorial."""

    seconds = 0.0

    def __init__(self) -> None:
        super().__init__("adder")
        self.service = self.create_service(BasicTypes, "add", self.add)

    def add(self, request: BasicTypes.Request, response: BasicTypes.Response) -> Any:
        self.note(f"adds {request.int32_value} and {request.int64_value}")
        if self.seconds:
            time.sleep(self.seconds)
            self.note("has added")
        response.int64_value = request.int32_value + request.int64_value
        return response


class AdderOfHalfASecond(Adder):
    """The same, and it takes its time."""

    seconds = 0.5


class AdderOfASecond(Adder):
    """The same, and it takes more time."""

    seconds = 1.0


def sum_of(a: int, b: int) -> BasicTypes.Request:
    """Return the request for a sum."""
    return BasicTypes.Request(int32_value=a, int64_value=b)


class AddingNode(LoggedNode):
    """A node with a client."""

    def __init__(self, name: str, group: CallbackGroup | None = None) -> None:
        super().__init__(name)
        self.client = self.create_client(BasicTypes, "add", callback_group=group)

    def note_response(self, response: BasicTypes.Response | None) -> None:
        self.note("no response" if response is None else f"sum {response.int64_value}")
