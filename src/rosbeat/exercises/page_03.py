"""Page 03, write a publisher: a sensor of another period, readings within limits, a lone node."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby, pairwise
from math import isfinite
from operator import sub
from typing import Any

from rosbeat.diagnosis.connections import Wire, diagnose_unpublished
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, passed
from rosbeat.exercises.model import (
    diagnose_beat,
    diagnose_length,
    explain_subscription,
    samples_on,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, drift, observe
from rosbeat.records import Observation

_FLOAT = "std_msgs/msg/Float32"

# Nothing is fed to a sensor, and what is asked of it is told on the page; drawn is how long it is
# watched. Random numbers are those of the page in any case: a walk that passes there passes later.

# 03a, another sensor.

_HUMIDITY = Wire("/humidity", _FLOAT)
_PERIOD, _DEPTH = 0.5, 5


def draw_seconds(draw: Draw) -> float:
    """Draw for how long a sensor is watched; only on the page until the moment of a reading."""
    return draw.whole(10, 10, 60) * _PERIOD + draw.number(0.0, 0.0625, 0.4375, 1 / 16_384)


def _judge_beat(observation: Observation, seconds: float) -> Verdict:
    wrong = diagnose_unpublished(observation, _HUMIDITY)
    wrong = wrong or diagnose_beat(observation, _HUMIDITY, _PERIOD)
    wrong = wrong or diagnose_length(observation, seconds)
    if wrong:
        return wrong
    ends = observation.graph.on(_HUMIDITY.topic, "publisher")
    qos = next((end.qos for end in ends if end.qos.depth != _DEPTH), ends[0].qos)
    if qos.history == "KEEP_ALL" or qos.depth != _DEPTH:
        depth = "without end" if qos.history == "KEEP_ALL" else str(qos.depth)
        return Diagnosis(
            "wrong-depth",
            f"The timing is right, but the publisher's queue depth is {depth}.",
            f"A depth of {_DEPTH} is wanted. Which argument of create_publisher is that?",
        )
    evidence = (
        f"{len(samples_on(observation, _HUMIDITY))} readings in {seconds:g} seconds on /humidity."
    )
    return passed(evidence, *([_BEST_EFFORT] if qos.reliability == "BEST_EFFORT" else []))


_BEST_EFFORT = (
    "Your publisher is BEST_EFFORT: it does not repeat what got lost, and a subscriber that asks "
    "for RELIABLE, as they do by default, hears nothing of it."
)

# 03b and 03c, walks between two limits.
#
# A step may be drawn in any way: with `uniform` or `choice`, by NumPy, from a generator of the
# node's own. So nobody can foretell what a right walk, or a misunderstood one, makes of the random
# numbers, and a walk is judged by what its readings have in common: each mistake shows in a way of
# its own, and is a row of a table.
#
# Random numbers drift up, then down, and then not at all. So both limits are met soon, and a walk
# that is still beyond a limit when the drift has turned gives itself away: what is published was
# cut off, and what is kept was not. Some generators do not drift; then more readings are needed.

#: Readings while the drift goes in one direction, and exponents of the drift.
_PHASE, _UP, _DOWN, _FREE = 600, 1 / 3, 3.0, 1.0
#: Readings of a run, or some more; a longer one follows if a limit may not have been met yet. A
#: walk without drift misses a limit in one of 10,000 runs of the last kind.
_RUNS = (3_600, 10_800, 32_400)
#: Seconds of wall time for a longer run; a busy machine needs a tenth of it.
_PATIENCE = {"deadline": 30.0}
#: Room for rounding to 32 bits, in a reading and in a step.
_ROUNDING, _IN_A_STEP = 1e-4, 1e-3
#: So many steps do not come again by chance, not even if there are only two to choose from.
_WINDOW = 64
#: Steps of two directions are alike if they differ by less than this factor; and so many of each
#: direction tell more than the widest two.
_EVEN, _ENOUGH = 0.8, 100


@dataclass(frozen=True)
class _Asked:
    """Hold what is asked of a walk."""

    wire: Wire
    rate: int  # readings a second
    low: float
    high: float
    step: float
    start: float | None = None  # where it has to begin
    rate_in_words: str = ""
    unit: str = "degrees"
    aside: str = ""  # a sentence after hints that name a number, with a space before it
    smallest: float = 0.8  # the widest step is at least this part of the widest allowed one


def _fahrenheit(celsius: float) -> float:
    return celsius * 9 / 5 + 32


_ROOM = _Asked(Wire("/temperature", _FLOAT), 1, 18.0, 28.0, 0.3, smallest=0.16 / 0.3)
_GREENHOUSE = _Asked(
    Wire("/greenhouse/temperature", _FLOAT),
    4,
    *(_fahrenheit(10.2), _fahrenheit(28.0), 0.9, _fahrenheit(22.0)),
    "Four readings a second. ",
    "degrees Fahrenheit",
    " In Celsius, where it walks, steps go up to 0.5, and the limits are 10.2 and 28.0.",
)


def draw_more(draw: Draw) -> float:
    """Draw for how many readings more than on the page a sensor is watched."""
    return draw.number(0.0, 0.25, 512.25, 1 / 128)


def _seconds(asked: _Asked, more: float) -> list[float]:
    """Return how long each run of a sensor takes."""
    return [(readings + more) / asked.rate for readings in _RUNS]


def _run_walk(asked: _Asked, answer: Answer, more: float) -> Observation:
    """Run a sensor until it has met both limits, or shown that it never will."""
    phase = _PHASE / asked.rate
    others = [drift([(phase, _UP), (phase, _DOWN), (0, _FREE)])]
    first, *_ = lengths = _seconds(asked, more)
    for seconds in lengths:
        options = _PATIENCE if seconds > first else {}
        seen = observe(answer, seconds, others=others, seed=3, **options)
        walk = _walk(asked, seen)
        found = walk.first_sign() if isinstance(walk, _Walk) else None
        if found is None or found[0] is not _NOT_MET:
            break
    return seen


class _Walk:
    """Hold at least two readings, and what can be seen of them."""

    def __init__(self, asked: _Asked, values: Sequence[float]) -> None:
        self.asked, self.values = asked, values
        self.moves = list(map(sub, values[1:], values))
        self.top, self.bottom = max(values), min(values)
        self.up, self.down = max(self.moves), -min(self.moves)
        self.widest = max(self.up, self.down)
        widths = sorted(abs(move) for move in self.moves if move) or [0.0]
        self.near = 2 * widths[int(0.95 * len(widths))]
        # Steps far wider than nearly all: whether they begin in the upper half, and where they end.
        middle = (self.top + self.bottom) / 2
        self.jumps = [
            (before > middle, now)
            for before, now in pairwise(values)
            if abs(now - before) > self.near + asked.step
        ]
        self.ends = (
            _End(self, self.top, asked.high, asked.low, self.top - asked.high, _PHASE),
            _End(self, self.bottom, asked.low, asked.high, asked.low - self.bottom, 2 * _PHASE),
        )

    def first_sign(self) -> tuple[_Sign, Any] | None:
        """Return the sign that counts, and where it shows: in the walk, or at an end of it."""
        signs: list[tuple[_Sign, Any]] = [(sign, self) for sign in _SIGNS]
        signs += [(sign, end) for end in self.ends for sign in _SIGNS_AT_AN_END]
        signs += [*((_NOT_MET, end) for end in self.ends), (_WRONG_START, self)]
        return next(((sign, seen) for sign, seen in signs if sign.shows(seen)), None)

    def evidence(self, mistake: str = "") -> str:
        unit = "" if mistake == "wrong-unit" else f" {self.asked.unit}"
        if self.widest == 0:
            return f"All readings are {self.top:.2f}{unit}."
        return (
            f"The readings were between {self.bottom:.2f} and {self.top:.2f}{unit}, in "
            f"steps of at most {self.widest:.2f}."
        )

    def first_slip(self) -> str:
        """Say when it first did what no right walk does, if there is such a moment."""
        asked = self.asked
        if self.widest == 0:
            return ""
        for n, (before, now) in enumerate(pairwise(self.values), 2):
            beyond = max(now - asked.high, asked.low - now)
            if abs(now - before) > asked.step + _IN_A_STEP or beyond > _ROUNDING:
                return f" At {n / asked.rate:g} s it went from {before:.2f} to {now:.2f}."
        return ""

    def is_constant(self, value: float) -> bool:
        return self.widest == 0 and abs(self.top - value) < _ROUNDING

    def starts_elsewhere(self) -> bool:
        start = self.asked.start
        return start is not None and abs(self.values[0] - start) > self.asked.step + 0.01

    def is_in_another_unit(self) -> bool:
        """Return whether it starts elsewhere, walks, and meets no limit as the formula gives it."""
        limits = (self.asked.low, self.asked.high)
        meets = any(abs(one - limit) < _ROUNDING for one in self.values for limit in limits)
        walks = 0 < self.widest <= 0.4 * (limits[1] - limits[0])
        return self.starts_elsewhere() and walks and not meets

    def is_converted_back(self) -> bool:
        first, second = self.values[:2]
        stands = self.asked is _GREENHOUSE and len(set(self.values[1:_PHASE])) == 1
        return stands and abs(second - first) > 1.0

    def is_mostly_at_a_limit(self) -> bool:
        """Return whether it is at its ends in every other reading: so wide are its steps."""
        there = sum(one in {self.top, self.bottom} for one in self.values)
        return self.widest > 0.5 * (self.top - self.bottom) and 2 * there > len(self.values)

    def wraps_round(self) -> bool:
        goals = [(now, self.bottom if is_high else self.top) for is_high, now in self.jumps]
        return bool(goals) and all(abs(now - goal) <= self.near for now, goal in goals)

    def is_set_back(self) -> bool:
        """Return whether all jumps from above end at one number, and all from below at another."""
        sides = [[now for high, now in self.jumps if high is side] for side in (True, False)]
        return any(sides) and all(max(one) - min(one) <= self.near for one in sides if one)

    def is_drawn_in_advance(self) -> bool:
        """Return whether the same steps come again, in the same order, away from both ends."""
        ends = {self.top, self.bottom}
        steps = [
            n if ends & {before, now} else round(now - before, 3)  # no two of these are the same
            for n, (before, now) in enumerate(pairwise(self.values), 1000)
        ]
        windows = [hash(tuple(steps[n : n + _WINDOW])) for n in range(len(steps) - _WINDOW)]
        return len(set(windows)) < len(windows)

    def is_uneven(self) -> bool:
        """Return whether steps in one direction are narrower than those in the other."""
        if min(self.up, self.down) >= _EVEN * self.widest:
            return False
        # The drift makes steps uneven, too, and so does a limit that cuts a step off.
        low, high = self.bottom + self.widest, self.top - self.widest
        free = pairwise(self.values[2 * _PHASE :])
        moves = [now - before for before, now in free if low < before < high]
        sides = [sorted(m for m in moves if m > 0), sorted(-m for m in moves if m < 0)]
        if min(map(len, sides)) < _ENOUGH:
            return True
        up, down = (side[int(0.95 * len(side))] for side in sides)
        return min(up, down) < _EVEN * max(up, down)

    def follows_a_rule(self) -> bool:
        """Return whether it turns round less than half as often as chance would."""
        moves = [move for move in self.moves[2 * _PHASE :] if move]
        ups = sum(move > 0 for move in moves) / max(1, len(moves))
        turns = sum((one > 0) != (next_one > 0) for one, next_one in pairwise(moves))
        # One whose steps grow too wide has another mistake: a speed that walks, for one.
        is_wide = self.widest > 2 * self.asked.step
        return len(moves) > 30 and not is_wide and turns <= ups * (1 - ups) * len(moves)

    def is_clamped_too_early(self) -> bool:
        # A whole step beyond is as far as such a walk gets; nothing cuts it off before.
        step, beyond = self.asked.step, max(end.beyond for end in self.ends)
        return _ROUNDING < beyond <= step + _ROUNDING and not any(
            end.is_met_often() and _ROUNDING < end.beyond < step - _IN_A_STEP for end in self.ends
        )


@dataclass(frozen=True)
class _End:
    """Hold one end of a walk."""

    walk: _Walk
    value: float
    limit: float  # where it should be
    other: float  # and where the other end should be
    beyond: float
    free: int  # the first reading that does not drift towards it

    def is_met_often(self) -> bool:
        return sum(one == self.value for one in self.walk.values) >= 5

    def is_cut(self) -> bool:
        """Return whether something cuts the walk off there, and not at the limit."""
        # With a few widths of steps only, all numbers come again and again.
        if abs(self.beyond) <= _IN_A_STEP or not self.is_met_often():
            return False
        different = len({round(one, 4) for one in self.walk.values})
        return different > len(self.walk.values) / 4

    def is_stuck(self) -> bool:
        """Return whether the walk stays at the limit for longer than chance would have it."""
        values = self.walk.values[self.free :]
        runs = groupby(values, lambda one: abs(one - self.limit) < _ROUNDING)
        return any(len(list(run)) > 60 for there, run in runs if there)


@dataclass(frozen=True)
class _Sign:
    """Say how a mistake shows in a walk, or at an end of it: `{0}` in the hint."""

    mistake: str
    hint: str
    shows: Callable[[Any], bool]


def _signs(*rows: tuple[str, str, Callable[[Any], bool]]) -> tuple[_Sign, ...]:
    return tuple(_Sign(*row) for row in rows)


#: The first one that shows names the mistake.
_SIGNS = _signs(
    ("converted-back", "After the first reading they are all {0.values[1]:.2f}. The node walks in "
     "Celsius and speaks in Fahrenheit. Is the converted number kept where the next step begins?",
     _Walk.is_converted_back),
    ("wrong-unit", "{0.top:g} is a limit in degrees Celsius. Clamp first, in Celsius, and convert "
     "then.",
     lambda walk: walk.starts_elsewhere() and (walk.is_constant(10.2) or walk.is_constant(28.0))),
    ("wrong-unit", "These are degrees Celsius still. Convert the number before you publish it.",
     lambda walk: walk.is_in_another_unit() and abs(walk.values[0] - 22.0) <= 0.51),
    ("wrong-unit", "22 degrees Celsius are {asked.start:.1f} Fahrenheit, and the first reading is "
     "{0.values[0]:.2f}. Compare your formula, brackets too: c * 9 / 5 + 32.",
     _Walk.is_in_another_unit),
    ("wrong-values", "A new message holds 0.0. Which line puts the number into its field data?",
     lambda walk: walk.is_constant(0.0)),
    ("clamp-swapped", "It stays at {0.top:g} from the first reading on. Which function keeps a "
     "number below a limit, min or max?", lambda walk: walk.is_constant(walk.asked.high)),
    ("never-changes", "It never changes. Does each call add a new random number to the old value? "
     "Are min and max swapped?", lambda walk: walk.widest == 0),
    ("wrong-values", "All readings are whole numbers. Is something rounded, or are the steps whole "
     "numbers?", lambda walk: all(one == round(one) for one in walk.values)),
    ("wraps-round", "Beyond one limit, it continues at the other. Clamp the value instead: then "
     "the walk stays at the limit until a step leads away from it.", _Walk.wraps_round),
    ("set-back", "At a limit, it is reset by far more than a step. Clamp the value instead: then "
     "the walk continues from the limit.", _Walk.is_set_back),
    ("jumps", "Most steps are small, and a few are not. Which line changes the temperature, "
     "besides the one that adds a step?", lambda walk: bool(walk.jumps)),
    ("step-too-wide", "Nearly every step leads from one limit to the other. Steps may be as wide "
     "as {asked.step:g}, up and down.{asked.aside}", _Walk.is_mostly_at_a_limit),
    ("forgets-itself", "Each reading is a new random number, independent of the one before. In a "
     "walk, you add a step to the old value.",
     lambda walk: walk.widest > 0.5 * (walk.top - walk.bottom)),
    ("one-way", "It goes one way only. Each step should go up or down at random.",
     lambda walk: walk.up <= 0 or walk.down <= 0),
    ("not-random", "The same steps come again, in the same order. Draw a new number at each call, "
     "and none in advance.", _Walk.is_drawn_in_advance),
    ("not-random", "It goes up and down by a rule of its own, every time the same way. Let a "
     "random number decide about each step.", _Walk.follows_a_rule),
    ("clamped-too-early", "It exceeds a limit by less than a step. Which comes first, the step or "
     "the clamp?", _Walk.is_clamped_too_early),
    ("step-too-wide", "A step is too wide. random.uniform(a, b) gives a number between a and "
     "b.{asked.aside}", lambda walk: walk.widest > walk.asked.step + _IN_A_STEP),
    ("step-too-small", "The steps are small. They may be as wide as {asked.step:g}, up and "
     "down.{asked.aside}", lambda walk: walk.widest < walk.asked.smallest * walk.asked.step),
    ("uneven-steps", "Steps go up by at most {0.up:.2f}, and down by at most {0.down:.2f}. They "
     "may be as wide as {asked.step:g}, up and down.{asked.aside}", _Walk.is_uneven),
)  # fmt: skip
_SIGNS_AT_AN_END = _signs(
    ("clamp-not-kept", "The reading stays at {0.limit:g} for minutes: you publish a clamped value, "
     "but the stored one goes on beyond {0.limit:g} and has to walk all the way back.",
     _End.is_stuck),
    ("clamp-swapped", "It never gets past {0.value:g}. Which of the two, min or max, keeps a "
     "number below a limit?", lambda end: end.is_cut() and abs(end.value - end.other) < _ROUNDING),
    ("other-limits", "Something cuts it off at {0.value:g}, and {0.limit:g} was asked "
     "for.{asked.aside}", _End.is_cut),
    ("no-clamp", "It got past {0.limit:g}. What cuts off a number that is beyond a "
     "limit?{asked.aside}", lambda end: end.beyond > _ROUNDING),
)  # fmt: skip
_NOT_MET = _Sign(
    "other-limits",
    "It stays inside narrower limits than {asked.low:g} and {asked.high:g}. Look at the two "
    "numbers.{asked.aside}",
    lambda end: end.beyond < -end.walk.asked.step,
)
_WRONG_START = _Sign(
    "wrong-start",
    "The walk is right, and its first reading is {0.values[0]:.2f}. It starts at 22.0 degrees "
    "Celsius, and the first reading is one step from there.",
    _Walk.starts_elsewhere,
)


def _walk(asked: _Asked, observation: Observation) -> _Walk | Diagnosis:
    """Return the walk that was published at the right times, or what keeps it from being one."""
    wrong = diagnose_unpublished(observation, asked.wire)
    wrong = wrong or diagnose_beat(observation, asked.wire, 1 / asked.rate)
    values = [one.value for one in samples_on(observation, asked.wire)]
    if wrong is None and not all(map(isfinite, values)):
        text = "Among the readings is one that is no finite number."
        wrong = Diagnosis("wrong-values", text, "Which calculation gives no number?")
    return wrong or _Walk(asked, values)


def _judge_walk(asked: _Asked, observation: Observation, more: float) -> Verdict:
    walk = _walk(asked, observation)
    if isinstance(walk, Diagnosis):
        return walk
    found = walk.first_sign()
    if found is None:
        return diagnose_length(observation, *_seconds(asked, more)) or passed(
            asked.rate_in_words + walk.evidence()
        )
    sign, seen = found
    hint = sign.hint.format(seen, asked=asked)
    return Diagnosis(sign.mistake, walk.evidence(sign.mistake) + walk.first_slip(), hint)


EXERCISES = (
    Exercise("03a", observe, _judge_beat, "another sensor", 2, (
        "Two calls are missing: one creates the publisher, the other the timer. The page shows "
        "both for the temperature sensor.",
        "create_publisher takes the message type, the topic's name in quotes, and the queue "
        "depth, in this order.",
        "create_timer takes the time between two calls, in seconds, and the method, without "
        "parentheses. Twice a second: how many seconds are that from one call to the next?",
    ), draw=draw_seconds, explains=partial(explain_subscription, _HUMIDITY)),
    Exercise("03b", partial(_run_walk, _ROOM), partial(_judge_walk, _ROOM), "a living room", 2, (
        "Three things happen at each tick: a random step, the clamp, and a message.",
        "random.uniform(a, b) is a number between a and b, and += adds it to what was there.",
        "min(high, x) limits x from above, and max(low, x) from below. Put one inside the "
        "other, and store the result in self.temperature.",
        "Float32(data=...) creates a message, and self.publisher_.publish sends it.",
    ), draw=draw_more, explains=partial(explain_subscription, _ROOM.wire)),
    Exercise("03c", partial(_run_walk, _GREENHOUSE), partial(_judge_walk, _GREENHOUSE),
        "a greenhouse, alone", 4, (
        "Begin with a copy of the sensor on this page, and change one thing at a time: topic, "
        "rate, unit. Check after each change.",
        "Four times a second means a quarter of a second between two calls.",
        "Keep self.temperature in Celsius, with the same step and clamp. Convert only the "
        "value that goes into the message.",
        "The result of a calculation such as c * 9 / 5 + 32 is already a float; store it in a "
        "variable of its own.",
    ), draw=draw_more, explains=partial(explain_subscription, _GREENHOUSE.wire)),
)  # fmt: skip
