"""`results.json`: all that is known of a class, for programs; docs/results.schema.json is its form.

The same gradebook gives the same bytes. There is no time in it, neither of day nor of work, so a
run that was interrupted and went on gives the file of a run that was not.
"""

from __future__ import annotations

import json
from dataclasses import fields
from math import isfinite
from typing import Any

from rosbeat.grading.marks import Gradebook, Mark
from rosbeat.record_json import parse, record, refusal, write

FORMAT = "rosbeat results"
#: Raised by one whenever a field is added, taken away or given another meaning.
VERSION = 3
#: Fields of a mark that differ from run to run.
UNSTEADY = ("seconds",)
_POINTS = ("points", "out_of", "judged")
_DIGITS = 6


def to_results(gradebook: Gradebook) -> str:
    """Write a gradebook as JSON, in ASCII, learners sorted.

    Args:
        gradebook: A class.
    """
    document = json.loads(write(gradebook, {"format": FORMAT, "version": VERSION}))
    document["learners"].sort(key=lambda graded: graded["learner"])
    for mark in _marks(document):
        for name in UNSTEADY:
            del mark[name]
        for name in _POINTS:  # 2 and 2.0 are one number, and so are 0 and -0
            mark[name] = round(float(mark[name]), _DIGITS) + 0.0
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


def from_results(text: str) -> Gradebook:
    """Read what `to_results` wrote; what it leaves out is 0.

    Args:
        text: The file.

    Raises:
        RecordError: If it is not JSON, of another format or version, or if any field is missing,
            unknown or of another type.
    """
    body = parse(text, "file of results", FORMAT, VERSION)
    usual = {one.name: one.default for one in fields(Mark) if one.name in UNSTEADY}
    try:
        for mark in _marks(body):
            mark.update(usual, **{name: _float(mark[name]) for name in _POINTS})
    except (AttributeError, KeyError, TypeError, ValueError, OverflowError) as error:
        means = f"The marks of a learner are not what they should be: {error}."
        raise refusal("It is no list of marks.", means) from error
    gradebook: Gradebook = record(Gradebook, body, "results")
    return gradebook


def _marks(document: dict[str, Any]) -> list[dict[str, Any]]:
    return [mark for graded in document["learners"] for mark in graded["marks"]]


def _float(value: Any) -> Any:  # noqa: ANN401 - unchecked: the next reader complains
    if type(value) is not int and type(value) is not float:
        return value
    if not isfinite(value):
        raise ValueError("there are endless points")
    return float(value)
