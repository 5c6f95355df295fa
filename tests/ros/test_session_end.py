"""After the end; and several sessions at once, which do not disturb each other."""

import random

import pytest
from rclpy.node import Node

from nodes import Listener, Speaker, Talker, Ticker
from rosbeat import Session
from rosbeat.errors import (
    ClosedSessionError,
    DurationError,
    NodeClassError,
    RosbeatError,
    UnknownTopicError,
)

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


def test_everybody_is_told_of_a_shutdown_even_if_one_raises():
    told = []

    def fail():
        raise ValueError

    with Session() as ros:
        ros._world.context.on_shutdown(fail)
        ros._world.context.on_shutdown(lambda: told.append(True))
    assert told == [True]
