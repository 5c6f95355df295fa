"""What a learner does with a session: add nodes, ask for what they did, mistype, and end it."""

import gc
import re
import signal
import threading
import time
import weakref
from functools import partial

import psutil
import pytest
import rclpy.utilities
from rcl_interfaces.msg import Log
from rclpy.node import Node
from std_msgs.msg import String

from nodes import Doer, Listener, Speaker, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import (
    ClosedSessionError,
    DurationError,
    NodeClassError,
    SessionError,
    UnknownTopicError,
)


class Endless(Node):
    """Interrupts itself, after long enough, in a callback that never returns."""

    def __init__(self, seconds=1.5):
        super().__init__("endless")
        self.seconds = seconds
        self.create_timer(2.0, self.tick)

    def tick(self):
        # Of the system: the functions that tell the time show virtual time here.
        end = time.clock_gettime(time.CLOCK_MONOTONIC) + self.seconds
        while True:
            if time.clock_gettime(time.CLOCK_MONOTONIC) > end:
                signal.raise_signal(signal.SIGINT)


def test_messages_of_ros_itself_are_not_recorded(ros, says):
    ros.add(lambda: Node("asker")).create_subscription(Log, "/rosout", lambda _: None, 10)
    ros.add(Talker)
    ros.run(1)
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("rosout")
    says(caught.value, "Messages on /rosout are not recorded", "ROS itself publishes on it")


