"""The door: what a session takes, refuses and leaves behind."""

import gc
import random
import re
import threading
from functools import partial

import psutil
import pytest
from rclpy.node import Node

from nodes import Doer, Listener, Speaker, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import (
    ClosedSessionError,
    DurationError,
    NodeClassError,
    NodeConstructionError,
    RosbeatError,
    SessionError,
    UnknownTopicError,
)


def names(session):
    return [node.get_name() for node in session.nodes]


# Adding and removing.


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
                self.publisher = self.create_publisher(Words_type(), "count", 10)
                self.create_timer(0.1, self.talk)

            def talk(self):
                self.publisher.publish(Words_type()(data="x"))

        ros.add(Talker)
        before = len(ros.messages("count"))
        ros.run(1)
        assert len(ros.messages("count")) - before == 10
    assert names(ros) == ["talker"]
    assert ros.graph().nodes == ("/talker",)


def Words_type():  # noqa: N802 - reads like the class it stands for
    from std_msgs.msg import String

    return String


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
    from rosbeat.runtime.world import World

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


# Constructors that fail.


class HalfWay(Node):
    def __init__(self):
        super().__init__("half_way")
        self.create_publisher(Words_type(), "left_over", 10)
        self.create_timer(1.0, self.tick)
        raise RuntimeError("no sensor")

    def tick(self):
        raise AssertionError


def test_nothing_is_left_of_a_node_whose_constructor_raises(ros, says, capfd):
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(HalfWay)
    says(caught.value, "RuntimeError: no sensor", 'raise RuntimeError("no sensor")')
    assert isinstance(caught.value.__cause__, RuntimeError)
    assert names(ros) == []
    assert ros.graph().endpoints == ()
    ros.run(5)
    assert ros.observation().faults == ()
    heard = []
    ear = ros.add(lambda: Node("ear"))
    from rcl_interfaces.msg import Log

    ear.create_subscription(Log, "/rosout", heard.append, 10)
    ros.add(lambda: Speaker("half_way"))
    ros.run(2)
    assert [line.msg for line in heard] == ["here is half_way"] * 2
    assert capfd.readouterr().err == ""


def test_interrupting_a_constructor_leaves_nothing(ros):
    class Endless(Node):
        def __init__(self):
            super().__init__("endless")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ros.add(Endless)
    assert names(ros) == []


def test_a_constructor_that_exits_is_explained(ros, says):
    class Quits(Node):
        def __init__(self):
            raise SystemExit(1)

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Quits)
    says(caught.value, "SystemExit")


def test_a_class_that_forgot_super(ros, says):
    class Forgetful(Node):
        def __init__(self):
            self.create_timer(1.0, print)

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Forgetful)
    says(caught.value, "_default_callback_group", "self.create_timer(1.0, print)")
    assert names(ros) == []


def test_a_class_that_gave_no_name(ros, says):
    class Nameless(Node):
        def __init__(self):
            super().__init__()

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Nameless)
    says(caught.value, "node_name")


@pytest.mark.parametrize("name", ["room temperature", "1temp", "temperature-sensor", "", "a/b"])
def test_names_that_ros_refuses(ros, says, name):
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(lambda: Node(name))
    says(caught.value)
    assert names(ros) == []


@pytest.mark.parametrize("name", [5, None])
def test_names_that_are_no_text(ros, says, name):
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(lambda: Node(name))
    says(caught.value)


@pytest.mark.parametrize(
    "thing",
    [5, "Talker", None, [], int, Session, lambda: 5, lambda: None],
    ids=lambda thing: type(thing).__name__,
)
def test_what_is_not_a_node_is_refused(ros, says, thing):
    with pytest.raises((NodeClassError, NodeConstructionError)) as caught:
        ros.add(thing)
    says(caught.value)


def test_a_node_of_another_session_is_refused(ros, says):
    with Session() as other:
        talker = other.add(Talker)
        with pytest.raises(NodeClassError) as caught:
            ros.add(talker)
        says(caught.value, "does not belong to this session")


# Bad input.


@pytest.mark.parametrize("seconds", [-1, -1e-9, float("nan"), float("inf"), "5", None, 1e12, True])
def test_durations_are_checked(ros, says, seconds):
    with pytest.raises(DurationError) as caught:
        ros.run(seconds)
    says(caught.value, "run(seconds=...)")
    assert ros.time == 0


def test_a_duration_beyond_all_numbers(ros, says):
    with pytest.raises(DurationError) as caught:
        ros.run(10**400)
    says(caught.value)


