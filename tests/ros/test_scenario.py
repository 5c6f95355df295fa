import os
import re
import signal
import threading
import time
from functools import partial

import pytest
import rclpy
from rcl_interfaces.msg import SetParametersResult
from rclpy.node import Node
from std_msgs.msg import Float32, Int32

import failing_answers  # answers that go wrong in every way
from rosbeat.ros.scenario import Add, Pause, Publish, Remove, Resume, SetParameter, observe
from rosbeat.ros.test_nodes import feeder

pytestmark = pytest.mark.ros


class Echo(Node):
    def __init__(self):
        super().__init__("echo")
        self.heard = self.create_publisher(Float32, "echo", 10)
        self.create_subscription(Float32, "in", self.heard.publish, 10)


class MakesAnew(Node):
    """Makes something at each call, or without end in one."""

    def __init__(self, make, endless=False):
        super().__init__("maker")
        self.make, self.endless = make, endless
        self.create_timer(0.001, self.tick)

    def tick(self):
        self.make(self)
        while self.endless:
            self.make(self)


@pytest.mark.parametrize(("what", "make"), [
    ("publishers on /level", lambda self: self.create_publisher(Int32, "level", 10)),
    ("subscriptions to /level", lambda self: self.create_subscription(Int32, "level", print, 10)),
    ("timers", lambda self: self.create_timer(0.001, self.tick)),
])  # fmt: skip
def test_what_is_made_at_each_call_is_told_from_a_callback_that_does_not_return(what, make):
    fault = observe(partial(MakesAnew, make), 10_000, deadline=1.5).faults[-1]
    assert (fault.kind, fault.callback) == ("DeadlinePassed", "tick")
    assert re.fullmatch(rf"\d+ {what} in \d+ calls", fault.text)


class Busy(Node):
    """Takes some wall time at each call, as code does on a machine that is busy."""

    def __init__(self, calls, seconds):
        super().__init__("busy")
        self.left, self.seconds = calls, seconds
        self.create_timer(0.001, self.tick)

    def tick(self):
        self.left -= 1
        end = time.monotonic() + self.seconds
        while time.monotonic() < end and self.left >= 0:
            pass


def test_what_is_slow_for_ever_is_not_said_to_be_endless():
    fault = observe(partial(Busy, 10_000, 0.05), 10, deadline=1).faults[-1]
    assert re.fullmatch(r"\d+ calls of callbacks took \d+ s", fault.text)
    assert fault.callback == "tick"


def test_a_function_an_instance_and_a_name_that_somebody_has(ros):
    feed = feeder("echo", "in", "std_msgs/msg/Float32", [1.0, 2.0])
    for answer in (Echo, lambda: Echo(), ros.add(Echo)):
        seen = observe(answer, 3, others=[feed])
        assert [s.value for s in seen.samples if s.topic == "/echo"] == [1.0, 2.0], answer
        assert not seen.faults


class Dialled(Echo):
    """Has a parameter that may not be negative."""

    def __init__(self):
        super().__init__()
        self.declare_parameter("gain", 1.0)
        self.add_on_set_parameters_callback(self.check)

    def check(self, parameters):
        gain = parameters[0].value
        if gain == 13.0:
            raise RuntimeError("unlucky")
        return SetParametersResult(successful=gain >= 0, reason="negative")


def steps_of(seen):
    return [(c.time, c.node, c.name, c.source) for c in seen.callbacks if c.kind == "step"]


def test_steps_are_done_at_their_times():
    steps = [
        Resume(at=4),
        Publish(at=1, topic="in", values=(1.0, 2.0)),
        Pause(at=2),
        Publish(at=3, topic="in", values=(3.0,)),
        SetParameter(at=5, name="gain", value=2.0),
        SetParameter(at=5.5, name="gain", value=-2.0),
        SetParameter(at=6, name="volume", value=1),
        Add(at=6, make=lambda: Node("other")),
        Remove(at=7),
        Pause(at=8, node="nobody"),
    ]
    seen = observe(Dialled, 9, steps=steps)
    assert not seen.faults
    echoed = [(s.time, s.value) for s in seen.samples if s.topic == "/echo"]
    assert echoed == [(1, 1.0), (1, 2.0), (4, 3.0)]
    assert steps_of(seen) == [
        (1, "/tester", "Publish", "in"),
        (2, "/echo", "Pause", ""),
        (3, "/tester", "Publish", "in"),
        (4, "/echo", "Resume", ""),
        (5, "/echo", "SetParameter", "gain: accepted"),
        (5.5, "/echo", "SetParameter", "gain: refused, negative"),
        (6, "/echo", "SetParameter", "volume: refused, not declared"),
        (7, "/echo", "Remove", ""),
        (8, "nobody", "Pause", "no such node"),
    ]
    assert seen.graph.nodes == ("/tester", "/other")
    assert seen.subject == "/echo"


def test_an_exception_while_a_parameter_is_set_ends_the_node():
    seen = observe(Dialled, 3, steps=[SetParameter(at=1, name="gain", value=13.0)])
    fault = seen.faults[0]
    assert (fault.node, fault.callback, fault.kind) == ("/echo", "set_parameters", "RuntimeError")