def test_an_interrupt_names_the_endless_callback_and_ends_its_node(ros):
    ros.add(Endless)
    ticker = ros.add(partial(Ticker, 1.0))
    with pytest.raises(KeyboardInterrupt) as caught:
        ros.run(5)
    shown = "\n".join(caught.value._render_traceback_())
    assert "/endless had been in tick for " in shown
    assert "line " in shown
    assert "What to try:   Mend the callback" in shown
    ros.run(5)
    assert [at // 10**9 for at, _ in ticker.fired] == [1, 2, 3, 4, 5, 6, 7]


def test_an_interrupt_in_a_quick_callback_ends_no_node(ros):
    node = ros.add(partial(Endless, 0.0))
    with pytest.raises(KeyboardInterrupt) as caught:
        ros.run(5)
    assert caught.value._render_traceback_() == [
        "KeyboardInterrupt: stopped at 2 s; the session is still open."
    ]
    assert ros.nodes == (node,)
    assert ros.observation().faults == ()


def names(session):
    return [node.get_name() for node in session.nodes]


def test_a_class_a_factory_and_a_node_can_be_added(ros):
    assert isinstance(ros.add(Talker), Talker)
    assert ros.add(lambda: Listener("ear")).get_name() == "ear"
    made = Ticker(1.0)
    assert ros.add(made) is made
    assert ros.add(made) is made
    assert names(ros) == ["talker", "ear", "ticker"]


def test_a_node_made_in_a_cell_rests_until_it_is_added(ros):
    ticker = Ticker(1.0)
    ros.run(3)
    assert ticker.fired == []
    ros.add(ticker)
    ros.run(0)
    # Its timer was due at 1, 2 and 3 s; like any executor that comes late, it fires once.
    assert [at for at, _ in ticker.fired] == [3_000_000_000]
    ros.run(2)
    assert len(ticker.fired) == 3


def test_a_cell_run_twenty_times_leaves_one_node_at_one_rate(ros):
    for _ in range(20):

        class Talker(Node):
            def __init__(self):
                super().__init__("talker")
                self.publisher = self.create_publisher(String, "count", 10)
                self.create_timer(0.1, self.talk)

            def talk(self):
                self.publisher.publish(String(data="x"))

        ros.add(Talker)
        before = len(ros.messages("count"))
        ros.run(1)
        assert len(ros.messages("count")) - before == 10
    assert names(ros) == ["talker"]
    assert ros.graph().nodes == ("/talker",)


@pytest.mark.parametrize("live", [False, True])
def test_a_session_cell_run_twenty_times_accumulates_nothing(live, eventually):
    process = psutil.Process()
    ros = Session()
    ros.close()
    gc.collect()
    descriptors, threads = process.num_fds(), process.num_threads()
    for _ in range(20):
        ros = Session()  # the one before is dropped, not closed
        ros.add(Speaker)
        if live:
            ros.start()
        else:
            ros.run(1, quiet=True)
    assert len([t for t in threading.enumerate() if t.name == "rosbeat live"]) == int(live)
    ros.close()
    gc.collect()
    eventually(lambda: process.num_threads() <= threads)
    eventually(lambda: process.num_fds() <= descriptors)


def test_remove_by_node_and_by_name(ros, says):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.remove(talker)
    ros.remove("/listener")
    assert names(ros) == []
    with pytest.raises(NodeClassError) as caught:
        ros.remove(talker)
    says(caught.value)


# What it prints in the cell.


def test_printed_logs_are_the_records(ros, capfd):
    ros.add(Speaker)
    ros.add(partial(Speaker, "other", 0.5))
    ros.run(2)
    printed = capfd.readouterr()
    assert printed.err == ""
    lines = [f"[{line.level}] [{line.time:.3f}] [{line.name}]: {line.text}" for line in ros.logs()]
    assert printed.out.splitlines() == lines
    assert len(lines) == 6
    assert [line.name for line in ros.logs("other")] == ["other"] * 4


def test_quiet_prints_nothing_and_a_flood_is_counted(ros, capsys):
    ros.add(partial(Speaker, "flood", 0.001))
    ros.run(1, quiet=True)
    assert capsys.readouterr().out == ""
    ros.run(1)
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 101
    assert re.fullmatch(r"\.\.\. and 900 more lines; logs\(\) has them all\.", lines[-1])
    assert len(ros.logs()) == 2000


# What it is asked for wrongly.


@pytest.mark.parametrize("seconds", [-1, float("nan"), "5", 1e12, 10**400, True])
def test_durations_are_checked(ros, says, seconds):
    with pytest.raises(DurationError) as caught:
        ros.run(seconds)
    says(caught.value, "run(seconds=...)")
    assert ros.time == 0


@pytest.mark.parametrize(
    "options",
    [{"seed": -1}, {"seed": 1.5}, {"seed": "7"}, {"seed": True}, {"domain_id": 215},
     {"domain_id": -1}, {"domain_id": "5"}],
)  # fmt: skip
def test_options_are_checked(options, says):
    with pytest.raises(SessionError) as caught:
        Session(**options)
    says(caught.value, next(iter(options)))


def test_an_unknown_topic_and_its_nearest(ros, says):
    ros.add(partial(Talker, topic="temperature"))
    ros.add(partial(Listener, topic="temprature"))
    ros.run(1)
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("temprature")
    says(caught.value, "/listener subscribes to it", "Did you mean /temperature? If not, add")
    ros.add(partial(Listener, topic="temperature"), name="other")
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("temprature")
    says(caught.value, "Add the publishing node first")  # /temperature has both sides
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("zebra")
    says(caught.value, "Published topics: /temperature")
    assert [sample.value for sample in ros.messages("/temperature")] == [1]
    with pytest.raises(UnknownTopicError, match="No messages were published"):
        ros.messages("parameter_events")


def test_an_unknown_node_and_its_nearest(ros, says):
    ros.add(Talker)
    with pytest.raises(SessionError) as caught:
        ros.pause("talkr")
    says(caught.value, "Did you mean /talker?")


def test_a_topic_with_a_blank_in_its_name(ros, says):
    with pytest.raises(SessionError) as caught:
        ros.explain("/a b")
    says(caught.value, "characters other than alphanumerics, '_', or '/'.")


@pytest.mark.parametrize("call", ["messages", "logs"])
def test_names_are_texts(ros, says, call):
    with pytest.raises(SessionError) as caught:
        getattr(ros, call)(5)
    says(caught.value, "quotation marks")


@pytest.mark.parametrize("call", ["run(1)", "start()", "stop()", "wait()", "add(Talker)"])
def test_calls_that_run_nodes_are_refused_in_a_callback(ros, capsys, call):
    ros.add(partial(Doer, lambda _: eval(f"ros.{call}", {"ros": ros, "Talker": Talker})))
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.kind == "SessionError"
    assert f"`ros.{call.partition('(')[0]}` was called from inside a callback" in fault.text
    assert names(ros) == ["doer"]
    capsys.readouterr()


# After the end; and several sessions at once, which do not disturb each other.


# The end.


def test_after_the_end_only_reading_is_possible(says):
    with Session() as ros:
        ros.add(Talker)
        ros.add(Speaker)
        ros.run(2, quiet=True)
        before = ros.observation()
    ros.close()
    assert len(ros.messages("count")) == 2
    assert len(ros.logs()) == 2
    assert ros.observation() == before
    assert ros.graph() == before.graph
    assert ros.graph().nodes == ("/talker", "/speaker")
    assert repr(ros) == "Session(closed)"
    for call in (
        lambda: ros.run(1), lambda: ros.add(Talker), ros.start, ros.stop,
        lambda: ros.remove("talker"), lambda: ros.pause("talker"), lambda: ros.wait(1),
        lambda: ros.wait_for_nodes("talker"),
    ):  # fmt: skip
        with pytest.raises(ClosedSessionError) as caught:
            call()
        says(caught.value)


def test_a_node_that_outlives_its_session_only_fails(capfd):
    with Session() as ros:
        talker = ros.add(Talker)
    with pytest.raises(Exception, match=r"."):
        talker.talk()
    talker.destroy_node()


# Two sessions.


def test_two_sessions_hear_nothing_of_each_other(capsys):
    with Session(seed=1) as one, Session(seed=1) as two:
        assert one.domain_id is two.domain_id is None
        ears = []
        for ros in one, two:
            ros.add(Talker)
            ears.append(ros.add(Listener))
            ros.add(Speaker)
        for _ in range(5):
            one.run(1)
            two.run(2)
        assert ears[0].heard == list(range(1, 6))
        assert ears[1].heard == list(range(1, 11))
        assert (len(one.logs()), len(two.logs())) == (5, 10)
        assert len(capsys.readouterr().out.splitlines()) == 15


def test_everybody_is_told_of_a_shutdown_even_if_one_raises():
    told = []

    def fail():
        raise ValueError

    with Session() as ros:
        ros._core.context.on_shutdown(fail)
        ros._core.context.on_shutdown(lambda: told.append(True))
    assert told == [True]


# A session's context is rclpy's default while it is open, and never afterwards.


def default():
    return rclpy.utilities.g_default_context


def test_sessions_closed_in_any_order():
    before = default()
    sessions = [Session() for _ in range(4)]
    for number in (1, 3, 0, 2):
        sessions[number].close()
        assert not getattr(default(), "ended", False)
    assert default() is before


def test_an_ended_context_keeps_nothing_alive():
    with Session() as first:
        context = default()
        world = weakref.ref(first._core)
    assert context.session_core is None
    context.init()
    context.shutdown()
    context.try_shutdown()
    del first
    gc.collect()
    assert world() is None


def test_no_log_file_is_written(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    with Session() as ros:
        ros.add(Speaker)
        ros.run(1, quiet=True)
    assert list(tmp_path.iterdir()) == []
