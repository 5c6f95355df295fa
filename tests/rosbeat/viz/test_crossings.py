import random
from datetime import datetime, timezone

import pytest

from rosbeat.errors import PictureError
from rosbeat.records import NANOSECONDS, LogRecord
from rosbeat.viz import crossing, theme
from rosbeat.viz.crossings import MOST, first_number, pairs

#: Seconds since the epoch, as the clock of a terminal's process shows them.
EPOCH = int(datetime(2026, 5, 4, tzinfo=timezone.utc).timestamp())


def log(name, at, text):
    time_ns = EPOCH * NANOSECONDS + round(at * NANOSECONDS)
    return LogRecord(time_ns, "INFO", name, text, "", 0)


def sensor(count, start=1):
    values = range(start, start + count)
    lines = [log("temperature_sensor", k, f"Publishing: {20 + k / 8:.2f}C") for k in values]
    return [log("temperature_sensor", 0, "Temperature Sensor Node Started"), *lines]


def monitor(numbers, delay=0.01):
    return [
        log("temperature_monitor", k + delay, f"Temperature: {20 + k / 8:.2f}C - Status:Normal")
        for k in numbers
    ]


def marks(picture, marker, hollow=False):
    lines = picture.figure.axes[0].lines
    return [x for x in lines if x.get_marker() == marker and x.get_zorder() == (5 if hollow else 4)]


def heads(picture):
    return [patch for patch in picture.figure.axes[0].patches if patch.get_zorder() == 2.5]


def test_one_arrow_for_each_message_and_lost_ones_are_hollow(is_tidy, words_in):
    picture = crossing(sensor(10), monitor(range(3, 11)))
    assert len(heads(picture)) == len(marks(picture, "s")) == len(marks(picture, "o")) == 8
    lost = marks(picture, "s", hollow=True)
    assert [mark.get_markerfacecolor() for mark in lost] == [theme.CARD] * 2
    assert {mark.get_markeredgecolor() for mark in lost} == {theme.ALERT}
    assert {"10 sent", "2 lost", "8 received", "lost message"} <= set(words_in(picture))
    assert is_tidy(picture)


def test_its_words_count_and_do_not_tell_times():
    picture = crossing(sensor(10), monitor(range(3, 11)))
    assert picture.description == (
        "temperature_sensor sent 10 messages: 8 arrived at temperature_monitor and 2 were lost. "
        "The first 2 were sent before anything arrived."
    )
    slower = crossing(sensor(10), monitor(range(3, 11), delay=0.3))
    assert slower.description == picture.description


def test_an_arrow_goes_from_its_line_to_the_line_with_the_same_number(words_in):
    picture = crossing(sensor(2), monitor([2], delay=0.5))
    (head,), (end,), (start,) = heads(picture), marks(picture, "o"), marks(picture, "s")
    assert head.get_path().vertices[0][0] == end.get_xdata()[0] > start.get_xdata()[0]
    assert words_in(picture).count("20.25") == 2
    assert words_in(picture).count("20.12") == 1


def test_the_axis_starts_at_the_first_line_of_either(words_in):
    late = [one for one in sensor(4) if "Started" not in one.text]
    for lines in (sensor(4), monitor(range(1, 5))), (late, monitor(range(1, 5))):
        picture = crossing(*lines)
        rules = [x for x in picture.figure.axes[0].lines if x.get_zorder() == 0.5]
        every = [x for marker in "|so" for x in picture.figure.axes[0].lines
                 if x.get_marker() == marker and x.get_zorder() > 2.5]  # fmt: skip
        first = min(float(x.get_xdata()[0]) for x in every)
        assert min(float(x.get_xdata()[0]) for x in rules) == pytest.approx(first)
        assert "0 s" in words_in(picture)


def test_what_was_not_lost_is_not_in_the_key(words_in):
    said = words_in(crossing(sensor(3), monitor([1, 2, 3])))
    assert {"line of the sender", "line of the receiver", "message", "other log line"} <= set(said)
    assert not {"lost message", "not among what was sent"} & set(said)
    assert not any("lost" in words for words in said)


