"""What the greenhouse has to do, what each requirement is worth, and the numbers in them.

It is read from JSON. `ROSBEAT_RUBRIC` names another file than the course's own.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib.resources import files
from math import isfinite
from pathlib import Path
from typing import Any

from rosbeat.errors import ExerciseError

SETTING = "ROSBEAT_RUBRIC"
#: The requirements that can be judged.
KNOWN = tuple(f"R{number}" for number in range(1, 12))
#: What the points of all requirements add up to: the points of the exercise.
TOTAL = 20
#: Names of the numbers; those in seconds are whole.
NUMBERS = (
    *("open_above", "close_below", "dry_below", "temperature_min", "temperature_max"),
    *("pump_seconds", "rest_seconds", "silent_seconds", "report_seconds", "react_seconds"),
)
_OWN = "rubrics/greenhouse.json"
_WORDS = {"id": str, "text": str, "points": int, "required": bool}
_FIELDS = "an id and a text in quotes, points (a whole number) and required (true or false)"


@dataclass(frozen=True)
class Requirement:
    """One thing that a greenhouse has to do.

    Attributes:
        id: Its name, such as `R1`.
        text: One sentence, numbers filled in.
        points: What it is worth.
        required: Whether the exercise is passed only with it.
    """

    id: str
    text: str
    points: int
    required: bool


@dataclass(frozen=True)
class Rubric:
    """All that a greenhouse has to do.

    Attributes:
        numbers: The limits and times that stand in the requirements, by name.
        requirements: The requirements, in order.
    """

    numbers: dict[str, float]
    requirements: tuple[Requirement, ...]


def the_rubric() -> Rubric:
    """Read the rubric: the file that `ROSBEAT_RUBRIC` names, or the course's own.

    Raises:
        ExerciseError: If the file cannot be read, or is no rubric.
    """
    chosen = os.environ.get(SETTING, "")
    if not chosen:
        text = files("rosbeat.exercises").joinpath(_OWN).read_text(encoding="utf-8")
        return parsed(text, _OWN)
    try:
        text = Path(chosen).expanduser().read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise ExerciseError(
            f"The rubric {chosen} cannot be read: {error}.",
            f"The variable {SETTING} names a file that is not there, or holds no text.",
            f"Correct the path, or unset {SETTING}: then the course's own rubric counts.",
        ) from None
    return parsed(text, chosen)


def rubric_of(numbers: Mapping[str, float]) -> Rubric:
    """Return the rubric, if it has the numbers that a trial was made with.

    Args:
        numbers: Those of the trial; what it says of itself is not believed.

    Raises:
        ExerciseError: If they are others, or the rubric cannot be used.
    """
    rubric = the_rubric()
    if dict(numbers) != rubric.numbers:
        raise ExerciseError(
            "This greenhouse was run in the weather of another rubric.",
            "Its numbers differ from those that count now, so what it did says nothing of them.",
            "Run the check again, or grade the answer anew.",
        )
    return rubric


def parsed(text: str, name: str) -> Rubric:
    """Make a rubric of the text of a file.

    Args:
        text: JSON, an object with `numbers` and `requirements`.
        name: The file's name, for errors.

    Raises:
        ExerciseError: If it is no rubric that a check could use; all reasons are told.
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise _refused(name, f"it is not JSON, {error}") from None
    wrong = list(_shape(data)) or [*_numbers(data["numbers"]), *_rows(data["requirements"])]
    wrong = wrong or [*_spans(data["numbers"]), *_texts(data)]
    if wrong:
        raise _refused(name, "; ".join(wrong))
    numbers = {key: float(value) for key, value in data["numbers"].items()}
    rows = [{**row, "text": _filled(row["text"], numbers)} for row in data["requirements"]]
    return Rubric(numbers, tuple(Requirement(**row) for row in rows))


# What may be wrong with it; each yields a few words for each thing.


def _shape(data: object) -> Iterator[str]:
    if not isinstance(data, dict) or set(data) != {"numbers", "requirements"}:
        yield "it should hold `numbers` and `requirements`, and nothing else"
    elif not isinstance(data["numbers"], dict) or not isinstance(data["requirements"], list):
        yield "`numbers` should be an object, and `requirements` a list"


def _numbers(found: dict[str, Any]) -> Iterator[str]:
    for name in sorted(set(NUMBERS) ^ set(found)):
        yield f"`{name}` is missing" if name in NUMBERS else f"there is no number `{name}`"
    for name, value in found.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
            yield f"`{name}` is {value!r} and should be a number"
        elif name.endswith("_seconds") and (value != int(value) or not 1 <= value <= 120):
            yield f"`{name}` is {value!r} and should be a whole number from 1 to 120"


def _rows(rows: list[Any]) -> Iterator[str]:
    for number, row in enumerate(rows, 1):
        kinds = {key: type(value) for key, value in row.items()} if isinstance(row, dict) else {}
        if kinds != _WORDS:
            yield f"requirement {number} should have {_FIELDS}, and nothing else"
            return
    ids = [row["id"] for row in rows]
    strange = sorted(set(ids) - set(KNOWN))
    if strange or len(set(ids)) != len(ids):
        yield f"each of {', '.join(KNOWN)} may stand there once, and nothing else"
    points = [row["points"] for row in rows]
    if sum(points) != TOTAL or min(points, default=0) < 0:
        yield f"the points add up to {sum(points)}; they should make {TOTAL}, none below 0"
    if not any(row["required"] for row in rows):
        yield "nothing is required"


def _spans(n: dict[str, float]) -> Iterator[str]:
    """What the weather of the trials needs to tell a right answer from a wrong one."""
    rules = {
        "`close_below` has to be at least 1 below `open_above`": n["close_below"] + 1
        <= n["open_above"],
        "`temperature_min` has to be at least 10 below `close_below`": n["temperature_min"] + 10
        <= n["close_below"],
        "`temperature_max` has to be at least 10 above `open_above`": n["open_above"] + 10
        <= n["temperature_max"],
        "`dry_below` has to be from 20 to 70": 20 <= n["dry_below"] <= 70,
        "`pump_seconds` has to be at least 3 above `react_seconds`": n["react_seconds"] + 3
        <= n["pump_seconds"],
        "`silent_seconds` has to be at least 3 above `react_seconds`": n["react_seconds"] + 3
        <= n["silent_seconds"],
        "`rest_seconds` has to be at least 5 above `react_seconds`": n["react_seconds"] + 5
        <= n["rest_seconds"],
        "`report_seconds` has to be from 5 to 30": 5 <= n["report_seconds"] <= 30,
        "`react_seconds` has to be at most 5": n["react_seconds"] <= 5,
    }
    yield from (text for text, holds in rules.items() if not holds)


def _texts(data: dict[str, Any]) -> Iterator[str]:
    for row in data["requirements"]:
        try:
            _filled(row["text"], data["numbers"])
        except (ValueError, LookupError, AttributeError):
            yield f"the text of {row['id']} has a brace that stands for no number"


def _filled(text: str, numbers: dict[str, float]) -> str:
    return text.format(**{name: f"{value:g}" for name, value in numbers.items()})


def _refused(name: str, why: str) -> ExerciseError:
    return ExerciseError(
        f"{name} is no rubric of the greenhouse: {why}.",
        "A check needs to know what is required, what it is worth, and which numbers count.",
        f"Start from a copy of the course's own, {_OWN} beside the exercises, and change little.",
    )
