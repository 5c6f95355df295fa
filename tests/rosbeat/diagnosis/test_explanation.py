"""All causes together: which comes first, and how it is shown."""

import ast
from dataclasses import FrozenInstanceError, replace
from html.parser import HTMLParser
from itertools import combinations
from pathlib import Path

import pytest
from scenes import (
    SENSOR_DATA,
    STRING,
    TOPIC,
    elsewhere,
    ended,
    heard,
    pub,
    scene,
    silent,
    spoke,
    sub,
    well,
)

from rosbeat.diagnosis import explanation
from rosbeat.diagnosis.explanation import WELL, Explanation, explain
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.diagnosis.situation import Condition, OtherDomain, StaleBuild
from rosbeat.records import GraphSnapshot

LOST = (spoke(number=2, rate=0.0), heard(number=0, missed=2, since=0))
BUILD = StaleBuild("sensor_simulator", "temperature_publisher", "sensor_simulator/publisher.py")
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
    assert set(SCENES) == {*explanation._ORDER, WELL}
    assert set(explanation._ORDER) <= {*MISTAKES, UNKNOWN}


def test_every_mistake_that_is_named_is_in_the_order():
    folder = Path(explanation.__file__).parent
    named = {
        call.args[0].value
        for path in folder.glob("explanation*.py")
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and ast.unparse(call.func) == "finding"
        and isinstance(call.args[0], ast.Constant)
    }  # fmt: skip
    assert named == set(explanation._ORDER) - {UNKNOWN}


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