def test_late_and_strange_lines_have_marks_of_their_own(words_in, is_tidy):
    picture = crossing(sensor(3), [*monitor([1]), log("temperature_monitor", 1.5, "got 99")])
    said = words_in(picture)
    assert {"sent after the receiver's last line", "not among what was sent"} <= set(said)
    colours = [x.get_markeredgecolor() for marker in "so" for x in marks(picture, marker, True)]
    assert colours == [theme.MUTED, theme.MUTED, theme.PURPLE]
    assert is_tidy(picture)


def test_a_receiver_that_never_said_anything(words_in, is_tidy):
    picture = crossing(sensor(3), [])
    assert {"the receiver", "0 received", "3 lost"} <= set(words_in(picture))
    assert picture.description.endswith("none arrived at the receiver and 3 were lost.")
    assert is_tidy(picture)


def test_a_receiver_without_a_message_keeps_its_name():
    started = [log("temperature_monitor", 0.5, "Temperature Monitor Node Started")]
    assert "none arrived at temperature_monitor" in crossing(sensor(3), started).description


@pytest.mark.parametrize("count", [1, 20, 60, 200])
def test_few_and_many_stay_tidy(count, is_tidy):
    assert is_tidy(crossing(sensor(count), monitor(range(1, count + 1))))


def test_long_names_stay_tidy(is_tidy):
    name = "building_a.floor_3.room_with_a_long_name.temperature_sensor"
    sent = [log(name, k, f"{k}") for k in range(5)]
    assert is_tidy(crossing(sent, [log(f"{name}_2", k, f"{k}") for k in range(5)]))


def test_all_at_one_instant(is_tidy):
    picture = crossing([log("one", 1, "5")], [log("two", 1, "5")])
    assert is_tidy(picture)
    assert len(heads(picture)) == 1


def test_lines_of_a_session_can_be_drawn():
    sent, got = LogRecord(0, "INFO", "a", "7", "f", 1), LogRecord(0, "INFO", "b", "7", "g", 2)
    assert "all" not in crossing([sent], (got,)).description


def test_without_a_number_there_is_nothing_to_draw():
    with pytest.raises(PictureError, match="no message to draw"):
        crossing([log("one", 0, "Started")], [])


@pytest.mark.parametrize("wrong", [5, "a text", [1, 2], None])
def test_other_things_are_refused(wrong):
    with pytest.raises(PictureError, match="two processes") as caught:
        crossing(wrong, [])
    assert caught.value.to_try
    with pytest.raises(PictureError, match="two processes"):
        crossing(sensor(1), wrong)


def test_two_processes_with_several_nodes_are_named_by_all():
    sent = [log("sensor", 0, "1"), log("helper", 1, "2")]
    said = crossing(sent, [log("monitor", 0.1, "1"), log("monitor", 1.1, "2")]).description
    assert said == "sensor and helper sent 2 messages: all arrived at monitor and none was lost."


def test_late_and_strange_lines_in_words():
    said = crossing(sensor(3), [*monitor([1]), log("temperature_monitor", 1.5, "got 99")])
    assert said.description == (
        "temperature_sensor sent 3 messages: 1 arrived at temperature_monitor, none was lost and 2 "
        "were sent after its last line. 1 line of temperature_monitor has a number that "
        "temperature_sensor did not log."
    )


def test_one_that_was_lost_in_words():
    said = crossing(sensor(3), monitor([2, 3])).description
    assert "2 arrived at temperature_monitor and 1 was lost. The first one was sent before" in said
    assert "1 was lost." in crossing(sensor(3), monitor([1, 3])).description


def test_too_many_in_words():
    said = crossing(sensor(MOST + 1), monitor(range(1, MOST + 2))).description
    assert said.endswith("1 later message is not shown.")


# Which lines tell of the same message.


def lines(*given):
    """Log lines from (seconds, text)."""
    return [log("node", at, str(text)) for at, text in given]


def partners(found):
    return [line.partner for line in found.sent]


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("Publishing: 22.13C", "22.13"),
        ("Temperature: 22.13C - Status:Normal", "22.13"),
        ("sensor2 says -5", "-5"),
        ("20-30", "20"),
        ("T=-0.5", "-0.5"),
        ("3.", "3"),
        ("Temperature Sensor Node Started", ""),
        ("v1.2", ""),
        ("", ""),
    ],
)
def test_the_first_number_in_a_text(text, number):
    assert first_number(text) == number


