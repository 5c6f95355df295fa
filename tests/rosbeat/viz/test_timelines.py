"""Timelines: marks, arrows, callbacks that take time, nodes that share a process, and words."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.patches import FancyBboxPatch, Rectangle

from rosbeat.errors import PictureError
from rosbeat.records import (
    NANOSECONDS,
    CallbackRecord,
    Fault,
    GraphSnapshot,
    LogRecord,
    Observation,
    WaitRecord,
)
from rosbeat.viz import theme, timeline
from rosbeat.viz.timelines import MOST_EVENTS, calls_of, runs_of


def axes_of(picture):
    picture.figure.canvas.draw()
    return picture.figure.axes[0]


def heads(picture):
    return [patch for patch in picture.figure.axes[0].patches if patch.get_zorder() == 2.5]


def at(time):
    return round(time * NANOSECONDS)


def call(time, node, name, kind="timer", source="1 s"):
    return CallbackRecord(at(time), node, kind, name, source)


def wait(begin, end, node, callback, reason="sleep"):
    return WaitRecord(at(begin), at(end), node, callback, reason)


def seen(calls, waits, processes=(), nodes=(), until=5.0, **more):
    order = tuple(nodes) or tuple(dict.fromkeys(one.node for one in (*calls, *waits)))
    graph = GraphSnapshot(order, processes=tuple(processes))
    return Observation(
        at(until), 7, callbacks=tuple(calls), waits=tuple(waits), graph=graph, **more
    )


def bars(picture):
    """Every stretch of a bar in the lanes: left, right, middle, fill and hatch."""
    found = [one for one in axes_of(picture).patches if type(one) is Rectangle]
    boxes = [(one.get_bbox(), one) for one in found if one.get_height() > 10]
    return [
        (box.x0, box.x1, (box.y0 + box.y1) / 2, one.get_facecolor(), one.get_hatch())
        for box, one in boxes
    ]


def marks(picture, marker):
    lines = [line for line in axes_of(picture).lines if line.get_zorder() == 4]
    return [tuple(*line.get_xydata()) for line in lines if line.get_marker() == marker]


def frames(picture):
    found = [one for one in axes_of(picture).patches if isinstance(one, FancyBboxPatch)]
    return [one.get_window_extent() for one in found]


def height_of(picture, name):
    (text,) = (one for one in axes_of(picture).texts if one.get_text() == name)
    return text.get_position()[1]


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


def test_one_mark_per_callback_and_one_arrow_per_message(make, is_tidy):
    picture = timeline(make.pair(5))
    assert len(marks(picture, "s")) == len(marks(picture, "o")) == len(heads(picture)) == 5
    assert is_tidy(picture)


def test_an_arrow_ends_at_the_callback_it_caused(make):
    picture = timeline(make.pair(1))
    (mark,), (head,) = marks(picture, "o"), heads(picture)
    tip = head.get_path().vertices[0]
    assert tip[0] == mark[0]
    assert 0 < tip[1] - mark[1] < 10


def test_names_key_and_times_are_written(make, words_in):
    said = words_in(timeline(make.pair(5)))
    assert {"/sensor", "/monitor", "timer callback", "message on /temperature", "0 s"} <= set(said)
    assert "message nobody took" not in said


def test_a_lost_message_looks_different(make, words_in):
    picture = timeline(Observation(NANOSECONDS, 7, (make.sample(1, 1.0),)))
    assert "message nobody took" in words_in(picture)
    assert [line.get_linestyle() for line in picture.figure.axes[0].patches[:1]] == ["--"]


def test_events_and_messages_that_were_too_old_have_marks_of_their_own(make, words_in, is_tidy):
    calls = [replace(make.heard(2), kind=kind) for kind in ("event", "expired", "task")]
    picture = timeline(Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=tuple(calls)))
    assert {"event callback", "message too old", "other callback"} <= set(words_in(picture))
    assert [len(marks(picture, one)) for one in "vxD"] == [1, 1, 1]
    assert is_tidy(picture)


def test_the_messages_of_no_topic_look_like_lost_ones(make):
    topics = [f"/topic_{k}" for k in range(6)]
    samples = tuple(make.sample(1, 1.0, topic) for topic in topics)
    calls = tuple(make.heard(1, topic=topic) for topic in topics)
    picture = timeline(Observation(NANOSECONDS, 7, samples, callbacks=calls))
    colours = {patch.get_edgecolor() for patch in picture.figure.axes[0].patches}
    lost = tuple(int(theme.ALERT[at : at + 2], 16) / 255 for at in (1, 3, 5))
    assert not any(colour[:3] == pytest.approx(lost) for colour in colours)


def test_a_burst_shows_its_number(make, words_in, is_tidy):
    calls = (make.timer(1), *[make.heard(1)] * 20)
    samples = tuple(make.sample(1, k) for k in range(20))
    picture = timeline(Observation(NANOSECONDS, 7, samples, callbacks=calls))
    assert "×20" in words_in(picture)
    assert is_tidy(picture)


def test_logs_warnings_and_faults_are_marked(make, words_in):
    logs = tuple(LogRecord(NANOSECONDS, level, "sensor", "", "f", 1) for level in ("INFO", "WARN"))
    fault = Fault(NANOSECONDS, "/sensor", "publish", "ValueError", "", 1, "")
    picture = timeline(make.pair(2, logs=logs, faults=(fault,)))
    assert len(marks(picture, "|")) == len(marks(picture, "^")) == len(marks(picture, "X")) == 1
    assert {"log line", "warning or error", "node ended by an exception"} <= set(words_in(picture))


def test_too_much_is_cut_and_said(make, words_in, is_tidy):
    picture = timeline(make.pair(600))
    assert "1740 later messages and callbacks are not shown." in words_in(picture)
    assert is_tidy(picture)


def test_many_nodes_with_long_names_stay_readable(make, is_tidy):
    nodes = [f"/building_a/floor_{k}/room_with_a_long_name/monitor" for k in range(10)]
    calls = (make.timer(1), *(make.heard(1, node) for node in nodes))
    assert is_tidy(timeline(Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=calls)))


def test_everything_at_time_zero(make, is_tidy):
    assert is_tidy(timeline(Observation(0, 7, (make.sample(0, 1.0),), callbacks=(make.heard(0),))))


def test_other_callbacks_have_their_own_mark(make):
    call = make.timer(1).__class__(NANOSECONDS, "/sensor", "service", "answer", "/add")
    assert len(marks(timeline(Observation(NANOSECONDS, 7, callbacks=(call,))), "D")) == 1


@pytest.mark.parametrize("until", [-1, float("nan"), "soon"])
def test_a_wrong_end_gets_three_parts(make, until):
    with pytest.raises(PictureError, match="cannot end at"):
        timeline(make.pair(1), until=until)


def test_an_unknown_topic_gets_the_nearest(make):
    with pytest.raises(PictureError, match="Did you mean '/temperature'"):
        timeline(make.pair(1), topics="temprature")


# What is shown.


def test_a_message_that_nobody_takes_at_its_instant_reaches_nobody(make):
    seen = Observation(2 * NANOSECONDS, 7, (make.sample(1, 2.0),), callbacks=(make.heard(2),))
    assert "1 message on /temperature from /sensor reaches nobody." in timeline(seen).description


def test_too_much_is_cut_between_two_instants(make):
    picture = timeline(make.pair(600))
    assert len(heads(picture)) * 3 == MOST_EVENTS
    assert picture.description.startswith("A timeline from 0 s to 20 s")
    assert picture.description.endswith("1740 later messages and callbacks are not shown.")


def test_an_instant_is_never_cut_in_two(make):
    said = timeline(Observation(NANOSECONDS, 7, tuple(make.sample(1, k) for k in range(100))))
    assert "100 messages on /temperature from /sensor reach nobody." in said.description
    assert "not shown" not in said.description


def test_until_ends_the_axis(make):
    said = timeline(make.pair(10), until=4).description
    assert said.startswith("A timeline from 0 s to 4 s with 2 nodes.")
    assert said.endswith("18 later messages and callbacks are not shown.")


def test_the_axis_reaches_the_end_of_the_session(make):
    seen = Observation(9 * NANOSECONDS, 7, (make.sample(1, 2.0),))
    assert timeline(seen).description.startswith("A timeline from 0 s to 9 s")


def test_only_the_lanes_of_a_topic_that_was_asked_for(make, words_in):
    pair = make.pair(2)
    calls = (*pair.callbacks, make.heard(1, "/other", "/alert"), make.timer(1, "/clockwork"))
    seen = replace(pair, callbacks=calls)
    assert not {"/other", "/clockwork"} & set(words_in(timeline(seen, "temperature")))
    assert {"/other", "/clockwork"} <= set(words_in(timeline(seen)))


def test_hidden_nodes_have_no_lane(make):
    calls = (make.heard(1, "/_spy"),)
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=calls)
    assert "with 1 node." in timeline(seen).description


def test_logs_and_faults_of_a_node_in_a_namespace(make):
    log = LogRecord(NANOSECONDS, "INFO", "building.sensor", "hello", "f", 1)
    fault = Fault(NANOSECONDS, "/building/sensor", "f", "ValueError", "", 1, "")
    sample = make.sample(1, 1.0, node="/building/sensor")
    said = timeline(Observation(NANOSECONDS, 7, (sample,), (log,), faults=(fault,))).description
    assert "/building/sensor: 1 log line." in said
    assert "At 1 s, ValueError in f ended /building/sensor." in said


def test_nothing_gets_three_parts():
    with pytest.raises(PictureError, match="nothing to put on a timeline") as caught:
        timeline(Observation(0, 7))
    assert caught.value.to_try


# Callbacks that take time, and nodes that share a process.


def test_a_bar_reaches_from_the_begin_of_a_wait_to_its_end(is_tidy, words_in):
    picture = timeline(SINGLE)
    ((left, right, middle, _, hatch),) = bars(picture)
    begin, late = marks(picture, "s")[0], marks(picture, "s")[2]
    assert (left, middle) == pytest.approx(begin)
    assert right == pytest.approx(late[0])  # the timer of the other node, when the sleep is over
    assert not hatch
    assert {"callback sleeps", "read"} <= set(words_in(picture))
    assert "callback waits" not in words_in(picture)
    assert is_tidy(picture)


def test_overlapping_callbacks_of_one_node_are_stacked(is_tidy, words_in):
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


def test_a_callback_at_the_begin_or_the_end_of_another_is_not_below_it():
    calls = [call(1, "/arm", "move"), call(1, "/arm", "blink"), call(2, "/arm", "blink")]
    picture = timeline(seen(calls, [wait(1, 2, "/arm", "move")]))
    ((_, _, middle, *_),) = bars(picture)
    heights = {y for _, y in marks(picture, "s")}
    assert heights == {min(heights)}
    assert min(heights) == pytest.approx(middle)


def test_callbacks_one_after_the_other_share_a_row():
    waits = [wait(k, k + 1, "/arm", "move") for k in range(1, 4)]
    calls = [call(k, "/arm", "move") for k in range(1, 4)]
    middles = {middle for _, _, middle, *_ in bars(timeline(seen(calls, waits)))}
    assert len(middles) == 1


def test_lanes_of_one_process_stand_together_in_a_frame(words_in, is_tidy):
    picture = timeline(SINGLE)
    driver, beeper, free = (height_of(picture, name) for name in ("/driver", "/beeper", "/free"))
    assert driver > beeper > free
    (frame,) = frames(picture)
    assert frame.y1 > driver > beeper > frame.y0 > free
    assert words_in(picture).count("one process") == 1
    edge = picture.figure.bbox
    assert edge.x0 < frame.x0 < frame.x1 < edge.x1
    assert is_tidy(picture)


def test_two_processes_have_two_frames(words_in, is_tidy):
    calls = [call(1, name, "f") for name in ("/a", "/b", "/c", "/d", "/e")]
    picture = timeline(seen(calls, [], [("/a", "/d"), ("/b", "/c")]))
    heights = [height_of(picture, name) for name in ("/a", "/d", "/b", "/c", "/e")]
    assert heights == sorted(heights, reverse=True)
    upper, lower = frames(picture)
    assert upper.y0 > lower.y1
    assert words_in(picture).count("one process") == 2
    assert is_tidy(picture)


def test_only_one_lane_of_a_process_needs_no_frame(make):
    pair = make.pair(2)
    graph = replace(pair.graph, nodes=(*pair.graph.nodes, "/x"), processes=(("/sensor", "/x"),))
    shown, plain = timeline(replace(pair, graph=graph)), timeline(pair)
    assert shown.svg() == plain.svg()
    assert shown.description == plain.description


def test_a_message_leaves_the_end_of_the_callback_that_sent_it(make):
    calls = [
        call(1, "/arm", "move"),
        call(1.5, "/arm", "look"),
        call(3, "/hand", "follow", "subscription", "/t"),
    ]
    waits = [wait(1, 2, "/arm", "move"), wait(1.5, 3, "/arm", "look")]
    samples = (make.sample(3, 1.0, "/t", "/arm"),)
    picture = timeline(replace(seen(calls, waits), samples=samples))
    _, look = bars(picture)
    paths = [one.get_path().vertices for one in axes_of(picture).patches if one.get_zorder() == 2]
    assert tuple(paths[0][0]) == pytest.approx((look[1], look[2]))


def test_a_fault_stands_at_the_end_of_its_callback():
    fault = Fault(at(3), "/arm", "look", "ValueError", "", 1, "")
    picture = timeline(replace(MULTI, faults=(fault,)))
    _, look = bars(picture)
    assert marks(picture, "X") == [pytest.approx((look[1], look[2]))]


def test_a_wait_that_goes_on_is_cut_at_the_end():
    picture = timeline(SINGLE, until=1.5)
    ((_, right, *_),) = bars(picture)
    assert right == pytest.approx(marks(picture, "s")[1][0])
    assert (
        "read of /driver begins at 1 s and is not done when the timeline ends, as it sleeps."
        in (picture.description)
    )


def test_a_wait_that_begins_later_is_not_shown():
    assert len(bars(timeline(SINGLE, until=1))) == 1
    with pytest.raises(PictureError):
        timeline(SINGLE, until=0.9)


def test_a_node_that_waits_in_its_constructor_has_a_lane(words_in):
    waits = [wait(k, k + 1, "/late", "__init__", "/add to appear") for k in range(2)]
    picture = timeline(seen([], waits))
    assert "/late" in words_in(picture)
    assert len(bars(picture)) == 2
    assert "/late does nothing but wait." in picture.description
    assert "__init__ of /late takes 2 s, as it waits for /add to appear: from 0 s to 2 s." in (
        picture.description
    )


def test_hidden_nodes_have_no_bars():
    calls = [call(1, "/a", "f"), call(1, "/_b", "f")]
    picture = timeline(seen(calls, [wait(1, 2, "/_b", "f")], [("/a", "/_b")]))
    assert bars(picture) == frames(picture) == []
    assert "process" not in picture.description


def test_many_waits_are_cut_and_said(is_tidy, words_in):
    calls = [call(k / 10, "/busy", "work") for k in range(1, 200)]
    waits = [wait(k / 10, k / 10 + 0.05, "/busy", "work") for k in range(1, 200)]
    picture = timeline(seen(calls, waits, until=20))
    assert len(bars(picture)) == 60
    assert "139 later messages and callbacks are not shown." in words_in(picture)
    assert "and 55 times more." in picture.description
    assert is_tidy(picture)


def test_the_words_of_a_single_threaded_process():
    assert (
        "/driver and /beeper share one process. read of /driver takes 0.7 s, as it sleeps: from "
        "1 s to 1.7 s. Meanwhile, no other callback runs in the process of /driver and /beeper."
    ) in timeline(SINGLE).description


def test_the_words_of_a_multi_threaded_process():
    calls = [*MULTI.callbacks, call(4, "/hand", "grip")]
    graph = replace(MULTI.graph, nodes=("/arm", "/eye", "/hand"))
    assert (
        "/arm and /hand share one process. move of /arm takes 1 s, as it sleeps: from 1 s to 2 s. "
        "look of /arm takes 1.5 s, as it waits for an answer from /add: from 1.5 s to 3 s. "
        "move of /arm and look of /arm overlap from 1.5 s to 2 s. Meanwhile, 1 other callback "
        "runs in the process of /arm and /hand."
    ) in timeline(replace(MULTI, callbacks=tuple(calls), graph=graph)).description


def test_the_words_of_several_runs_of_one_callback():
    calls = [call(1, "/a", "f"), call(1.5, "/a", "f"), call(3, "/a", "f")]
    waits = [
        wait(1, 2, "/a", "f"),
        wait(1.5, 2.5, "/a", "f"),
        wait(3, 3.5, "/a", "f"),
        wait(3.5, 4.5, "/a", "f", "an answer from /x"),
    ]
    said = timeline(seen(calls, waits)).description
    assert "f of /a takes 1 s to 1.5 s, as it sleeps and waits for an answer from /x: from" in said
    assert "Runs of f of /a overlap from 1.5 s to 2 s." in said


# Waits joined to runs.


def test_waits_of_one_run_are_joined():
    waits = [wait(1, 2, "/a", "f"), wait(2, 3, "/a", "f"), wait(3, 3, "/a", "f")]
    (run,) = runs_of(waits, [call(1, "/a", "f")])
    assert (run.time, run.until_ns, len(run.waits)) == (1.0, at(3), 2)


def test_a_run_that_begins_when_another_ends_is_another():
    waits = [wait(1, 2, "/a", "f"), wait(2, 3, "/a", "f")]
    assert len(runs_of(waits, [call(1, "/a", "f"), call(2, "/a", "f")])) == 2


def test_a_run_goes_on_beside_one_that_begins():
    waits = [wait(1, 2, "/a", "f"), wait(2, 3, "/a", "f"), wait(2, 4, "/a", "f")]
    runs = runs_of(waits, [call(1, "/a", "f"), call(2, "/a", "f")])
    assert sorted(len(run.waits) for run in runs) == [1, 2]
    assert {run.level for run in runs} == {0, 1}


spans = st.lists(
    st.tuples(
        st.integers(0, 8), st.integers(1, 4), st.sampled_from(["/a", "/b"]), st.sampled_from("fg")
    ),
    max_size=12,
)


@settings(max_examples=150, deadline=None)
@given(spans)
def test_runs_in_one_row_never_overlap(given_spans):
    calls = [call(begin, node, name) for begin, _, node, name in sorted(given_spans)]
    waits = [wait(begin, begin + long, node, name) for begin, long, node, name in given_spans]
    runs = runs_of(waits, calls)
    assert len(runs) == len(waits)
    for k, one in enumerate(runs):
        for other in runs[k + 1 :]:
            together = one.time_ns < other.until_ns and other.time_ns < one.until_ns
            assert not (together and (one.node, one.level) == (other.node, other.level))
    assert sorted(one.level for one in calls_of(calls, runs)) == sorted(r.level for r in runs)


# The same in words.


def said(seen):
    return timeline(seen, "temperature").description


def test_who_did_what(make):
    log = LogRecord(NANOSECONDS, "INFO", "sensor", "hello", "f", 1)
    assert said(make.pair(2, logs=(log,))) == (
        "A timeline from 0 s to 2 s with 2 nodes. /sensor: 2 timer callbacks and 1 log line. "
        "/monitor: 2 subscription callbacks. 2 messages on /temperature from /sensor make a "
        "callback of /monitor run at the same instant."
    )


def test_a_node_that_does_nothing(make):
    assert "/sensor: nothing happens." in said(Observation(NANOSECONDS, 7, (make.sample(1, 1.0),)))


def test_several_readers(make):
    calls = (make.heard(1), make.heard(1, "/other"))
    seen = Observation(NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=calls)
    assert "makes callbacks of /monitor and /other run" in said(seen)


def test_events_and_messages_that_were_too_old(make):
    rare = tuple(
        replace(make.heard(2), kind=kind) for kind in ("event", "event", "expired", "expired")
    )
    seen = Observation(2 * NANOSECONDS, 7, (make.sample(1, 1.0),), callbacks=rare)
    assert "/monitor: 2 event callbacks and 2 messages too old." in said(seen)
    assert "reaches nobody" in said(seen)
