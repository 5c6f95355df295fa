"""Against the wall clock, in a background thread; other processes can talk to the nodes."""

import os
import signal
import threading
import time
from functools import partial

import pytest
from rclpy.exceptions import InvalidHandle
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import Trigger

from nodes import SECOND, AsyncDoer, Doer, Listener, Server, Speaker, Talker, Ticker, since_start
from other_process import other_process
from rosbeat import Session
from rosbeat.errors import DurationError, SessionError
from rosbeat.ros.clock import START
from rosbeat.ros.context import Interrupts


def live_threads():
    return [thread for thread in threading.enumerate() if thread.name == "rosbeat live"]


def test_messages_and_logs_are_recorded(ros, capsys):
    ros.add(partial(Talker, period=0.02))
    listener = ros.add(Listener)
    ros.add(partial(Speaker, period=0.02))
    ros.start()
    assert ros.wait(10, until=lambda: len(listener.heard) >= 10)
    ros.stop()
    samples = ros.messages("count")
    assert [sample.value for sample in samples] == list(range(1, len(samples) + 1))
    assert [sample.time_ns for sample in samples] == sorted(sample.time_ns for sample in samples)
    assert len(capsys.readouterr().out.splitlines()) == len(ros.logs())


def test_start_does_not_fire_at_once(ros):
    ticker = ros.add(partial(Ticker, 30.0, 0.01))
    ros.run(29)
    ros.start()
    assert ros.wait(10, until=lambda: len(ticker.times(1)) > 2905)
    assert ticker.times(0) == []


def test_virtual_time_goes_on_at_the_right_rate(ros):
    ticker = ros.add(partial(Ticker, 0.1))
    talker, listener = ros.add(partial(Talker, period=0.1)), ros.add(Listener)
    for _ in range(2):
        ros.run(1)
        ros.start()
        ros.start()
        count = len(ticker.fired)
        assert ros.wait(10, until=lambda count=count: len(ticker.fired) > count)
        ros.stop()
        ros.stop()
        assert not ros.is_live
        before, fired, heard = ros.time, len(ticker.fired), len(listener.heard)
        ros.run(2)
        assert ros.time == pytest.approx(before + 2)
        assert len(ticker.fired) - fired == 20
        assert listener.heard == list(range(1, talker.count + 1))
        assert len(listener.heard) - heard in (20, 21)


def test_clocks_begin_late_and_follow_the_wall_while_live(ros):
    node = ros.add(lambda: Node("honest"))
    # As on a robot, where nobody publishes `/clock`.
    assert node.get_parameter("use_sim_time").value is False
    assert node.get_clock().now().nanoseconds == START * SECOND
    ros.start()
    assert abs(node.get_clock().now().nanoseconds - time.time_ns()) < 1e9
    born_live = ros.add(lambda: Node("born_live"))
    assert abs(born_live.get_clock().now().nanoseconds - time.time_ns()) < 1e9
    ros.stop()
    assert since_start(node) == since_start(born_live) == round(ros.time * 1e9)


def test_what_is_destroyed_while_rclpy_gathers_entities_stops_nobody(ros, eventually):
    talker = ros.add(Talker)
    (event, *_) = next(iter(talker.publishers)).event_handlers
    original, raised = event.add_to_wait_set, []

    def destroyed_meanwhile(wait_set):
        if not raised:
            raised.append(True)
            raise InvalidHandle
        original(wait_set)

    event.add_to_wait_set = destroyed_meanwhile
    ros.start()
    eventually(lambda: raised)
    assert ros.wait(10, until=lambda: ros.messages("count"))
    assert len(live_threads()) == 1


