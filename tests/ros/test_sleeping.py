"""A sleep in a callback takes virtual time, on a page as in a check."""

import time
from time import sleep

import numpy as np
import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat import Session
from rosbeat.errors import SessionError
from rosbeat.ros.scenario import observe

pytestmark = pytest.mark.ros


class Beat(Node):
    """Says `beat` each second."""

    def __init__(self, name="beat"):
        super().__init__(name)
        self.pub = self.create_publisher(Float32, name, 10)
        self.create_timer(1.0, lambda: self.pub.publish(Float32(data=1.0)))


class Worker(Beat):
    """Beats, and sleeps as long as it is told to."""

    def __init__(self):
        super().__init__("worker")
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


def times(ros, topic):
    return [one.time for one in ros.messages(topic)]


def test_a_page_and_a_check_see_the_same(slept, ros):
    for node in (Boss, Beat, Worker):
        ros.add(node)
    ros.run(seconds=8)
    assert times(ros, "beat") == [1, 2, 3, 4, 5, 6, 7, 8]
    assert times(ros, "worker") == [1, 4.5, 5, 6, 7, 8]
    assert [(one.time, one.text) for one in ros.logs()] == [(4.5, "done")]
    seen = observe(Worker, 8, others=[Boss, Beat])
    assert seen.samples == ros.observation().samples
    assert seen.callbacks == ros.observation().callbacks
    assert 3.0 not in slept


def test_every_way_to_sleep_counts(ros):
    def nap(node):
        sleep(1)  # a name of this module
        node.get_clock().sleep_for(rclpy_seconds(1))

    node = ros.add(lambda: Node("napper"))
    timer = node.create_timer(1.0, lambda: (timer.cancel(), nap(node), node.get_logger().info("")))
    ros.run(seconds=3)
    assert [one.time for one in ros.logs("napper")] == [3]


def rclpy_seconds(number):
    from rclpy.duration import Duration

    return Duration(seconds=number)


def test_a_constructor_sleeps_in_virtual_time_and_the_others_go_on(slept, ros):
    class Slow(Beat):
        def __init__(self):
            time.sleep(2.5)
            super().__init__("slow")

    ros.add(Beat)
    ros.add(Slow)
    assert (ros.time, times(ros, "beat")) == (2.5, [1, 2])
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


class Index:
    """A whole number of a library's own, as NumPy has some."""

    def __index__(self):
        return 1_000


@pytest.mark.parametrize("span", [1_000, 1e3, np.int64(1_000), np.float64(1_000), Index()])
def test_what_python_sleeps_for_takes_virtual_time(ros, span):
    sleeper = ros.spawn(lambda: time.sleep(span))  # for longer than the test may take
    ros.run(999.9)
    assert sleeper.returncode is None
    ros.run(0.1)
    assert sleeper.returncode == 0


@pytest.mark.parametrize(
    "span", [-1, -1e-12, float("nan"), float("inf"), 10**30, 1e10, "2", None, np.float32(2)]
)
def test_what_python_refuses_to_sleep_for_is_refused(ros, span):
    with pytest.raises((ValueError, TypeError, OverflowError)) as real:
        time.sleep(span)
    refused = ros.spawn(lambda: time.sleep(span))
    assert refused.returncode == 1
    assert refused.stderr.endswith(f"{real.typename}: {real.value}\n")


def test_an_interrupt_ends_a_sleep(ros, monkeypatch):
    node = ros.add(lambda: Node("napper"))
    ros.add(Beat)
    timer = node.create_timer(1.0, lambda: time.sleep(1000))
    stopper = ros.add(lambda: Node("stopper"))

    def stop():
        raise KeyboardInterrupt

    stopper.create_timer(5.0, stop)
    with pytest.raises(KeyboardInterrupt):
        ros.run(seconds=20)
    assert ros.time == 5
    assert time.sleep is sleep
    timer.cancel()
    ros.remove(stopper)
    with Session() as other:
        other.run(seconds=1)
    ros.run(seconds=2)
    assert times(ros, "beat")[-1] == 7
