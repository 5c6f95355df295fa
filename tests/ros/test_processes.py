"""Nodes that share a process, callbacks that sleep or wait, and deadlocks."""

import gc
import threading
import time
from time import sleep

import numpy as np
import pytest
import rclpy
from greenlet import greenlet
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from std_msgs.msg import Float32, Int32
from std_srvs.srv import Trigger

from rosbeat import Session
from rosbeat.errors import NodeConstructionError, SessionError
from rosbeat.ros.scenario import observe

pytestmark = pytest.mark.ros


class Beat(Node):
    """Says a number each half second."""

    def __init__(self, name="beat", period=0.5):
        super().__init__(name)
        self.pub = self.create_publisher(Int32, name, 10)
        self.create_timer(period, lambda: self.pub.publish(Int32(data=1)))


class Sleeper(Node):
    """Sleeps for 1.2 s in a callback, once, at 1 s."""

    def __init__(self):
        super().__init__("sleeper")
        self.timer = self.create_timer(1.0, self.sleep)

    def sleep(self):
        self.timer.cancel()
        time.sleep(1.2)
        self.get_logger().info("awake")


class Two(Node):
    """Two timers, of 1 s and 1.3 s, whose callbacks sleep for 1 s each, once."""

    def __init__(self, one, other):
        super().__init__("two")
        self.timers_ = [
            self.create_timer(1.0, lambda: self.work(0), one),
            self.create_timer(1.3, lambda: self.work(1), other),
        ]

    def work(self, number):
        self.timers_[number].cancel()
        self.get_logger().info(f"{number} begins")
        time.sleep(1.0)
        self.get_logger().info(f"{number} ends")


def times(ros, topic):
    return [one.time for one in ros.messages(topic)]


def lines(ros):
    return [(line.time, line.text) for line in ros.logs()]


# One process or two.


def test_the_graph_tells_which_nodes_share_a_process(ros):
    ros.add(Sleeper)
    assert ros.graph().processes == ()
    ros.add(Beat, lambda: Beat("other"))
    assert ros.graph().processes == (("/beat", "/other"),)
    assert ros.observation().graph.processes == (("/beat", "/other"),)


def test_waits_are_recorded(ros):
    ros.add(Sleeper)
    ros.run(2)
    (wait,) = ros.observation().waits
    assert (wait.time, wait.until_ns / 1e9) == (1, 2)
    assert (wait.node, wait.callback, wait.reason) == ("/sleeper", "sleep", "sleep")
    ros.run(2)
    (wait,) = ros.observation().waits
    assert wait.until_ns / 1e9 == 2.2


def test_an_exception_ends_all_nodes_of_its_process(ros, capsys):
    def fail():
        raise ValueError("no more")

    def bad():
        node = Node("bad")
        node.create_timer(1.2, fail)
        return node

    ros.add(bad, Beat)
    ros.add(lambda: Beat("other"))
    ros.run(3)
    assert times(ros, "beat") == [0.5, 1]
    assert times(ros, "other")[-1] == 3
    assert "/beat ran in the same process, which has ended." in capsys.readouterr().out


# Deadlocks.


class Asker(Node):
    """Calls a service in a callback, at 1 s."""

    def __init__(self, group=None, timeout=None):
        super().__init__("asker")
        self.client = self.create_client(Trigger, "ask", callback_group=group)
        self.timer = self.create_timer(1.0, self.ask)
        self.timeout = timeout

    def ask(self):
        self.timer.cancel()
        answer = self.client.call(Trigger.Request(), self.timeout)
        self.get_logger().info("nothing" if answer is None else "answered")


class Server(Node):
    """Answers after a sleep of 0.7 s."""

    def __init__(self):
        super().__init__("server")
        self.create_service(Trigger, "ask", self.answer)

    def answer(self, _, response):
        time.sleep(0.7)
        return response


def test_a_deadlock_says_who_waits_for_what_and_the_others_go_on(ros, capsys):
    ros.add(Server)
    ros.add(Asker, Beat)
    ros.add(lambda: Beat("other"))
    ros.run(3)
    (fault,) = ros.observation().faults
    assert (fault.node, fault.callback, fault.kind) == ("/asker", "ask", "DeadlockError")
    assert fault.code == "answer = self.client.call(Trigger.Request(), self.timeout)"
    err = capsys.readouterr().err
    assert "/asker waits in `ask` for a response from /ask, forever." in err
    assert "a deadlock, on a real robot too" in err
    assert times(ros, "beat") == [0.5]
    assert times(ros, "other")[-1] == 3
    ros.run(3)
    assert capsys.readouterr().err == ""  # it is told once


