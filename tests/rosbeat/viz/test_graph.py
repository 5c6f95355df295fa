"""Pictures of the graph: what is drawn where, marked causes, words."""

from dataclasses import replace
from itertools import combinations

import pytest
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch, Polygon

from pictures import is_tidy, lines, patches, words_in
from record_builders import FLOAT, STRING, graph_of, pub, sub
from rosbeat.diagnosis.silence import explain
from rosbeat.diagnosis.topic_snapshot import Beat, Condition, Scene
from rosbeat.records import Endpoint, Observation, QoS
from rosbeat.viz import graph, theme

ADD, FIBONACCI = "example_interfaces/srv/AddTwoInts", "example_interfaces/action/Fibonacci"
LONG = "/building_a/floor_3/room_17/temperature"
SIMPLE = graph_of(
    pub("/temperature_sensor", "/temperature"),
    sub("/temperature_monitor", "/temperature"),
    pub("/temperature_sensor", "/rosout"),
)
READERS = graph_of(
    pub("/sensor", "/temperature"), sub("/monitor", "/temperature"), sub("/logger", "/temperature")
)
CYCLE = graph_of(
    *(pub("/ping", "/ball"), sub("/pong", "/ball"), pub("/pong", "/back"), sub("/ping", "/back")),
    sub("/watcher", "/back"),
)
SERVICE = graph_of(
    Endpoint("/client", "/add", ADD, "client", QoS()),
    Endpoint("/server", "/add", ADD, "server", QoS()),
    pub("/other", "/t", 0),
)


def stages(count, name="/stage"):
    """Return a chain of nodes, each of which reads the topic of the one before."""
    ends = []
    for k in range(count - 1):
        ends += [pub(f"{name}_{k}", f"/result_{k}"), sub(f"{name}_{k + 1}", f"/result_{k}")]
    return graph_of(*ends)


def twelve():
    ends = [pub(f"/sensor_{k}", f"/reading_{k // 2}") for k in range(6)]
    ends += [sub(f"/monitor_{k}", f"/reading_{j}") for k in range(6) for j in range(k % 3 + 1)]
    return graph_of(*ends)


def dashes(picture):
    return [line.get_linestyle() for line in patches(picture, PathPatch)]


def bold(picture):
    return [text.get_text() for text in picture.figure.axes[0].texts if text.get_weight() == "bold"]


def test_nodes_are_ellipses_and_topics_are_rectangles():
    picture = graph(SIMPLE)
    assert [len(patches(picture, one)) for one in (Ellipse, FancyBboxPatch, PathPatch)] == [2, 1, 2]
    order = ["/temperature_sensor", "/temperature", "/temperature_monitor"]
    assert sorted(words_in(picture)) == sorted([*order, "Float32"])
    places = {text.get_text(): text.get_position()[0] for text in picture.figure.axes[0].texts}
    assert [places[name] for name in order] == sorted(places[name] for name in order)
    assert "/rosout" in words_in(graph(SIMPLE, infrastructure=True))
    assert graph(Observation(0, 7, graph=SIMPLE)).svg() == picture.svg()


@pytest.mark.parametrize(
    "names", ["temperature_sensor", ["/temperature_sensor", "/temperature"]], ids=str
)
def test_only_the_names_of_what_is_highlighted_are_bold(names):
    wanted = [names] if isinstance(names, str) else names
    assert bold(graph(SIMPLE, highlight=names)) == [f"/{name.lstrip('/')}" for name in wanted]


# fmt: off
TIDY = {
    "twelve nodes": twelve(),
    "twelve alone": graph_of(alone=[f"/node_{k}" for k in range(12)]),
    "six stages": stages(6, "/stage_number"),
    "a cycle": CYCLE,
    "itself": graph_of(pub("/echo", "/voice"), sub("/echo", "/voice")),
    "long names": graph_of(
        pub(f"{LONG}_and_humidity_sensor", LONG),
        sub("/building_a/central_monitoring/temperature_monitor", LONG),
    ),
    "one word": graph_of(pub("/" + "x" * 80, "/" + "y" * 80)),
    "a topic named like its node": graph_of(pub("/a", "/a"), sub("/b", "/a")),
    "nobody hears": graph_of(pub("/temperature_sensor", "/t", 0), sub("/b" * 40, "/humidity")),
}
# fmt: on


@pytest.mark.parametrize("case", TIDY)
def test_nothing_overlaps_and_text_is_inside_its_shape(case):
    picture = graph(TIDY[case])
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH
    shapes = patches(picture, Ellipse) + patches(picture, FancyBboxPatch)
    boxes = [shape.get_window_extent() for shape in shapes]
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    outlines = [shape.get_transform().transform_path(shape.get_path()) for shape in shapes]
    for text in picture.figure.axes[0].texts:
        box = text.get_window_extent()
        corners = [(x, y) for x in (box.x0, box.x1) for y in (box.y0 + 2, box.y1 - 2)]
        inside = [outline.contains_points(corners).all() for outline in outlines]
        assert sum(inside) == 1, text.get_text()


