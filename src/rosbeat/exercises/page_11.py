"""Page 11, record and replay: look into a bag, notice what is wrong, and test who notices it.

The scenarios know only what they record and replay. What a right answer makes of it, and what one
makes of it whose author misunderstood something, is simulated by the judges from what was drawn:
what was played is not taken from the evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import accumulate, chain, pairwise
from math import isclose, isnan, nan
from pathlib import Path
from random import Random
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple

from rosbeat import bags
from rosbeat.diagnosis.connections import Wire, diagnose_unheard, diagnose_unpublished
from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.exercise import Exercise, Verdict, before_judging, passed
from rosbeat.exercises.model import (
    ZERO_IS_FALSE,
    Mismatch,
    Model,
    Suspect,
    Track,
    agree,
    as_float32,
    before_reading,
    diagnose,
    diagnose_words,
    first_mismatch,
    grouped,
    name_mistake,
    samples_on,
    spelling,
    tells_apart,
    variants,
)
from rosbeat.exercises.random_inputs import Draw
from rosbeat.exercises.scenarios import Answer, Report, observe, report
from rosbeat.records import NANOSECONDS, Observation, Sample

_FLOAT, _STRING = "std_msgs/msg/Float32", "std_msgs/msg/String"
_TEMPERATURE = Wire("/temperature", _FLOAT)
_FAULT = Wire("/fault", _STRING)
#: What a watchdog may say.
WORDS = ("nan", "jump", "stuck")
#: The node that plays a recording, and the one that is said to have made it.
_PLAYER, _MAKER = "/replay", "/recorded"


def _sample(at: float, topic: str, value: float | str) -> Sample:
    kind = _STRING if isinstance(value, str) else _FLOAT
    return Sample(round(at * NANOSECONDS), topic, kind, _MAKER, {"data": value})


def _seen_in(samples: Iterable[Sample]) -> Observation:
    """Return messages as what a session has seen, which can be recorded and replayed."""
    ordered = tuple(sorted(samples, key=lambda one: one.time_ns))
    return Observation(ordered[-1].time_ns, 0, ordered)


# 11a, look into a bag: a function is called with one bag after the other.

#: Times in seconds, and the reading at each. A float32 holds each of these numbers exactly.
_Readings = Sequence[tuple[float, float]]
#: Another topic in the same bags; of these, as many as `_statuses` says.
_STATUS = ((3, "Normal"), (9.5, "Low"), (10.5, "High"), (11.5, "Normal"))


def draw_readings(draw: Draw) -> Sequence[_Readings]:
    """Draw recordings in which no number is the same as another by chance; one comes twice.

    On the page, the longest gap lies at the beginning, in the middle, at the end, and beside a NaN.
    NaN stands at the beginning, in the middle and at the end. One reading is 0 whatever is drawn:
    in Python it counts as false.
    """

    def recording(first: float, gaps: Sequence[float], values: Sequence[float]) -> _Readings:
        longer = draw.one_of(1, 1.5, 2, 2.5, 3)
        times = accumulate((gap * longer for gap in draw.shuffled(gaps)), initial=first)
        drawn = {
            value: draw.number(value, -9.0, 40.0)
            for value in dict.fromkeys(values)
            if value and not isnan(value)
        }
        numbers = (drawn.get(value, value) for value in values)
        return tuple(zip(times, numbers, strict=True))

    return draw.until(
        lambda: draw.shuffled(
            (
                recording(3, (4.5, 1, 1.5, 1), (21.0, 21.5, 21.0, 24.0, 22.0)),
                recording(1, (1, 1, 6, 1, 2.5, 1.5), (nan, 20.0, 19.5, nan, 18.25, 18.0, 20.75)),
                recording(10, (0.5, 3.5, 1.25), (25.5, 0.0, 30.0, nan)),
                recording(2, (0.75,), (-4.0, 2.5)),
            )
        ),
        lambda recordings: all(
            tells_apart(recordings, partial(_in_each, find=right), suspects, _near)
            for right, suspects in ASKED.values()
        ),
    )


@dataclass(frozen=True)
class BagReports:
    """Hold what a function found in several recordings.

    Attributes:
        reports: One for each, up to the first that has no result.
    """

    reports: tuple[Report, ...]


def _look_into_bags(answer: Answer, recordings: Sequence[_Readings]) -> BagReports:
    found: list[Report] = []
    with TemporaryDirectory(prefix="rosbeat-") as folder:
        for number, readings in enumerate(recordings):
            samples = [_sample(at, "/temperature", float(value)) for at, value in readings]
            samples += [_sample(at, "/status", word) for at, word in _statuses(readings)]
            found.append(report(answer, bags.record(_seen_in(samples), Path(folder, str(number)))))
            if not found[-1].result:
                break
    return BagReports(tuple(found))


def _statuses(readings: _Readings) -> Sequence[tuple[float, str]]:
    """Return what is on the other topic: half as many messages as on the first, and one."""
    return _STATUS[: len(readings) // 2 + 1]


def _gaps(readings: _Readings) -> list[float]:
    return [later - earlier for (earlier, _), (later, _) in pairwise(readings)]


def _good(readings: _Readings) -> _Readings:
    return [(at, value) for at, value in readings if not isnan(value)]


def _numbers(readings: _Readings) -> list[float]:
    return [value for _, value in _good(readings)]


def _all_times(readings: _Readings) -> list[float]:
    """Return the times of all messages in a bag."""
    return [at for at, _ in [*readings, *_statuses(readings)]]


def _in_each(recordings: Sequence[_Readings], find: Callable[[_Readings], float]) -> Track:
    return {number: (find(readings),) for number, readings in enumerate(recordings)}


def _findings(*rows: tuple[Any, ...]) -> tuple[Suspect, ...]:
    """Return suspects from rows of a mistake, a hint, and one way or more to find the number."""
    options = ((name, hint, *({"find": one} for one in finds)) for name, hint, *finds in rows)
    return variants(_in_each, options)


_EVERY = "A reading of NaN is a message all the same."
_FENCE = "Between five messages there are four gaps. Which of the two numbers is asked for?"
_UNIT = "The record of a message has its time twice, in two units. In which one is this?"
_GAP = "A gap lies between two messages that follow each other; the longest of them is asked for."
_PLAIN = "Divide the sum of the numbers by how many there are."
#: What is asked for, each with other ways to get a number.
ASKED: dict[str, tuple[Callable[[_Readings], float], tuple[Suspect, ...]]] = {
    "messages": (len, _findings(
        ("all-topics", "The bag has other topics, too. How many messages has this one?",
         lambda r: len(_all_times(r)), lambda r: len(_statuses(r))),
        ("nan-left-out", _EVERY, lambda r: len(_good(r))),
        ("counted-wrong", _FENCE, lambda r: len(r) - 1, lambda r: len(r) + 1),
    )),
    "gap": (lambda r: max(_gaps(r)), _findings(
        ("wrong-unit", _UNIT, lambda r: max(_gaps(r)) * 10**9, lambda r: max(_gaps(r)) * 1000),
        ("nan-left-out", _EVERY, lambda r: max(_gaps(_good(r)))),
        ("other-gap", _GAP,
         lambda r: min(_gaps(r)),
         lambda r: _gaps(r)[0],
         lambda r: _gaps(r)[-1],
         lambda r: sum(_gaps(r)),
         lambda r: max(_all_times(r)) - min(_all_times(r)),
         lambda r: max(_all_times(r)),
         lambda r: sum(_gaps(r)) / len(_gaps(r)),
         lambda r: median(_gaps(r)),
         lambda r: max(*_gaps(r), r[0][0]),
         lambda r: max(*_gaps(r), 1.0),
         lambda r: -max(_gaps(r)),
         lambda r: max(abs(b - a) for a, b in pairwise(_numbers(r)))),
    )),
    "mean": (lambda r: sum(_numbers(r)) / len(_numbers(r)), _findings(
        ("nan-spreads", "A sum that contains NaN is NaN. Leave NaN out before you add.",
         lambda r: sum(value for _, value in r) / len(r)),
        ("wrong-share", "If you leave a reading out of the sum, leave it out of the count, too.",
         lambda r: sum(_numbers(r)) / len(r)),
        ("other-mean", "A value that occurs twice counts twice, but a set holds it only once.",
         lambda r: sum(set(_numbers(r))) / len(set(_numbers(r)))),
        ("other-mean", _PLAIN,
         lambda r: median(_numbers(r)),
         lambda r: sum(_numbers(r)),
         lambda r: sum(_numbers(r)) // len(_numbers(r)),
         lambda r: round(sum(_numbers(r)) / len(_numbers(r))),
         lambda r: (max(_numbers(r)) + min(_numbers(r))) / 2),
        ("counted-wrong", _FENCE, lambda r: sum(_numbers(r)) / max(1, len(_numbers(r)) - 1)),
    )),
}  # fmt: skip

#: What exceptions mean in a function that is given a bag: the type, and what the text holds.
_RAISED = (
    ("AttributeError", "", "wrong-attribute",
     "Print one of the messages: it shows the names of all that it has."),
    ("BagError", "", "topic-misspelled",
     "Print the bag: it shows its topics. Names match letter by letter."),
    ("ZeroDivisionError", "", "division-by-zero", "By what do you divide, and when is that 0?"),
    ("IndexError", "", "index-error",
     "Some bags hold only a few messages. How long is your list there?"),
    ("CallError", "without `topic`", "argument-missing",
     "A bag may hold several topics. How does the cell above ask for one of them?"),
    ("TypeError", "0 positional arguments", "argument-missing",
     "The check hands a bag over. Does the first line of your function have a name for it?"),
    ("TypeError", "'Bag' object is not subscriptable", "wrong-attribute",
     "A bag gives its messages back when a method is called. Which one does the page show?"),
    ("TypeError", "Sample object", "message-for-value",
     "Each message is one object, and no pair. Its time and its value have names of their own."),
    ("TypeError", " and 'dict'", "message-for-value",
     "`data` is the whole message, field by field. Under which name is the number alone?"),
    ("TypeError", "'Sample'", "message-for-value",
     "That is a whole message with its time. Under which name does it hold the number?"),
)  # fmt: skip


def _judge_bag_reports(seen: BagReports, recordings: Sequence[_Readings]) -> Verdict:
    for one in seen.reports:
        example = 'check("11a", look_into)'
        early = _raised_in_function(one) or before_reading(one, example)
        if early:
            return early
    numbers = (_diagnose_number(seen, recordings, key) for key in ASKED)
    wrong = _diagnose_shape(seen) or next(filter(None, numbers), None)
    return wrong or passed(
        f"{len(recordings)} recordings that this page has not seen: all three numbers are right "
        "in each."
    )


def _raised_in_function(one: Report) -> Verdict | None:
    kind, _, text = one.problem.partition(": ")
    for name, part, mistake, hint in _RAISED:
        if kind == name and part in text:
            said = text.splitlines()[0].rstrip(".") if text else "without a word"
            return Diagnosis(mistake, f"The function raised {kind}: {said}.", hint)
    return None


def _diagnose_shape(seen: BagReports) -> Diagnosis | None:
    for one in seen.reports:
        if not isinstance(one.value, dict):
            return Diagnosis(
                "no-dict",
                f"The function gave back a {one.type_name}.",
                "Return a dictionary in braces, as the cell shows, with a name before each number.",
            )
        absent = [key for key in ASKED if key not in one.value]
        if absent:
            hints = [spelling(key, absent) for key in one.value]
            return Diagnosis(
                "key-missing",
                f"The result has {', '.join(map(repr, one.value)) or 'no names'}, and no "
                f"{absent[0]!r}.",
                next(filter(None, hints), f"The three names are {', '.join(ASKED)}."),
            )
    return None


def _diagnose_number(
    seen: BagReports, recordings: Sequence[_Readings], key: str
) -> Diagnosis | None:
    """Say what is wrong with one of the three numbers, or None if it is right in each bag."""
    found = [one.value[key] for one in seen.reports]
    odd = [one for one in found if isinstance(one, bool) or not isinstance(one, int | float)]
    if odd:
        hint = "Return the number itself, not a list or a string."
        return Diagnosis("no-number", f"For {key!r} the function gave back {odd[0]!r}.", hint)
    done = {number: (one,) for number, one in enumerate(found)}
    right, suspects = ASKED[key]

    def describe(mismatch: Mismatch) -> Diagnosis:
        readings = ", ".join(f"{value:g} at {at:g} s" for at, value in recordings[mismatch.at])
        evidence = (
            f"In a recording with the readings {readings}, {key!r} is {mismatch.right[0]:g}, and "
            f"the function found {mismatch.done[0]:g}."
        )
        if all(one == found[0] for one in found):
            hint = (
                "The result is the same for every bag. Calculate it from the messages of this one."
            )
            return Diagnosis("fixed-answer", evidence, hint)
        return Diagnosis("wrong-values", evidence, "Print the list from which you calculate it.")

    return diagnose(recordings, done, _in_each(recordings, right), suspects, describe, _near)


def _near(one: float, other: float) -> bool:
    """Return whether two numbers are equal, rounded to two decimals or not."""
    if isnan(one) or isnan(other):
        return isnan(one) and isnan(other)
    return isclose(one, other, rel_tol=1e-9, abs_tol=0.006)


# 11b, notice a faulty sensor: recordings are played to a node, and it says what is wrong in them.


@dataclass(frozen=True)
class Replayed:
    """Hold what an answer did with one recording.

    Attributes:
        recording: What is in the recording, in a few words.
        observation: What happened while it was played.
    """

    recording: str
    observation: Observation

    @property
    def said(self) -> Track:
        """Return what the node said, by time in nanoseconds."""
        said = samples_on(self.observation, _FAULT)
        return grouped((one.time_ns, str(one.value)) for one in said)


@dataclass(frozen=True)
class Replays:
    """Hold what an answer did with several recordings.

    Attributes:
        runs: One for each recording; the last one is the first in which an exception was raised.
    """

    runs: tuple[Replayed, ...]


@dataclass(frozen=True)
class Recording:
    """Hold a recording to play.

    Attributes:
        words: What is in it, in a few words.
        samples: Its messages.
        faults: What is broken in it on purpose.
    """

    words: str
    samples: tuple[Sample, ...]
    faults: tuple[Callable[[Sequence[Sample]], Sequence[Sample]], ...] = ()

    @cached_property
    def heard(self) -> tuple[Sample, ...]:
        """Return what a node hears of it, in order."""
        return tuple(
            replace(one, node=_PLAYER, data={"data": as_float32(one.value)})
            for one in bags.inject(_seen_in(self.samples), *self.faults)
        )


def _column(
    values: Iterable[float], topic: str = "/temperature", first: float = 1.0
) -> tuple[Sample, ...]:
    """Return messages on a topic, one a second."""
    return tuple(_sample(first + number, topic, value) for number, value in enumerate(values))


def _walk(seed: int, count: int, start: float = 22.0) -> list[float]:
    """Return a random walk that never stands still, with steps of at most half a degree.

    All are multiples of 1/64: a float32 holds them exactly, and no step is zero.
    """
    dice, found = Random(seed), [start]
    while len(found) < count:
        step = dice.choice((-1, 1)) * dice.randint(1, 32)
        found.append(found[-1] + step / 64)
    return found


def _replay(answer: Answer, recordings: Iterable[Recording]) -> Replays:
    """Play recordings to an answer, each in a session of its own."""
    runs: list[Replayed] = []
    for one in recordings:
        seen = _seen_in(one.samples)
        player = bags.replay(seen, faults=one.faults, name=_PLAYER.strip("/"))
        runs.append(Replayed(one.words, observe(answer, seen.time + 1.0, others=[player])))
        if runs[-1].observation.faults:
            break
    return Replays(tuple(runs))


def _in_all(model: Callable[..., Track]) -> Model:
    return lambda recordings: {
        (number, at): words
        for number, one in enumerate(recordings)
        for at, words in model(one.heard).items()
    }


def _judge_alarms(seen: Replays, recordings: Sequence[Recording]) -> Verdict:
    for run in seen.runs:
        early = before_judging(run.observation)
        if early:
            return early
    runs = [*zip(seen.runs, recordings, strict=True)]
    # Silence is a mistake only in all recordings, and where something was due.
    due = [run for run, _ in runs if run.said]
    due += [run for run, recording in runs if watch_one(recording.heard)]
    words = (diagnose_words(run.observation, _FAULT, WORDS) for run, _ in runs)
    wrong = (
        diagnose_unheard(runs[0][0].observation, _TEMPERATURE)
        or diagnose_unpublished(due[0].observation, _FAULT)
        or next(filter(None, words), None)
        or _diagnose_alarms(runs)
    )
    heard = [one.heard for one in recordings]
    count = sum(len(watch_one(one)) for one in heard)
    return wrong or passed(
        f"{len(runs)} recordings, {sum(map(len, heard))} readings: "
        f"{count} alarms where there was something wrong, and none where all was well."
    )


def _diagnose_alarms(runs: Sequence[tuple[Replayed, Recording]]) -> Diagnosis | None:
    found = ((pair, first_mismatch(pair[0].said, watch_one(pair[1].heard))) for pair in runs)
    first = next(((pair, mismatch) for pair, mismatch in found if mismatch), None)
    if first is None:
        return None
    wrong, mismatch = first
    # With two mistakes, no suspect may reproduce all recordings. Then those count that reproduce
    # the first wrong one and the most others. Silence alone has too many explanations.
    explained = {
        one: [pair for pair in runs if agree(one.model(pair[1].heard), pair[0].said)]
        for one in SUSPECTS
    }
    fit = [
        one
        for one, some in explained.items()
        if wrong in some and any(other.said for other, _ in some)
    ]
    most = max((len(explained[one]) for one in fit), default=0)
    return name_mistake(
        [one for one in fit if len(explained[one]) == most],
        _other_alarm(wrong[1], mismatch),
    )


def _other_alarm(recording: Recording, mismatch: Mismatch) -> Diagnosis:
    """Name what no suspect reproduces by the first moment at which it is not right."""
    at, done, right = mismatch.at, mismatch.done, mismatch.right
    before = f"In the recording of {recording.words}, at {at / NANOSECONDS:g} s, "
    before += f"{_last_readings(recording.heard, at)}, the node said"
    word = (right or done)[0]
    which = f"Which condition of yours decides about {word!r}? Print what it compares."
    if not done:
        return Diagnosis("alert-missing", f"{before} nothing, and {right[0]!r} was due.", which)
    said = f"{before} {' and '.join(map(repr, done))}, and"
    if not right:
        return Diagnosis("alert-too-many", f"{said} nothing was due.", which)
    if set(done) == set(right):
        hint = "One message for each fault that is found is enough."
        return Diagnosis("alert-too-many", f"{said} {right[0]!r} once was due.", hint)
    hint = "Go through your conditions in their order with this reading."
    return Diagnosis("wrong-word", f"{said} {right[0]!r} was due.", hint)


#: Up to four equal readings in a row, steps of a thousandth of a degree, and pairs of equals.
_QUIET = (
    *(21.0, 21.0009765625, 21.0, 21.0009765625, 21.001953125, 21.0, 21.0009765625, 21.0),
    *(21.25, 21.25, 21.5, 21.5, 21.75, 21.75, 22.0, 22.0, 22.25, 22.25, 22.5, 22.5),
    *(22.75, 22.75, 22.75, 22.75, 23.0, 23.0, 23.0, 23.25, 23.25, 23.25, 23.25, 23.0),
)
#: A jump is more than 5 degrees: just enough, not quite, up, down, over a NaN, from 0, and far
#: away. At the end, three equal readings and three others are no hang.
_JUMPS = (
    (22.0, 23.5, 26.0, 22.5, 27.0),
    (22.25, 27.25, 22.25, 27.265625, 27.0, 21.5, 21.25, 26.25, 21.25),
    (33.0, 33.25, nan, 40.0, 39.75, nan, nan, 30.0, 30.25),
    (5.0, 5.25, 11.25, -10.0, -10.25, 0.0, 5.5),
    (22.0, 30.0, 30.0, 30.0, 24.5, 24.5, 24.5),
)
#: Two hangs, at 0 and below it.
_FROST = (1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.25, -2.5, -2.5, -2.5, -2.5, -2.5, -2.25)


def _higher(values: Sequence[float], draw: Draw) -> Sequence[float]:
    """Draw readings that are all as much higher; a jump from exactly 0 stays what it is."""
    degrees = draw.number(0.0, -4.0, 4.0)
    return values if 0.0 in values else [value + degrees for value in values]


def draw_sick(draw: Draw) -> Sequence[Recording]:
    """Draw recordings: where all is well first, then one kind of fault each."""
    whole = draw.whole
    return draw.until(
        lambda: (
            Recording(
                "a cold room that is heated",
                _column(_higher([10 + k / 2 for k in range(45)], draw)),
                (bags.dropouts(0.1, [(18, 23)], seed=whole(1, 1, 10**6)),),
            ),
            Recording("a quiet room", _column(_higher(_QUIET, draw))),
            Recording(
                "a sensor that fails openly",
                _column(_walk(whole(2, 1, 10**6), 25)),
                (
                    bags.with_nan(0, draw.one_of(2.5, 1.5, 3.5)),
                    bags.with_nan(whole(6, 5, 10)),
                    bags.with_nan(whole(14, 12, 20), whole(3, 2, 4)),
                ),
            ),
            Recording(
                "a disturbed line",
                _column(chain(*(_higher(some, draw) for some in draw.shuffled(_JUMPS)))),
            ),
            Recording(
                "a sensor that hangs now and then",
                _column(_walk(whole(4, 1, 10**6), 50)),
                (
                    bags.stuck(0, whole(9, 6, 11)),
                    bags.stuck(whole(20, 16, 21), whole(6, 5, 8)),
                    bags.stuck(whole(32, 31, 34), whole(14, 11, 15)),
                ),
            ),
            Recording("a sensor that hangs in the frost", _column(_FROST, first=whole(1, 1, 9))),
        ),
        lambda recordings: tells_apart(recordings, *models()),
    )


#: Whether a node tells of a hang: from how many readings are equal, how many are a hang, and
#: whether it has told of this one.
_SAYS: dict[str, Callable[[int, int, bool], bool]] = {
    "once": lambda row, equal, told: row >= equal and not told,
    "at five": lambda row, equal, _: row == equal,
    "always": lambda row, equal, _: row >= equal,
    "every fifth": lambda row, equal, _: row > 1 and row % equal == 0,
    "anew": lambda row, equal, _: row > 1 and row % (equal - 1) == 1,  # the fifth counts as first
}


def watch_one(
    heard: Iterable[Sample],
    *,
    hears_nan: bool = True,
    keeps_nan: bool = False,
    start: float | None = None,
    limit: float = 5.0,
    at_limit: bool = False,
    signs: Sequence[int] = (-1, 0, 1),
    compares: str = "before",
    equal: int = 5,
    nearly: float = 0.0,
    says: str = "once",
    resets: bool = True,
    jump_resets: bool = True,
    tells_again: bool = True,
    alone: bool = False,
) -> Track:
    """Return what a node says of one sensor; by default it does what is asked for.

    Args:
        heard: The readings.
        hears_nan: Whether it notices NaN.
        keeps_nan: Whether NaN becomes the reading before.
        start: The reading before the first one.
        limit: What a difference must be above to be a jump.
        at_limit: Whether the limit itself is a jump.
        signs: Of which differences it notices jumps.
        compares: With which reading: the one `before`, the `first`, the last `good` one, with
            `itself`, because it is kept too early, or with the one before unless that is 0 (`not
            zero`).
        equal: How many equal readings are a hang.
        nearly: How far readings that it takes for equal may be apart.
        says: When it tells of a hang, a key of `_SAYS`.
        resets: Whether it counts anew after a reading that differs.
        jump_resets: Whether it does so after a jump, too.
        tells_again: Whether it tells of another hang.
        alone: Whether the first reading is equal to itself, and so a hang.
    """
    said: dict[int, tuple[str, ...]] = {}
    last = base = start
    row, told = 1, False
    for one in heard:
        value = float(one.value)
        if isnan(value):
            if keeps_nan:
                last, base, row = nan, nan, 1
            said |= {one.time_ns: ("nan",)} if hears_nan else {}
            continue
        if compares == "itself":
            last = base = value
        off = 0.0 if base is None or (compares == "not zero" and base == 0) else value - base
        far = abs(off) > limit or (at_limit and abs(off) == limit)
        jumps = far and (off > 0) - (off < 0) in signs
        hangs = alone and last is None
        if last is not None and (jump_resets or not jumps):
            if abs(value - last) <= nearly:
                row += 1
            elif resets:
                row, told = 1, told and not tells_again
            hangs = _SAYS[says](row, equal, told)
            told = told or hangs
        last = value
        if base is None or compares in ("before", "not zero") or (compares == "good" and not jumps):
            base = value
        if jumps or hangs:
            said[one.time_ns] = ("jump" if jumps else "stuck",)
    return said


_NAN = (
    "NaN is neither above nor below nor equal to anything, not even to itself. The page shows a "
    "function that asks for it."
)
_NAN_KEPT = (
    "After a NaN, the node has stored NaN, or nothing: no reading is far from that, or equal to "
    "it. Which reading should it store instead?"
)
_FIRST = "What is the very first reading compared with? There's no reading before it."
_BOTH = "A jump may go up or down. What is the sign of your difference?"
_JUMP = "A difference of more than 5 degrees is a jump: 6 degrees is one, but exactly 5 isn't."
_MEMORY = "What does your node remember of the reading before, and when does it change that?"
_COUNT = "Count on paper: which is the fifth equal reading in a row, if the first one is the first?"
_AGAIN = "Report it once. Report it again only after the reading has changed."
_MOVED = "What has to happen to the stored state when the reading changes again?"
_QUIETLY = "A sensor in a quiet room moves very little, and that is no hang: compare exactly."
SUSPECTS = variants(watch_one, (
    ("nan-compared", _NAN, {"hears_nan": False, "keeps_nan": True}, {"hears_nan": False}),
    ("nan-kept", _NAN_KEPT, {"keeps_nan": True}, {"keeps_nan": True, "jump_resets": False}),
    ("alarm-at-start", _FIRST, *({"start": one} for one in (0.0, 20.0, 22.0, 25.0))),
    ("alarm-at-start", _FIRST, {"alone": True}, {"alone": True, "says": "always"}),
    ("boundary", _JUMP, {"at_limit": True}),
    ("other-limits", _JUMP, *({"limit": one} for one in (0.5, 1, 2, 3, 4, 6, 7, 8, 10, 15))),
    ("one-direction", _BOTH, {"signs": (-1,)}, {"signs": (1,)}),
    ("other-reading", _MEMORY, *({"compares": one} for one in ("first", "good", "itself"))),
    ("zero-is-false", f"Your node takes a reading of 0 for no reading. {ZERO_IS_FALSE}",
     {"compares": "not zero"}),
    ("counted-wrong", _COUNT, *({"equal": one} for one in (4, 6, 3, 2, 7, 10))),
    ("status-repeated", _AGAIN, *({"says": one} for one in ("always", "every fifth", "anew"))),
    ("never-reset", _MOVED, {"jump_resets": False}, {"resets": False}, {"tells_again": False}),
    ("nearly-equal", _QUIETLY, *({"nearly": one} for one in (0.001, 0.005, 0.01, 0.05, 0.1))),
    ("status-repeated", _AGAIN, *({"says": "always", "equal": one} for one in (4, 6))),
    ("never-reset", _MOVED, *({"resets": False, "says": one} for one in ("always", "at five"))),
))  # fmt: skip


def _last_readings(heard: Sequence[Sample], at: int) -> str:
    if at not in {one.time_ns for one in heard}:
        return "when no reading came"
    values = [one.value for one in heard if one.time_ns <= at]
    more = "..., " if len(values) > 6 else ""
    return f"after {more}{', '.join(f'{value:g}' for value in values[-6:])}"


def models() -> tuple[Model, tuple[Suspect, ...]]:
    """Return the right model and the suspects as they hear one recording after the other."""
    return _in_all(watch_one), tuple(replace(one, model=_in_all(one.model)) for one in SUSPECTS)


# 11c, test a watchdog: readings for which each of three faulty ones does what a right one does not.

#: How many readings a test may have.
MOST = 12
#: What a `Float32` can hold.
_LARGEST = 3.4e38


def _first(done: Track, right: Track) -> int:
    """Return the number of the first reading at which a faulty watchdog shows, from 1."""
    mismatch = first_mismatch(done, right)
    return round(mismatch.at / NANOSECONDS) if mismatch else 0


def _words(said: Track) -> str:
    """Return what a watchdog says, with the number of each reading."""
    each = [f"{word!r} at reading {round(at / NANOSECONDS)}" for at, (word, *_) in said.items()]
    return " and ".join([", ".join(each[:-1]), each[-1]] if each[1:] else each) or "nothing"


def _diagnose_readings(seen: Report) -> Diagnosis | None:
    """Say why a result is no test, or None if it is one."""
    values = seen.value
    if not isinstance(values, list) or not values:
        what = "an empty list" if values == [] else f"a {seen.type_name}"
        evidence = f"The function returned {what}."
        return Diagnosis("no-readings", evidence, "Return a list of readings: `[22.0, 22.5, ...]`.")
    odd = [one for one in values if isinstance(one, bool) or not isinstance(one, int | float)]
    odd += [one for one in values if one not in odd and abs(one) > _LARGEST]
    if odd:
        hint = "Each reading is a number that a `Float32` can hold, or `math.nan`."
        return Diagnosis("no-reading", f"The list contains {odd[0]!r}.", hint)
    if len(values) > MOST:
        hint = "A short test is easier to read. Which readings do you need for which watchdog?"
        return Diagnosis("too-many-readings", f"The list has {len(values)} readings.", hint)
    return None


def _missed_jump(values: Sequence[float]) -> tuple[str, str]:
    """Return why a test does not catch a watchdog that looks for jumps upwards only."""
    steps = [later - one for one, later in pairwise(one for one in values if not isnan(one))]
    if any(step == -5 for step in steps):
        return "test-at-limit", "A step of exactly 5 degrees is no jump yet. Let it be larger."
    if any(step > 5 for step in steps):
        hint = "All the jumps in your list go up. What does this watchdog do with another one?"
        return "test-one-direction", hint
    return "test-lacks-case", "Which of your readings is a jump that this watchdog doesn't notice?"


def _missed_nan(values: Sequence[float]) -> tuple[str, str]:
    """Return why a test does not catch a watchdog that keeps NaN."""
    if not any(map(isnan, values)):
        return "test-lacks-case", "Only a list that contains `math.nan` can catch this watchdog."
    first = next((at for at, one in enumerate(values) if not isnan(one)), len(values))
    if not any(map(isnan, values[first:])):
        hint = (
            "There is no number before your NaN. With what would a correct watchdog compare the "
            "reading after it?"
        )
        return "test-no-effect", hint
    hint = (
        "After NaN, this watchdog can't compare the next reading with anything. What should that "
        "reading be, so that a correct watchdog reports it?"
    )
    return "test-no-effect", hint


def _missed_repeat(values: Sequence[float]) -> tuple[str, str]:
    """Return why a test does not catch a watchdog that repeats itself."""
    if ("stuck",) in watch_one(_column(values)).values():
        hint = "The list ends too early, or changes too early. At which equal reading does it show?"
        return "test-at-limit", hint
    return "test-lacks-case", "When is `stuck` due at all? Your list doesn't get that far."


class FaultyWatchdog(NamedTuple):
    """Hold a watchdog with one fault.

    Attributes:
        fault: What it does wrong, a verb and more.
        model: What it says of readings.
        diagnose_miss: Returns why readings do not show the fault: the mistake's id and a hint.
    """

    fault: str
    model: Callable[..., Track]
    diagnose_miss: Callable[[Sequence[float]], tuple[str, str]]


#: The faulty watchdogs of the page.
FAULTY = {
    "A": FaultyWatchdog("reports only jumps upwards", partial(watch_one, signs=(1,)), _missed_jump),
    "B": FaultyWatchdog(
        "keeps NaN as the last number", partial(watch_one, keeps_nan=True), _missed_nan
    ),
    "C": FaultyWatchdog(
        "repeats `stuck` at each further equal reading",
        partial(watch_one, says="always"),
        _missed_repeat,
    ),
}


def _judge_test(seen: Report) -> Verdict:
    wrong = before_reading(seen, 'check("11c", readings)') or _diagnose_readings(seen)
    if wrong:
        return wrong
    values = [as_float32(one) for one in seen.value]
    heard = _column(values)
    right = watch_one(heard)
    for name, (fault, model, diagnose_miss) in FAULTY.items():
        if agree(model(heard), right):
            evidence = (
                f"A correct watchdog publishes {_words(right)} for your readings, and so does "
                f"watchdog {name}, which {fault}."
            )
            mistake, hint = diagnose_miss(values)
            return Diagnosis(mistake, evidence, hint)
    shown = (f"{name} at reading {_first(one.model(heard), right)}" for name, one in FAULTY.items())
    return passed(
        f"{len(values)} readings, and each of the three watchdogs fails your test: "
        f"{', '.join(shown)}."
    )


EXERCISES: tuple[Exercise[Any], ...] = (
    Exercise("11a", _look_into_bags, _judge_bag_reports, "look into a bag", 2, (
        "Each message has a time in seconds and a value. Make lists of them first.",
        "zip(readings, readings[1:]) gives each message together with the next one.",
        "Test for NaN with the function that page 11 shows, and keep only the numbers in a "
        "list for the mean.",
    ), draw=draw_readings),
    Exercise("11b", _replay, _judge_alarms, "notice a faulty sensor", 3, (
        "Test for NaN first. If the reading is NaN, leave everything else for the next "
        "reading.",
        "A jump is a difference, and its sign does not matter: abs takes it away. Before the "
        "first reading there is nothing to compare with.",
        "Count how many equal readings there were in a row. When does the count start again? "
        "And at exactly which count do you publish?",
    ), draw=draw_sick),
    Exercise("11c", report, _judge_test, "test a watchdog", 3, (
        "Take one watchdog at a time. What does a correct watchdog do that this one doesn't, "
        "and for which readings?",
        "For B: which reading after NaN would a correct watchdog report?",
        "For C: how many equal readings does it take until a correct watchdog has said "
        "`stuck`? What does it say at the next one?",
    )),
)  # fmt: skip