def test_two_that_wait_for_each_other(ros, capsys):
    class Friend(Node):
        def __init__(self, name, other):
            super().__init__(name)
            self.client = self.create_client(
                Trigger, other, callback_group=MutuallyExclusiveCallbackGroup()
            )
            self.create_service(Trigger, name, lambda _, response: response)
            self.timer = self.create_timer(1.0, self.ask)

        def ask(self):
            self.timer.cancel()
            time.sleep(0.1)  # so that both are busy when they ask
            self.client.call(Trigger.Request())

    ros.add(lambda: Friend("one", "other"), threads=2)
    ros.add(lambda: Friend("other", "one"), threads=2)
    ros.run(10)
    (fault,) = ros.observation().faults
    assert "/one waits in `ask` for a response from /other; /other waits in `ask`" in fault.text
    capsys.readouterr()


# Constructors.


def test_a_constructor_that_waits_for_ever_says_so(ros, says):
    class Patient(Node):
        def __init__(self):
            super().__init__("patient")
            client = self.create_client(Trigger, "ask")
            while not client.wait_for_service(timeout_sec=1.0):
                self.get_logger().info("waiting again")

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Patient)
    says(caught.value, "is still waiting after 600 s of virtual time", "ros.spawn")
    assert ros.nodes == ()
    ros.add(Server)
    ros.add(Patient)


# What is left behind.


def all_greenlets():
    gc.collect()
    return [one for one in gc.get_objects() if isinstance(one, greenlet) and not one.dead]


def test_a_session_leaves_no_greenlet_thread_or_patched_function():
    sleep, spin, before = time.sleep, rclpy.spin, len(all_greenlets())
    threads = threading.active_count()
    ended = []

    class Careful(Sleeper):
        def sleep(self):
            try:
                super().sleep()
            finally:
                ended.append(self.get_name())

    for leave in ("close", "interrupt"):
        with Session() as ros:
            ros.add(Careful)
            ros.run(1.5)
            if leave == "interrupt":
                node = ros.add(lambda: Node("stopper"))

                def stop():
                    raise KeyboardInterrupt

                node.create_timer(0.1, stop)
                with pytest.raises(KeyboardInterrupt):
                    ros.run(5)
        del ros
    assert ended == ["sleeper", "sleeper"]
    assert (time.sleep, rclpy.spin) == (sleep, spin)
    assert len(all_greenlets()) == before
    assert threading.active_count() == threads


# Bad input.


@pytest.mark.parametrize("threads", [0, 1.5, True])
def test_threads_have_to_be_a_number(ros, says, threads):
    with pytest.raises(SessionError) as caught:
        ros.add(Beat, threads=threads)
    says(caught.value, "threads=")


def test_add_needs_a_node_and_one_name_for_each(ros, says):
    with pytest.raises(SessionError) as caught:
        ros.add()
    says(caught.value, "was called without a node")
    with pytest.raises(SessionError) as caught:
        ros.add(Beat, Sleeper, name="both")
    says(caught.value, "both")


# Threads of the kernel.


def in_thread(do):
    """Do something in another thread and return what it raised."""
    raised = []

    def run():
        try:
            do()
        except Exception as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join(20)
    assert not thread.is_alive()
    return raised


def test_a_callback_that_waits_goes_on_in_its_own_thread(ros, says):
    ros.add(Sleeper)
    ros.run(1.5)
    (error,) = in_thread(lambda: ros.run(1))
    says(error, "sleep of /sleeper waits")
    ros.run(1)
    assert lines(ros) == [(2.2, "awake")]


# In a cell, and explained.


def test_explain_knows_a_deadlock(capsys):
    class Speaker(Asker):
        def __init__(self):
            super().__init__()
            self.pub = self.create_publisher(Int32, "speech", 10)
            self.create_timer(0.4, lambda: self.pub.publish(Int32(data=1)))

    with Session() as ros:
        ros.add(Server)
        ros.add(Speaker)
        ros.run(5)
        told = str(ros.explain("speech"))
    assert "a callback of /asker has not returned" in told
    capsys.readouterr()


# What is left behind when a cell is run again; and the same every time.


class OwnError(BaseException):
    """An exception that `except Exception` does not catch."""


def raise_own_error():
    raise OwnError


async def raise_own_error_later():
    raise OwnError


@pytest.mark.parametrize("callback", [raise_own_error, raise_own_error_later])
def test_any_exception_of_a_callback_ends_its_process_only(ros, callback):
    class Raising(Node):
        def __init__(self):
            super().__init__("raising")
            self.create_timer(1.0, callback)

    ros.add(Raising)
    ros.add(Beat)
    ros.run(2)
    assert len(ros.messages("beat")) == 4
    (fault,) = ros.observation().faults
    assert (fault.node, fault.kind, fault.time_ns) == ("/raising", "OwnError", 1_000_000_000)


# A sleep in a callback takes virtual time, on a page as in a check.


