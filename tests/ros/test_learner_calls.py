"""`rclpy.init`, `spin` and `shutdown` in a cell: they work or explain themselves; none hangs."""

import signal
import sys
import threading
import time
from functools import partial

import pytest
import rclpy
from rclpy.exceptions import NotInitializedException
from rclpy.node import Node
from rclpy.task import Future

from nodes import Doer, Listener, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import NodeClassError, NoSessionError, SessionError


@pytest.fixture
def interrupt():
    """Press Interrupt after so many seconds."""
    timers = []

    def after(seconds):
        timer = threading.Timer(seconds, signal.raise_signal, [signal.SIGINT])
        timers.append(timer)
        timer.start()

    yield after
    for timer in timers:
        timer.cancel()
        timer.join()


@pytest.fixture
def plain():
    """ROS as a learner starts it, without a session."""
    rclpy.init(args=[], domain_id=50, signal_handler_options=rclpy.SignalHandlerOptions.NO)
    yield
    rclpy.try_shutdown()


def test_init_in_a_session_has_nothing_to_do(ros, capsys):
    rclpy.init()
    rclpy.init(args=["--ros-args"])
    assert capsys.readouterr().out.count("rclpy.init() has no effect here") == 2
    assert rclpy.ok()


def test_shutdown_in_a_session_leaves_it_open(ros, capsys):
    rclpy.shutdown()
    rclpy.try_shutdown()
    assert "does not close this session" in capsys.readouterr().out
    assert rclpy.ok()
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(2)
    assert len(ticker.fired) == 2


def test_shutdown_in_a_callback_ends_that_node(ros, capsys):
    doer = ros.add(partial(Doer, lambda _: rclpy.shutdown()))
    ticker = ros.add(partial(Ticker, 1.0))
    ros.run(5)
    assert "/doer called rclpy.shutdown() and stops" in capsys.readouterr().out
    assert len([run for run in ros.observation().callbacks if run.node == "/doer"]) == 1
    assert len(ticker.fired) == 5
    with pytest.raises(SessionError, match="cannot be resumed"):
        ros.resume(doer)


def test_a_destroyed_node_is_not_spun(ros):
    ticker = ros.add(partial(Ticker, 1.0))
    ros.remove(ticker)
    with pytest.raises(NodeClassError, match="/ticker does not belong to this session"):
        rclpy.spin(ticker)
    with pytest.raises(NodeClassError, match="it has been destroyed"):
        rclpy.spin_until_future_complete(ticker, Future(), timeout_sec=1)


def test_spin_runs_live_until_interrupt(ros, capsys, interrupt):
    ticker = ros.add(partial(Ticker, 0.01))
    interrupt(0.5)
    with pytest.raises(KeyboardInterrupt):
        rclpy.spin(ticker)
    assert len(ticker.fired) > 5
    assert not ros.is_live
    assert "spins in real time until you interrupt" in capsys.readouterr().out
    count = len(ticker.fired)
    ros.run(1)
    assert len(ticker.fired) == count + 100


def test_spin_once_points_to_run(ros, says):
    with pytest.raises(SessionError) as caught:
        rclpy.spin_once(ros.add(Talker))
    says(caught.value, "ros.run")


def test_spinning_in_a_callback_is_refused(ros, capsys):
    ros.add(partial(Doer, rclpy.spin))
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.kind == "SessionError"
    assert "deadlock" in capsys.readouterr().err


def test_spin_until_a_future_that_never_comes(ros):
    node = ros.add(lambda: Node("waits"))
    rclpy.spin_until_future_complete(node, Future(), timeout_sec=7.0)
    assert ros.time == 7
    future = Future()
    future.cancel()
    rclpy.spin_until_future_complete(node, future)
    assert ros.time == 7


def test_spin_until_future_complete_live(ros):
    node = ros.add(lambda: Node("waits"))
    future = Future()
    node.create_timer(0.05, lambda: future.set_result(5))
    ros.start()
    rclpy.spin_until_future_complete(node, future, timeout_sec=10.0)
    assert future.result() == 5


def test_without_a_session_everything_is_rclpys_own(plain):
    talker, listener = Talker(period=0.01), Listener()
    for node in (talker, listener):
        assert not node.get_parameter("use_sim_time").value
    deadline = time.monotonic() + 10
    while not listener.heard and time.monotonic() < deadline:
        rclpy.spin_once(talker, timeout_sec=0.05)
        rclpy.spin_once(listener, timeout_sec=0.05)
    assert listener.heard
    talker.destroy_node()
    listener.destroy_node()


def test_a_plain_node_beside_a_session(plain, interrupt):
    node = Node("plain")
    fired = []
    node.create_timer(0.02, lambda: fired.append(1))
    with Session():
        interrupt(0.3)
        with pytest.raises(KeyboardInterrupt):
            rclpy.spin(node)
    assert fired
    assert rclpy.ok()
    node.destroy_node()


def test_on_a_page_a_node_without_a_session_is_explained(monkeypatch):
    with pytest.raises(NotInitializedException):  # in a program: rclpy's own words
        Node("alone")
    monkeypatch.setitem(sys.modules, "ipykernel.kernelapp", sys)
    with pytest.raises(NoSessionError, match="no session is open") as caught:
        Node("alone")
    assert caught.value.means
    assert "Session()" in caught.value.to_try
    assert "the class itself, without parentheses" in caught.value.to_try
