"""Whether the vent follows the temperature (R1)."""

from __future__ import annotations

from collections.abc import Mapping

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.greenhouse.days import Day, plain_day
from rosbeat.exercises.greenhouse.reading import Switch, silent, stamp, switch
from rosbeat.exercises.greenhouse.trials import Trials

VENT = "/vent"
#: Seconds before a temperature ends, when the vent is looked at for the last time.
_JUST_BEFORE = 0.01


def judge_vent(trials: Trials) -> Diagnosis | None:
    """R1: the vent follows the temperature, with two limits."""
    numbers, seen = trials.numbers, trials.plain
    return silent(seen, VENT) or wrong_vent(switch(seen, VENT), plain_day(numbers), numbers)


def wrong_vent(vent: Switch, day: Day, numbers: Mapping[str, float]) -> Diagnosis | None:
    """The first temperature after which the vent does not stand as it should.

    Args:
        vent: What the vent was told.
        day: The temperatures.
        numbers: The limits.
    """
    before = False
    for begins, ends, value in day.held:
        opened = stands(value, before, numbers)
        for time in (begins + numbers["react_seconds"], ends - _JUST_BEFORE):
            if vent.at(time) != opened:
                return _told(numbers, value, (before, opened), time)
        before = opened
    return None


def stands(value: float, before: bool, numbers: Mapping[str, float]) -> bool:
    """Whether the vent has to be open.

    Args:
        value: The temperature.
        before: Whether it was open before that.
        numbers: The limits.
    """
    return value > numbers["open_above"] or (before and value >= numbers["close_below"])


def _told(
    numbers: Mapping[str, float], value: float, change: tuple[bool, bool], time: float
) -> Diagnosis:
    before, wanted = change
    opening, closing = numbers["open_above"], numbers["close_below"]
    words = ("closed", "open")
    evidence = (
        f"It was {words[before]}, the temperature became {value:g}, and at {stamp(time)} the vent "
        f"was {words[not wanted]}; it should have been {words[wanted]}."
    )
    if value in (opening, closing):
        hint = f"Exactly {value:g} changes nothing: above means above, and below means below."
        return Diagnosis("boundary", evidence, hint)
    if closing < value < opening:
        hint = "Between the two limits the vent stays as it was. So the node has to remember that."
        return Diagnosis("no-hysteresis", evidence, hint)
    hint = f"Above {opening:g} it opens, below {closing:g} it closes. Which line decides that?"
    return Diagnosis("wrong-state", evidence, hint)
