import random

import pytest

from rosbeat.records import NANOSECONDS, LogRecord
from rosbeat.viz.pairs import MOST, first_number, pairs

EPOCH = 1_795_291_137 * NANOSECONDS


def log(*lines, name="node"):
    """Log lines from (seconds, text)."""
    return [
        LogRecord(EPOCH + round(at * NANOSECONDS), "INFO", name, str(text), "", 0)
        for at, text in lines
    ]


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
    found = pairs(log((0, "send 22.10"), (1, "send 5")), log((0.1, "got 22.1"), (1.1, "got 5.0")))
    assert partners(found) == [0, 1]
    assert found.lost == found.late == found.strange == ()


def test_what_came_before_the_receiver_is_lost():
    sent = log(*((at, at) for at in range(5)))
    found = pairs(sent, log((2.01, 2), (3.01, 3), (4.01, 4)))
    assert partners(found) == [None, None, 0, 1, 2]
    assert [line.words for line in found.lost] == ["0", "1"]
    assert found.early == found.lost


def test_a_lost_message_whose_number_comes_again_is_still_lost():
    sent = log((0, 7), (1, 8), (2, 9), (3, 7))
    assert partners(pairs(sent, log((1.01, 8), (2.01, 9), (3.01, 7)))) == [None, 0, 1, 2]


def test_of_two_equal_numbers_the_nearer_one_arrived():
    assert partners(pairs(log((0, 7), (3, 7)), log((3.01, 7)))) == [None, 0]


def test_a_value_that_stands_still_is_lost_where_nobody_listened():
    sent = log(*((at, 10.2) for at in range(6)))
    assert partners(pairs(sent, log(*((at + 0.01, 10.2) for at in range(2, 6))))) == [
        None, None, 0, 1, 2, 3,
    ]  # fmt: skip


def test_a_receiver_that_was_busy_gets_all_of_them_late():
    assert partners(pairs(log((0, 7), (1, 7), (2, 7)), log((5, 7), (5, 7), (5, 7)))) == [0, 1, 2]


def test_the_receiver_may_log_a_little_before_the_sender_and_not_much():
    assert partners(pairs(log((5, 7)), log((4, 7)))) == [0]
    assert partners(pairs(log((5, 7)), log((2, 7)))) == [None]


def test_what_was_sent_after_the_last_line_of_the_receiver_is_not_called_lost():
    found = pairs(log((0, 1), (1, 2), (2, 3), (3, 4)), log((0.1, 1), (2.1, 3)))
    assert [line.words for line in found.lost] == ["2"]
    assert [line.words for line in found.late] == ["4"]
    assert found.early == ()


def test_without_any_receiver_all_are_lost():
    found = pairs(log((0, 1), (1, 2)), [])
    assert len(found.lost) == len(found.early) == 2
    assert found.late == ()


def test_what_nobody_sent_is_strange():
    found = pairs(log((0, 1)), log((0.1, 1), (0.2, 99)))
    assert [line.words for line in found.strange] == ["99"]


def test_lines_are_put_in_order_and_lines_without_number_left_out():
    found = pairs(log((1, 2), (0, "Started"), (0.5, 1)), [])
    assert [line.words for line in found.sent] == ["1", "2"]


def test_too_many_are_cut_on_both_sides():
    sent = log(*((at / 10, at) for at in range(MOST + 40)))
    found = pairs(sent, log(*((at / 10 + 0.001, at) for at in range(MOST + 40))))
    assert (len(found.sent), len(found.received), found.skipped) == (MOST, MOST, 40)
    assert partners(found) == list(range(MOST))


@pytest.mark.parametrize("seed", range(20))
def test_whatever_is_dropped_the_rest_is_paired_in_order(seed):
    rng = random.Random(seed)
    sent = [(at, rng.randint(18, 24)) for at in range(40)]
    kept = [rank for rank in range(40) if rng.random() < 0.7]
    found = pairs(log(*sent), log(*((sent[k][0] + 0.01, sent[k][1]) for k in kept)))
    links = [rank for rank in partners(found) if rank is not None]
    assert links == list(range(len(kept)))
    assert [rank for rank, link in enumerate(partners(found)) if link is not None] == kept
