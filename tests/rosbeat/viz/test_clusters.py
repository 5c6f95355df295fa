"""Frames around the nodes of one process: through the picture, and as properties of any graph."""

from dataclasses import replace
from itertools import combinations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.patches import Ellipse, FancyBboxPatch

from rosbeat import viz
from rosbeat.records import Endpoint, Observation, QoS
from rosbeat.viz import theme
from rosbeat.viz.clusters import Rim, clustered, enclosed
from rosbeat.viz.layers import layering
from rosbeat.viz.placement import needed, place

ADD = "example_interfaces/srv/AddTwoInts"


def sensor_and_readers(make):
    return make.graph(
        make.pub("/sensor", "/temperature"),
        make.sub("/monitor", "/temperature"),
        make.sub("/logger", "/temperature"),
    )


def chain(make, count):
    ends = []
    for k in range(count - 1):
        ends += [
            make.pub(f"/stage_{k}", f"/result_{k}"),
            make.sub(f"/stage_{k + 1}", f"/result_{k}"),
        ]
    return make.graph(*ends)


def with_processes(graph, *processes):
    return replace(graph, processes=processes)


class Shown:
    """What a finished picture has: frames, and boxes by the names written in them."""

    def __init__(self, picture):
        picture.figure.canvas.draw()
        axes = picture.figure.axes[0]
        patches = [one for one in axes.patches if isinstance(one, Ellipse | FancyBboxPatch)]
        frames = [one for one in patches if one.get_zorder() < 1]
        self.frames = [one.get_window_extent() for one in frames]
        boxes = [one.get_window_extent() for one in patches if one not in frames]
        self.labels = [one.get_text() for one in axes.texts if one.get_text() == "one process"]
        names = [one for one in axes.texts if one.get_text().startswith("/")]
        self.boxes = {
            text.get_text(): next(box for box in boxes if box.contains(*middle(text)))
            for text in names
        }

    def inside(self, frame):
        """The names whose boxes are in a frame; every box is inside or outside as a whole."""
        found = {name for name, box in self.boxes.items() if holds(frame, box)}
        touched = {name for name, box in self.boxes.items() if frame.overlaps(box)}
        assert found == touched
        return found


