from dataclasses import replace

import pytest

from rosbeat.errors import PictureError
from rosbeat.records import NANOSECONDS, Fault, LogRecord, Observation
from rosbeat.viz import theme
from rosbeat.viz.time_lanes import timeline


def marks(picture, marker):
    """The marks in the lanes; the one in the key does not count."""
    lines = picture.figure.axes[0].lines
    return [line for line in lines if line.get_marker() == marker and line.get_zorder() == 4]


def heads(picture):
    return [patch for patch in picture.figure.axes[0].patches if patch.get_zorder() == 2.5]


def test_one_mark_per_callback_and_one_arrow_per_message(make, is_tidy):
    picture = timeline(make.pair(5))
    assert len(marks(picture, "s")) == len(marks(picture, "o")) == len(heads(picture)) == 5
    assert is_tidy(picture)


def test_an_arrow_ends_at_the_callback_it_caused(make):
    picture = timeline(make.pair(1))
    (mark,), (head,) = marks(picture, "o"), heads(picture)
    tip = head.get_path().vertices[0]
    assert tip[0] == mark.get_xdata()[0]
    assert 0 < tip[1] - mark.get_ydata()[0] < 10


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
