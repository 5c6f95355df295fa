"""Answers to the exercises of page 09."""

from bank.answer import Answer
from bank.beyond import (
    anywhere_right,
    anywhere_wrong,
    claims_more,
    silence_right,
    silence_wrong,
    worker_right,
    worker_wrong,
)

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "09a": ("create_timer(3", "silence.reset()", "self.lost=True", ">=3.0"),
    "09b": ("create_timer(3", "work.reset()", "waiting.pop(0)", "is_canceled():"),
    "09c": ('declare_parameter("low"', "msg.data>self.high", '"reading",self', ":.1f"),
}

ANSWERS: tuple[Answer, ...] = (
    *silence_right.ANSWERS,
    *silence_wrong.ANSWERS,
    *worker_right.ANSWERS,
    *worker_wrong.ANSWERS,
    *anywhere_right.ANSWERS,
    *anywhere_wrong.ANSWERS,
    *claims_more.ANSWERS,
)
