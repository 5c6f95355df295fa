"""One side is missing, or the two do not fit."""

import pytest
from scenes import (
    LATCHED,
    SENSOR_DATA,
    STRING,
    TOPIC,
    elsewhere,
    heard,
    pub,
    scene,
    seconds,
    spoke,
    sub,
)

from rosbeat.diagnosis.explanation import explain
from rosbeat.diagnosis.explanation_links import sides_of, visible_topics
from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.diagnosis.situation import Former


def only(told, topic=TOPIC):
    """The only cause, its headline and its marks."""
    found = explain(topic, told)
    (diagnosis,) = found.diagnoses
    assert found.verdict == diagnosis.mistake
    return diagnosis, found.headlines[0], found.marks


def test_nobody_publishes():
    told = scene(sub(), pub("/other", "/humidity"), beats=[heard(number=0, since=0)])
    diagnosis, headline, _ = only(told)
    assert diagnosis.mistake == "no-publisher"
    assert headline == "nobody publishes on /temperature"
    assert "/monitor listens there" in diagnosis.evidence
    assert "Topics that are published: /humidity." in diagnosis.evidence
    assert "ros.add" in diagnosis.hint


def test_somebody_published_before():
    former = (Former("/old", 3, seconds(2)), Former("/sensor", 12, seconds(5)))
    evidence = only(scene(sub(), former=former))[0].evidence
    assert "/sensor did until 5 s, and is no longer there" in evidence
    unknown = only(scene(sub(), former=(Former("?", 1, seconds(1)),)))[0].evidence
    assert "another process did until 1 s" in unknown


def test_nobody_subscribes():
    diagnosis, headline, _ = only(scene(pub(matched=0), beats=[spoke()]))
    assert diagnosis.mistake == "no-subscription"
    assert headline == "nobody subscribes to /temperature"


def test_a_listener_that_is_not_shown_is_one():
    assert explain(TOPIC, scene(pub(matched=1), beats=[spoke()])).is_well


@pytest.mark.parametrize(
    ("told", "words"),
    [
        (scene(sub()), "with `ros.add(...)`, and"),
        (scene(sub(), domain_id=7), "or in a terminal"),
        (elsewhere(scene(sub())), "with `ros2 run`"),
    ],
)
def test_the_hint_fits_the_place(told, words):
    assert words in only(told)[0].hint


def test_a_topic_that_nobody_uses():
    diagnosis, headline, marks = only(scene(pub("/a", "/humidity"), sub("/b", "/humidity")))
    assert diagnosis.mistake == "topic-unknown"
    assert headline == "nobody uses /temperature"
    assert "Topics that are used: /humidity." in diagnosis.evidence
    assert [mark.kind for mark in marks] == ["topic"]


def test_the_question_itself_is_misspelt():
    diagnosis, _, marks = only(scene(pub(), sub(), beats=[spoke(), heard()]), "/temprature")
    assert diagnosis.mistake == "topic-unknown"
    assert "Did you mean /temperature?" in diagnosis.hint
    assert [mark.kind for mark in marks] == ["topic", "near"]


def test_in_an_empty_graph():
    diagnosis, _, _ = only(scene())
    assert "Topics that are used: none." in diagnosis.evidence


@pytest.mark.parametrize("asked", ["/temprature", "/temperature"])
def test_a_misspelt_name_whichever_side_is_asked_about(asked):
    told = scene(pub(topic="/temprature", matched=0), sub(matched=0))
    diagnosis, headline, (mark,) = only(told, asked)
    assert diagnosis.mistake == "topic-misspelled"
    assert headline == "/temprature and /temperature are two topics"
    assert "one letter" in diagnosis.evidence
    assert (mark.kind, mark.subject, mark.other) == ("near", "/temprature", "/temperature")


def test_a_near_name_with_both_sides_is_another_topic():
    others = (pub("/a", "/temperature_2"), sub("/b", "/temperature_2"))
    assert only(scene(sub(), *others))[0].mistake == "no-publisher"


