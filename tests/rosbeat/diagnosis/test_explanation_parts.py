import pytest
from scenes import pub, sub

from rosbeat.diagnosis import explanation_parts as parts
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.records import QoS


@pytest.mark.parametrize(
    ("rate", "words"),
    [
        (1.0, "1 message a second"),
        (0.9987, "1 message a second"),
        (4.02, "4 messages a second"),
        (1.5, "1.5 messages a second"),
        (123.0, "120 messages a second"),
        (0.5, "a message every 2 s"),
        (0.1, "a message every 10 s"),
    ],
)
def test_rates(rate, words):
    assert parts.rate_words(rate) == words


def test_a_rate_has_its_verb():
    assert parts.comes(1.0, "comes", "come") == "1 message a second comes"
    assert parts.comes(4.0, "comes", "come") == "4 messages a second come"
    assert parts.comes(0.5, "comes", "come") == "a message every 2 s comes"


def test_lists_name_each_once():
    assert parts.listing([]) == ""
    assert parts.listing(["/a", "/a"]) == "/a"
    assert parts.listing(["/a", "/b", "/c"]) == "/a, /b and /c"
    assert parts.nodes_of([pub("/a"), sub("/a"), sub("/b")]) == "/a and /b"
    assert parts.verb([pub("/a"), sub("/a")], "is", "are") == "is"
    assert parts.verb([pub("/a"), sub("/b")], "is", "are") == "are"


def test_numbers_types_and_times():
    assert [parts.count(n, "message") for n in (0, 1, 2)] == [
        *("no messages", "1 message", "2 messages")
    ]
    assert parts.short_type("std_msgs/msg/Float32") == "Float32"
    assert [parts.seconds(n) for n in (3.0, 0.25, 1000.0)] == ["3 s", "0.25 s", "1000 s"]


def test_an_unknown_depth_is_left_out():
    assert parts.qos_words(QoS()) == "RELIABLE, VOLATILE, depth 10"
    assert parts.qos_words(QoS(depth=0)) == "RELIABLE, VOLATILE"
    limited = QoS(deadline_ns=500_000_000, lifespan_ns=2_000_000_000)
    assert parts.qos_words(limited).endswith("depth 10, deadline 0.5 s, lifespan 2 s")


def test_a_finding_and_its_mark():
    mark = parts.link(sub(), "nothing", "arrives")
    assert (mark.kind, mark.subject, mark.other) == ("link", "/monitor", "/temperature")
    assert mark.side == "subscription"
    found = parts.finding("not-spun", "it stands still", "seen", "do", [mark])
    assert found.diagnosis == Diagnosis("not-spun", "seen", "do")
    assert found.marks == (mark,)
