"""What must hold of what `check` says of the answers to exercises about nodes."""

import re
from collections.abc import Iterable, Mapping
from functools import cache
from unittest.mock import patch

from bank.answer import Answer
from bank.running import outcome_of
from rosbeat.diagnosis.mistakes import MISTAKES, UNKNOWN
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import Outcome
from rosbeat.ros.scenario import observe

#: Of the answers with one mistake, how many have to be told its name.
SHARE_NAMED = 0.95

#: What a learner has to find, in pieces that no hint may hold; spaces do not count.
SECRETS = {
    "00a": ('String,"weather"',),
    "00b": ('String,"sports"', "create_timer(2"),
    "03a": ('Float32,"humidity"', '"humidity",5', "create_timer(0.5", "(0.5,"),
    "03b": ("uniform(-0.3,0.3)", "max(18", "min(28"),
    "03c": ("create_timer(0.25", "uniform(-0.5,0.5)", "max(10.2", "min(28"),
    "04a": ("temp>8", "temp<2", "if2.0<="),
    "04b": ("msg.data>26", "msg.data<20", 'String,"alert"'),
    "04c": ("[-5:]", "maxlen=5", "value<25", "value>21", "/len("),
}

#: Seconds after which an answer that never returns is broken off here; a page has more patience.
_SHORT = 2.0


@cache
def outcome(answer: Answer) -> Outcome:
    """What `check` says of an answer."""
    assert observe.__kwdefaults__ is not None
    blocks = {"callback-blocks", "constructor-blocks"} & set(answer.mistakes)
    patience = _SHORT if blocks else observe.__kwdefaults__["deadline"]
    with patch.dict(observe.__kwdefaults__, deadline=patience):
        return outcome_of(answer.exercise, answer.text, answer.subject)


def is_single(answer: Answer) -> bool:
    """Whether there is one mistake in an answer, and one name for it."""
    return len(answer.mistakes) == 1


def assert_told(answer: Answer, secrets: Mapping[str, tuple[str, ...]] = SECRETS) -> None:
    """Check the outcome of an answer, and the mistake that is named.

    One in twenty may be new to the judge (`assert_named`); a wrong name is never right.
    """
    found = outcome(answer)
    assert found.status == answer.status, found
    unnamed = (UNKNOWN,) if is_single(answer) else ()
    assert found.mistake in (answer.mistakes + unnamed or ("",)), found
    assert found.evidence
    assert bool(found.hint) == (found.status == "failed"), found
    assert not leaks(answer.exercise, found.hint, secrets), found


def leaks(exercise: str, hint: str, secrets: Mapping[str, tuple[str, ...]] = SECRETS) -> list[str]:
    """The pieces of the answer that a hint gives away."""
    text = re.sub(r"\s", "", hint)
    return [secret for secret in secrets[exercise] if secret in text]


def assert_named(answers: Iterable[Answer]) -> None:
    """Check that nearly all answers with one mistake are told its name."""
    single = [answer for answer in answers if is_single(answer)]
    unnamed = [answer.id for answer in single if outcome(answer).mistake == UNKNOWN]
    assert len(unnamed) <= (1 - SHARE_NAMED) * len(single), unnamed


def assert_sorted_out(answers: Iterable[Answer]) -> None:
    """Check that no right answer is refused and no wrong one accepted."""
    assert [one.id for one in answers if outcome(one).status != one.status] == []


def assert_wide(
    page: str, answers: Iterable[Answer], secrets: Mapping[str, tuple[str, ...]]
) -> None:
    """Check that each exercise of a page beyond 06 has right answers, wrong ones and pairs."""
    answers = list(answers)
    mine = [name for name in EXERCISES if name.startswith(page)]
    assert sorted({one.exercise for one in answers}) == mine == sorted(secrets)
    assert len({one.id for one in answers}) == len(answers)
    assert {name for one in answers for name in one.mistakes} - {UNKNOWN} <= set(MISTAKES)
    for exercise in mine:
        here = [one for one in answers if one.exercise == exercise]
        counts = (
            sum(one.status == "passed" for one in here),
            sum(len(one.mistakes) == 1 for one in here),
            sum(len(one.mistakes) > 1 for one in here),
        )
        wanted = (6, 12, 3)
        assert all(count >= least for count, least in zip(counts, wanted, strict=True)), counts
