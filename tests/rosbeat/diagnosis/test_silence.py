"""Why nothing arrives on a topic: from scenes to explanations."""

from __future__ import annotations

import ast
from dataclasses import FrozenInstanceError, replace
from html.parser import HTMLParser
from itertools import combinations
from pathlib import Path

import pytest
from scenes import (
    LATCHED,
    SENSOR_DATA,
    STRING,
    TOPIC,
    elsewhere,
    ended,
    heard,
    pub,
    scene,
    seconds,
    silent,
    spoke,
    sub,
    timer,
    well,
)

from rosbeat.diagnosis import silence
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.diagnosis.silence import (
    WELL,
    Explanation,
    arrival,
    difference,
    explain,
    nearest,
    private_domains,
    report,
    sides_of,
    visible_topics,
)
from rosbeat.diagnosis.situation import Beat, Condition, Former, OtherDomain, StaleBuild
from rosbeat.records import GraphSnapshot, QoS

# Explanations: names

NAME = "/temperature"


@pytest.mark.parametrize(
    "other",
    [
        *("/temprature", "/Temperature", "/temperatures", "/tempearture", "/temperature_1"),
        *("/room/temperature", "/TEMPERATURE", "/temp_erature"),
    ],
)
def test_what_is_almost_the_same_is_found(other):
    assert nearest(NAME, ["/humidity", other]) == other
    assert nearest(other, [NAME, "/humidity"]) == NAME


@pytest.mark.parametrize("other", ["/humidity", "/temp", "/status", "/mean", "/t", "/pressure"])
def test_what_is_another_word_is_not(other):
    assert nearest(NAME, [other]) == ""


def test_the_name_itself_does_not_count():
    assert nearest(NAME, [NAME]) == ""
    assert nearest(NAME, []) == ""


def test_of_two_the_nearer_one_and_always_the_same():
    others = ["/temprature", "/temperatures", "/tmprature"]
    assert nearest(NAME, others) == nearest(NAME, reversed(others)) == "/temperatures"


def test_a_slash_and_an_underscore_are_no_letters():
    assert difference("/room/temperature", "/room_temperature").endswith("in one character")


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ("/Temperature", "capital letters"),
        ("/room/temperature", "before the last slash"),
        ("/temp_erature", "underscores"),
        ("/temprature", "one letter"),
        ("/temperature1", "one character"),
        ("/temprture", "2 letters"),
    ],
)
def test_in_what_they_differ(other, words):
    assert words in difference(NAME, other)


# One side is missing, or the two do not fit.


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


def test_two_types_of_one_name_are_told_apart():
    told = scene(pub(kind="my_msgs/msg/Float32", matched=0), sub(matched=0), beats=[spoke()])
    assert "publishes my_msgs/msg/Float32" in only(told)[0].evidence


def test_another_type_beside_a_publisher_that_is_heard():
    told = scene(pub(), pub("/other", kind=STRING, matched=0), sub(), beats=[spoke(), heard()])
    diagnosis, _, (mark,) = only(told)
    assert diagnosis.mistake == "type-mismatch"
    assert "/other publishes String, and /monitor subscribes to Float32" in diagnosis.evidence
    assert mark.words == ("sends String", "asks for Float32")


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
    assert sides_of("/none", graph).missing == "both"
    assert visible_topics(graph) == [TOPIC]


# Nodes that do not do their part.


def causes(told):
    return [one.mistake for one in explain(TOPIC, told).diagnoses]


def first(told):
    found = explain(TOPIC, told)
    return found.diagnoses[0], found.headlines[0], found.marks


def test_a_node_that_has_ended_and_why():
    diagnosis, headline, marks = first(silent(ended()))
    assert causes(silent(ended())) == ["node-ended"]
    assert headline == "/sensor has ended"
    assert "At 3 s publish raised ZeroDivisionError: division by zero." in diagnosis.evidence
    assert "Line 5: `1 / 0`" in diagnosis.evidence
    assert [(mark.kind, mark.subject) for mark in marks] == [("node", "/sensor")]


def test_a_node_that_ended_itself():
    diagnosis, _, _ = first(silent(Condition("/sensor", "ended")))
    assert "rclpy.shutdown()" in diagnosis.evidence