def test_time_ends_after_292_years(ros, says):
    for _ in range(9):
        ros.run(1e9)
    with pytest.raises(DurationError) as caught:
        ros.run(1e9)
    says(caught.value, "292 years")


@pytest.mark.parametrize(
    "options",
    [{"seed": -1}, {"seed": 1.5}, {"seed": "7"}, {"seed": True}, {"domain_id": 102},
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
    says(caught.value, "/listener listens there", "Did you mean /temperature?")
    with pytest.raises(UnknownTopicError) as caught:
        ros.messages("zebra")
    says(caught.value, "Published topics: /temperature")
    assert [sample.value for sample in ros.messages("/temperature")] == [1]


def test_an_unknown_node_and_its_nearest(ros, says):
    ros.add(Talker)
    with pytest.raises(SessionError) as caught:
        ros.pause("talkr")
    says(caught.value, "Did you mean /talker?")


@pytest.mark.parametrize("call", ["messages", "logs"])
def test_names_are_texts(ros, says, call):
    with pytest.raises(SessionError) as caught:
        getattr(ros, call)(5)
    says(caught.value, "quotation marks")


def test_run_in_a_callback_is_refused(ros, capsys):
    ros.add(partial(Doer, lambda _: ros.run(1)))
    ros.run(1)
    (fault,) = ros.observation().faults
    assert fault.kind == "SessionError"
    assert "`ros.run` was called from inside a callback" in fault.text
    capsys.readouterr()


@pytest.mark.parametrize("call", ["start", "stop", "wait"])
def test_live_calls_in_a_callback_are_refused(ros, call, capsys):
    ros.add(partial(Doer, lambda _: getattr(ros, call)()))
    ros.run(1)
    assert [fault.kind for fault in ros.observation().faults] == ["SessionError"]
    capsys.readouterr()


def test_adding_in_a_callback_is_refused(ros, capsys):
    ros.add(partial(Doer, lambda _: ros.add(Talker)))
    ros.run(1)
    assert [fault.kind for fault in ros.observation().faults] == ["SessionError"]
    assert names(ros) == ["doer"]
    capsys.readouterr()


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
    assert repr(ros) == "Session(closed)"
    for call in (
        lambda: ros.run(1), lambda: ros.add(Talker), ros.start, ros.stop, ros.graph,
        lambda: ros.remove("talker"), lambda: ros.pause("talker"), lambda: ros.wait(1),
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


def test_every_error_is_one_of_ours():
    for kind in (ClosedSessionError, DurationError, NodeClassError, UnknownTopicError):
        assert issubclass(kind, RosbeatError)


def test_repr(ros):
    assert repr(ros) == "Session(virtual time, 0 s, no nodes)"
    ros.add(Talker)
    ros.run(2.5)
    assert repr(ros) == "Session(virtual time, 2.5 s, /talker)"


# Two sessions.


def test_two_sessions_hear_nothing_of_each_other(capsys):
    with Session(seed=1) as one, Session(seed=1) as two:
        assert one.domain_id != two.domain_id
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


def test_random_numbers_do_not_mix():
    class Dice(Node):
        def __init__(self):
            super().__init__("dice")
            self.drawn = [random.random()]
            self.create_timer(1.0, lambda: self.drawn.append(random.random()))

    def alone(seed):
        with Session(seed=seed) as ros:
            dice = ros.add(Dice)
            ros.run(6)
            return dice.drawn

    random.seed(99)
    outside = [random.random() for _ in range(3)]
    random.seed(99)
    with Session(seed=1) as one, Session(seed=2) as two:
        dice = [one.add(Dice), two.add(Dice)]
        seen = []
        for _ in range(3):
            one.run(2)
            seen.append(random.random())
            two.run(2)
    assert seen == outside
    assert [die.drawn for die in dice] == [alone(1), alone(2)]


def test_a_node_belongs_to_the_session_that_adds_it():
    with Session() as one, Session() as two:
        one.add(Talker)
        two.add(Listener)
        one.add(Speaker)
    assert one.observation().graph.nodes == ("/talker", "/speaker")
    assert two.observation().graph.nodes == ("/listener",)


def test_closing_the_inner_session_gives_the_outer_back():
    with Session() as outer:
        with Session() as inner:
            assert inner.add(Talker).context is not outer.add(Listener).context
        made = Ticker(1.0)
        outer.add(made)
        assert len(outer.nodes) == 2


def test_closing_the_outer_session_first():
    outer, inner = Session(), Session()
    outer.close()
    inner.add(Talker)
    inner.run(1)
    inner.close()
    with Session() as third:
        third.add(Talker)
        third.run(1)
        assert len(third.messages("count")) == 1


# What is printed.


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
