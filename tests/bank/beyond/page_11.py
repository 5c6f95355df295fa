"""Answers to the exercises of page 11."""

from bank.answer import Answer
from bank.beyond import (
    bags_more,
    drift_right,
    drift_wrong,
    look_into,
    watchdog_right,
    watchdog_wrong,
)

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "11a": ("max(", "isnan(", "sum(", "len(readings)", ".time-"),
    "11b": ("isnan(", "abs(", "==5", ">5", "isnotNone"),
    "11c": ("isnan(", "abs(", "[-10:]", "maxlen", ">1.0", "=False"),
}

ANSWERS: tuple[Answer, ...] = (
    *look_into.ANSWERS,
    *watchdog_right.ANSWERS,
    *watchdog_wrong.ANSWERS,
    *drift_right.ANSWERS,
    *drift_wrong.ANSWERS,
    *bags_more.ANSWERS,
)