@pytest.mark.parametrize(
    ("state", "mistake", "words"),
    [
        ("paused", "not-spun", 'ros.resume("sensor")'),
        ("not added", "not-spun", "ros.add(...)"),
        ("no answer", "not-spun", "rclpy.spin(node)"),
        ("blocked", "callback-blocks", "no `time.sleep`"),
    ],
)
def test_a_node_that_nobody_runs(state, mistake, words):
    told = silent(Condition("/sensor", state, callback="publish"))
    diagnosis, headline, (mark,) = first(told)
    assert causes(told) == [mistake]
    assert "/sensor" in headline
    assert words in diagnosis.hint
    assert mark.kind == "node"


def test_who_blocks_need_not_be_on_the_topic():
    told = silent(Condition("/busy", "blocked", callback="work"))
    told = replace(told, own=told.own | {"/busy"}, virtual=False)
    assert causes(told) == ["callback-blocks"]
    assert "no other node of the session" in first(told)[0].evidence


def test_who_publishes_in_a_loop_of_its_own_need_not_answer():
    told = elsewhere(well(conditions=(Condition("/sensor", "no answer"),)))
    assert explain(TOPIC, told).is_well
    deaf = elsewhere(well(conditions=(Condition("/monitor", "no answer"),)))
    assert causes(deaf) == ["not-spun"]


def test_a_node_elsewhere_is_not_on_the_topic():
    assert explain(TOPIC, well(conditions=(ended("/other"),))).is_well


def test_no_time_has_passed():
    beats = (spoke(number=0, watched=0), heard(number=0, since=0))
    told = scene(pub(), sub(), beats=beats, now_ns=0)
    diagnosis, headline, _ = first(told)
    assert causes(told) == ["not-spun"]
    assert "no time has passed" in headline
    assert "ros.run" in diagnosis.hint
    assert causes(replace(told, virtual=False)) == ["never-published"]


def test_what_was_published_waits_for_the_next_run():
    beats = (spoke(number=1, last=0, rate=0.0, watched=0), heard(number=0, since=1))
    told = scene(pub(), sub(), beats=beats, now_ns=0, waiting=True)
    assert causes(told) == ["not-spun"]


def test_a_publisher_without_a_timer():
    diagnosis, headline, _ = first(silent())
    assert causes(silent()) == ["never-published"]
    assert headline == "/sensor has not published anything"
    assert "It has no timer" in diagnosis.evidence


@pytest.mark.parametrize(
    ("clock", "evidence", "hint"),
    [
        (timer(calls=10), "publish_temperature ran 10 times", "as far as `publish`"),
        (timer(period=60.0), "a period of 60 s and has not fired", "longer than 60 s"),
        (timer(), "a period of 1 s and has not fired", "cancels"),
    ],
)
def test_a_publisher_with_a_timer(clock, evidence, hint):
    diagnosis, _, _ = first(silent(timers=(clock,)))
    assert evidence in diagnosis.evidence
    assert hint in diagnosis.hint


def test_a_silent_publisher_of_another_process():
    diagnosis, _, _ = first(elsewhere(silent()))
    assert diagnosis.mistake == "never-published"
    assert "in 10 s no message came" in diagnosis.evidence
    assert "--seconds 30" in diagnosis.hint


def test_a_publisher_that_has_stopped():
    beats = (spoke(number=4, last=4.0), heard(number=4, last=4.0))
    diagnosis, headline, _ = first(scene(pub(), sub(), beats=beats))
    assert diagnosis.mistake == "gone-quiet"
    assert headline == "/sensor has stopped publishing"
    assert "4 messages, the last at 4 s, and nothing in the 6 s since" in diagnosis.evidence
    slow = (spoke(number=2, last=6.0, rate=0.25), heard(number=2))
    assert explain(TOPIC, scene(pub(), sub(), beats=slow)).is_well
    once = (spoke(number=1, last=1.0, rate=0.0), heard(number=1))
    assert explain(TOPIC, scene(pub(), sub(), beats=once)).is_well


def test_two_nodes_of_one_name():
    told = scene(pub(), pub(), sub(), twins=("/sensor",), beats=(spoke(), heard()))
    diagnosis, headline, _ = first(told)
    assert causes(told) == ["run-twice"]
    assert headline == "2 nodes are called /sensor"
    assert "each publishes" in diagnosis.evidence
    deaf = scene(pub(), sub(), sub(), twins=("/monitor",), beats=(spoke(), heard()))
    assert "each hears all" in first(deaf)[0].evidence


