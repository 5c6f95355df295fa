"""Timelines: marks, arrows, callbacks that take time, nodes that share a process, and words."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.patches import FancyBboxPatch, Rectangle

from pictures import heads, is_tidy, lines, words_in
from record_builders import at, call, graph_of, heard, pair, sample, timer, wait
from rosbeat.errors import PictureError
from rosbeat.records import Fault, LogRecord, Observation
from rosbeat.viz import theme, timeline
from rosbeat.viz.timelines import MOST_EVENTS, runs_of, stacked


def axes_of(picture):
    picture.figure.canvas.draw()
    return picture.figure.axes[0]


def made(*samples, calls=(), until=1, **more):
    return Observation(at(until), 7, samples, callbacks=tuple(calls), **more)


def seen(calls, waits, processes=(), nodes=(), until=5.0):
    order = tuple(nodes) or tuple(dict.fromkeys(one.node for one in (*calls, *waits)))
    graph = graph_of(alone=order, processes=processes)
    return made(calls=calls, until=until, waits=tuple(waits), graph=graph)


def bars(picture):
    """Every stretch of a bar in the lanes: left, right, middle, fill and hatch."""
    found = [one for one in axes_of(picture).patches if type(one) is Rectangle]
    boxes = [(one.get_bbox(), one) for one in found if one.get_height() > 10]
    return [
        (box.x0, box.x1, (box.y0 + box.y1) / 2, one.get_facecolor(), one.get_hatch())
        for box, one in boxes
    ]


def frames(picture):
    found = [one for one in axes_of(picture).patches if isinstance(one, FancyBboxPatch)]
    return [one.get_window_extent() for one in found]


def height_of(picture, name):
    (text,) = (one for one in axes_of(picture).texts if one.get_text() == name)
    return text.get_position()[1]


def marks(picture, marker):
    return [tuple(*line.get_xydata()) for line in lines(picture, marker, layer=4)]


MULTI = seen(
    [call(1, "/arm", "move"), call(1.5, "/arm", "look"), call(1.7, "/arm", "blink")],
    [wait(1, 2, "/arm", "move"), wait(1.5, 3, "/arm", "look", "an answer from /add")],
    processes=[("/arm", "/hand")],
    nodes=["/arm", "/eye", "/hand"],
)

SINGLE = seen(
    [call(1, "/driver", "read"), call(1.5, "/free", "tick"), call(1.7, "/beeper", "beep")],
    [wait(1, 1.7, "/driver", "read")],
    processes=[("/driver", "/beeper")],
    nodes=["/driver", "/free", "/beeper"],
)

ONE = sample(1, 1.0)


def test_one_mark_per_callback_and_one_arrow_per_message():
    picture = timeline(pair(5))
    assert len(marks(picture, "s")) == len(marks(picture, "o")) == len(heads(picture)) == 5
    assert {"/sensor", "/monitor", "timer callback", "message on /temperature", "0 s"} <= set(
        words_in(picture)
    )
    assert "message nobody took" not in words_in(picture)
    picture = timeline(pair(1))
    (mark,), (head,) = marks(picture, "o"), heads(picture)
    tip = head.get_path().vertices[0]
    assert tip[0] == mark[0]
    assert 0 < tip[1] - mark[1] < 10


HELLO = LogRecord(at(1), "INFO", "sensor", "hello", "f", 1)
LEVELS = tuple(replace(HELLO, level=level) for level in ("INFO", "WARN"))
STOPPED = Fault(at(1), "/sensor", "publish", "ValueError", "", 1, "")


@pytest.mark.parametrize(
    ("observation", "written", "counts"),
    [
        (made(ONE), {"message nobody took"}, {}),
        (made(ONE, calls=[replace(heard(2), kind=one) for one in ("event", "expired", "task")]),
         {"event callback", "message too old", "other callback"}, {"v": 1, "x": 1, "D": 1}),
        (made(*(sample(1, k) for k in range(20)), calls=[timer(1), *[heard(1)] * 20]),
         {"×20"}, {"o": 1}),
        (pair(2, logs=LEVELS, faults=(STOPPED,)),
         {"log line", "warning or error", "node ended by an exception"},
         {"|": 1, "^": 1, "X": 1}),
        (pair(600), {"1740 later messages and callbacks are not shown."}, {}),
        (made(sample(0, 1.0), calls=[heard(0)], until=0), {"0 s"}, {}),
        (made(calls=[call(1, "/sensor", "answer", "service", "/add")]), set(), {"D": 1}),
        (made(ONE, calls=[timer(1), *(heard(1, f"/building_a/floor_{k}/room_with_a_long_name/node")
                                      for k in range(10))]), {"/sensor"}, {"o": 10}),
    ],
)  # fmt: skip
def test_what_happened_has_marks_of_its_own(observation, written, counts):
    picture = timeline(observation)
    assert written <= set(words_in(picture))
    assert {marker: len(marks(picture, marker)) for marker in counts} == counts
    assert is_tidy(picture)


def test_a_node_that_hears_itself_gets_no_arrow():
    picture = timeline(made(ONE, calls=[timer(1), heard(1, "/sensor")]))
    assert heads(picture) == []
    assert "message nobody took" not in words_in(picture)


def test_only_lost_messages_look_like_lost_ones():
    assert [one.get_linestyle() for one in axes_of(timeline(made(ONE))).patches[:1]] == ["--"]
    topics = [f"/topic_{k}" for k in range(6)]
    calls = [heard(1, topic=topic) for topic in topics]
    picture = timeline(made(*(sample(1, 1.0, topic) for topic in topics), calls=calls))
    assert not {"--", "-."} & {str(one.get_linestyle()) for one in axes_of(picture).patches}
    colours = {patch.get_edgecolor() for patch in axes_of(picture).patches}
    lost = tuple(int(theme.ALERT[k : k + 2], 16) / 255 for k in (1, 3, 5))
    assert not any(colour[:3] == pytest.approx(lost) for colour in colours)


# What is shown, in words.


# fmt: off
ROOM = "/building/sensor"
TAKEN = "makes a callback of /monitor run at the same instant."
SAID = {
    "who did what": (pair(2, logs=(HELLO,)), {}, [
        "A timeline from 0 s to 2 s with 2 nodes. /sensor: 2 timer callbacks and 1 log line. "
        "/monitor: 2 subscription callbacks. 2 messages on /temperature from /sensor make a "
        "callback of /monitor run at the same instant."]),
    "a node that does nothing": (made(ONE), {}, ["/sensor: nothing happens."]),
    "several readers": (made(ONE, calls=[heard(1), heard(1, "/other")]), {},
                        ["makes callbacks of /monitor and /other run"]),
    "a message that nobody takes at its instant": (made(ONE, calls=[heard(2)], until=2), {},
        ["1 message on /temperature from /sensor reaches nobody."]),
    "events, and messages that were too old": (
        made(ONE, calls=[replace(heard(2), kind=one) for one in ("event", "expired") * 2], until=2),
        {}, ["/monitor: 2 event callbacks and 2 messages too old.", "reaches nobody"]),
    "too much": (pair(600), {}, ["A timeline from 0 s to 20 s with 2 nodes.",
                                 "1740 later messages and callbacks are not shown."]),
    "until ends the axis": (pair(10), {"until": 4}, [
        "A timeline from 0 s to 4 s with 2 nodes.",
        "18 later messages and callbacks are not shown."]),
    "since begins it": (pair(600, faults=(replace(STOPPED, time_ns=at(17)),)),
        {"since": 16, "until": 18}, [
        "A timeline from 16 s to 18 s with 2 nodes. /sensor: 3 timer callbacks.",
        "At 17 s, "]),
    "the end of the session": (made(ONE, until=9), {}, ["A timeline from 0 s to 9 s"]),
    "hidden nodes have no lane": (made(ONE, calls=[heard(1, "/_spy")]), {}, ["with 1 node."]),
    "a node in a namespace": (
        made(sample(1, 1.0, node=ROOM), logs=(replace(HELLO, name="building.sensor"),),
             faults=(Fault(at(1), ROOM, "f", "ValueError", "", 1, ""),)),
        {}, ["/building/sensor: 1 log line.", "At 1 s, ValueError in f ended /building/sensor."]),
    "a single-threaded process": (SINGLE, {}, [
        "/driver and /beeper share one process. read of /driver takes 0.7 s, as it sleeps: from "
        "1 s to 1.7 s. Meanwhile, no other callback runs in the process of /driver and /beeper."]),
    "a multi-threaded process": (
        replace(MULTI, callbacks=(*MULTI.callbacks, call(4, "/hand", "grip"))), {}, [
        "/arm and /hand share one process. move of /arm takes 1 s, as it sleeps: from 1 s to 2 s. "
        "look of /arm takes 1.5 s, as it waits for an answer from /add: from 1.5 s to 3 s. "
        "move of /arm and look of /arm overlap from 1.5 s to 2 s. Meanwhile, 1 other callback "
        "runs in the process of /arm and /hand."]),
    "several runs of one callback": (
        seen([call(time, "/a", "f") for time in (1, 1.5, 3)],
             [wait(1, 2, "/a", "f"), wait(1.5, 2.5, "/a", "f"), wait(3, 3.5, "/a", "f"),
              wait(3.5, 4.5, "/a", "f", "an answer from /x")]), {}, [
        "f of /a takes 1 s to 1.5 s, as it sleeps and waits for an answer from /x: from",
        "Runs of f of /a overlap from 1.5 s to 2 s."]),
    "a wait that is cut at the end": (SINGLE, {"until": 1.5}, [
        "read of /driver begins at 1 s and is not done when the timeline ends, as it sleeps."]),
    "a node that waits in its constructor": (
        seen([], [wait(k, k + 1, "/late", "__init__", "/add to appear") for k in range(2)]), {}, [
        "/late does nothing but wait.",
        "__init__ of /late takes 2 s, as it waits for /add to appear: from 0 s to 2 s."]),
}
# fmt: on


@pytest.mark.parametrize("case", SAID)
def test_its_words(case):
    observation, given_more, parts = SAID[case]
    description = timeline(observation, **given_more).description
    for part in parts:
        assert part in description


def test_an_axis_begins_where_it_is_asked_to():
    picture = timeline(pair(600), since=16, until=18)
    assert {"16 s", "17 s", "18 s"} <= set(words_in(picture))
    assert "0 s" not in words_in(picture)
    assert is_tidy(picture)


def test_an_instant_is_never_cut_in_two():
    said = timeline(made(*(sample(1, k) for k in range(100)))).description
    assert "100 messages on /temperature from /sensor reach nobody." in said
    assert "not shown" not in said
    assert len(heads(timeline(pair(600)))) * 3 == MOST_EVENTS


def test_only_the_lanes_of_a_topic_that_was_asked_for():
    some = pair(2)
    calls = (*some.callbacks, heard(1, "/other", "/alert"), timer(1, "/clockwork"))
    some = replace(some, callbacks=calls)
    assert not {"/other", "/clockwork"} & set(words_in(timeline(some, "temperature")))
    assert {"/other", "/clockwork"} <= set(words_in(timeline(some)))


# Callbacks that take time, and nodes that share a process.


def test_a_bar_reaches_from_the_begin_of_a_wait_to_its_end():
    picture = timeline(SINGLE)
    ((left, right, middle, _, hatch),) = bars(picture)
    begin, late = marks(picture, "s")[0], marks(picture, "s")[2]
    assert (left, middle) == pytest.approx(begin)
    assert right == pytest.approx(late[0])  # the timer of the other node, when the sleep is over
    assert not hatch
    assert {"callback sleeps", "read"} <= set(words_in(picture))
    assert "callback waits" not in words_in(picture)
    assert is_tidy(picture)


def test_overlapping_callbacks_of_one_node_are_stacked():
    picture = timeline(MULTI)
    move, look = bars(picture)
    assert look[0] < move[1]  # they overlap in time,
    assert move[2] - look[2] > 15  # and not in the picture
    assert move[3] != look[3]
    assert (move[4], look[4]) == ("", theme.WAIT.hatch)
    beginnings = [(left, middle) for left, _, middle, *_ in (move, look)]
    *own, blink = marks(picture, "s")
    assert own == [pytest.approx(one) for one in beginnings]
    assert blink[1] < look[2] - 15  # it ran beside both, and took no time
    assert {"callback sleeps", "callback waits", "move", "look"} <= set(words_in(picture))
    assert is_tidy(picture)


def test_callbacks_that_do_not_overlap_share_a_row():
    calls = [call(1, "/arm", "move"), call(1, "/arm", "blink"), call(2, "/arm", "blink")]
    picture = timeline(seen(calls, [wait(1, 2, "/arm", "move")]))
    ((_, _, middle, *_),) = bars(picture)
    assert [y for _, y in marks(picture, "s")] == pytest.approx([middle] * len(marks(picture, "s")))
    waits = [wait(k, k + 1, "/arm", "move") for k in range(1, 4)]
    calls = [call(k, "/arm", "move") for k in range(1, 4)]
    assert len({middle for _, _, middle, *_ in bars(timeline(seen(calls, waits)))}) == 1


def test_lanes_of_one_process_stand_together_in_a_frame():
    calls = [call(1, name, "f") for name in ("/a", "/b", "/c", "/d", "/e")]
    two = timeline(seen(calls, [], [("/a", "/d"), ("/b", "/c")]))
    for picture, order in (
        (timeline(SINGLE), ["/driver", "/beeper", "/free"]),
        (two, ["/a", "/d", "/b", "/c", "/e"]),
    ):
        heights = [height_of(picture, name) for name in order]
        assert heights == sorted(heights, reverse=True)
        edge = picture.figure.bbox
        for number, frame in enumerate(frames(picture)):
            inside = [frame.y0 < height < frame.y1 for height in heights]
            assert inside == [k // 2 == number for k in range(len(order))]
            assert edge.x0 < frame.x0 < frame.x1 < edge.x1
        assert len(frames(picture)) == words_in(picture).count("one process") == len(order) // 2
        assert is_tidy(picture)


def test_only_one_lane_of_a_process_needs_no_frame():
    plain = pair(2)
    graph = replace(plain.graph, nodes=(*plain.graph.nodes, "/x"), processes=(("/sensor", "/x"),))
    shown, plain = timeline(replace(plain, graph=graph)), timeline(plain)
    assert (shown.svg(), shown.description) == (plain.svg(), plain.description)
    calls = [call(1, "/a", "f"), call(1, "/_b", "f")]
    picture = timeline(seen(calls, [wait(1, 2, "/_b", "f")], [("/a", "/_b")]))
    assert bars(picture) == frames(picture) == []
    assert "process" not in picture.description


def test_a_message_or_a_fault_leaves_the_end_of_its_callback():
    calls = [*MULTI.callbacks[:2], call(3, "/hand", "follow", "subscription", "/t")]
    sent = replace(seen(calls, MULTI.waits), samples=(sample(3, 1.0, "/t", "/arm"),))
    _, look = bars(timeline(sent))
    patches = axes_of(timeline(sent)).patches
    paths = [one.get_path().vertices for one in patches if one.get_zorder() == 2]
    assert tuple(paths[0][0]) == pytest.approx((look[1], look[2]))
    picture = timeline(
        replace(MULTI, faults=(Fault(at(3), "/arm", "look", "ValueError", "", 1, ""),))
    )
    _, look = bars(picture)
    assert marks(picture, "X") == [pytest.approx((look[1], look[2]))]


def test_waits_end_with_the_timeline():
    picture = timeline(SINGLE, until=1.5)
    ((_, right, *_),) = bars(picture)
    assert right == pytest.approx(marks(picture, "s")[1][0])
    assert len(bars(timeline(SINGLE, until=1))) == 1
    with pytest.raises(PictureError):
        timeline(SINGLE, until=0.9)
    late = timeline(SAID["a node that waits in its constructor"][0])
    assert "/late" in words_in(late)
    assert len(bars(late)) == 2


def test_many_waits_are_cut_and_said():
    calls = [call(k / 10, "/busy", "work") for k in range(1, 200)]
    waits = [wait(k / 10, k / 10 + 0.05, "/busy", "work") for k in range(1, 200)]
    picture = timeline(seen(calls, waits, until=20))
    assert len(bars(picture)) == 60
    assert "139 later messages and callbacks are not shown." in words_in(picture)
    assert "and 55 times more." in picture.description
    assert is_tidy(picture)


# Waits joined to runs.


@pytest.mark.parametrize(
    ("spans", "begins", "lengths", "levels"),
    [
        ([(1, 2), (2, 3), (3, 3)], [1], [2], {0}),
        ([(1, 2), (2, 3)], [1, 2], [1, 1], {0}),  # begins when the other ends
        ([(1, 2), (2, 3), (2, 4)], [1, 2], [1, 2], {0, 1}),  # goes on beside one that begins
    ],
)
def test_waits_of_one_run_are_joined(spans, begins, lengths, levels):
    calls = [call(time, "/a", "f") for time in begins]
    runs = stacked(runs_of([wait(*span, "/a", "f") for span in spans], calls))
    assert sorted(len(run.waits) for run in runs) == lengths
    assert {run.level for run in runs} == levels
    assert (min(run.time for run in runs), max(run.until_ns for run in runs)) == (
        1.0,
        at(max(end for _, end in spans)),
    )


spans = st.lists(
    st.tuples(
        st.integers(0, 8), st.integers(1, 4), st.sampled_from(["/a", "/b"]), st.sampled_from("fg")
    ),
    max_size=12,
)


@settings(max_examples=60, deadline=None)
@given(spans)
def test_runs_in_one_row_never_overlap(given_spans):
    calls = [call(begin, node, name) for begin, _, node, name in sorted(given_spans)]
    waits = [wait(begin, begin + long, node, name) for begin, long, node, name in given_spans]
    runs = stacked(runs_of(waits, calls))
    assert len(runs) == len(waits)
    for k, one in enumerate(runs):
        for other in runs[k + 1 :]:
            together = one.time_ns < other.until_ns and other.time_ns < one.until_ns
            assert not (together and (one.node, one.level) == (other.node, other.level))
