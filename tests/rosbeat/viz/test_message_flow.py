"""Messages between two processes: which log lines tell of one message, and the picture of it."""

import random

import pytest

from pictures import heads, is_tidy, words_in
from pictures import lines as drawn
from record_builders import at
from rosbeat.records import LogRecord
from rosbeat.viz import message_flow, theme
from rosbeat.viz.message_flows import MOST, first_number, pairs

#: Seconds since the epoch, as the clock of a terminal's process shows them.
EPOCH = 1_777_852_800


def log(name, time, text):
    return LogRecord(at(EPOCH) + at(time), "INFO", name, text, "", 0)


def sensor(count):
    values = range(1, count + 1)
    said = [log("temperature_sensor", k, f"Publishing: {20 + k / 8:.2f}C") for k in values]
    return [log("temperature_sensor", 0, "Temperature Sensor Node Started"), *said]


def monitor(numbers, delay=0.01):
    return [
        log("temperature_monitor", k + delay, f"Temperature: {20 + k / 8:.2f}C - Status:Normal")
        for k in numbers
    ]


def marks(picture, marker, hollow=False):
    return drawn(picture, marker, layer=5 if hollow else 4)


STRANGE = [*monitor([1]), log("temperature_monitor", 1.5, "got 99")]
NAME = "building_a.floor_3.room_with_a_long_name.temperature_sensor"


def test_one_arrow_for_each_message_and_those_without_are_hollow():
    picture = message_flow(sensor(10), monitor((3, 4, 7, 8, 9, 10)))
    assert len(heads(picture)) == len(marks(picture, "s")) == len(marks(picture, "o")) == 6
    lost, early = (marks(picture, marker, hollow=True) for marker in "sD")
    assert [mark.get_markerfacecolor() for mark in lost + early] == [theme.CARD] * 4
    assert {mark.get_markeredgecolor() for mark in lost} == {theme.ALERT}
    assert {mark.get_markeredgecolor() for mark in early} == {theme.MUTED}
    assert len(lost) == len(early) == 2
    picture = message_flow(sensor(2), monitor([2], delay=0.5))
    (head,), (end,), (start,) = heads(picture), marks(picture, "o"), marks(picture, "s")
    assert head.get_path().vertices[0][0] == end.get_xdata()[0] > start.get_xdata()[0]
    assert [words_in(picture).count(words) for words in ("20.25", "20.12")] == [2, 1]
    picture = message_flow(sensor(3), STRANGE)
    colours = [one.get_markeredgecolor() for one in marks(picture, "s", True)]
    assert (colours, len(marks(picture, "o", True))) == ([theme.MUTED] * 2, 1)
    assert marks(picture, "o", True)[0].get_markeredgecolor() == theme.PURPLE


@pytest.mark.parametrize(
    ("sent", "got", "written", "words"),
    [
        (sensor(10), monitor((1, 2, *range(5, 11))),
         {"10 sent", "2 lost", "8 received", "lost message"},
         "temperature_sensor sent 10 messages: 8 arrived at temperature_monitor and 2 were lost."),
        # Nobody was listening yet; and it does not tell times.
        *((sensor(10), monitor(range(3, 11), delay), {"sent before anybody was listening"},
           "temperature_sensor sent 10 messages: 8 arrived at temperature_monitor and none was "
           "lost. The first 2 were sent before anybody was listening.") for delay in (0.01, 0.3)),
        (sensor(10), monitor((2, 5, 6, 7, 8, 9, 10)), {"2 lost"},
         "7 arrived at temperature_monitor and 2 were lost. The first one was sent before anybody "
         "was listening."),
        (sensor(3), monitor([1, 2, 3]),
         {"line of the sender", "line of the receiver", "message", "other log line"},
         "and none was lost"),
        (sensor(3), STRANGE, {"sent after the receiver's last line", "not among what was sent"},
         "temperature_sensor sent 3 messages: 1 arrived at temperature_monitor, none was lost and "
         "2 were sent after its last line. 1 line of temperature_monitor has a number that "
         "temperature_sensor did not log."),
        (sensor(3), [], {"the receiver", "0 received"},
         "none arrived at the receiver. The first 3 were sent before anybody was listening."),
        (sensor(3), [log("temperature_monitor", 0.5, "Temperature Monitor Node Started")], set(),
         "none arrived at temperature_monitor."),
        ([log("sensor", 0, "1"), log("helper", 1, "2")],
         [log("monitor", 0.1, "1"), log("monitor", 1.1, "2")], set(),
         "sensor and helper sent 2 messages: all arrived at monitor and none was lost."),
        ([log(NAME, k, f"{k}") for k in range(5)], [log(f"{NAME}_2", k, f"{k}") for k in range(5)],
         set(), "and none was lost"),
        ([log("one", 1, "5")], [log("two", 1, "5")], set(), "and none was lost"),
        ([LogRecord(0, "INFO", "a", "7", "f", 1)], (LogRecord(0, "INFO", "b", "7", "g", 2),), set(),
         "a sent 1 message: 1 arrived at b and none was lost."),
        *((sensor(count), monitor(range(1, count + 1)), set(), "and none was lost")
          for count in (1, 20, 60, 200)),
    ],
)  # fmt: skip
def test_its_words(sent, got, written, words):
    picture = message_flow(sent, got)
    assert written <= set(words_in(picture))
    assert words in picture.description
    lost = [one for one in words_in(picture) if "lost" in one]
    assert bool(lost) == ("were lost" in words)
    assert is_tidy(picture)


