"""Threads of a node and what they wait for take virtual time, and nothing false is said of them."""

import sys
import threading
import time
from queue import Queue
from types import SimpleNamespace

import pytest
import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node
from std_msgs.msg import Float32, String

from nodes import SECOND, since_start
from rosbeat import Session as PageSession
from rosbeat.errors import NodeConstructionError
from rosbeat.ros.session import Session

LOCK = threading.Lock()


@pytest.fixture
def engine():
    """Give a session as ROS developers have it, without what pages add."""
    with Session() as session:
        yield session


class Worker(Node):
    """Hands what it hears to a thread, which works on each for half a second."""

    def __init__(self):
        super().__init__("worker")
        self.orders, self.done = Queue(), []
        self.create_subscription(Float32, "order", self.orders.put, 10)
        threading.Thread(target=self.work, daemon=True).start()

    def work(self):
        while True:
            order = self.orders.get()
            time.sleep(0.5)
            self.done.append((since_start(self), order.data))


def test_a_thread_that_waits_for_work_is_no_deadlock(ros):
    worker = ros.add(Worker)
    publisher = worker.create_publisher(Float32, "order", 10)
    publisher.publish(Float32(data=1.0))
    publisher.publish(Float32(data=2.0))
    ros.run(5)
    assert worker.done == [(SECOND // 2, 1.0), (SECOND, 2.0)]
    assert ros.observation().faults == ()
    assert ros.observation().waits == ()


def test_a_lock_of_a_module_holds_up_the_second_callback_only(ros):
    class Sharing(Node):
        def __init__(self):
            super().__init__("sharing")
            group = ReentrantCallbackGroup()
            self.create_timer(1.0, lambda: self.hold(0.5), group)
            self.create_timer(1.0, lambda: self.hold(0.0), group)
            self.create_timer(0.6, lambda: None, group)
            self.held = []

        def hold(self, seconds):
            with LOCK:
                time.sleep(seconds)
                self.held.append(since_start(self) / SECOND)

    node = ros.add(Sharing, threads=3)
    ros.run(2.9)
    assert node.held == [1.5, 1.5, 2.5, 2.5]
    assert type(LOCK).__name__ == "lock"  # it is Python's own again


@pytest.mark.parametrize(
    "clock",
    [lambda node: node.get_clock().now().nanoseconds / 1e9, lambda _: time.monotonic()],
    ids=["its own", "Python's"],
)
def test_a_loop_on_a_clock_lets_time_pass(ros, clock):
    class Busy(Node):
        def __init__(self):
            super().__init__("busy")
            self.create_timer(1.0, self.work)
            self.ended = []

        def work(self):
            end = clock(self) + 0.5
            while clock(self) < end:
                pass
            self.ended.append(round(since_start(self) / SECOND, 2))

    node = ros.add(Busy)
    ros.run(2.8)
    assert node.ended == pytest.approx([1.5, 2.5], abs=0.01)


def test_the_executor_that_waits_in_c_is_refused(ros, says):
    def main():
        rclpy.init()
        rclpy.experimental.EventsExecutor()

    program = ros.spawn(main)
    assert program.returncode == 1
    assert "SessionError: A session cannot run an EventsExecutor." in program.stderr
    assert "What to try:" in program.stderr


def test_exit_in_a_kernel_ends_the_process_of_the_node(ros, monkeypatch):
    """In a kernel `exit` only asks the shell to end, after the cell."""
    asked = []
    shell = SimpleNamespace(ask_exit=lambda: asked.append(True))
    python = SimpleNamespace(get_ipython=lambda: shell)
    monkeypatch.setitem(sys.modules, "IPython", python)

    class Leaving(Node):
        def __init__(self):
            super().__init__("leaving")
            self.create_timer(1.0, lambda: shell.ask_exit())
            self.create_timer(1.5, lambda: asked.append("it goes on"))

    ros.add(Leaving)
    ros.run(3)
    assert asked == []
    (fault,) = ros.observation().faults
    assert (fault.node, fault.kind, fault.time) == ("/leaving", "SystemExit", 1)
    shell.ask_exit()
    assert asked == [True]


def number(type_, data):
    class Number(Node):
        def __init__(self):
            super().__init__("number")
            self.heard = []
            self.create_subscription(type_, "number", lambda msg: self.heard.append(msg.data), 10)
            publisher = self.create_publisher(type_, "number", 10)
            self.create_timer(1.0, lambda: publisher.publish(type_(data=data)))

    return Number


def test_two_processes_may_have_one_name_and_two_types_of_one_topic(engine):
    nodes = [engine.add(number(Float32, 1.0)), engine.add(number(String, "one"))]
    engine.run(2)
    assert [node.heard for node in nodes] == [[1.0, 1.0], ["one", "one"]]
    assert [sample.type_name for sample in engine.messages("number")] == [
        "std_msgs/msg/Float32", "std_msgs/msg/String",
    ] * 2  # fmt: skip
    assert len(engine.graph().on("/number", "publisher")) == 2


def test_a_page_replaces_a_node_of_the_same_name_and_refuses_a_second_type():
    with PageSession() as page:
        first = page.add(number(Float32, 1.0))
        page.add(number(Float32, 2.0))
        page.run(1)
        assert first.heard == []
        with pytest.raises(NodeConstructionError, match="already exists with another"):
            page.add(lambda: Node("other").create_subscription(String, "number", print, 10).node)


@pytest.mark.parametrize("end", ["publisher", "subscription"])
def test_an_endpoint_that_is_destroyed_by_itself_ends_its_process_only(engine, end, capsys):
    class Destroyer(Node):
        def __init__(self):
            super().__init__("destroyer")
            self.publisher = self.create_publisher(Float32, "a", 10)
            self.subscription = self.create_subscription(Float32, "b", print, 10)
            self.create_timer(1.0, lambda: getattr(self, end).destroy())

    engine.add(Destroyer)
    other = engine.add(number(Float32, 1.0))
    engine.run(3)
    assert other.heard == [1.0] * 3
    (fault,) = engine.observation().faults
    assert (fault.node, fault.kind) == ("/destroyer", "InvalidHandle")
