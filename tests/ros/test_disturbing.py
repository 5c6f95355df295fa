"""Messages that go wrong on their way."""

import math

import pytest
from rclpy.node import Node
from std_msgs.msg import Float32

from rosbeat.ros.instruments import Disturbance

pytestmark = pytest.mark.ros


@pytest.fixture
def node(ros):
    node = ros.add(lambda: Node("sensor"))
    node.temperature = node.create_publisher(Float32, "temperature", 10)
    node.humidity = node.create_publisher(Float32, "humidity", 10)
    return node


@pytest.fixture
def values(ros, node):
    def publish(*values):
        for value in values:
            node.temperature.publish(Float32(data=value))
        return [sample.value for sample in ros.messages("temperature")]

    return publish


@pytest.fixture
def disturbance(node):
    made = Disturbance("/temperature")
    made.reach(node.publishers)
    made.reach(node.publishers)  # again and again, as the graph is looked at
    return made


def test_what_is_recorded_is_what_went_out(values, disturbance):
    disturbance.kind, disturbance.amount = "offset", 5.0
    assert values(20.0, 21.5) == [25.0, 26.5]


def test_the_nodes_own_message_stays_as_it_is(node, disturbance):
    disturbance.kind, disturbance.amount = "offset", 5.0
    message = Float32(data=1.0)
    node.temperature.publish(message)
    assert message.data == 1.0


def test_not_a_number(values, disturbance):
    disturbance.kind = "nan"
    assert all(map(math.isnan, values(20.0, 21.5)))


@pytest.mark.parametrize(("share", "least", "most"), [(0, 200, 200), (50, 70, 130), (100, 0, 0)])
def test_a_share_of_the_messages_is_lost(values, disturbance, share, least, most):
    disturbance.kind, disturbance.amount = "dropout", float(share)
    assert least <= len(values(*[1.0] * 200)) <= most


def test_other_topics_are_left_alone(ros, node, disturbance):
    disturbance.kind = "nan"
    node.humidity.publish(Float32(data=50.0))
    assert [sample.value for sample in ros.messages("humidity")] == [50.0]


def test_afterwards_all_is_as_before(node, values, disturbance):
    disturbance.kind = "nan"
    disturbance.end()
    assert values(20.0) == [20.0]
    assert "Disturbance" not in repr(node.temperature.publish)


def test_what_rclpy_refuses_it_refuses_still(node, disturbance):
    disturbance.kind = "offset"
    with pytest.raises(TypeError, match="Expected"):
        node.temperature.publish(25.0)
