"""Pictures of the graph: what is drawn where, frames of processes, marked causes, words."""

from dataclasses import replace
from itertools import combinations

import pytest
from matplotlib.patches import Ellipse, FancyBboxPatch, PathPatch, Polygon

from rosbeat.diagnosis.silence import explain
from rosbeat.diagnosis.situation import Beat, Condition, Scene
from rosbeat.errors import PictureError
from rosbeat.records import Endpoint, GraphSnapshot, Observation, QoS
from rosbeat.viz import graph, theme

FLOAT, STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
ADD, FIBONACCI = "example_interfaces/srv/AddTwoInts", "example_interfaces/action/Fibonacci"


def patches(picture, kind):
    return [patch for patch in picture.figure.axes[0].patches if type(patch) is kind]


@pytest.fixture
def sensor_and_monitor(make):
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


def test_nodes_are_ellipses_and_topics_are_rectangles(sensor_and_monitor, words_in):
    picture = graph(sensor_and_monitor)
    assert len(patches(picture, Ellipse)) == 2
    assert len(patches(picture, FancyBboxPatch)) == 1
    assert len(patches(picture, PathPatch)) == 2
    names = ["/temperature", "/temperature_monitor", "/temperature_sensor", "Float32"]
    assert sorted(words_in(picture)) == names


def test_publishers_are_left_topics_in_the_middle_subscribers_right(sensor_and_monitor):
    texts = {text.get_text(): text for text in graph(sensor_and_monitor).figure.axes[0].texts}
    order = [texts[name].get_position()[0] for name in
             ("/temperature_sensor", "/temperature", "/temperature_monitor")]  # fmt: skip
    assert order == sorted(order)


def test_an_observation_does_as_well(sensor_and_monitor):
    seen = Observation(0, 7, graph=sensor_and_monitor)
    assert graph(seen).description == graph(sensor_and_monitor).description


def test_infrastructure_on_request(sensor_and_monitor, words_in):
    assert "/rosout" in words_in(graph(sensor_and_monitor, infrastructure=True))


def test_where_nothing_passes_the_arrow_is_dashed_and_of_another_colour(make, words_in):
    picture = graph(make.graph(make.pub("/a", "/t", 0), make.sub("/b", "/t", 0)))
    lines = patches(picture, PathPatch)
    assert {line.get_linestyle() for line in lines} == {"--"}
    fine = patches(graph(make.graph(make.pub("/a", "/t"), make.sub("/b", "/t"))), PathPatch)
    assert {line.get_linestyle() for line in fine} == {"-"}
    assert lines[0].get_edgecolor() != fine[0].get_edgecolor()
    assert "QoS does not match" in words_in(picture)


@pytest.mark.parametrize("names", ["temperature_sensor", ["/temperature_sensor", "/temperature"]])
def test_what_is_highlighted_is_bold(sensor_and_monitor, names):
    picture = graph(sensor_and_monitor, highlight=names)
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


def test_an_unknown_highlight_gets_the_nearest(sensor_and_monitor):
    with pytest.raises(PictureError, match="Did you mean '/temperature_sensor'"):
        graph(sensor_and_monitor, highlight="temperature_senser")


def test_the_text_is_inside_its_shape(make):
    ends = (make.pub("/temperature_sensor", "/t", 0), make.sub("/b" * 40, "/humidity"))
    picture = graph(make.graph(*ends), highlight="/t")
    picture.figure.canvas.draw()
    boxes = patches(picture, Ellipse) + patches(picture, FancyBboxPatch)
    outlines = [box.get_transform().transform_path(box.get_path()) for box in boxes]
    for text in picture.figure.axes[0].texts:
        box = text.get_window_extent()
        corners = [(x, y) for x in (box.x0, box.x1) for y in (box.y0 + 2, box.y1 - 2)]
        inside = [outline.contains_points(corners).all() for outline in outlines]
        assert sum(inside) == 1, text.get_text()


def test_only_the_name_in_a_highlighted_box_is_bold(make):
    picture = graph(make.graph(make.pub("/a", "/t", 0)), highlight="t")
    weights = {text.get_text(): text.get_weight() for text in picture.figure.axes[0].texts}
    assert weights == {
        "/a": "normal", "/t": "bold", "Float32": "normal", "nobody subscribes": "normal",
    }  # fmt: skip


# What is shown, and in words.


def test_hidden_nodes_are_left_out_but_still_listen(make, words_in):
    picture = graph(make.graph(make.pub("/a", "/t", -1), make.sub("/_watch", "/t", -1)))
    assert words_in(picture) == ["/a", "/t", "Float32"]
    assert len(patches(picture, Polygon)) == 1
    assert picture.description.endswith("Left out: 1 hidden node.")


