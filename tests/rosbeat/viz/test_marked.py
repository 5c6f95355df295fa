"""An explanation as a picture: the cause is marked where it is, in words and in shape."""

import pytest
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch, Polygon

from rosbeat.diagnosis.silence import explain
from rosbeat.diagnosis.situation import Beat, Condition, Scene
from rosbeat.records import Endpoint, GraphSnapshot, QoS
from rosbeat.viz import theme
from rosbeat.viz.marked import has_head, marked, note_key, say
from rosbeat.viz.node_graph import graph
from rosbeat.viz.wiring import Edge

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
TOPIC = "/temperature"
WEAK = QoS(reliability="BEST_EFFORT")


def end(node, kind, topic=TOPIC, type_name=FLOAT, qos=None, matched=0):
    return Endpoint(node, topic, type_name, kind, qos or QoS(), matched)


def pair(sends=FLOAT, offers=None, matched=0, publishes_on=TOPIC):
    return (
        end("/temperature_sensor", "publisher", publishes_on, sends, offers, matched),
        end("/temperature_monitor", "subscription", matched=matched),
    )


def scene(*ends, twins=(), **more):
    nodes = tuple(dict.fromkeys(one.node for one in ends))
    return Scene(GraphSnapshot((*nodes, *twins), ends), own=frozenset(nodes), **more)


def beats(published, heard):
    return (
        Beat("/temperature_sensor", "publisher", published, published, float(published)),
        Beat("/temperature_monitor", "subscription", heard),
    )


def stopped(state):
    condition = Condition("/temperature_sensor", state, callback="publish")
    return scene(*pair(matched=1), conditions=(condition,), beats=beats(0, 0))


CASES = {
    "all is well": scene(*pair(matched=1), beats=beats(9, 9)),
    "qos": scene(*pair(offers=WEAK), beats=beats(9, 0)),
    "types": scene(*pair(sends=STRING), beats=beats(9, 0)),
    "near": scene(*pair(publishes_on="/temprature"), beats=beats(9, 0)),
    "unknown": scene(*pair(publishes_on="/pressure"), beats=beats(9, 0)),
    "nobody publishes": scene(pair()[1]),
    "nobody subscribes": scene(pair()[0], beats=beats(9, 0)),
    "silent": scene(*pair(matched=1), beats=beats(0, 0)),
    "ended": stopped("ended"),
    "paused": stopped("paused"),
    "blocked": stopped("blocked"),
    "twins": scene(
        *(pair(matched=1)[0], *pair(matched=1)),
        twins=("/temperature_sensor",),
        beats=beats(9, 9),
    ),
    "one of two": scene(
        end("/temperature_sensor", "publisher", qos=WEAK),
        end("/temperature_monitor", "subscription", matched=1),
        end("/good_sensor", "publisher", matched=1),
        beats=beats(9, 9),
    ),
    "itself": scene(end("/echo", "publisher", matched=1), end("/echo", "subscription", matched=1)),
}


def look(name, topic=TOPIC):
    return explain(topic, CASES[name])


def patches(picture, kind):
    return [patch for patch in picture.figure.axes[0].patches if type(patch) is kind]


@pytest.mark.parametrize("case", CASES)
def test_nothing_overlaps_and_nothing_is_cut_off(case, is_tidy):
    picture = graph(look(case))
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH


@pytest.mark.parametrize("case", CASES)
def test_the_picture_is_the_same_every_time(case):
    assert graph(look(case)).png() == graph(look(case)).png()
    assert graph(look(case)).svg() == graph(look(case)).svg()


@pytest.mark.parametrize("case", CASES)
def test_every_word_of_a_mark_is_in_the_picture_and_in_the_text(case, words_in):
    found, picture = look(case), graph(look(case))
    for mark in found.marks:
        assert set(mark.words) <= set(words_in(picture))
        assert " ".join(mark.words) in picture.description
    assert picture.description.startswith(say(found))
    assert found.title in picture.description
    assert picture.html().count("alt=") == 1