def test_the_axis_starts_at_the_first_line_of_either():
    late = [one for one in sensor(4) if "Started" not in one.text]
    for sent in (sensor(4), late):
        picture = message_flow(sent, monitor(range(1, 5)))
        rules = [one for one in picture.figure.axes[0].lines if one.get_zorder() == 0.5]
        every = [
            one for marker in "|so" for one in drawn(picture, marker) if one.get_zorder() > 2.5
        ]
        first = min(float(one.get_xdata()[0]) for one in every)
        assert min(float(one.get_xdata()[0]) for one in rules) == pytest.approx(first)
        assert "0 s" in words_in(picture)


# Which lines tell of the same message.


def lines(*given):
    """Log lines from (seconds, text)."""
    return [log("node", time, str(text)) for time, text in given]


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


@pytest.mark.parametrize(
    ("sent", "got", "partner"),
    [
        # Equal numbers are one message, however they are written.
        ([(0, "send 22.10"), (1, "send 5")], [(0.1, "got 22.1"), (1.1, "got 5.0")], [0, 1]),
        # What came before the receiver has no partner,
        ([(k, k) for k in range(5)], [(2.01, 2), (3.01, 3), (4.01, 4)], [None, None, 0, 1, 2]),
        # even if its number comes again,
        ([(0, 7), (1, 8), (2, 9), (3, 7)], [(1.01, 8), (2.01, 9), (3.01, 7)], [None, 0, 1, 2]),
        # and of two equal numbers the nearer one arrived,
        ([(0, 7), (3, 7)], [(3.01, 7)], [None, 0]),
        # and a value that stands still has none where nobody listened.
        ([(k, 10.2) for k in range(6)], [(k + 0.01, 10.2) for k in range(2, 6)],
         [None, None, 0, 1, 2, 3]),
        # A receiver that was busy gets all of them late.
        ([(0, 7), (1, 7), (2, 7)], [(5, 7), (5, 7), (5, 7)], [0, 1, 2]),
        # It may log a little before the sender, and not much.
        ([(5, 7)], [(4, 7)], [0]),
        ([(5, 7)], [(2, 7)], [None]),
        # Lines are put in order, and those without a number left out.
        ([(1, 2), (0, "Started"), (0.5, 1)], [(0.6, 1), (1.1, 2)], [0, 1]),
    ],
)  # fmt: skip
def test_which_lines_are_one_message(sent, got, partner):
    assert partners(pairs(lines(*sent), lines(*got))) == partner


def test_too_many_are_cut_on_both_sides():
    sent = lines(*((k / 10, k) for k in range(MOST + 40)))
    found = pairs(sent, lines(*((k / 10 + 0.001, k) for k in range(MOST + 40))))
    assert (len(found.sent), len(found.received), found.skipped) == (MOST, MOST, 40)
    assert partners(found) == list(range(MOST))


@pytest.mark.parametrize("seed", range(6))
def test_whatever_is_dropped_the_rest_is_paired_in_order(seed):
    rng = random.Random(seed)
    sent = [(at, rng.randint(18, 24)) for at in range(40)]
    kept = [rank for rank in range(40) if rng.random() < 0.7]
    found = pairs(lines(*sent), lines(*((sent[k][0] + 0.01, sent[k][1]) for k in kept)))
    links = [rank for rank in partners(found) if rank is not None]
    assert links == list(range(len(kept)))
    assert [rank for rank, link in enumerate(partners(found)) if link is not None] == kept