def test_another_of_that_name_that_is_not_on_the_topic():
    told = scene(pub(), sub(), twins=("/sensor",), beats=(spoke(), heard()))
    assert explain(TOPIC, told).is_well
    two = scene(pub(), pub(), sub(), beats=(spoke(), heard()))
    assert explain(TOPIC, two).is_well


@pytest.mark.parametrize(
    ("number", "words"), [(1, "The only message was"), (5, "All 5 messages were")]
)
def test_the_first_messages_are_lost(number, words):
    beats = (spoke(number=number, rate=0.0), heard(number=0, missed=number, since=0))
    told = scene(pub(), sub(), beats=beats)
    diagnosis, _, _ = first(told)
    assert causes(told) == ["first-messages-lost"]
    assert words in diagnosis.evidence
    assert "TRANSIENT_LOCAL" in diagnosis.hint


def test_messages_that_nobody_can_account_for():
    told = scene(pub(), sub(), beats=(spoke(), heard(number=0, since=3)))
    assert causes(told) == [UNKNOWN]
    assert first(told)[1] == "this is new to me"
    # Live, a message or two may be on their way.
    live = replace(told, virtual=False, beats=(spoke(), heard(number=0, since=2)))
    assert explain(TOPIC, live).is_well


# Explanations: elsewhere

BUILD = StaleBuild("sensor_simulator", "temperature_publisher", "sensor_simulator/publisher.py")


def test_what_is_missing_here_is_there():
    other = OtherDomain(12, publishers=("/sensor",), subscriptions=("/display",))
    found = explain(TOPIC, elsewhere(scene(sub(), other_domains=(other,))))
    assert [one.mistake for one in found.diagnoses] == ["other-domain", "no-publisher"]
    assert "In ROS domain 12, /sensor publishes on /temperature; this is domain 7." in (
        found.diagnoses[0].evidence
    )
    assert "/display" not in found.diagnoses[0].evidence
    assert "ROS_DOMAIN_ID" in found.diagnoses[0].hint


def test_both_sides_are_there():
    other = OtherDomain(12, publishers=("/sensor",), subscriptions=("/display",))
    found = explain(TOPIC, elsewhere(scene(other_domains=(other,))))
    assert found.verdict == "other-domain"
    assert "/display subscribes to" in found.diagnoses[0].evidence


def test_another_domain_matters_only_if_something_is_missing():
    other = OtherDomain(12, publishers=("/sensor",))
    assert explain(TOPIC, well(other_domains=(other,))).is_well
    assert causes(silent(other_domains=(other,))) == ["never-published"]
    assert causes(scene(sub(), other_domains=(OtherDomain(12),))) == ["no-publisher"]


def test_private_domains_are_a_remark():
    told = scene(sub(), other_domains=(OtherDomain(60, private=True),))
    assert causes(told) == ["no-publisher"]
    assert "ROS domain 60" in explain(TOPIC, told).sentences[-1]
    two = (OtherDomain(60, private=True), OtherDomain(61, private=True))
    assert "domains 60 and 61" in private_domains(scene(other_domains=two))
    assert private_domains(scene()) == ""


def test_a_build_that_is_older_than_its_source():
    found = explain(TOPIC, elsewhere(scene(sub(), stale_builds=(BUILD,))))
    assert [one.mistake for one in found.diagnoses] == ["not-rebuilt", "no-publisher"]
    assert "ros2 run sensor_simulator temperature_publisher" in found.diagnoses[0].evidence
    assert "colcon build" in found.diagnoses[0].hint


def test_a_package_that_was_never_built():
    build = StaleBuild("sensor_simulator", "temperature_publisher", "a/b.py", built=False)
    assert causes(elsewhere(scene(sub(), stale_builds=(build,))))[0] == "not-built"


def test_an_old_build_is_no_cause_if_all_is_well():
    found = explain(TOPIC, well(stale_builds=(BUILD,)))
    assert found.is_well
    assert found.sentences[-1].startswith("Note: temperature_publisher was edited")


def test_a_silent_publisher_may_be_an_old_build():
    told = elsewhere(scene(pub(), sub(), stale_builds=(BUILD,)))
    assert "not-rebuilt" in causes(told)


# Explanations: report


def test_who_is_there_and_what_each_has_done():
    told = scene(pub(), sub(), beats=(spoke(), heard(missed=2)))
    assert report(sides_of(TOPIC, told.graph), told) == (
        "/sensor publishes Float32 (RELIABLE, VOLATILE, depth 10): 10 messages, 1 message a "
        "second, the last at 10 s.",
        "/monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10): its callback ran 10 "
        "times, the last at 10 s; 2 messages had been published before.",
    )