def test_a_clash_is_written_on_the_broken_arrow(words_in):
    picture = graph(look("qos"))
    assert {"offers BEST_EFFORT", "asks for RELIABLE"} <= set(words_in(picture))
    assert "Between /temperature_monitor and /temperature is a broken line" in picture.description
    lines = patches(picture, PathPatch)
    assert len(lines) == 3
    assert len(patches(picture, Polygon)) == 2  # the half before the words has no head


def test_only_the_clashing_arrow_is_broken():
    styles = [line.get_linestyle() for line in patches(graph(look("one of two")), PathPatch)]
    assert styles.count("-") == 2
    assert styles.count("--") == 2


def test_a_node_that_does_not_run_is_dashed_and_has_a_cross(words_in):
    picture = graph(look("ended"))
    dashed = [one for one in patches(picture, Ellipse) if one.get_linestyle() == "--"]
    assert len(dashed) == 1
    assert [line.get_marker() for line in picture.figure.axes[0].lines] == ["X"]
    assert "has ended" in words_in(picture)
    assert "/temperature_sensor has a cross: has ended." in picture.description


def test_nodes_of_one_name_run(words_in):
    picture = graph(look("twins"))
    assert {one.get_linestyle() for one in patches(picture, Ellipse)} == {"-"}
    assert "2 of this name" in words_in(picture)
    assert "stands for several nodes" in picture.description


def test_a_near_miss_has_both_names_and_no_arrow_between(words_in):
    picture = graph(look("near"))
    assert {"/temprature", "/temperature", "almost the", "same name"} <= set(words_in(picture))
    assert len(patches(picture, Polygon)) == 2
    assert len(patches(picture, PathPatch)) == 4


def test_a_topic_that_nobody_uses_is_there_all_the_same(words_in):
    picture = graph(look("near", "/temperatur"))
    boxes = patches(picture, FancyBboxPatch)
    assert [box.get_linestyle() for box in boxes].count("--") == 1
    assert {"/temperatur", "nobody uses", "this name"} <= set(words_in(picture))


def test_the_topic_is_bold():
    texts = graph(look("all is well")).figure.axes[0].texts
    assert [text.get_text() for text in texts if text.get_weight() == "bold"] == [TOPIC]


def test_where_all_is_well_nothing_is_marked():
    picture = graph(look("all is well"))
    assert {line.get_linestyle() for line in patches(picture, PathPatch)} == {"-"}
    assert picture.description.startswith("All is well on /temperature")


def test_a_topic_that_every_node_brings_is_shown_if_asked_about(words_in):
    ends = (*pair(matched=1), end("/temperature_sensor", "publisher", "/rosout"))
    picture = graph(explain("/rosout", scene(*ends, beats=beats(9, 9))))
    assert "/rosout" in words_in(picture)


def test_the_arrow_through_a_note():
    shown = marked(look("qos"))
    key = note_key("topic /temperature", "node /temperature_monitor")
    assert shown.notes == {key: ("offers BEST_EFFORT", "asks for RELIABLE")}
    edges = [(edge.source, edge.target) for edge in shown.wiring.edges]
    assert ("topic /temperature", key) in edges
    assert ("topic /temperature", "node /temperature_monitor") not in edges
    assert ("topic /temperature", "node /temperature_monitor") in [
        (edge.source, edge.target) for edge in shown.plain.edges
    ]


def test_which_halves_have_a_head():
    note = note_key("topic /a", "node /b")
    assert not has_head(Edge("topic /a", note))
    assert has_head(Edge(note, "node /b"))
    between = note_key("topic /a", "topic /b")
    assert not has_head(Edge("topic /a", between))
    assert not has_head(Edge(between, "topic /b"))
    assert has_head(Edge("node /a", "topic /b"))
