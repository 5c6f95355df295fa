"""What a function found in several recordings: judged, with what it should have found.

Pure functions. The messages are made up in `rosbeat.exercises.bag_report_runs`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import isclose, isnan
from statistics import median

from rosbeat.diagnosis.mistakes import Diagnosis
from rosbeat.exercises.bag_report_runs import RECORDINGS, BagReports, Readings, words_beside
from rosbeat.exercises.exercise import failed, failed_by, passed
from rosbeat.exercises.model import before_reading
from rosbeat.exercises.scenarios import Report
from rosbeat.records import NANOSECONDS, Outcome

KEYS = ("messages", "gap", "mean")
#: How far a number may be off: somebody may have rounded it to two decimals.
_ROUNDING = 0.006
_EXAMPLE = 'check("11a", look_into)'


# What there is to find, and what somebody may have found instead.


def _gaps(readings: Readings) -> list[float]:
    return [later - earlier for (earlier, _), (later, _) in pairwise(readings)]


def _numbers(readings: Readings) -> list[float]:
    return [value for _, value in readings if not isnan(value)]


def _good(readings: Readings) -> Readings:
    return [(at, value) for at, value in readings if not isnan(value)]


def _duration(rows: Sequence[tuple[float, object]]) -> float:
    times = [at for at, _ in rows]
    return max(times) - min(times)


def _messages(readings: Readings) -> float:
    return len(readings)


def _gap(readings: Readings) -> float:
    return max(_gaps(readings))


def _mean(readings: Readings) -> float:
    return sum(_numbers(readings)) / len(_numbers(readings))


ASKED: dict[str, Callable[[Readings], float]] = {
    "messages": _messages,
    "gap": _gap,
    "mean": _mean,
}
_TOPIC = "The bag has other topics, too. How many messages has this one?"
_EVERY = "A reading that is no number was a message all the same."
_FENCE = "Between five messages there are four gaps. Which of the two numbers is asked for?"
_SECONDS = "The record of a message has its time twice, in two units. In which one is this?"
_WHICH = "A gap lies between two messages that follow each other; the longest of them is asked for."
_NAN = "A sum with NaN in it is NaN. Leave out what is no number before you add."
_SHARE = "What is left out of the sum is left out of the count as well."
_PLAIN = "The sum of the numbers, divided by how many they are."

#: For each number: other ways to get one, with the mistake and a hint.
OTHERS: dict[str, tuple[tuple[str, str, Callable[[Readings], float]], ...]] = {
    "messages": (
        ("all-topics", _TOPIC, lambda r: len(r) + len(words_beside(r))),
        ("all-topics", _TOPIC, lambda r: len(words_beside(r))),
        ("nan-left-out", _EVERY, lambda r: len(_good(r))),
        ("counted-wrong", _FENCE, lambda r: len(r) - 1),
        ("counted-wrong", _FENCE, lambda r: len(r) + 1),
    ),
    "gap": (
        ("wrong-unit", _SECONDS, lambda r: _gap(r) * NANOSECONDS),
        ("wrong-unit", _SECONDS, lambda r: _gap(r) * 1000),
        ("nan-left-out", _EVERY, lambda r: max(_gaps(_good(r)))),
        ("other-gap", _WHICH, lambda r: min(_gaps(r))),
        ("other-gap", _WHICH, lambda r: _gaps(r)[0]),
        ("other-gap", _WHICH, lambda r: _gaps(r)[-1]),
        ("other-gap", _WHICH, lambda r: r[-1][0] - r[0][0]),
        ("other-gap", _WHICH, lambda r: _duration([*r, *words_beside(r)])),
        ("other-gap", _WHICH, lambda r: max(at for at, _ in [*r, *words_beside(r)])),
        ("other-gap", _WHICH, lambda r: sum(_gaps(r)) / len(_gaps(r))),
        ("other-gap", _WHICH, lambda r: median(_gaps(r))),
        ("other-gap", _WHICH, lambda r: max(_gap(r), r[0][0])),
        ("other-gap", _WHICH, lambda r: -_gap(r)),
        ("other-gap", _WHICH, lambda r: max(abs(b - a) for (_, a), (_, b) in pairwise(_good(r)))),
    ),
    "mean": (
        ("nan-spreads", _NAN, lambda r: sum(value for _, value in r) / len(r)),
        ("wrong-share", _SHARE, lambda r: sum(_numbers(r)) / len(r)),
        ("other-mean", _PLAIN, lambda r: median(_numbers(r))),
        ("other-mean", _PLAIN, lambda r: sum(_numbers(r))),
        ("other-mean", _PLAIN, lambda r: sum(_numbers(r)) // len(_numbers(r))),
        ("other-mean", _PLAIN, lambda r: round(_mean(r))),
        ("other-mean", _PLAIN, lambda r: (max(_numbers(r)) + min(_numbers(r))) / 2),
        ("counted-wrong", _FENCE, lambda r: sum(_numbers(r)) / max(1, len(_numbers(r)) - 1)),
    ),
}


# The judge.

_RAISED = {
    "AttributeError": (
        "wrong-attribute",
        "Print one of the messages: it shows the names of all that it has.",
    ),
    "BagError": (
        "topic-misspelled",
        "Print the bag: it shows its topics. Names match letter by letter.",
    ),
    "ZeroDivisionError": (
        "division-by-zero",
        "By what do you divide, and when is that 0?",
    ),
    "IndexError": (
        "index-error",
        "Some bags hold only a few messages. How long is your list there?",
    ),
}


#: What some TypeErrors say, and what they mean in a function that is given a bag.
_MISTYPED = (
    (
        "argument: 'topic'",
        "argument-missing",
        "A bag may hold several topics. How does the cell above ask for one of them?",
    ),
    (
        "0 positional arguments",
        "argument-missing",
        "The check hands a bag over. Does the first line of your function have a name for it?",
    ),
    (
        "'Bag' object is not subscriptable",
        "wrong-attribute",
        "A bag gives its messages back when a method is called. Which one does the page show?",
    ),
    (
        "Sample object",
        "message-for-value",
        "Each message is one object, and no pair. Its time and its value have names of their own.",
    ),
    (
        " and 'dict'",
        "message-for-value",
        "`data` is the whole message, field by field. Under which name is the number alone?",
    ),
    (
        "'Sample'",
        "message-for-value",
        "That is a whole message with its time. Under which name does it hold the number?",
    ),
)


def judge_bag_reports(exercise: str, seen: BagReports) -> Outcome:
    """Judge what a function found in the recordings.

    Args:
        exercise: The exercise's id.
        seen: What it gave back.
    """
    for one in seen.reports:
        early = _raised(exercise, one) or before_reading(exercise, one, _EXAMPLE)
        if early:
            return early
    wrong = _shape(seen) or next(filter(None, (_number(seen, key) for key in KEYS)), None)
    if wrong:
        return failed_by(exercise, wrong)
    return passed(
        exercise,
        f"{len(RECORDINGS)} recordings that this page has not seen: all three numbers are right "
        "in each.",
    )


def _raised(exercise: str, one: Report) -> Outcome | None:
    """What some exceptions mean in a function that looks into a bag."""
    kind, _, text = one.problem.partition(": ")
    mistyped = next((row[1:] for row in _MISTYPED if kind == "TypeError" and row[0] in text), None)
    if kind not in _RAISED and not mistyped:
        return None
    mistake, hint = mistyped or _RAISED[kind]
    said = text.splitlines()[0].rstrip(".") if text else "without a word"
    return failed(exercise, f"The function raised {kind}: {said}.", hint, mistake)


def _shape(seen: BagReports) -> Diagnosis | None:
    for one in seen.reports:
        if not isinstance(one.value, dict):
            return Diagnosis(
                "no-dict",
                f"The function gave back a {one.type_name}.",
                "Give back a dict in braces, as the cell shows, with a name before each number.",
            )
        missing = [key for key in KEYS if key not in one.value]
        if missing:
            return Diagnosis(
                "key-missing",
                f"The result has {', '.join(map(repr, one.value)) or 'no names'}, and no "
                f"{missing[0]!r}.",
                f"The three names are {', '.join(KEYS)}, letter by letter.",
            )
    return None


def _number(seen: BagReports, key: str) -> Diagnosis | None:
    found = [one.value[key] for one in seen.reports]
    odd = next((one for one in found if isinstance(one, bool) or not isinstance(one, int | float)),
               None)  # fmt: skip
    if odd is not None or None in found:
        hint = "Give back the number itself, not a list of them and no text."
        return Diagnosis("no-number", f"For {key!r} the function gave back {odd!r}.", hint)
    wanted = [ASKED[key](readings) for readings in RECORDINGS]
    if _all_near(found, wanted):
        return None
    return _wrong(key, found, wanted)


def _wrong(key: str, found: list[float], wanted: list[float]) -> Diagnosis:
    at = next(n for n, pair in enumerate(zip(found, wanted, strict=True)) if not _near(*pair))
    evidence = (
        f"In a recording with the readings {_listed(RECORDINGS[at])}, {key!r} is "
        f"{wanted[at]:g}, and the function found {found[at]:g}."
    )
    if all(one == found[0] for one in found):
        hint = "The result is the same for every bag. Calculate it from the messages of this one."
        return Diagnosis("fixed-answer", evidence, hint)
    for mistake, hint, other in OTHERS[key]:
        if _all_near(found, [other(readings) for readings in RECORDINGS]):
            return Diagnosis(mistake, evidence, hint)
    return Diagnosis("wrong-values", evidence, "Print the list from which you calculate it.")


def _all_near(found: Sequence[float], wanted: Sequence[float]) -> bool:
    return all(_near(one, other) for one, other in zip(found, wanted, strict=True))


def _near(one: float, other: float) -> bool:
    if isnan(one) or isnan(other):
        return isnan(one) and isnan(other)
    return isclose(one, other, rel_tol=1e-9, abs_tol=_ROUNDING)


def _listed(readings: Readings) -> str:
    return ", ".join(f"{value:g} at {at:g} s" for at, value in readings)
