"""`ros.explain`: what sessions see of themselves, and of nodes in other processes."""

import time
from functools import partial

import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from std_msgs.msg import Int32

from nodes import Doer, Listener, Talker
from other_process import other_process
from rosbeat import Session
from rosbeat.diagnosis.silence import Explanation
from rosbeat.domains import lease_domain
from rosbeat.errors import SessionError
from rosbeat.records import is_hidden

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


def removed(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.remove("talker")


def misspelt(ros):
    ros.add(Talker)
    ros.add(partial(Listener, topic="cuont"))
    ros.run(3)
    assert verdicts(ros, "cuont") == ["topic-misspelled"]
    assert "Did you mean /count?" in ros.explain("counts").diagnoses[0].hint


def of_other_qualities(ros):
    ros.add(partial(Talker, qos=qos_profile_sensor_data))
    ros.add(Listener)
    ros.add(partial(Listener, "latched", qos=LATCHED))
    ros.run(3)
    assert ros.explain("count").headlines == (
        "the reliability of /talker and /listener is incompatible",
        "reliability and durability of /talker and /latched are incompatible",
    )


def paused(ros):
    ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    ros.pause("listener")


def never_added(ros):
    ros.add(Talker)
    Listener()
    ros.run(3)


def ended(ros):
    silent_node(ros, do=lambda _: 1 / 0)
    ros.add(Listener)
    ros.run(3)


def never_used(ros):
    silent_node(ros)
    ros.add(Listener)
    ros.run(3)


def stopped(ros):
    talker = ros.add(Talker)
    ros.add(Listener)
    ros.run(3)
    talker.timer.cancel()
    ros.run(10)


def two_causes(ros):
    ended(ros)
    ros.pause("listener")


def from_a_constructor(ros):
    ros.add(Listener)
    list(silent_node(ros).publishers)[-1].publish(Int32(data=1))


def too_late(ros, qos=10):
    talker = ros.add(partial(Talker, qos=qos))
    ros.run(3)
    talker.timer.cancel()
    ros.add(partial(Listener, qos=qos))
    ros.run(1)


#: What is done, the verdicts, and a text of the first diagnosis: its evidence and its hint.
CAUSES = [
    (lambda ros: None, ["topic-unknown"], ""),
    (lambda ros: ros.add(Listener), ["no-publisher"], ""),
    (lambda ros: (ros.add(Talker), ros.run(1)), ["no-subscription"], ""),
    (removed, ["no-publisher"], ""),
    (misspelt, ["topic-misspelled"], ""),
    (of_other_qualities, ["qos-mismatch", "qos-mismatch"], ""),
    (from_a_constructor, ["not-spun"], ""),
    (paused, ["not-spun"], 'ros.resume("listener")'),
    (never_added, ["not-spun"], "ros.add"),
    (ended, ["node-ended"], "At 1 s act raised ZeroDivisionError: division by zero."),
    (never_used, ["never-published"], "act ran 3 times"),
    (stopped, ["gone-quiet"], ""),
    (too_late, ["first-messages-lost"], ""),
    (partial(too_late, qos=LATCHED), ["all-is-well"], ""),
    (two_causes, ["node-ended", "not-spun"], ""),
]


@pytest.mark.parametrize(("do", "expected", "text"), CAUSES)
def test_why_nothing_arrives(ros, capsys, do, expected, text):
    do(ros)
    assert verdicts(ros) == expected
    if text:
        (first, *_) = ros.explain("count").diagnoses
        assert text in f"{first.evidence} {first.hint}"
    capsys.readouterr()


def test_no_time_has_passed(ros):
    ros.add(Talker)
    ros.add(Listener)
    assert verdicts(ros) == ["not-spun"]
    ros.run(3)
    assert verdicts(ros) == ["all-is-well"]
    ros.add(Talker)  # in the place of the other
    assert verdicts(ros) == ["not-spun"]


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


# Nodes of other processes: what arrives from them, and whether they answer.


#: The second one is in the graph and nobody spins it.
NODES = (
    "Talker(period=0.1), *(kept := [Listener('deaf', 'count'), Talker('quiet', 'hush')])[2:], "
    "Listener(topic='cuont'), Listener(topic='hush'), Words(topic='words'),"
)


@pytest.fixture(scope="module")
def domain():
    lease = lease_domain()
    with other_process(lease.domain_id, NODES):
        yield lease.domain_id
    lease.release()


@pytest.fixture
def joined(domain):
    with Session(domain_id=domain) as session:
        yield session


def mistakes(found):
    return [one.mistake for one in found.diagnoses] or [found.verdict]


def test_a_node_that_is_not_spun_hears_nothing(joined):
    found = joined.explain("count", seconds=20)
    assert mistakes(found) == ["not-spun"]
    assert found.headlines == ("/deaf does not answer",)
    assert found.rate_hz > 0


def test_a_node_that_is_not_spun_says_nothing(joined):
    found = joined.explain("hush", seconds=0.5)
    assert mistakes(found) == ["not-spun"]
    assert found.headlines == ("/quiet does not answer",)


def test_an_own_node_hears_them(joined):
    listener = joined.add(partial(Listener, "own", "words"))
    assert listener.heard == []
    found = joined.explain("words", seconds=20)
    assert mistakes(found) == ["type-mismatch"]
    assert "/words publishes String, and /own subscribes to Int32" in found.diagnoses[0].evidence


def test_nothing_is_left_behind(joined, eventually):
    hidden = lambda: [name for name in joined._core.graph_observer.nodes() if is_hidden(name)]  # noqa: E731
    before = hidden()
    joined.explain("cuont", seconds=0)
    eventually(lambda: hidden() == before, 30)
    assert joined.nodes == ()
