"""Answers to the exercises of page 13."""

from bank.answer import Answer
from bank.beyond import greenhouse_right, greenhouse_wrong, page_13_more, vent_alone

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "13a": ("msg.data>above", "msg.data<below", "wanted!=self.is_open"),
    "13b": (">=5e9", "create_timer(10", "low<=msg.data", "checked/"),
}

ANSWERS: tuple[Answer, ...] = (
    *vent_alone.ANSWERS,
    *greenhouse_right.ANSWERS,
    *greenhouse_wrong.ANSWERS,
    *page_13_more.ANSWERS,
)