def test_a_long_chain_runs_down():
    width, height = graph(stages(6)).figure.get_size_inches()
    assert height > width


@pytest.mark.parametrize(
    ("ends", "styles", "fault"),
    [
        ([pub("/a", "/t", 1), sub("/b", "/t", 1)], "- -", ""),
        ([pub("/a", "/t", -1), sub("/b", "/t", -1)], "- -", ""),
        ([pub("/a", "/t", 0)], "--", "nobody subscribes"),
        ([pub("/a", "/t", -1)], "--", "nobody subscribes"),
        ([sub("/a", "/t", 0)], "--", "nobody publishes"),
        ([pub("/a", "/t", 0), sub("/b", "/t", 0)], "-- --", "QoS does not match"),
        ([pub("/a", "/t", 0), sub("/b", "/t", 0, STRING)], "-- --", "types differ"),
        ([pub("/a", "/t"), sub("/b", "/t", 0), sub("/c", "/t")], "- -- -",
         "QoS does not match for /b"),
        ([pub("/a", "/t", 0), pub("/a", "/t"), sub("/b", "/t")], "- -", ""),  # one arrow
        ([pub("/a", "/t"), pub("/a", "/t", 0), sub("/b", "/t")], "- -", ""),
    ],
)  # fmt: skip
def test_where_nothing_passes_the_arrow_is_dashed_and_says_why(ends, styles, fault):
    picture = graph(graph_of(*ends))
    assert dashes(picture) == styles.split()
    edges = {line.get_linestyle(): line.get_edgecolor() for line in patches(picture, PathPatch)}
    assert len(set(edges.values())) == len(edges)
    assert (fault in picture.description) if fault else ("There, " not in picture.description)
    assert not fault or words_in(picture).count(fault.removesuffix(" for /b")) == 1


@pytest.mark.parametrize(
    ("shown", "words"),
    [
        (graph_of(pub("/a", "/t"), sub("/b", "/t"), alone=["/c"]),
         "3 nodes and 1 topic. /t (Float32): published by /a, subscribed to by /b. /c uses no "
         "topic."),
        (graph_of(sub("/b", "/t", 1)), "published by another process, subscribed to by /b"),
        (graph_of(pub("/a", "/t", 1)), "published by /a, subscribed to by another process"),
        (graph_of(pub("/a", "/t", -1), sub("/_watch", "/t", -1)), "Left out: 1 hidden node."),
        (graph_of(Endpoint("/a", "/b/get_parameters", "rcl_interfaces/srv/A", "client", QoS())),
         "offered by nobody, used by /a"),
        (replace(stages(4), processes=(("/stage_0", "/stage_1"), ("/stage_2", "/stage_3"))),
         "/stage_0 and /stage_1 share one process. /stage_2 and /stage_3 share one process."),
    ],
)  # fmt: skip
def test_its_words(shown, words):
    assert words in graph(shown).description


def test_hidden_nodes_are_left_out_but_still_listen():
    picture = graph(graph_of(pub("/a", "/t", -1), sub("/_watch", "/t", -1)))
    assert words_in(picture) == ["/a", "/t", "Float32"]
    assert len(patches(picture, Polygon)) == 1


def test_services_and_actions_lead_from_who_uses_one_to_who_offers_it():
    ends = (
        *SERVICE.endpoints[:2],
        Endpoint("/server", "/heat", FIBONACCI, "action server", QoS()),
        Endpoint("/server", "/heat/_action/send_goal", f"{FIBONACCI}_SendGoal", "server", QoS()),
        Endpoint("/server", "/server/get_parameters", "rcl_interfaces/srv/A", "server", QoS()),
        Endpoint("/_spy", "/ask", ADD, "server", QoS()),
    )
    picture = graph(graph_of(*ends))
    names = ["/add", "/client", "/heat", "/server", "action Fibonacci", "service AddTwoInts"]
    assert sorted(words_in(picture)) == names
    assert len(patches(picture, Polygon)) == 3
    assert picture.description == (
        "2 nodes and no topics. /add (AddTwoInts) is a service: offered by /server, used by "
        "/client. /heat (Fibonacci) is an action: offered by /server, used by nobody. Left out: 1 "
        "hidden node."
    )
    assert is_tidy(picture)