class Worker(Beat):
    """Beats once a second, and sleeps as long as it is told to."""

    def __init__(self):
        super().__init__("worker", 1.0)
        self.create_subscription(Float32, "order", self.work, 10)

    def work(self, msg):
        time.sleep(msg.data)
        self.get_logger().info("done")


class Boss(Node):
    """Gives one order, of 3 s, at 1.5 s."""

    def __init__(self, seconds=3.0):
        super().__init__("boss")
        self.pub = self.create_publisher(Float32, "order", 10)
        self.timer = self.create_timer(1.5, self.order)
        self.seconds = seconds

    def order(self):
        self.timer.cancel()
        self.pub.publish(Float32(data=self.seconds))


def test_a_page_and_a_check_see_the_same(slept, ros):
    for node in (Boss, Beat, Worker):
        ros.add(node)
    ros.run(seconds=8)
    assert len(times(ros, "beat")) == 16
    assert times(ros, "worker") == [1, 4.5, 5, 6, 7, 8]
    assert [(one.time, one.text) for one in ros.logs()] == [(4.5, "done")]
    seen = observe(Worker, 8, others=[Boss, Beat])
    assert seen.samples == ros.observation().samples
    assert seen.callbacks == ros.observation().callbacks
    assert 3.0 not in slept


def test_every_way_to_sleep_counts(ros):
    def nap(node):
        sleep(1)  # a name of this module
        node.get_clock().sleep_for(Duration(seconds=1))

    node = ros.add(lambda: Node("napper"))
    timer = node.create_timer(1.0, lambda: (timer.cancel(), nap(node), node.get_logger().info("")))
    ros.run(seconds=3)
    assert [one.time for one in ros.logs("napper")] == [3]


def test_a_constructor_sleeps_in_virtual_time_and_the_others_go_on(slept, ros):
    class Slow(Beat):
        def __init__(self):
            time.sleep(2.5)
            super().__init__("slow")

    ros.add(Beat)
    ros.add(Slow)
    assert (ros.time, times(ros, "beat")) == (2.5, [0.5, 1, 1.5, 2, 2.5])
    assert 2.5 not in slept


def test_a_session_goes_live_only_when_nothing_sleeps_in_virtual_time(ros, says):
    ros.add(Boss)
    ros.add(Worker)
    ros.run(2)
    with pytest.raises(SessionError) as caught:
        ros.start()
    says(caught.value, "`work` of /worker is still waiting")
    ros.run(3)
    ros.start()
    ros.stop()


def test_one_that_is_paused_or_removed_in_its_sleep_stays_so(ros):
    ros.add(Boss)
    worker = ros.add(Worker)
    helper = ros.add(lambda: Node("helper"))
    helper.create_timer(2.0, lambda: ros.pause(worker))
    ros.run(seconds=8)
    assert times(ros, "worker") == [1]
    assert [one.time for one in ros.logs("worker")] == [4.5]
    ros.resume(worker)
    ros.remove(helper)
    ros.run(seconds=2)
    assert times(ros, "worker")[1:] == [8, 9, 10]


@pytest.mark.parametrize("span", [1_000, 1e3, np.int64(1_000)])
def test_what_python_sleeps_for_takes_virtual_time(ros, span):
    sleeper = ros.spawn(lambda: time.sleep(span))  # for longer than the test may take
    ros.run(999.9)
    assert sleeper.returncode is None
    ros.run(0.1)
    assert sleeper.returncode == 0


@pytest.mark.parametrize("span", [-1, float("nan"), 1e10, "2"])
def test_what_python_refuses_to_sleep_for_is_refused(ros, span):
    with pytest.raises((ValueError, TypeError, OverflowError)) as real:
        time.sleep(span)
    refused = ros.spawn(lambda: time.sleep(span))
    assert refused.returncode == 1
    assert refused.stderr.endswith(f"{real.typename}: {real.value}\n")


class Rounds(Node):
    """Has three timers that are due together, each of which sleeps, and a pool may run at once."""

    def __init__(self):
        super().__init__("rounds")
        group = ReentrantCallbackGroup()
        for seconds in (0.7, 0.9, 0.5):
            self.create_timer(0.4, lambda s=seconds: time.sleep(s), group)


def test_a_callback_that_sleeps_in_a_pool_is_known_until_it_returns():
    """rclpy hands a task to a second thread of the pool while the first one runs it."""
    before = threading.enumerate()
    with Session() as session:
        session.add(Rounds, threads=2)
        session.run(2.25)
        waits = session.observation().waits
        asleep = [wait for wait in waits if wait.until_ns == 2_250_000_000]
        assert len(asleep) == 2
        assert len(threading.enumerate()) == len(before) + 2
    assert threading.enumerate() == before