def test_a_fault_is_shown_in_the_next_call_and_the_others_go_on(ros, capsys, eventually):
    ros.add(partial(Doer, lambda _: 1 / 0, period=0.01))
    ticker = ros.add(partial(Ticker, 0.01))
    ros.start()
    eventually(lambda: ros._core.recorder.faults)
    assert capsys.readouterr().err == ""
    ros.logs()
    assert capsys.readouterr().err.count("ZeroDivisionError") == 1
    count = len(ticker.fired)
    assert ros.wait(10, until=lambda: len(ticker.fired) > count + 5)
    ros.stop()
    assert len(ros.observation().faults) == 1
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("error", [SystemExit, KeyboardInterrupt])
def test_a_callback_that_exits_does_not_silence_the_others(ros, capsys, error):
    def do(_):
        raise error

    ros.add(partial(Doer, do, period=0.01))
    ticker = ros.add(partial(Ticker, 0.01))
    ros.start()
    assert ros.wait(10, until=lambda: ros.observation().faults)
    count = len(ticker.fired)
    assert ros.wait(10, until=lambda: len(ticker.fired) > count + 5)
    capsys.readouterr()


def test_call_in_a_cell_while_live(ros):
    ros.add(Server)
    client = ros.add(lambda: Node("asker")).create_client(Trigger, "ask")
    ros.start()
    assert client.call(Trigger.Request(), timeout_sec=10.0).message == "1"


def test_call_in_a_live_callback_is_explained(ros, capsys):
    ros.add(Server)

    def do(node):
        node.create_client(Trigger, "ask").call(Trigger.Request())

    ros.add(partial(Doer, do, period=0.01))
    ros.start()
    assert ros.wait(10, until=lambda: ros.observation().faults)
    assert "deadlock" in capsys.readouterr().err


def test_stop_frees_a_group_in_which_a_coroutine_waits(ros):
    async def do(node):
        node.seen += 1
        if node.seen == 3:
            await Future()

    doer = ros.add(partial(AsyncDoer, do, period=0.01))
    doer.seen = 0
    ros.start()
    assert ros.wait(10, until=lambda: doer.seen == 3)
    ros.stop()
    ros.run(0.05)
    assert doer.seen == 8


def test_a_callback_that_never_returns_is_broken_off(ros, capsys):
    def do(_):
        while True:
            pass

    ros.add(partial(Doer, do, period=0.01))
    ros.start()
    assert ros.wait(10, until=lambda: ros.observation().callbacks)
    ros.stop()
    assert live_threads() == []
    (fault,) = ros.observation().faults
    assert fault.kind == "BrokenOff"
    capsys.readouterr()


def test_a_message_that_came_late_is_heard_in_virtual_time(ros):
    talker, listener = ros.add(partial(Talker, period=1000.0)), ros.add(Listener)
    ros.start()
    ros.pause(listener)
    talker.talk()
    ros.stop()
    ros.resume(listener)
    ros.run(0)
    assert listener.heard == [1]


def test_wait(ros, says):
    with pytest.raises(SessionError) as caught:
        ros.wait(1)
    says(caught.value, "not live")
    ros.start()
    with pytest.raises(DurationError) as error:
        ros.wait(-1)
    says(error.value, "wait(seconds=...)")
    assert ros.wait(0) is False
    assert ros.wait(0.1) is False
    assert ros.wait(until=lambda: True) is True
    with pytest.raises(SessionError) as caught:
        ros.run(1)
    says(caught.value, "ros.wait")


def test_interrupt_ends_a_wait_without_a_deadline(ros):
    ros.add(partial(Ticker, 0.01))
    ros.start()
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ros.wait()
    timer.join()
    assert ros.is_live


def test_another_process_hears_and_is_heard(empty_domain):
    with (
        other_process(empty_domain, "Relay('outside', 'count', 'reply'),"),
        Session(domain_id=empty_domain) as ros,
    ):
        ros.add(partial(Talker, period=0.02))
        listener = ros.add(partial(Listener, topic="reply"))
        ros.start()
        assert ros.wait(30, until=lambda: len(listener.heard) >= 3)


# Ctrl+C, and Interrupt of a kernel.


def test_an_interrupt_that_became_another_error_is_not_lost():
    before = signal.getsignal(signal.SIGINT)
    interrupts = Interrupts()
    with interrupts:
        try:
            os.kill(os.getpid(), signal.SIGINT)
            threading.Event().wait(5)
        except KeyboardInterrupt:
            assert interrupts.pressed
    with pytest.raises(KeyboardInterrupt):
        interrupts.raise_if_pressed()
    assert signal.getsignal(signal.SIGINT) is before