class Sleeper(Echo):
    """Sleeps in its callback, as it is told to."""

    def __init__(self):
        super().__init__()
        self.create_timer(1.0, self.tick)
        self.create_subscription(Float32, "nap", lambda msg: time.sleep(msg.data), 10)

    def tick(self):
        self.get_logger().info("tick")


def test_a_node_that_sleeps_in_a_callback_is_late_and_the_others_go_on(slept):
    feeds = [
        feeder("f", "in", "std_msgs/msg/Float32", [float(n) for n in range(1, 8)]),
        feeder("g", "nap", "std_msgs/msg/Float32", [2.5], period=1.5),
    ]
    seen = observe(Sleeper, 6, others=feeds)
    again = observe(Sleeper, 6, others=feeds)
    assert not seen.faults
    assert [s.time for s in seen.samples if s.topic == "/in"] == [1, 2, 3, 4, 5, 6]
    # It sleeps from 1.5 s to 4 s; what came meanwhile is answered then.
    echoed = [(s.time, s.value) for s in seen.samples if s.topic == "/echo"]
    assert echoed == [(1, 1), (4, 2), (4, 3), (4, 4), (5, 5), (6, 6)]
    assert [log.time for log in seen.logs] == [1, 4, 5, 6]
    assert seen == again
    assert 2.5 not in slept


def test_short_sleeps_take_no_time_and_endless_ones_are_faults():
    class Slow(Echo):
        def __init__(self, seconds=0.5):
            time.sleep(seconds)
            super().__init__()
            self.create_timer(1.0, lambda: self.heard.publish(Float32(data=1.0)))
            self.create_timer(1.0, lambda: time.sleep(0.25))

    seen = observe(Slow, 4)
    assert not seen.faults
    assert [s.time for s in seen.samples] == [1, 2, 3, 4]
    for answer in (lambda: Slow(1000), lambda: Slow(4.5)):
        (fault,) = observe(answer, 4).faults
        assert (fault.kind, fault.callback) == ("DeadlinePassed", "__init__")
        assert fault.text == "still asleep after 4 s"
        assert fault.code == "time.sleep(seconds)"


@pytest.mark.parametrize("case", failing_answers.ENDLESS)
def test_what_never_ends_is_ended(case):
    # Long enough for the node to be made on a busy machine, so that it ends where it never ends.
    seen = observe(failing_answers.ENDLESS[case], 5, deadline=0.8)
    fault = seen.faults[0]
    at_birth = case in failing_answers.AT_BIRTH
    if case in failing_answers.DEADLOCKED:
        assert (fault.kind, fault.callback) == ("DeadlockError", "beat")
        assert_all_is_well()
        return
    assert (fault.kind, fault.callback) == ("DeadlinePassed", "__init__" if at_birth else "beat")
    assert fault.node == ("" if at_birth else "/nasty")
    text = "still spinning after 5 s" if "executor" in case else "still running after 0.8 s"
    assert fault.text == text
    assert fault.code
    assert fault.line
    assert_all_is_well()


@pytest.mark.parametrize("case", failing_answers.RAISING)
def test_what_raises_is_a_fault(case):
    answer, kind = failing_answers.RAISING[case]
    seen = observe(answer, 5)
    assert [fault.kind for fault in seen.faults] == [kind]
    assert_all_is_well()


@pytest.mark.parametrize("case", failing_answers.HARMLESS)
def test_what_does_no_harm_is_no_fault(case):
    seen = observe(failing_answers.HARMLESS[case], 5)
    assert not seen.faults
    assert [s.time for s in seen.samples] == BEATS
    assert_all_is_well()
    for thread in [one for one in threading.enumerate() if one.name == "nasty"]:
        thread.join()  # what it prints meanwhile is for no other test


def test_a_function_may_start_ros_before_it_makes_its_node():
    def main():
        rclpy.init()
        return failing_answers.Base()

    seen = observe(main, 5)
    assert not seen.faults
    assert [s.time for s in seen.samples] == BEATS


BEATS = [n / 2 for n in range(1, 11)]


def assert_all_is_well():
    seen = observe(failing_answers.Base, 5)
    assert [s.time for s in seen.samples] == BEATS
    assert (seen.faults, seen.printed) == ((), 0)
    assert sum([1, 2]) == 3


def test_interrupt_in_an_observation_is_an_interrupt():
    press = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    press.start()
    with pytest.raises(KeyboardInterrupt):
        observe(failing_answers.ENDLESS["loop that catches everything"], 5, deadline=60)
    press.join()
    assert_all_is_well()


def test_what_a_thread_publishes_is_seen():
    class Threaded(Echo):
        def __init__(self):
            super().__init__()
            self.create_timer(1.0, self.begin)

        def begin(self):
            thread = threading.Thread(target=self.heard.publish, args=(Float32(data=1.0),))
            thread.start()
            thread.join()

    seen = observe(Threaded, 3)
    assert [(s.time, s.topic, s.value) for s in seen.samples] == [
        (n, "/echo", 1.0) for n in (1, 2, 3)
    ]
