"""A watchdog of one sensor: NaN, jumps, and a sensor that hangs. Pure functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import isnan, nan

from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.alarms import Suspect, Task, Words
from rosbeat.exercises.page_11_scenarios import TEMPERATURE
from rosbeat.exercises.replays import FLOAT
from rosbeat.records import Sample

_TEMPERATURE = Wire(TEMPERATURE, FLOAT)


@dataclass(frozen=True)
class Rules:
    """How a watchdog decides; what is asked for by default.

    Attributes:
        hears_nan: Whether it notices NaN.
        keeps_nan: Whether NaN becomes the reading before.
        start: The reading before the first one.
        limit: What a difference must be above to be a jump.
        at_limit: Whether the limit itself is a jump.
        up, down: Whether it notices jumps upwards and downwards.
        compares: With which reading: the one `before`, the `first`, the last `good` one, or with
            `itself`, because it is kept too early.
        equal: How many equal readings are a hang.
        nearly: How far readings that it takes for equal may be apart.
        says: Whether it says of a hang `once`, `always` while it lasts, for every fifth reading, or
            every fourth after the first, or only for the first hang ever (`never again`), or
            whenever the count is `at five`.
        resets: Whether it counts anew after a reading that differs.
        jump_resets: Whether it does so after a jump, too.
        alone: Whether the first reading is equal to itself, and so a hang.
    """

    hears_nan: bool = True
    keeps_nan: bool = False
    start: float | None = None
    limit: float = 5.0
    at_limit: bool = False
    up: bool = True
    down: bool = True
    compares: str = "before"
    equal: int = 5
    nearly: float = 0.0
    says: str = "once"
    resets: bool = True
    jump_resets: bool = True
    alone: bool = False


#: What is asked for.
ASKED = Rules()


class Watchdog:
    """A model of such a node.

    Args:
        rules: How it decides.
    """

    def __init__(self, rules: Rules) -> None:
        self._rules = rules
        self._last: float | None = rules.start
        self._base: float | None = rules.start
        self._row, self._hung = 1, False

    def hear(self, value: float) -> str:
        """What it says of a reading, or nothing."""
        if isnan(value):
            if self._rules.keeps_nan:
                self._last, self._base, self._row = nan, nan, 1
            return "nan" if self._rules.hears_nan else ""
        if self._rules.compares == "itself":
            self._last = self._base = value
        jumps = self._jumps(value)
        hangs = (self._rules.jump_resets or not jumps) and self._hangs(value)
        self._last = value
        follows = {"before": True, "first": False, "good": not jumps, "itself": True}
        if self._base is None or follows[self._rules.compares]:
            self._base = value
        return "jump" if jumps else "stuck" if hangs else ""

    def _jumps(self, value: float) -> bool:
        off = 0.0 if self._base is None else value - self._base
        if (off > 0 and not self._rules.up) or (off < 0 and not self._rules.down):
            return False
        size, rules = abs(off), self._rules
        return size > rules.limit or (rules.at_limit and size == rules.limit)

    def _hangs(self, value: float) -> bool:
        rules = self._rules
        if self._last is None:
            return rules.alone
        if abs(value - self._last) <= rules.nearly:
            self._row += 1
        elif rules.resets:
            self._row = 1
            self._hung = self._hung and rules.says == "never again"
        if rules.says == "always":
            return self._row >= rules.equal
        if rules.says == "every fifth":
            return self._row > 1 and self._row % rules.equal == 0
        if rules.says == "every fourth":
            return self._row > 1 and self._row % (rules.equal - 1) == 1
        if rules.says == "at five":
            return self._row == rules.equal
        if self._row < rules.equal or self._hung:
            return False
        self._hung = True
        return True


def watch(heard: Sequence[Sample], rules: Rules = ASKED) -> Words:
    """What a watchdog says of what it hears.

    Args:
        heard: The readings.
        rules: How it decides.
    """
    dog = Watchdog(rules)
    said = {one.time_ns: dog.hear(one.value) for one in heard}
    return {at: word for at, word in said.items() if word}


_ORDER = "What does your node remember of the reading before, and when does it change that?"
_FIRST = "With what is the very first reading compared? There is no reading before it."
_NAN = (
    "NaN is neither above nor below nor equal to anything, not even to itself. The page shows a "
    "function that asks for it."
)
_KEPT = (
    "After a NaN the node has NaN in its memory, and nothing is far from it or equal to it. Which "
    "reading should it remember there?"
)
_COUNT = "Count on paper: which is the fifth equal reading in a row, if the first one is the first?"
_AGAIN = "Say it once, when it is found. The next time is after the sensor has moved again."
_RESET = "What has to happen to your memory when the sensor moves again?"
_NEARLY = "A sensor in a quiet room moves very little, and that is no hang: compare exactly."
_BOTH = "A jump may go up or down. What is the sign of your difference?"
_LIMIT = "More than 5 degrees is a jump; 5 degrees are none, and 6 are one."

_OTHERS: tuple[tuple[str, str, tuple[Rules, ...]], ...] = (
    ("nan-compared", _NAN, (Rules(hears_nan=False, keeps_nan=True), Rules(hears_nan=False))),
    ("nan-kept", _KEPT, (Rules(keeps_nan=True), Rules(keeps_nan=True, jump_resets=False))),
    ("alarm-at-start", _FIRST, tuple(Rules(start=start) for start in (0.0, 20.0, 22.0, 25.0))),
    ("alarm-at-start", _FIRST, (Rules(alone=True), Rules(alone=True, says="always"))),
    ("boundary", _LIMIT, (Rules(at_limit=True),)),
    ("other-limits", _LIMIT, tuple(Rules(limit=x) for x in (0.5, 1, 2, 3, 4, 6, 7, 8, 10, 15))),
    ("one-direction", _BOTH, (Rules(up=False), Rules(down=False))),
    ("other-reading", _ORDER, (Rules(compares="first"), Rules(compares="good"))),
    ("other-reading", _ORDER, (Rules(compares="itself"),)),
    ("counted-wrong", _COUNT, tuple(Rules(equal=x) for x in (4, 6, 3, 2, 7, 10))),
    ("status-repeated", _AGAIN, tuple(Rules(says=x) for x in ("always", "every fifth"))),
    ("status-repeated", _AGAIN, (Rules(says="every fourth"),)),
    ("never-reset", _RESET, (Rules(jump_resets=False),)),
    ("never-reset", _RESET, (Rules(resets=False), Rules(says="never again"))),
    ("nearly-equal", _NEARLY, tuple(Rules(nearly=x) for x in (0.001, 0.005, 0.01, 0.05, 0.1))),
    ("status-repeated", _AGAIN, tuple(Rules(says="always", equal=x) for x in (4, 6))),
    ("never-reset", _RESET, tuple(Rules(resets=False, says=x) for x in ("always", "at five"))),
)  # fmt: skip


def _context(heard: Sequence[Sample], at: int) -> str:
    values = [one.value for one in heard if one.time_ns <= at]
    if at not in {one.time_ns for one in heard}:
        return "when no reading came"
    more = "..., " if len(values) > 6 else ""
    return f"after {more}{', '.join(f'{value:g}' for value in values[-6:])}"


#: Listen to a temperature and say what is wrong with it.
TASK = Task(
    (_TEMPERATURE,),
    ("nan", "jump", "stuck"),
    watch,
    tuple(
        Suspect(name, hint, partial(watch, rules=rules))
        for name, hint, many in _OTHERS
        for rules in many
    ),
    _context,
)
