"""Page 13, build your own: the vent alone, then a whole greenhouse."""

from __future__ import annotations

from typing import Any

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.diagnosis.wires import Wire, why_not_heard, why_not_published
from rosbeat.exercises.exercise import Exercise, before_judging, failed_by, passed
from rosbeat.exercises.greenhouse.commands import repeated
from rosbeat.exercises.greenhouse.days import airing
from rosbeat.exercises.greenhouse.judge import judge_greenhouse
from rosbeat.exercises.greenhouse.reading import silent, switch
from rosbeat.exercises.greenhouse.rubric import TOTAL, rubric_of, the_rubric
from rosbeat.exercises.greenhouse.trials import Trials, aired, tried
from rosbeat.exercises.greenhouse.vent import wrong_vent
from rosbeat.records import Observation, Outcome

_TEMPERATURE = Wire("/temperature", "std_msgs/msg/Float32")
_VENT = Wire("/vent", "std_msgs/msg/Bool")


def _given() -> dict[str, Any]:
    """What both scenarios are handed besides an answer."""
    return {"numbers": the_rubric().numbers}


def _judge_vent(trials: Trials) -> Outcome:
    seen, numbers = trials.plain, rubric_of(trials.numbers).numbers
    early = before_judging("13a", seen)
    if early:
        return early
    vent = switch(seen, _VENT.topic)
    wrong = _deaf_or_dumb(seen) or wrong_vent(vent, airing(numbers), numbers)
    wrong = wrong or repeated(vent, _VENT.topic)
    if wrong:
        return failed_by("13a", wrong)
    count = len(vent.commands)
    return passed("13a", f"{len(airing(numbers).held)} temperatures, and {count} commands.")


def _deaf_or_dumb(seen: Observation) -> Diagnosis | None:
    heard = any(call.source == _TEMPERATURE.topic for call in seen.callbacks)
    return (
        (None if heard else why_not_heard(seen, _TEMPERATURE))
        or why_not_published(seen, _VENT)
        or silent(seen, _VENT.topic)
    )


def _judge_all(trials: Trials) -> Outcome:
    return judge_greenhouse("13b", trials)


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "13a",
        aired,
        _judge_vent,
        "the vent alone",
        3,
        (
            "You have written such a node on page 04: the calm monitor. What does it remember?",
            "The new state follows from the temperature and from the old state. Ask for above and "
            "for below; in between nothing happens.",
            "Keep what was published last in a variable of the node; publish only what differs.",
        ),
        given=_given,
    ),
    Exercise(
        "13b",
        tried,
        _judge_all,
        "a greenhouse",
        TOTAL,
        (
            "Do one requirement after the other, and run the check in between: it gives points for "
            "each one that is met.",
            "For the pump, draw its states: ready, running, resting. Which event leads from one to "
            "the next, and when may it not?",
            "A silence is no event. A timer looks once in a while at how long ago the last message "
            "was: self.get_clock().now() tells the time.",
            "Where a reading is checked is up to you: in each node, or in one that passes on what "
            "can be on topics of its own. The second is shorter.",
        ),
        given=_given,
    ),
)