def test_what_is_not_known_is_left_out():
    unknown = QoS(depth=0)
    told = elsewhere(scene(pub(qos=unknown), sub(qos=unknown), arriving_hz=4.0))
    assert report(sides_of(TOPIC, told.graph), told) == (
        "/sensor publishes Float32 (RELIABLE, VOLATILE).",
        "/monitor subscribes to Float32 (RELIABLE, VOLATILE).",
        "Altogether 4 messages a second come from other processes.",
    )


def test_nothing_came():
    silent = Beat("/sensor", "publisher", 0, watched_ns=3_000_000_000)
    told = scene(pub(), sub(), beats=(silent, heard(number=0, since=0)))
    publisher, listener = report(sides_of(TOPIC, told.graph), told)
    assert publisher.endswith("nothing in 3 s.")
    assert listener.endswith("its callback has not run.")


def test_what_arrives():
    told = well()
    sides = sides_of(TOPIC, told.graph)
    assert arrival(sides, told, 4.0) == "4 messages a second arrive at /monitor"
    assert arrival(sides, told, 0.0) == "10 messages arrived at /monitor so far"
    alone = scene(pub(), beats=(spoke(),))
    assert "not shown here" in arrival(sides_of(TOPIC, alone.graph), alone, 1.0)


def test_several_publishers_add_up():
    beats = (spoke(), spoke("/other", rate=3.0), heard())
    found = explain(TOPIC, scene(pub(), pub("/other"), sub(), beats=beats))
    assert found.is_well
    assert found.rate_hz == 4.0


# All causes together: which comes first, and how it is shown.

LOST = (spoke(number=2, rate=0.0), heard(number=0, missed=2, since=0))
OTHER = OtherDomain(12, publishers=("/sensor",))
#: A scene for every verdict.
SCENES = {
    "node-ended": silent(ended()),
    "callback-blocks": silent(Condition("/sensor", "blocked", callback="work")),
    "not-spun": silent(Condition("/monitor", "paused")),
    "type-mismatch": scene(pub(kind=STRING, matched=0), sub(matched=0), beats=(spoke(),)),
    "qos-mismatch": scene(pub(qos=SENSOR_DATA, matched=0), sub(matched=0), beats=(spoke(),)),
    "topic-misspelled": scene(pub(topic="/temprature", matched=0), sub(matched=0)),
    "other-domain": elsewhere(scene(sub(), other_domains=(OTHER,))),
    "not-rebuilt": elsewhere(scene(sub(), stale_builds=(BUILD,))),
    "not-built": elsewhere(scene(sub(), stale_builds=(replace(BUILD, built=False),))),
    "topic-unknown": scene(),
    "no-publisher": scene(sub()),
    "never-published": silent(),
    "gone-quiet": scene(pub(), sub(), beats=(spoke(last=2.0), heard())),
    "first-messages-lost": scene(pub(), sub(), beats=LOST),
    "run-twice": scene(pub(), pub(), sub(), twins=("/sensor",), beats=(spoke(), heard())),
    "no-subscription": scene(pub(matched=0), beats=(spoke(),)),
    UNKNOWN: scene(pub(), sub(), beats=(spoke(), heard(number=0))),
    WELL: well(),
}


@pytest.mark.parametrize("verdict", SCENES)
def test_every_verdict(verdict):
    found = explain(TOPIC, SCENES[verdict])
    assert found.verdict == verdict
    assert found.is_well == (verdict == WELL) == (found.diagnoses == ())
    assert len(found.headlines) == max(1, len(found.diagnoses))
    assert all(one.evidence and one.hint for one in found.diagnoses)


def test_every_verdict_is_a_mistake_with_a_name_and_is_tried_here():
    assert set(SCENES) == {*silence._ORDER, WELL}
    assert set(silence._ORDER) <= {*MISTAKES, UNKNOWN}


def test_every_mistake_that_is_named_is_in_the_order():
    folder = Path(silence.__file__).parent
    named = {
        call.args[0].value
        for path in folder.glob("silence.py")
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and ast.unparse(call.func) in ("finding", "_Cause")
        and isinstance(call.args[0], ast.Constant)
    }  # fmt: skip
    assert named == set(silence._ORDER) - {UNKNOWN}