@pytest.mark.parametrize(
    ("ends", "fault"),
    [
        (lambda m: [m.pub("/a", "/t", 0)], "nobody subscribes"),
        (lambda m: [m.pub("/a", "/t", -1)], "nobody subscribes"),
        (lambda m: [m.sub("/a", "/t", 0)], "nobody publishes"),
        (lambda m: [m.pub("/a", "/t", 0), m.sub("/b", "/t", 0)], "QoS does not match"),
        (lambda m: [m.pub("/a", "/t", 0), m.sub("/b", "/t", 0, STRING)], "types differ"),
    ],
)
def test_what_is_wrong_is_written_and_said(make, words_in, ends, fault):
    picture = graph(make.graph(*ends(make)))
    assert words_in(picture).count(fault) == 1
    assert f"There, {fault}" in picture.description


@pytest.mark.parametrize("matched", [1, -1])
def test_a_matched_or_unknown_pair_is_fine(make, matched):
    fine = make.graph(make.pub("/a", "/t", matched), make.sub("/b", "/t", matched))
    assert {line.get_linestyle() for line in patches(graph(fine), PathPatch)} == {"-"}


def test_what_comes_from_another_process_is_not_said_to_come_from_nobody(make):
    heard = graph(make.graph(make.sub("/b", "/t", 1)))
    assert "published by another process, subscribed to by /b" in heard.description
    said = graph(make.graph(make.pub("/a", "/t", 1)))
    assert "published by /a, subscribed to by another process" in said.description


def test_one_broken_reader_does_not_break_the_others(make):
    ends = (make.pub("/a", "/t"), make.sub("/b", "/t", 0), make.sub("/c", "/t"))
    picture = graph(make.graph(*ends))
    assert [line.get_linestyle() for line in patches(picture, PathPatch)] == ["-", "--", "-"]
    assert "QoS does not match for /b." in picture.description


@pytest.mark.parametrize("matched", [(0, 1), (1, 0)])
def test_two_publishers_of_one_node_are_one_arrow(make, matched):
    ends = [make.pub("/a", "/t", number) for number in matched]
    lines = patches(graph(make.graph(*ends, make.sub("/b", "/t"))), PathPatch)
    assert [line.get_linestyle() for line in lines] == ["-", "-"]


def test_the_words_say_who_talks_to_whom(make):
    shown = make.graph(make.pub("/a", "/t"), make.sub("/b", "/t"), alone=["/c"])
    assert graph(shown).description == (
        "3 nodes and 1 topic. /t (Float32): published by /a, subscribed to by /b. /c uses no topic."
    )


# Services and actions.


def test_services_and_actions_lead_from_who_uses_one_to_who_offers_it(make, words_in, is_tidy):
    ends = (
        Endpoint("/client", "/add", ADD, "client", QoS()),
        Endpoint("/server", "/add", ADD, "server", QoS()),
        Endpoint("/server", "/heat", FIBONACCI, "action server", QoS()),
        Endpoint("/server", "/heat/_action/send_goal", f"{FIBONACCI}_SendGoal", "server", QoS()),
        Endpoint("/server", "/server/get_parameters", "rcl_interfaces/srv/A", "server", QoS()),
        Endpoint("/_spy", "/ask", ADD, "server", QoS()),
    )
    picture = graph(make.graph(*ends))
    names = ["/add", "/client", "/heat", "/server", "action Fibonacci", "service AddTwoInts"]
    assert sorted(words_in(picture)) == names
    assert len(patches(picture, Polygon)) == 3
    assert picture.description == (
        "2 nodes and no topics. /add (AddTwoInts) is a service: offered by /server, used by "
        "/client. /heat (Fibonacci) is an action: offered by /server, used by nobody. Left out: 1 "
        "hidden node."
    )
    assert is_tidy(picture)


def test_who_asks_for_what_every_node_brings_is_shown(make):
    end = Endpoint("/a", "/b/get_parameters", "rcl_interfaces/srv/A", "client", QoS())
    assert "offered by nobody, used by /a" in graph(make.graph(end)).description


# Frames around the nodes of one process.


def sensor_and_readers(make):
    return make.graph(
        make.pub("/sensor", "/temperature"),
        make.sub("/monitor", "/temperature"),
        make.sub("/logger", "/temperature"),
    )


def stages(make, count):
    ends = []
    for k in range(count - 1):
        ends += [
            make.pub(f"/stage_{k}", f"/result_{k}"),
            make.sub(f"/stage_{k + 1}", f"/result_{k}"),
        ]
    return make.graph(*ends)


