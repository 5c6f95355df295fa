"""Nodes whose constructor fails, and what is no node at all."""

from functools import partial

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import Int32, String

from nodes import Listener, Speaker, Talker, Words
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


def test_a_node_that_never_called_super_is_refused(ros, says):
    class Empty(Node):
        def __init__(self):
            pass

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Empty)
    says(caught.value, "super().__init__ has not been called yet")
    assert names(ros) == []


def test_a_message_in_the_place_of_its_class_is_refused(ros, says):
    class Confused(Node):
        def __init__(self):
            super().__init__("confused")
            self.create_publisher(String(), "words", 10)

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Confused)
    says(caught.value, "instead of the class String", "Pass the class itself")
    assert names(ros) == []


def test_a_node_that_spins_while_it_is_made_is_refused(ros, says):
    class Spinning(Node):
        def __init__(self):
            super().__init__("spinning")
            rclpy.spin(self)

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Spinning)
    says(caught.value, "from inside the constructor")


def test_an_error_that_misleads_is_translated(ros, says):
    class Swapped(Node):
        def __init__(self):
            super().__init__("swapped")
            self.create_publisher("words", String, 10)

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Swapped)
    says(caught.value, "create_publisher got a string instead of the message type")
    assert "Invoked with" not in str(caught.value)


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


def test_a_node_name_with_a_space_prints_nothing_on_stderr(ros, says, capfd):
    class Spaced(Node):
        def __init__(self):
            super().__init__("bad name")

    with pytest.raises(NodeConstructionError) as caught:
        ros.add(Spaced)
    says(caught.value, "ROS does not allow the name 'bad name'")
    assert capfd.readouterr().err == ""
