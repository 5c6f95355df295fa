"""Nodes whose constructor fails, and what is no node at all."""

from functools import partial

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32, String

from nodes import Listener, Speaker, Words
from rosbeat import Session
from rosbeat.errors import NodeClassError, NodeConstructionError


def names(session):
    return [node.get_name() for node in session.nodes]


class HalfWay(Node):
    def __init__(self):
        super().__init__("half_way")
        self.create_publisher(String, "left_over", 10)
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


class Broken(Node):
    """Does one thing wrong in its constructor."""

    def __init__(self, do):
        do(self)


def made(do):
    """Do something after the node itself has been made."""

    def make(node):
        Node.__init__(node, "broken")
        do(node)

    return make


def leave(_):
    raise SystemExit(1)


FORGOT = "_default_callback_group", "node.create_timer(1.0, print)"
#: What a constructor does, and what is said of it.
WRONG = {
    "exits": (leave, ("SystemExit",)),
    "forgot super": (lambda node: node.create_timer(1.0, print), FORGOT),
    "does nothing": (lambda _: None, ("super().__init__ has not been called yet",)),
    "gives no name": (Node.__init__, ("node_name",)),
    "a name with a space": (
        lambda node: Node.__init__(node, "bad name"),
        ("ROS does not allow the name 'bad name'",),
    ),
    "a message, not its class": (
        made(lambda node: node.create_publisher(String(), "words", 10)),
        ("instead of the class String", "Pass the class itself"),
    ),
    "spins": (made(rclpy.spin), ("from inside the constructor",)),
    "swaps topic and type": (
        made(lambda node: node.create_publisher("words", String, 10)),
        ("create_publisher got a string instead of the message type",),
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_a_constructor_does_wrong_is_explained(ros, says, capfd, case):
    do, words = WRONG[case]
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(partial(Broken, do))
    says(caught.value, *words)
    assert "Invoked with" not in str(caught.value)
    assert names(ros) == []
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize("name", ["1temp", "", 5])
def test_names_that_ros_refuses(ros, says, name):
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(lambda: Node(name))
    says(caught.value)
    assert names(ros) == []


@pytest.mark.parametrize(
    "thing",
    [5, "Talker", None, [], int, Session, lambda: 5, lambda: None],
    ids=lambda thing: type(thing).__name__,
)
def test_what_is_not_a_node_is_refused(ros, says, thing):
    with pytest.raises((NodeClassError, NodeConstructionError)) as caught:
        ros.add(thing)
    says(caught.value)


# What the middleware prints by itself.


class Both(Node):
    def __init__(self, first):
        super().__init__("both")
        if first == "publisher":
            self.create_publisher(Int32, "count", 10)
        else:
            self.create_subscription(Int32, "count", print, 10)
        self.create_subscription(String, "count", print, 10)


@pytest.mark.parametrize("first", ["publisher", "subscription"])
def test_a_second_type_on_a_topic_is_refused_and_nothing_is_on_stderr(ros, says, capfd, first):
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(partial(Both, first))
    says(
        caught.value,
        "existing topic name rt/count with incompatible type std_msgs::msg::dds_::String_",
        "The topic already exists with another message type.",
    )
    assert capfd.readouterr().err == ""


def test_a_subscription_to_the_topic_of_another_node_is_refused_until_that_is_gone(
    ros, says, capfd
):
    words = ros.add(partial(Words, topic="count"))
    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Listener)
    says(caught.value, "with incompatible type std_msgs::msg::dds_::Int32_")
    assert capfd.readouterr().err == ""
    ros.remove(words)
    ros.add(Listener)
