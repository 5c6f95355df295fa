"""Waiting with a deadline."""

import time

from rosbeat.ros.graph import poll


def test_what_is_true_already_is_not_waited_for():
    assert poll(lambda: True, time.monotonic() - 1) is True


def test_the_deadline_ends_it():
    begin = time.monotonic()
    assert poll(bool, begin + 0.12) is False
    assert time.monotonic() >= begin + 0.12


def test_without_a_deadline_it_asks_until_it_is_true():
    answers = [False, False, "yes"]
    seen = []
    assert poll(lambda: answers.pop(0), None, lambda: seen.append(len(answers))) is True
    assert seen == [3, 2, 1]