def middle(text):
    box = text.get_window_extent()
    return (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2


def holds(frame, box):
    across = frame.x0 < box.x0 and box.x1 < frame.x1
    return across and frame.y0 < box.y0 and box.y1 < frame.y1


CASES = {
    "two of three, in one column": (
        sensor_and_readers, [("/monitor", "/logger")], [{"/monitor", "/logger"}]
    ),
    "two of three, a topic that others use, too": (
        sensor_and_readers, [("/sensor", "/logger")], [{"/sensor", "/logger"}]
    ),
    "two of three, a topic of their own": (
        lambda m: chain(m, 3), [("/stage_0", "/stage_1")], [{"/stage_0", "/result_0", "/stage_1"}]
    ),
    "all": (
        sensor_and_readers, [("/sensor", "/monitor", "/logger")],
        [{"/sensor", "/monitor", "/logger", "/temperature"}],
    ),
    "two processes of two nodes": (
        lambda m: chain(m, 4), [("/stage_0", "/stage_1"), ("/stage_2", "/stage_3")],
        [{"/stage_0", "/result_0", "/stage_1"}, {"/stage_2", "/result_2", "/stage_3"}],
    ),
    "two processes that take turns": (
        lambda m: chain(m, 4), [("/stage_0", "/stage_2"), ("/stage_1", "/stage_3")],
        [{"/stage_0", "/stage_2"}, {"/stage_1", "/stage_3"}],
    ),
    "a long chain, which runs down": (
        lambda m: chain(m, 6), [("/stage_0", "/stage_1"), ("/stage_3", "/stage_5")],
        [{"/stage_0", "/result_0", "/stage_1"}, {"/stage_3", "/stage_5"}],
    ),
    "short names": (
        lambda m: m.graph(m.pub("/a", "/t"), m.pub("/b", "/t"), m.sub("/c", "/t")), [("/a", "/b")],
        [{"/a", "/b"}],
    ),
    "nodes without topics": (
        lambda m: m.graph(m.pub("/a", "/t"), m.sub("/b", "/t"), alone=["/p", "/q"]),
        [("/p", "/q")], [{"/p", "/q"}],
    ),
    "a cycle": (
        lambda m: m.graph(
            *(m.pub("/ping", "/ball"), m.sub("/pong", "/ball")),
            *(m.pub("/pong", "/back"), m.sub("/ping", "/back"), m.sub("/watcher", "/back")),
        ),
        [("/ping", "/pong")], [{"/ping", "/ball", "/pong"}],
    ),
    "a service": (
        lambda m: m.graph(
            Endpoint("/client", "/add", ADD, "client", QoS()),
            Endpoint("/server", "/add", ADD, "server", QoS()), m.pub("/other", "/t", 0),
        ),
        [("/client", "/server")], [{"/client", "/add", "/server"}],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_frame_holds_the_nodes_of_one_process_and_what_only_they_use(make, case, is_tidy):
    build, processes, wanted = CASES[case]
    picture = viz.graph(with_processes(build(make), *processes))
    shown = Shown(picture)
    assert sorted(map(sorted, map(shown.inside, shown.frames))) == sorted(map(sorted, wanted))
    assert shown.labels == ["one process"] * len(wanted)
    assert not any(one.overlaps(other) for one, other in combinations(shown.frames, 2))
    boxes = shown.boxes.values()
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH
    edge = picture.figure.bbox
    assert all(holds(edge, frame) for frame in shown.frames)


def test_the_words_name_who_shares_a_process(make):
    graph = with_processes(chain(make, 4), ("/stage_0", "/stage_1"), ("/stage_2", "/stage_3"))
    assert viz.graph(graph).description.endswith(
        "/stage_0 and /stage_1 share one process. /stage_2 and /stage_3 share one process."
    )


@pytest.mark.parametrize("processes", [(), (("/sensor",),), (("/sensor", "/_spy"),)])
def test_without_shared_processes_the_picture_is_what_it_was(make, processes):
    graph = make.graph(
        make.pub("/sensor", "/t"), make.sub("/monitor", "/t"), make.sub("/_spy", "/t")
    )
    plain, other = viz.graph(graph), viz.graph(with_processes(graph, *processes))
    assert other.svg() == plain.svg()
    assert other.png() == plain.png()
    assert other.description == plain.description
    assert "process" not in plain.description


def test_a_node_is_in_one_frame_even_if_two_nodes_have_its_name(make):
    processes = (("/sensor", "/monitor", "/sensor"), ("/sensor", "/logger"))
    shown = Shown(viz.graph(with_processes(sensor_and_readers(make), *processes)))
    assert [shown.inside(frame) for frame in shown.frames] == [{"/sensor", "/monitor"}]


def test_a_picture_with_frames_is_the_same_each_time(make):
    graph = with_processes(chain(make, 5), ("/stage_0", "/stage_3"), ("/stage_1", "/stage_4"))
    assert viz.graph(graph).png() == viz.graph(graph).png()
    assert viz.graph(Observation(0, 7, graph=graph)).svg() == viz.graph(graph).svg()


def test_an_arrow_is_never_hidden_by_the_label_of_a_frame(make):
    for build, processes, _ in CASES.values():
        axes = viz.graph(with_processes(build(make), *processes)).figure.axes[0]
        axes.figure.canvas.draw()
        labels = [one.get_window_extent() for one in axes.texts if "process" in one.get_text()]
        heads = [one.get_window_extent() for one in axes.patches if one.get_zorder() == 2.5]
        assert not any(label.overlaps(head) for label in labels for head in heads)


# Properties of any graph.

nodes = [f"n{k}" for k in range(6)]
topics = [f"t{k}" for k in range(4)]
sizes = {name: (60.0 + 9 * k, 30.0 + 4 * k) for k, name in enumerate(nodes + topics)}
wires = st.lists(
    st.tuples(st.sampled_from(nodes), st.sampled_from(topics), st.booleans()).map(
        lambda one: one[:2] if one[2] else one[1::-1]
    ),
    unique=True,
    max_size=14,
)
homes = st.lists(st.integers(0, 3), min_size=len(nodes), max_size=len(nodes))


def apart(one, other):
    along = abs(one.along - other.along) - (one.length + other.length) / 2
    across = abs(one.across - other.across) - (one.breadth + other.breadth) / 2
    return max(along, across)


def depth(frame, box):
    along = frame.length / 2 - abs(frame.along - box.along) - box.length / 2
    return min(along, frame.breadth / 2 - abs(frame.across - box.across) - box.breadth / 2)


@settings(max_examples=60, deadline=None)
@given(wires, homes)
def test_frames_hold_their_boxes_and_no_others_in_any_graph(links, home):
    groups = [[n for n, h in zip(nodes, home, strict=True) if h == k] for k in range(3)]
    groups = [group for group in groups if len(group) > 1]
    plan = layering(dict.fromkeys(nodes, 0) | dict.fromkeys(topics, 1), links)
    members = enclosed(groups, links, topics)
    plan = replace(clustered(plan, members), rim=Rim((12.0, 16.0), (12.0, 10.0), (110.0, 90.0)))
    result = place(plan, sizes, 700)
    assert set(result.boxes) == set(sizes)
    assert len(result.frames) == len(groups)
    assert result.length <= max(700, needed(plan, sizes)) + 1e-6
    assert all(apart(*pair) > -0.01 for pair in combinations(result.boxes.values(), 2))
    assert all(apart(*pair) > -0.01 for pair in combinations(result.frames, 2))
    for frame, block in zip(result.frames, plan.clusters, strict=True):
        assert set(block) & set(sizes) in members
        for name, box in result.boxes.items():
            assert (depth(frame, box) if name in block else apart(frame, box)) > 9.9
        assert frame.across - frame.breadth / 2 >= -0.01
        assert frame.across + frame.breadth / 2 <= result.breadth + 0.01


def test_what_a_note_leads_to_goes_with_it():
    links = [("a", "note"), ("note", "t"), ("t", "b"), ("c", "u"), ("u", "b")]
    assert enclosed([["a", "b"]], links, ["note", "t", "u"]) == [{"a", "b", "note", "t"}]


def test_a_topic_that_only_one_node_uses_stays_outside():
    assert enclosed([["a", "b"]], [("a", "t")], ["t"]) == [{"a", "b"}]
