"""`ros.explain` in sessions: what they see of themselves."""

import time
from functools import partial

import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Int32

from nodes import Doer, Listener, Talker
from rosbeat import Session
from rosbeat.diagnosis.silence import Explanation
from rosbeat.errors import ClosedSessionError, DurationError, SessionError

pytestmark = pytest.mark.ros
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)


def verdicts(ros, topic="count"):
    found = ros.explain(topic)
    return [one.mistake for one in found.diagnoses] or [found.verdict]


def silent_node(ros, name="talker", do=lambda _: None):
    """A node with a timer and a publisher that it does not use."""
    node = ros.add(partial(Doer, do, name))
    node.create_publisher(Int32, "count", 10)
    return node


def test_all_is_well_with_the_rate(ros):
    ros.add(partial(Talker, period=0.25))
    ros.add(Listener)
    ros.run(10)
    found = ros.explain("/count")
    assert isinstance(found, Explanation)
    assert found.is_well
    assert found.rate_hz == 4.0
    assert found.title == "All is well on /count: 4 messages a second arrive at /listener."
    assert "40 messages" in found.sentences[0]
    assert "ran 40 times, the last at 10 s" in found.sentences[1]


def test_it_is_the_same_every_time_and_changes_nothing(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(10)
    before = ros.observation()
    assert ros.explain("count") == ros.explain("count")
    assert ros.observation() == before


def test_the_rate_is_that_of_the_newest_messages(ros):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.run(60)
    talker.timer.timer_period_ns = 100_000_000
    talker.timer.reset()
    ros.run(20)
    assert ros.explain("count").rate_hz == pytest.approx(10.0)


def test_nobody_is_there_and_then_one_side_is(ros):
    assert verdicts(ros) == ["topic-unknown"]
    ros.add(Listener)
    assert verdicts(ros) == ["no-publisher"]
    ros.remove("listener")
    ros.add(Talker)
    ros.run(1)
    assert verdicts(ros) == ["no-subscription"]


def test_a_publisher_that_was_removed(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.remove("talker")
    assert "/talker published until 3 s" in ros.explain("count").diagnoses[0].evidence


def test_a_misspelt_name(ros):
    ros.add(Talker)
    ros.add(partial(Listener, topic="cuont"))
    ros.run(3)
    assert verdicts(ros) == verdicts(ros, "cuont") == ["topic-misspelled"]
    assert "Did you mean /count?" in ros.explain("counts").diagnoses[0].hint


def test_qualities_that_do_not_fit(ros):
    ros.add(partial(Talker, qos=qos_profile_sensor_data))
    ros.add(Listener)
    ros.add(partial(Listener, "latched", qos=LATCHED))
    ros.run(3)
    assert verdicts(ros) == ["qos-mismatch", "qos-mismatch"]
    assert ros.explain("count").headlines == (
        "the reliability of /talker and /listener is incompatible",
        "reliability and durability of /talker and /latched are incompatible",
    )


def test_no_time_has_passed(ros):
    ros.add(Talker)
    ros.add(Listener)
    assert verdicts(ros) == ["not-spun"]
    ros.run(3)
    assert verdicts(ros) == ["all-is-well"]
    ros.add(Talker)  # in the place of the other
    assert verdicts(ros) == ["not-spun"]


def test_a_message_from_a_constructor_waits_for_the_next_run(ros):
    ros.add(Listener)
    silent_node(ros)
    node = ros.nodes[-1]
    next(node.publishers)  # /parameter_events
    list(node.publishers)[-1].publish(Int32(data=1))
    assert verdicts(ros) == ["not-spun"]
    ros.run(1)
    assert verdicts(ros) == ["all-is-well"]


def test_a_paused_node(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.pause("listener")
    assert verdicts(ros) == ["not-spun"]
    assert 'ros.resume("listener")' in ros.explain("count").diagnoses[0].hint
    ros.resume("listener")
    assert verdicts(ros) == ["all-is-well"]


def test_a_node_that_was_never_added(ros):
    ros.add(Talker)
    node = Listener()
    ros.run(3)
    assert verdicts(ros) == ["not-spun"]
    assert "ros.add" in ros.explain("count").diagnoses[0].hint
    ros.add(node)
    ros.run(1)
    assert verdicts(ros) == ["all-is-well"]


def test_a_node_that_has_ended(ros, capsys):
    silent_node(ros, do=lambda _: 1 / 0)
    ros.add(Listener)
    ros.run(3)
    found = ros.explain("count")
    assert [one.mistake for one in found.diagnoses] == ["node-ended"]
    assert "At 1 s act raised ZeroDivisionError: division by zero." in found.diagnoses[0].evidence
    assert "lambda _: 1 / 0" in found.diagnoses[0].evidence
    capsys.readouterr()
    ros.add(Talker)
    ros.run(1)
    assert verdicts(ros) == ["all-is-well"]


def test_a_publisher_that_is_never_used(ros):
    silent_node(ros)
    ros.add(Listener)
    ros.run(3)
    assert verdicts(ros) == ["never-published"]
    assert "act ran 3 times" in ros.explain("count").diagnoses[0].evidence


def test_a_publisher_that_has_stopped(ros):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    talker.timer.cancel()
    ros.run(10)
    assert verdicts(ros) == ["gone-quiet"]


@pytest.mark.parametrize(
    ("qos", "verdict"), [(10, "first-messages-lost"), (LATCHED, "all-is-well")]
)
def test_messages_from_before(ros, qos, verdict):
    talker = ros.add(partial(Talker, qos=qos))
    ros.run(3)
    talker.timer.cancel()
    ros.add(partial(Listener, qos=qos))
    ros.run(1)
    assert verdicts(ros) == [verdict]


def test_a_late_listener_that_gets_the_rest_is_well(ros):
    ros.add(Talker)
    ros.run(3)
    ros.add(Listener)
    ros.run(3)
    found = ros.explain("count")
    assert found.is_well
    assert (
        "ran 3 times, the last at 6 s; 3 messages had been published before" in (found.sentences[1])
    )


def test_two_causes_at_once(ros, capsys):
    silent_node(ros, do=lambda _: 1 / 0)
    ros.add(Listener)
    ros.run(3)
    ros.pause("listener")
    assert verdicts(ros) == ["node-ended", "not-spun"]
    capsys.readouterr()


def test_live(ros, eventually):
    ros.add(partial(Talker, period=0.02))
    listener = ros.add(Listener)
    ros.start()
    eventually(lambda: len(listener.heard) > 20, 60)
    found = ros.explain("count")
    assert found.is_well
    assert found.rate_hz > 0


def test_live_a_callback_that_does_not_return(eventually):
    begun, stop = [], []

    def hang(_):
        begun.append(True)
        while not stop:
            time.sleep(0.01)

    with Session() as ros:
        ros.add(partial(Doer, hang, period=0.01))
        ros.add(Talker)
        ros.add(Listener)
        ros.start()
        eventually(lambda: begun, 60)
        found = ros.explain("count")
        stop.append(True)
    assert found.verdict == "callback-blocks"
    assert "act has started but not returned" in found.diagnoses[0].evidence
    assert len(found.diagnoses) == 1


@pytest.mark.parametrize("name", ["room temperature", "1temp", "", "a//b", "temperature/", "a-b"])
def test_a_bad_name_gets_three_parts(ros, says, name):
    with pytest.raises(SessionError) as caught:
        ros.explain(name)
    says(caught.value, "cannot be the name of a topic", "topic name must not")


@pytest.mark.parametrize("name", [None, 5, Int32])
def test_no_name_gets_three_parts(ros, says, name):
    with pytest.raises(SessionError) as caught:
        ros.explain(name)
    says(caught.value, "quotation marks")


def test_a_bad_time_gets_three_parts(ros, says):
    with pytest.raises(DurationError) as caught:
        ros.explain("count", seconds=-1)
    says(caught.value, "explain(seconds=...)")


def test_from_inside_a_callback(ros, capsys):
    ros.add(partial(Doer, lambda _: ros.explain("count")))
    ros.run(1)
    assert [fault.kind for fault in ros.observation().faults] == ["SessionError"]
    capsys.readouterr()


def test_after_the_end(says):
    ros = Session()
    ros.close()
    with pytest.raises(ClosedSessionError) as caught:
        ros.explain("count")
    says(caught.value, "is closed")


def test_a_node_on_two_sides_of_one_topic(ros):
    node = ros.add(Talker)
    node.create_subscription(Int32, "count", lambda _: None, 10)
    ros.run(3)
    assert verdicts(ros) == ["all-is-well"]


def test_topics_that_every_node_brings(ros):
    ros.add(lambda: Node("alone"))
    ros.run(1)
    assert ros.explain("parameter_events").topic == "/parameter_events"
