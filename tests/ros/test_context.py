"""A session's context is rclpy's default while it is open, and never afterwards."""

import gc
import weakref

import rclpy.utilities

from nodes import Speaker, Talker
from rosbeat import Session
from rosbeat.ros.context import SessionContext


def default():
    return rclpy.utilities.g_default_context


def test_sessions_nest():
    before = default()
    outer = Session()
    middle = default()
    inner = Session()
    assert isinstance(middle, SessionContext)
    assert default() is not middle
    inner.close()
    assert default() is middle
    outer.close()
    assert default() is before


def test_sessions_closed_in_any_order():
    before = default()
    sessions = [Session() for _ in range(4)]
    for number in (1, 3, 0, 2):
        sessions[number].close()
        assert not getattr(default(), "ended", False)
    assert default() is before


def test_a_session_closed_while_another_runs(ros):
    inner = Session()
    ros.add(lambda: (inner.close(), Talker())[1])
    assert default() is ros._world.context


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


def test_a_context_cannot_be_shut_down_by_rclpy(ros):
    rclpy.shutdown(context=ros._world.context)
    assert ros._world.context.ok()