def test_which_nodes_share_a_process_is_written_below():
    names = tuple(f"/building_a/floor_3/room_{k}/temperature_sensor" for k in range(6))
    for bare, processes in (
        (READERS, [("/sensor", "/logger", "/sensor")]),
        (stages(4), [("/stage_0", "/stage_1"), ("/stage_2", "/stage_3")]),
        (graph_of(alone=names), [names]),
    ):
        picture = graph(replace(bare, processes=tuple(processes)))
        assert is_tidy(picture)
        said = [line for line in words_in(picture) if line in picture.description]
        assert sum("share one process." in line for line in said) >= 1
    plain = graph_of(pub("/sensor", "/t"), sub("/monitor", "/t"), sub("/_spy", "/t"))
    for alone in ((("/sensor",),), (("/sensor", "/_spy"),)):
        picture = graph(replace(plain, processes=alone))
        assert (picture.svg(), picture.description) == (
            graph(plain).svg(),
            graph(plain).description,
        )


# Causes of an explanation, marked.

TOPIC = "/temperature"
WEAK = QoS(reliability="BEST_EFFORT")


def talk(sends=FLOAT, offers=WEAK, matched=0, publishes_on=TOPIC):
    return (
        pub("/temperature_sensor", publishes_on, matched, sends, offers),
        sub("/temperature_monitor", TOPIC, matched),
    )


FINE = talk(offers=QoS(), matched=1)


def scene(*ends, twins=(), published=9, heard=9, **more):
    shown = graph_of(*ends)
    beats = (
        Beat("/temperature_sensor", "publisher", published, published, float(published)),
        Beat("/temperature_monitor", "subscription", heard),
    )
    own = frozenset(shown.nodes)
    shown = replace(shown, nodes=(*shown.nodes, *twins))
    return Scene(shown, own=own, beats=beats, **more)


def stopped(state):
    condition = Condition("/temperature_sensor", state, callback="publish")
    return scene(*FINE, conditions=(condition,), published=0, heard=0)


# fmt: off
MARKED = {
    "all is well": scene(*FINE),
    "qos": scene(*talk(), heard=0),
    "types": scene(*talk(STRING, QoS()), heard=0),
    "near": scene(*talk(offers=QoS(), publishes_on="/temprature"), heard=0),
    "unknown": scene(*talk(offers=QoS(), publishes_on="/pressure"), heard=0),
    "nobody publishes": scene(talk()[1]),
    "nobody subscribes": scene(talk(offers=QoS())[0], heard=0),
    "silent": scene(*FINE, published=0, heard=0),
    "ended": stopped("ended"),
    "paused": stopped("paused"),
    "blocked": stopped("blocked"),
    "twins": scene(FINE[0], *FINE, twins=("/temperature_sensor",)),
    "one of two": scene(
        talk()[0], FINE[1], pub("/good_sensor", TOPIC),
    ),
    "itself": scene(pub("/echo", TOPIC), sub("/echo", TOPIC)),
}
# fmt: on


def look(name, topic=TOPIC):
    return explain(topic, MARKED[name])


@pytest.mark.parametrize("case", MARKED)
def test_every_word_of_a_mark_is_in_the_picture_and_in_the_text(case):
    found, picture = look(case), graph(look(case))
    for mark in found.marks:
        assert set(mark.words) <= set(words_in(picture))
        assert " ".join(mark.words) in picture.description
    assert picture.description.startswith(found.title)
    assert bold(picture) == [TOPIC]
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH


@pytest.mark.parametrize(
    ("case", "topic", "written", "said", "styles", "arrows"),
    [
        ("all is well", TOPIC, set(), "All is well on /temperature", "- -", 2),
        # The half of an arrow before the words has no head.
        ("qos", TOPIC, {"offers BEST_EFFORT", "requests RELIABLE"},
         "Between /temperature_monitor and /temperature is a broken line", "-- -- --", 2),
        ("one of two", TOPIC, set(), "", "- - -- --", 3),
        ("near", TOPIC, {"/temprature", "/temperature", "almost the", "same name"}, "", None, 2),
        ("near", "/temperatur", {"/temperatur", "no node uses", "this name"}, "", None, None),
        ("twins", TOPIC, {"2 of this name"}, "stands for several nodes", None, None),
        ("ended", TOPIC, {"has ended"}, "/temperature_sensor has a cross: has ended.", None, None),
    ],
)  # fmt: skip
def test_a_cause_is_marked(case, topic, written, said, styles, arrows):
    picture = graph(look(case, topic))
    assert written <= set(words_in(picture))
    assert said in picture.description
    assert styles is None or sorted(dashes(picture)) == styles.split()
    assert arrows is None or len(patches(picture, Polygon)) == arrows
    # A node that does not run is dashed and has a cross; so is a topic that nobody uses.
    ellipses = [one.get_linestyle() for one in patches(picture, Ellipse)]
    assert ellipses.count("--") == len(lines(picture, "X")) == (case == "ended")
    boxes = [one.get_linestyle() for one in patches(picture, FancyBboxPatch)]
    assert boxes.count("--") == (topic == "/temperatur")


def test_a_topic_that_every_node_brings_is_shown_if_asked_about():
    ends = (*FINE, pub("/temperature_sensor", "/rosout", 0))
    assert "/rosout" in words_in(graph(explain("/rosout", scene(*ends))))
