"""Answers to the exercises of page 12."""

from bank.answer import Answer
from bank.beyond import (
    heat_right,
    heat_wrong,
    high_right,
    high_wrong,
    limits_right,
    limits_wrong,
    page_12_more,
)

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS: dict[str, tuple[str, ...]] = {
    "12a": ("10.0<=request", "10<=value", 'BasicTypes,"set_high"'),
    "12b": ("p.name:p.value", "parameter.name:parameter.value", "new.update"),
    "12c": ("10<=goal.order", "canceled()", "publish_feedback(", "Bool(data=False)"),
}

_MODULES = (
    *(high_right, high_wrong, limits_right, limits_wrong, heat_right, heat_wrong),
    page_12_more,
)
ANSWERS: tuple[Answer, ...] = tuple(one for module in _MODULES for one in module.ANSWERS)