def test_equal_numbers_are_one_message_however_they_are_written():
    found = pairs(
        lines((0, "send 22.10"), (1, "send 5")), lines((0.1, "got 22.1"), (1.1, "got 5.0"))
    )
    assert partners(found) == [0, 1]
    assert found.lost == found.late == found.strange == ()


def test_what_came_before_the_receiver_is_lost():
    sent = lines(*((at, at) for at in range(5)))
    found = pairs(sent, lines((2.01, 2), (3.01, 3), (4.01, 4)))
    assert partners(found) == [None, None, 0, 1, 2]
    assert [line.words for line in found.lost] == ["0", "1"]
    assert found.early == found.lost


def test_a_lost_message_whose_number_comes_again_is_still_lost():
    sent = lines((0, 7), (1, 8), (2, 9), (3, 7))
    assert partners(pairs(sent, lines((1.01, 8), (2.01, 9), (3.01, 7)))) == [None, 0, 1, 2]


def test_of_two_equal_numbers_the_nearer_one_arrived():
    assert partners(pairs(lines((0, 7), (3, 7)), lines((3.01, 7)))) == [None, 0]


def test_a_value_that_stands_still_is_lost_where_nobody_listened():
    sent = lines(*((at, 10.2) for at in range(6)))
    assert partners(pairs(sent, lines(*((at + 0.01, 10.2) for at in range(2, 6))))) == [
        None, None, 0, 1, 2, 3,
    ]  # fmt: skip


def test_a_receiver_that_was_busy_gets_all_of_them_late():
    assert partners(pairs(lines((0, 7), (1, 7), (2, 7)), lines((5, 7), (5, 7), (5, 7)))) == [
        0,
        1,
        2,
    ]


def test_the_receiver_may_log_a_little_before_the_sender_and_not_much():
    assert partners(pairs(lines((5, 7)), lines((4, 7)))) == [0]
    assert partners(pairs(lines((5, 7)), lines((2, 7)))) == [None]


def test_what_was_sent_after_the_last_line_of_the_receiver_is_not_called_lost():
    found = pairs(lines((0, 1), (1, 2), (2, 3), (3, 4)), lines((0.1, 1), (2.1, 3)))
    assert [line.words for line in found.lost] == ["2"]
    assert [line.words for line in found.late] == ["4"]
    assert found.early == ()


def test_without_any_receiver_all_are_lost():
    found = pairs(lines((0, 1), (1, 2)), [])
    assert len(found.lost) == len(found.early) == 2
    assert found.late == ()


def test_what_nobody_sent_is_strange():
    found = pairs(lines((0, 1)), lines((0.1, 1), (0.2, 99)))
    assert [line.words for line in found.strange] == ["99"]


def test_lines_are_put_in_order_and_lines_without_number_left_out():
    found = pairs(lines((1, 2), (0, "Started"), (0.5, 1)), [])
    assert [line.words for line in found.sent] == ["1", "2"]


def test_too_many_are_cut_on_both_sides():
    sent = lines(*((at / 10, at) for at in range(MOST + 40)))
    found = pairs(sent, lines(*((at / 10 + 0.001, at) for at in range(MOST + 40))))
    assert (len(found.sent), len(found.received), found.skipped) == (MOST, MOST, 40)
    assert partners(found) == list(range(MOST))


@pytest.mark.parametrize("seed", range(20))
def test_whatever_is_dropped_the_rest_is_paired_in_order(seed):
    rng = random.Random(seed)
    sent = [(at, rng.randint(18, 24)) for at in range(40)]
    kept = [rank for rank in range(40) if rng.random() < 0.7]
    found = pairs(lines(*sent), lines(*((sent[k][0] + 0.01, sent[k][1]) for k in kept)))
    links = [rank for rank in partners(found) if rank is not None]
    assert links == list(range(len(kept)))
    assert [rank for rank, link in enumerate(partners(found)) if link is not None] == kept
