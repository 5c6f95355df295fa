"""Nodes whose constructor fails, and what is no node at all."""

import pytest
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

from nodes import Speaker, Talker
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
    says(caught.value, "not the class String", "Hand over the class itself")
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
    says(caught.value, "create_publisher got a text in the place of the message type")
    assert "Invoked with" not in str(caught.value)
