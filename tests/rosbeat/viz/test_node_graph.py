from itertools import combinations

import pytest
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch

from rosbeat.errors import PictureError
from rosbeat.records import GraphSnapshot, Observation
from rosbeat.viz import theme
from rosbeat.viz.node_graph import graph


def patches(picture, kind):
    return [patch for patch in picture.figure.axes[0].patches if type(patch) is kind]


@pytest.fixture
def pair(make):
    return make.graph(
        make.pub("/temperature_sensor", "/temperature"),
        make.sub("/temperature_monitor", "/temperature"),
        make.pub("/temperature_sensor", "/rosout"),
    )


def chain(make, stages):
    ends = []
    for k in range(stages):
        ends += [make.pub(f"/stage_number_{k}", f"/result_{k}")]
        ends += [make.sub(f"/stage_number_{k + 1}", f"/result_{k}")]
    return make.graph(*ends)


def twelve(make):
    ends = [make.pub(f"/sensor_{k}", f"/reading_{k // 2}") for k in range(6)]
    ends += [make.sub(f"/monitor_{k}", f"/reading_{j}") for k in range(6) for j in range(k % 3 + 1)]
    return make.graph(*ends)


def test_nodes_are_ellipses_and_topics_are_rectangles(pair, words_in):
    picture = graph(pair)
    assert len(patches(picture, Ellipse)) == 2
    assert len(patches(picture, FancyBboxPatch)) == 1
    assert len(patches(picture, PathPatch)) == 2
    names = ["/temperature", "/temperature_monitor", "/temperature_sensor", "Float32"]
    assert sorted(words_in(picture)) == names


def test_publishers_are_left_topics_in_the_middle_subscribers_right(pair):
    texts = {text.get_text(): text for text in graph(pair).figure.axes[0].texts}
    order = [texts[name].get_position()[0] for name in
             ("/temperature_sensor", "/temperature", "/temperature_monitor")]  # fmt: skip
    assert order == sorted(order)


def test_an_observation_does_as_well(pair):
    assert graph(Observation(0, 7, graph=pair)).description == graph(pair).description


def test_infrastructure_on_request(pair, words_in):
    assert "/rosout" in words_in(graph(pair, infrastructure=True))


def test_where_nothing_passes_the_arrow_is_dashed_and_of_another_colour(make, words_in):
    picture = graph(make.graph(make.pub("/a", "/t", 0), make.sub("/b", "/t", 0)))
    lines = patches(picture, PathPatch)
    assert {line.get_linestyle() for line in lines} == {"--"}
    fine = patches(graph(make.graph(make.pub("/a", "/t"), make.sub("/b", "/t"))), PathPatch)
    assert {line.get_linestyle() for line in fine} == {"-"}
    assert lines[0].get_edgecolor() != fine[0].get_edgecolor()
    assert "QoS does not match" in words_in(picture)


@pytest.mark.parametrize("names", ["temperature_sensor", ["/temperature_sensor", "/temperature"]])
def test_what_is_highlighted_is_bold(pair, names):
    picture = graph(pair, highlight=names)
    bold = [text.get_text() for text in picture.figure.axes[0].texts if text.get_weight() == "bold"]
    wanted = [names] if isinstance(names, str) else names
    assert bold == [f"/{name.lstrip('/')}" for name in wanted]


LONG = "/building_a/floor_3/room_17/temperature"
CASES = {
    "one node": lambda m: m.graph(alone=["/talker"]),
    "twelve nodes": twelve,
    "twelve alone": lambda m: m.graph(alone=[f"/node_{k}" for k in range(12)]),
    "three stages": lambda m: chain(m, 2),
    "six stages": lambda m: chain(m, 5),
    "a cycle": lambda m: m.graph(
        *(m.pub("/ping", "/ball"), m.sub("/pong", "/ball")),
        *(m.pub("/pong", "/back"), m.sub("/ping", "/back")),
    ),
    "itself": lambda m: m.graph(m.pub("/echo", "/voice"), m.sub("/echo", "/voice")),
    "long names": lambda m: m.graph(
        m.pub(f"{LONG}_and_humidity_sensor", LONG),
        m.sub("/building_a/central_monitoring/temperature_monitor", LONG),
    ),
    "one word": lambda m: m.graph(m.pub("/" + "x" * 80, "/" + "y" * 80)),
    "a topic named like its node": lambda m: m.graph(m.pub("/a", "/a"), m.sub("/b", "/a")),
}


@pytest.mark.parametrize("case", CASES)
def test_nothing_overlaps_and_nothing_is_wider_than_the_page(make, case, is_tidy):
    picture = graph(CASES[case](make))
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH
    boxes = [patch.get_window_extent() for kind in (Ellipse, FancyBboxPatch)
             for patch in patches(picture, kind)]  # fmt: skip
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))


def test_a_long_chain_runs_down(make):
    width, height = graph(chain(make, 5)).figure.get_size_inches()
    assert height > width


def test_no_node_gets_three_parts(make):
    for empty in (GraphSnapshot(), make.graph(alone=["/_hidden"])):
        with pytest.raises(PictureError, match="no node to draw"):
            graph(empty)


def test_an_unknown_highlight_gets_the_nearest(pair):
    with pytest.raises(PictureError, match="Did you mean '/temperature_sensor'"):
        graph(pair, highlight="temperature_senser")
