"""The diagnoses that a learner's function gave back: whether they can be read, and what they say.

A result is a dict from a patient's number to a pair (diagnosis, place), or to a list of such pairs.
`"ward"` may be a key too: the number of the ward, if it is not the page's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from rosbeat.exercises.exercise import BLANK, failed
from rosbeat.records import Outcome

#: The ward of the page.
WARD = 7
_KEY = "ward"
_FORM = '`1: ("callback-blocks", "/a_node")`'


@dataclass(frozen=True)
class Claim:
    """One diagnosis.

    Attributes:
        mistake: What is said to be the matter.
        place: Where.
    """

    mistake: str
    place: str


def ward_of(value: Any) -> int | None:  # noqa: ANN401 - plain data
    """The number of the ward; None if it is none."""
    number = value.get(_KEY, WARD) if isinstance(value, dict) else None
    return number if type(number) is int and 0 <= number < 2**32 else None


def shape(exercise: str, value: Any, patients: Sequence[int]) -> Outcome | None:  # noqa: ANN401
    """What is wrong with the form of a result; None if it can be read.

    Args:
        exercise: The exercise's id.
        value: The result, as JSON holds it: keys of dicts are texts.
        patients: Numbers of the patients that are asked for.
    """
    if not isinstance(value, dict):
        kind = type(value).__name__
        return _refused(exercise, f"The function gave back a {kind}, and no dict.")
    if ward_of(value) is None:
        return _refused(exercise, f"There is no ward {value[_KEY]!r}: it is a whole number.")
    for key, one in value.items():
        if key != _KEY and key not in map(str, patients):
            asked = f"Patients {patients[0]} to {patients[-1]} are asked for"
            return _refused(exercise, f"The result has a key {key}. {asked}.")
        if key != _KEY and _pairs(one) is None:
            return _refused(exercise, f"What stands at patient {key} is no pair of two texts.")
    return None


def claims_of(value: dict[str, Any], number: int) -> list[Claim]:
    """The diagnoses of one patient; blanks and empty texts are none."""
    pairs = _pairs(value.get(str(number), [])) or []
    return [Claim(what, where) for what, where in pairs if BLANK not in (what, where) and what]


def _pairs(one: Any) -> list[tuple[str, str]] | None:  # noqa: ANN401
    """One pair, or a list of pairs, as a list of pairs; None if it is neither."""
    if not isinstance(one, list):
        return None
    if len(one) == 2 and all(isinstance(part, str) for part in one):
        return [(one[0].strip(), one[1].strip())]
    found = []
    for pair in one:
        if not (isinstance(pair, list) and len(pair) == 2):
            return None
        if not all(isinstance(part, str) for part in pair):
            return None
        found.append((pair[0].strip(), pair[1].strip()))
    return found


def _refused(exercise: str, evidence: str) -> Outcome:
    hint = f"Give back a dict: the patient's number, then diagnosis and place, as in {_FORM}."
    return failed(exercise, evidence, hint, "no-diagnoses")
