"""After the end; and several sessions at once, which do not disturb each other."""

import gc
import weakref

import pytest
import rclpy.utilities

from nodes import Listener, Speaker, Talker
from rosbeat import Session
from rosbeat.errors import ClosedSessionError

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
        ros._world.context.on_shutdown(fail)
        ros._world.context.on_shutdown(lambda: told.append(True))
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
        world = weakref.ref(first._world)
    assert context.watcher is None
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
