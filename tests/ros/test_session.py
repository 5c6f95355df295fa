"""The door: what a session takes and what it leaves behind."""

import gc
import signal
import threading
import time
from functools import partial

import psutil
import pytest
from rclpy.node import Node
from std_msgs.msg import String

from nodes import Listener, Speaker, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import NodeClassError


class Endless(Node):
    """Interrupts itself, after long enough, in a callback that never returns."""

    def __init__(self, seconds=1.5):
        super().__init__("endless")
        self.seconds = seconds
        self.create_timer(2.0, self.tick)

    def tick(self):
        end = time.monotonic() + self.seconds
        while True:
            if time.monotonic() > end:
                signal.raise_signal(signal.SIGINT)


def test_an_interrupt_names_the_endless_callback_and_ends_its_node(ros, capsys):
    ros.add(Endless)
    ticker = ros.add(partial(Ticker, 1.0))
    with pytest.raises(KeyboardInterrupt) as caught:
        ros.run(5)
    shown = "\n".join(caught.value._render_traceback_())
    assert "/endless had been in tick for " in shown
    assert "line " in shown
    assert "What to try:   Mend the callback" in shown
    ros.run(5)
    assert "rosbeat: /endless ended when you interrupted its callback." in capsys.readouterr().out
    assert [at // 10**9 for at, _ in ticker.fired] == [1, 2, 3, 4, 5, 6, 7]
    ros.add(Endless)
    ros.run(1)
    assert "interrupted" not in capsys.readouterr().out


def test_an_interrupt_in_a_quick_callback_ends_no_node(ros, capsys):
    node = ros.add(partial(Endless, 0.0))
    with pytest.raises(KeyboardInterrupt) as caught:
        ros.run(5)
    assert caught.value._render_traceback_() == [
        "KeyboardInterrupt: stopped at 2 s; the session goes on."
    ]
    node.tick = lambda: None
    ros.run(1)
    assert "interrupted" not in capsys.readouterr().out


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


def test_a_with_block_run_twenty_times():
    heard = set()
    for _ in range(20):
        with Session(seed=4) as ros:
            ros.add(Talker)
            listener = ros.add(Listener)
            ros.run(3)
            heard.add(tuple(listener.heard))
    assert heard == {(1, 2, 3)}


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


def test_worlds_are_not_kept(eventually):
    from rosbeat.ros.world import World

    gc.collect()
    before = len([thing for thing in gc.get_objects() if isinstance(thing, World)])
    for _ in range(10):
        ros = Session()
        ros.add(Talker)
        ros.run(1)
    ros.close()
    del ros
    gc.collect()
    after = len([thing for thing in gc.get_objects() if isinstance(thing, World)])
    assert after - before <= 1


def test_a_dropped_session_is_closed(eventually):
    ros = Session()
    ros.add(Ticker(1.0) and partial(Ticker, 1.0))
    ros.start()
    world = ros._world
    del ros
    gc.collect()
    assert world.closed
    assert "rosbeat live" not in {thread.name for thread in threading.enumerate()}


def test_remove_by_node_and_by_name(ros, says):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.remove(talker)
    ros.remove("/listener")
    assert names(ros) == []
    with pytest.raises(NodeClassError) as caught:
        ros.remove(talker)
    says(caught.value)


def test_namespaces(ros):
    class Named(Node):
        def __init__(self):
            super().__init__("sensor", namespace="room/one")

    ros.add(Named)
    ros.add(Named)
    assert ros.graph().nodes == ("/room/one/sensor",)
    ros.remove("room/one/sensor")
