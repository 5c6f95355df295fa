"""Page 09, test the five claims: a silence noticed, work beside a beat, a monitor for any place."""

from __future__ import annotations

from typing import Any

from rosbeat.exercises.exercise import Exercise
from rosbeat.exercises.noticing import judge_noticing
from rosbeat.exercises.page_09_scenarios import GREENHOUSE, HOME, ORDERS, PORCH, READINGS, SCENARIOS
from rosbeat.exercises.reusable import HIGH, LOW, UNIT, Place, judge_reusable
from rosbeat.exercises.steady_work import judge_work

_PLACES = (
    Place("", HOME.topic, "/status", LOW, HIGH, UNIT, HOME.readings),
    Place(
        "/greenhouse/humidity_monitor", GREENHOUSE.topic, "/greenhouse/status", 40.0, 70.0, "%",
        GREENHOUSE.readings,
    ),
    Place("/porch/light_monitor", PORCH.topic, "/porch/light", LOW, 800.0, "lx", PORCH.readings),
)  # fmt: skip

EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise(
        "09a",
        SCENARIOS["09a"],
        lambda seen: judge_noticing("09a", seen, READINGS),
        "notice the silence",
        3,
        (
            "Two callbacks: one for what comes, and one that looks at what does not come.",
            "What they have to share: when the last reading came, and whether the sensor is lost.",
            "self.get_clock().now() is a time, and the difference of two has nanoseconds. Or let a "
            "timer begin anew with each reading.",
            "Before the first reading there is nothing to lose. Say a word only when what is "
            "remembered changes.",
        ),
    ),
    Exercise(
        "09b",
        SCENARIOS["09b"],
        lambda seen: judge_work("09b", seen, ORDERS),
        "work, and go on beating",
        3,
        (
            "No callback may last: each does something short, returns, and is called again.",
            "Waiting is what timers are for. One of them can tell that the work on an order is "
            "done.",
            "A list remembers the orders that wait: new ones go to its end, and the one that is "
            "worked on is its first.",
            "A timer can be stopped with cancel() and begins anew with reset(); is_canceled() says "
            "whether it is stopped.",
        ),
    ),
    Exercise(
        "09c",
        SCENARIOS["09c"],
        lambda seen: judge_reusable("09c", seen, _PLACES),
        "a monitor for any place",
        3,
        (
            "Whatever differs from place to place comes from outside; the code only says what it "
            "is if nobody says anything.",
            "Look at the sensor of this page: a parameter is declared once, with its default, and "
            "what it holds is asked for by the same name.",
            "A name without a slash in front is completed by the node's namespace, and can be "
            "remapped there.",
            "Decide first: above one limit, below the other, or neither. Then make one text of the "
            "word, the reading and the unit.",
        ),
    ),
)