def with_processes(shown, *processes):
    return replace(shown, processes=processes)


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


FRAMES = {
    "two of three, in one column": (
        sensor_and_readers, [("/monitor", "/logger")], [{"/monitor", "/logger"}]
    ),
    "two of three, a topic that others use, too": (
        sensor_and_readers, [("/sensor", "/logger")], [{"/sensor", "/logger"}]
    ),
    "two of three, a topic of their own": (
        lambda m: stages(m, 3), [("/stage_0", "/stage_1")], [{"/stage_0", "/result_0", "/stage_1"}]
    ),
    "all": (
        sensor_and_readers, [("/sensor", "/monitor", "/logger")],
        [{"/sensor", "/monitor", "/logger", "/temperature"}],
    ),
    "two processes of two nodes": (
        lambda m: stages(m, 4), [("/stage_0", "/stage_1"), ("/stage_2", "/stage_3")],
        [{"/stage_0", "/result_0", "/stage_1"}, {"/stage_2", "/result_2", "/stage_3"}],
    ),
    "two processes that take turns": (
        lambda m: stages(m, 4), [("/stage_0", "/stage_2"), ("/stage_1", "/stage_3")],
        [{"/stage_0", "/stage_2"}, {"/stage_1", "/stage_3"}],
    ),
    "a long chain, which runs down": (
        lambda m: stages(m, 6), [("/stage_0", "/stage_1"), ("/stage_3", "/stage_5")],
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


@pytest.mark.parametrize("case", FRAMES)
def test_a_frame_holds_the_nodes_of_one_process_and_what_only_they_use(make, case, is_tidy):
    build, processes, wanted = FRAMES[case]
    picture = graph(with_processes(build(make), *processes))
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
    shown = with_processes(stages(make, 4), ("/stage_0", "/stage_1"), ("/stage_2", "/stage_3"))
    assert graph(shown).description.endswith(
        "/stage_0 and /stage_1 share one process. /stage_2 and /stage_3 share one process."
    )


@pytest.mark.parametrize("processes", [(), (("/sensor",),), (("/sensor", "/_spy"),)])
def test_without_shared_processes_the_picture_is_what_it_was(make, processes):
    bare = make.graph(
        make.pub("/sensor", "/t"), make.sub("/monitor", "/t"), make.sub("/_spy", "/t")
    )
    plain, other = graph(bare), graph(with_processes(bare, *processes))
    assert other.svg() == plain.svg()
    assert other.png() == plain.png()
    assert other.description == plain.description
    assert "process" not in plain.description


def test_a_node_is_in_one_frame_even_if_two_nodes_have_its_name(make):
    processes = (("/sensor", "/monitor", "/sensor"), ("/sensor", "/logger"))
    shown = Shown(graph(with_processes(sensor_and_readers(make), *processes)))
    assert [shown.inside(frame) for frame in shown.frames] == [{"/sensor", "/monitor"}]


def test_a_picture_with_frames_is_the_same_each_time(make):
    shown = with_processes(stages(make, 5), ("/stage_0", "/stage_3"), ("/stage_1", "/stage_4"))
    assert graph(shown).png() == graph(shown).png()
    assert graph(Observation(0, 7, graph=shown)).svg() == graph(shown).svg()


def test_an_arrow_is_never_hidden_by_the_label_of_a_frame(make):
    for build, processes, _ in FRAMES.values():
        axes = graph(with_processes(build(make), *processes)).figure.axes[0]
        axes.figure.canvas.draw()
        labels = [one.get_window_extent() for one in axes.texts if "process" in one.get_text()]
        heads = [one.get_window_extent() for one in axes.patches if one.get_zorder() == 2.5]
        assert not any(label.overlaps(head) for label in labels for head in heads)


# Causes of an explanation, marked.

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


MARKED = {
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
    return explain(topic, MARKED[name])


@pytest.mark.parametrize("case", MARKED)
def test_marks_do_not_overlap(case, is_tidy):
    picture = graph(look(case))
    assert is_tidy(picture)
    assert picture.figure.get_figwidth() * theme.DPI == theme.WIDTH


@pytest.mark.parametrize("case", MARKED)
def test_every_word_of_a_mark_is_in_the_picture_and_in_the_text(case, words_in):
    found, picture = look(case), graph(look(case))
    for mark in found.marks:
        assert set(mark.words) <= set(words_in(picture))
        assert " ".join(mark.words) in picture.description
    assert picture.description.startswith(found.title)
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
