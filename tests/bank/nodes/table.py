"""All answers to the exercises about nodes."""

from bank.answer import Answer
from bank.nodes import (
    alarm_right,
    alarm_wrong,
    beat_right,
    beat_wrong,
    blind_00_04,
    blind_00_04_more,
    blind_00_04_rare,
    fridge_right,
    fridge_wrong,
    greenhouse_right,
    greenhouse_wrong,
    hysteresis_right,
    hysteresis_wrong,
    listening_more,
    page_00_further,
    page_03_further,
    reader_right,
    reader_wrong,
    reporter_right,
    reporter_wrong,
    room_right,
    room_wrong,
)

_MODULES = (
    *(reader_right, reader_wrong, reporter_right, reporter_wrong),
    *(beat_right, beat_wrong, room_right, room_wrong, greenhouse_right, greenhouse_wrong),
    *(page_00_further, page_03_further),
    *(fridge_right, fridge_wrong, alarm_right, alarm_wrong, hysteresis_right, hysteresis_wrong),
    listening_more,
    *(blind_00_04, blind_00_04_more, blind_00_04_rare),
)

ANSWERS: tuple[Answer, ...] = tuple(one for module in _MODULES for one in module.ANSWERS)