def together(one, other):
    """Both scenes in one: each on its own nodes."""
    graph = GraphSnapshot((*one.graph.nodes, *other.graph.nodes),
                          (*one.graph.endpoints, *other.graph.endpoints))  # fmt: skip
    return replace(
        one, graph=graph, beats=(*one.beats, *other.beats),
        conditions=(*one.conditions, *other.conditions), own=one.own | other.own,
    )  # fmt: skip


def renamed(told):
    """The same scene with other nodes."""

    def name(record):
        return replace(record, node=f"{record.node}_2")

    graph = GraphSnapshot(tuple(f"{node}_2" for node in told.graph.nodes),
                          tuple(map(name, told.graph.endpoints)))  # fmt: skip
    return replace(
        told, graph=graph, own=frozenset(graph.nodes), beats=tuple(map(name, told.beats)),
        conditions=tuple(map(name, told.conditions)),
    )  # fmt: skip


PAIRS = list(
    combinations(
        ["node-ended", "not-spun", "qos-mismatch", "never-published", "gone-quiet", "run-twice"], 2
    )
)


@pytest.mark.parametrize(("one", "other"), PAIRS)
def test_pairs_of_causes_are_both_named_the_likelier_first(one, other):
    told = together(SCENES[one], renamed(SCENES[other]))
    found = [diagnosis.mistake for diagnosis in explain(TOPIC, told).diagnoses]
    assert {one, other} <= set(found)
    assert found.index(one) < found.index(other)
    assert found == [
        diagnosis.mistake
        for diagnosis in explain(
            TOPIC, together(renamed(SCENES[other]), SCENES[one])
        ).diagnoses
    ]  # fmt: skip


def test_the_same_scene_gives_the_same_words():
    for told in SCENES.values():
        assert str(explain(TOPIC, told)) == str(explain(TOPIC, told))
        assert explain(TOPIC, told) == explain(TOPIC, told)


def test_the_text():
    assert str(explain(TOPIC, SCENES["no-publisher"])).splitlines() == [
        "\N{BALLOT X} Nobody publishes on /temperature.",
        "  Seen: /monitor listens there, and no node publishes. Topics that are published: none.",
        "  Hint: Start the node that publishes, with `ros.add(...)`, and compare the topic's name "
        "in its",
        "        `create_publisher`.",
        "  - /monitor subscribes to Float32 (RELIABLE, VOLATILE, depth 10).",
    ]
    assert str(explain(TOPIC, well())).startswith(
        "\N{CHECK MARK} All is well on /temperature: 1 message a second arrives at /monitor.\n"
    )


def test_a_second_cause_says_also():
    text = str(explain(TOPIC, SCENES["other-domain"]))
    assert "Also: nobody publishes on /temperature." in text


def test_the_text_is_never_wide():
    for told in SCENES.values():
        assert max(map(len, str(explain(TOPIC, told)).splitlines())) <= 100


class _Reader(HTMLParser):
    """Reads the words, and complains about tags that do not close."""

    def __init__(self):
        super().__init__()
        self.words, self.open = [], []

    def handle_starttag(self, tag, attrs):
        if tag != "br":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


@pytest.mark.parametrize("verdict", SCENES)
def test_the_html_says_the_same_and_takes_the_readers_colours(verdict):
    found = explain(TOPIC, SCENES[verdict])
    html, reader = found._repr_html_(), _Reader()
    reader.feed(html)
    assert reader.open == []
    assert "background" not in html
    assert ";color:" not in html
    words = "".join(reader.words)
    for text in (found.title, *found.headlines[1:], *found.sentences):
        assert text in words
    for one in found.diagnoses:
        assert one.evidence in words
        assert one.hint in words


def test_what_a_learner_typed_does_not_become_markup():
    evil = Condition("/monitor", "ended", replace(ended().fault, text="<script>alert(1)</script>"))
    html = explain(TOPIC, silent(evil))._repr_html_()
    assert "<script>" not in html
    assert "&lt;script&gt;" in html


def test_it_shows_itself_and_cannot_be_changed():
    found = explain(TOPIC, well())
    assert repr(found) == str(found)
    with pytest.raises(FrozenInstanceError):
        found.verdict = "other"  # type: ignore[misc]
    assert Explanation(TOPIC, WELL).graph == GraphSnapshot()


def test_messages_that_could_not_be_counted_are_new():
    found = explain(TOPIC, elsewhere(scene(pub(), sub())))
    assert found.verdict == UNKNOWN
    assert "ros2 topic echo /temperature" in found.diagnoses[0].hint
