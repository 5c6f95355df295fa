"""A watchdog of two sensors: it notices that one of them drifts. Pure functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from math import isnan, nan

from rosbeat.diagnosis.wires import Wire
from rosbeat.exercises.alarms import Suspect, Task, Words
from rosbeat.exercises.page_11_scenarios import REFERENCE, TEMPERATURE
from rosbeat.exercises.replays import FLOAT
from rosbeat.records import Sample

_WORD = "drift"


@dataclass(frozen=True)
class Rules:
    """How such a watchdog decides; what is asked for by default.

    Attributes:
        pairs: Of how many pairs it takes the mean; 0 for all.
        moves: Whether these are the last ones, and not the first.
        full: Whether it waits until there are so many.
        sizes: Whether it takes the mean of sizes, without signs.
        up, down: Whether it notices a mean above and below.
        limit: What the mean must be beyond.
        nan: What it does with a pair in which there is NaN: `skips` it, `keeps` it as any other
            difference, or never `loses` it again, in a running sum.
        start: The reference before the first one came; None if it waits for one.
        says: Whether it says of a drift `once`, `always` while it lasts, or `never again`.
        partners: Whether a pair is a temperature and the `newest` reference, or the next
            reference in the `order` in which they came, or one that comes `late`, after it.
    """

    pairs: int = 10
    moves: bool = True
    full: bool = True
    sizes: bool = False
    up: bool = True
    down: bool = True
    limit: float = 1.0
    nan: str = "skips"
    start: float | None = None
    says: str = "once"
    partners: str = "newest"


#: What is asked for.
ASKED = Rules()


class Watchdog:
    """A model of such a node.

    Args:
        rules: How it decides.
    """

    def __init__(self, rules: Rules) -> None:
        self._rules = rules
        self._references: list[float] = [] if rules.start is None else [rules.start]
        self._waiting: list[float] = []
        self._all: list[float] = []
        self._drifts = False

    def hear(self, topic: str, value: float) -> str:
        """What it says when a reading of one of the two comes, or nothing."""
        if self._rules.partners == "order":
            return self._in_order(topic, value)
        if self._rules.partners == "late":
            return self._late(topic, value)
        if topic == REFERENCE:
            self._references = [value]
            return ""
        return self._judged(value - self._references[0]) if self._references else ""

    def words(self) -> str:
        """What it knows of the pairs so far."""
        some = self._all[-self._rules.pairs :]
        if len(some) < self._rules.pairs:
            return f"after {len(some)} pair{'' if len(some) == 1 else 's'}"
        mean = sum(some) / len(some)
        return f"with a mean difference of {mean:.2f} in the last {len(some)} pairs"

    def _in_order(self, topic: str, value: float) -> str:
        (self._references if topic == REFERENCE else self._waiting).append(value)
        if not self._references or not self._waiting:
            return ""
        return self._judged(self._waiting.pop(0) - self._references.pop(0))

    def _late(self, topic: str, value: float) -> str:
        if topic == REFERENCE:
            return self._judged(self._waiting[0] - value) if self._waiting else ""
        self._waiting = [value]
        return ""

    def _judged(self, difference: float) -> str:
        if not isnan(difference) or self._rules.nan != "skips":
            self._all.append(abs(difference) if self._rules.sizes else difference)
        before, self._drifts = self._drifts, self._is_off(self._mean())
        if self._rules.says == "always":
            return _WORD if self._drifts else ""
        if self._rules.says == "never again":
            self._drifts = self._drifts or before
        return _WORD if self._drifts and not before else ""

    def _mean(self) -> float:
        width = self._rules.pairs
        some = self._all[-width:] if self._rules.moves else self._all[:width]
        if self._rules.nan == "loses" and any(map(isnan, self._all)):
            return nan
        if not some or (self._rules.full and len(some) < self._rules.pairs):
            return 0.0
        return sum(some) / len(some)

    def _is_off(self, mean: float) -> bool:
        up, down = mean > self._rules.limit, mean < -self._rules.limit
        return (up and self._rules.up) or (down and self._rules.down)


def watch(heard: Sequence[Sample], rules: Rules = ASKED) -> Words:
    """What such a watchdog says of what it hears.

    Args:
        heard: The readings of both sensors.
        rules: How it decides.
    """
    dog = Watchdog(rules)
    said = {one.time_ns: dog.hear(one.topic, one.value) for one in heard}
    return {at: word for at, word in said.items() if word}


_WINDOW = "The last ten pairs count, and no others: how many differences are in your mean?"
_EARLY = "With fewer than ten pairs nothing is said. What does your mean do at the beginning?"
_SIGNS = (
    "The difference keeps its sign until the mean is made. A noisy sensor is as often above as "
    "below, and that is no drift."
)
_BOTH = "A sensor may drift up or down. What is the sign of your mean then?"
_NAN = "A sum with NaN in it is NaN, which is never above or below a limit. Keep it out."
_START = "What is in your memory of the reference before its first reading has come?"
_AGAIN = "Say it once, when it is found. The next time is after the mean has come back."
_RESET = "What has to happen to your memory when the mean has come back?"
_LIMIT = "A mean of more than 1 degree is a drift; one of 1.5 is, and one of 0.8 is none."
_PAIRS = "If a reading is lost, the two lists are no longer in step. Which reference is the newest?"
_WHEN = "Each reading of temperature makes a pair. Which of your two callbacks makes yours?"

_LIMITS = (0.5, 0.75, 0.9, 1.1, 1.25, 1.5, 2.0, 5.0, 10.0)

_OTHERS: tuple[tuple[str, str, tuple[Rules, ...]], ...] = (
    ("wrong-window", _WINDOW, tuple(Rules(pairs=x) for x in (9, 11, 1, 5, 8, 12, 20))),
    ("wrong-window", _WINDOW, (Rules(pairs=0, full=False), Rules(pairs=1, full=False))),
    ("wrong-window", _WINDOW, (Rules(pairs=1, full=False, says="always"),)),
    ("wrong-window", _WINDOW, (Rules(moves=False),)),
    ("too-few-pairs", _EARLY, (Rules(full=False),)),
    ("mean-of-sizes", _SIGNS, (Rules(sizes=True),)),
    ("one-direction", _BOTH, (Rules(down=False), Rules(up=False))),
    ("nan-spreads", _NAN, (Rules(nan="keeps"), Rules(nan="loses"))),
    ("wrong-start", _START, tuple(Rules(start=x) for x in (0.0, 20.0, 22.0))),
    ("status-repeated", _AGAIN, (Rules(says="always"),)),
    ("never-reset", _RESET, (Rules(says="never again"),)),
    ("other-limits", _LIMIT, tuple(Rules(limit=x) for x in _LIMITS)),
    ("pairs-mixed-up", _PAIRS, (Rules(partners="order"),)),
    ("pairs-mixed-up", _WHEN, (Rules(partners="late"),)),
    ("wrong-window", _WINDOW, tuple(Rules(pairs=x, full=False) for x in (9, 11, 5, 20))),
)  # fmt: skip


def _context(heard: Sequence[Sample], at: int) -> str:
    dog = Watchdog(ASKED)
    for one in heard:
        if one.time_ns <= at:
            dog.hear(one.topic, one.value)
    return dog.words()


TASK = Task(
    (Wire(TEMPERATURE, FLOAT), Wire(REFERENCE, FLOAT)),
    (_WORD,),
    watch,
    tuple(
        Suspect(name, hint, partial(watch, rules=rules))
        for name, hint, many in _OTHERS
        for rules in many
    ),
    _context,
)
