"""What was published on a topic, from made-up observations."""

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.model import missing, on
from rosbeat.records import CallbackRecord, Endpoint, GraphSnapshot, Observation, QoS, Sample

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
WIRE = Wire("/humidity", FLOAT)


def sample(topic="/humidity", type_name=FLOAT, time_ns=1):
    return Sample(time_ns, topic, type_name, "/node", {"data": 1.0})


def seen(*samples, ends=(), callbacks=()):
    graph = GraphSnapshot(("/node",), tuple(ends))
    return Observation(10**9, 0, samples, (), tuple(callbacks), (), graph, "/node")


def publisher(topic):
    return Endpoint("/node", topic, FLOAT, "publisher", QoS())


def test_messages_of_one_topic_are_taken():
    mine, other = sample(), sample("/other")
    assert on(seen(other, mine), WIRE) == [mine]


def test_nothing_is_missing_if_the_type_is_right():
    assert missing(seen(sample()), WIRE) is None


def test_another_type_is_named():
    found = missing(seen(sample(type_name=STRING)), WIRE)
    assert found.mistake == "type-mismatch"
    assert STRING in found.evidence
    assert FLOAT in found.hint


def test_a_silence_is_explained_by_what_the_node_made():
    assert missing(seen(), WIRE).mistake == "no-publisher"
    assert missing(seen(ends=[publisher("/humidty")]), WIRE).mistake == "topic-misspelled"
    called = CallbackRecord(1, "/node", "subscription", "listen", "/x")
    ends = [publisher("/humidity"), publisher("/mean")]
    silent = seen(sample("/mean"), ends=ends, callbacks=[called])
    assert missing(silent, WIRE, ["/mean"]).mistake == "never-published"


def test_a_silence_that_nothing_explains_gets_the_exercise_s_own_words():
    own = Diagnosis("never-published", "Nothing on {topic}.", "Look.")
    nobody = Observation(10**9, 0)
    assert missing(nobody, WIRE, otherwise=own).mistake in ("no-publisher", "never-published")
