"""What stands below a cell that ends in a record, or in a part of rclpy."""

import pytest
from IPython.core.interactiveshell import InteractiveShell
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Float32

from rosbeat import Session, record_display


class Sensor(Node):
    """Publishes once a second."""

    def __init__(self):
        super().__init__("sensor")
        profile = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
        profile.deadline = Duration(seconds=2)
        self.publisher = self.create_publisher(Float32, "temperature", profile)
        self.timer = self.create_timer(0.5, self.publish)
        self.profile = profile

    def publish(self):
        self.publisher.publish(Float32(data=20.1))
        self.get_logger().info("said 20.1")


@pytest.fixture(scope="module")
def shown():
    """Shows a value as a cell does."""
    shell = InteractiveShell()
    record_display.register(shell)
    return lambda value: shell.display_formatter.format(value)[0]["text/plain"]


@pytest.fixture(scope="module")
def ros():
    with Session(seed=1) as session:
        session.add(Sensor)
        session.run(seconds=1, quiet=True)
        yield session


def test_records_are_one_line_each_with_times_in_seconds(shown, ros):
    assert shown(ros.messages("temperature")) == (
        "(Sample(time=0.5, topic='/temperature', node='/sensor', value=20.1),\n"
        " Sample(time=1.0, topic='/temperature', node='/sensor', value=20.1))"
    )
    first = ros.logs("sensor")[0]
    assert shown(first) == "LogRecord(time=0.5, level='INFO', name='sensor', text='said 20.1')"
    assert shown(ros.observation()) == (
        "Observation(1 s, seed 1: 2 messages, 2 log lines, 2 callbacks, 0 faults)"
    )
    assert "time_ns=500000000" in repr(first)


def test_a_graph_says_who_uses_which_topic(shown, ros):
    assert shown(ros.graph()) == (
        "GraphSnapshot: 1 node, 1 topic\n  /temperature: /sensor → nobody"
    )
    (end,) = ros.graph().on("/temperature", "publisher")
    assert shown(end).startswith(
        "Endpoint(node='/sensor', name='/temperature', type_name='std_msgs"
    )
    assert "qos=QoS(reliability='BEST_EFFORT', " in shown(end)


def test_nodes_and_their_parts_say_what_they_are(shown, ros):
    (sensor,) = ros.nodes
    assert shown(sensor) == "Sensor(/sensor; publishes /temperature; timers every 0.5 s)"
    assert shown(sensor.publisher) == "Publisher(topic_name='/temperature')"
    assert shown(sensor.timer) == "Timer(every 0.5 s)"
    assert shown(sensor.profile) == (
        "QoSProfile(reliability=BEST_EFFORT, durability=VOLATILE, history=KEEP_LAST, depth=5,"
        " deadline=2 s)"
    )


def test_what_cannot_be_asked_any_more_has_its_usual_form(shown):
    with Session() as session:
        session.add(Sensor)
        (sensor,) = session.nodes
    assert shown(sensor.timer).startswith(("<rclpy.timer.Timer object", "Timer("))


@pytest.mark.parametrize(
    ("value", "text"),
    [(20.100000381469727, "20.1"), (0.1, "0.1"), (float("nan"), "nan"), (1e300, "1e+300"),
     (1 / 3, "0.3333333333333333"), (-0.0, "-0.0")],
)  # fmt: skip
def test_a_number_has_the_digits_that_were_sent(shown, value, text):
    from rosbeat.records import Sample

    one = Sample(0, "/t", "std_msgs/msg/Float64", "/n", {"data": value})
    assert shown(one).endswith(f"value={text})")


def test_a_long_value_is_cut(shown):
    from rosbeat.records import Sample

    assert len(shown(Sample(0, "/t", "x", "/n", {"data": "a" * 10_000}))) < 300