def test_another_word_is_no_misspelling():
    told = scene(pub(topic="/humidity", matched=0), sub(matched=0))
    assert only(told)[0].mistake == "no-publisher"


def test_two_types():
    told = scene(pub(kind=STRING, matched=0), sub(matched=0), beats=[spoke(), heard(number=0)])
    diagnosis, headline, (mark,) = only(told)
    assert diagnosis.mistake == "type-mismatch"
    assert headline == "two message types on /temperature"
    assert "/sensor publishes String, and /monitor subscribes to Float32" in diagnosis.evidence
    assert mark.words == ("sends String", "asks for Float32")


def test_another_type_beside_a_publisher_that_is_heard():
    told = scene(pub(), pub("/other", kind=STRING, matched=0), sub(), beats=[spoke(), heard()])
    diagnosis, _, (mark,) = only(told)
    assert diagnosis.mistake == "type-mismatch"
    assert "/other publishes String, and /monitor subscribes to Float32" in diagnosis.evidence
    assert mark.words == ("sends String", "asks for Float32")


def test_two_types_of_one_name_are_told_apart():
    told = scene(pub(kind="my_msgs/msg/Float32", matched=0), sub(matched=0), beats=[spoke()])
    assert "publishes my_msgs/msg/Float32" in only(told)[0].evidence


@pytest.mark.parametrize(
    ("offered", "asked", "words", "policy"),
    [
        (SENSOR_DATA, None, ("offers BEST_EFFORT", "asks for RELIABLE"), "reliability"),
        (None, LATCHED, ("offers VOLATILE", "asks for TRANSIENT_LOCAL"), "durability"),
    ],
)
def test_qualities_that_do_not_fit(offered, asked, words, policy):
    told = scene(pub(qos=offered, matched=0), sub(qos=asked, matched=0),
                 beats=[spoke(), heard(number=0)])  # fmt: skip
    diagnosis, headline, (mark,) = only(told)
    assert diagnosis.mistake == "qos-mismatch"
    assert headline == f"the {policy} of /sensor and /monitor does not fit"
    assert f"The rule of {policy}: a subscription that asks for" in diagnosis.evidence
    assert (mark.words, mark.subject) == (words, "/monitor")


def test_both_policies_in_one_sentence():
    told = scene(pub(qos=SENSOR_DATA, matched=0), sub(qos=LATCHED, matched=0), beats=[spoke()])
    _, headline, (mark,) = only(told)
    assert headline == "reliability and durability of /sensor and /monitor do not fit"
    assert mark.words[0] == "offers BEST_EFFORT and VOLATILE"


def test_one_of_two_publishers_fits():
    told = scene(pub(qos=SENSOR_DATA, matched=0), pub("/good"), sub(),
                 beats=[spoke(), spoke("/good"), heard()])  # fmt: skip
    diagnosis, _, (mark,) = only(told)
    assert diagnosis.mistake == "qos-mismatch"
    assert mark.subject == "/sensor"


def test_not_connected_and_nobody_knows_why():
    told = scene(pub(matched=0), sub(matched=0), beats=[spoke(), heard(number=0, since=9)])
    diagnosis, headline, _ = only(told)
    assert diagnosis.mistake == UNKNOWN
    assert headline == "/sensor and /monitor are not connected"
    assert "deadline" in diagnosis.hint


def test_an_unknown_number_of_matches_says_nothing():
    told = scene(pub(matched=-1), sub(matched=-1), beats=[spoke(), heard()])
    assert explain(TOPIC, told).is_well


def test_sides():
    graph = scene(pub(), sub(), pub("/a", "/rosout"), pub("/a", "/_hidden")).graph
    assert sides_of(TOPIC, graph).missing == ""
    assert len(list(sides_of(TOPIC, graph).pairs)) == 1
    assert sides_of("/none", graph).missing == "both"
    assert visible_topics(graph) == [TOPIC]
