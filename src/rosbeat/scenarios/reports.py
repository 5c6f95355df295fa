"""A function whose result is the answer: called once, and what it gave back as plain data."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

from rosbeat.ros.isolation import Deadline

#: Seconds of wall time that the function may take.
SECONDS = 2.0
#: Characters of JSON that a result may have.
MOST = 20_000


@dataclass(frozen=True)
class Report:
    """What a function gave back.

    Attributes:
        result: Its result as a text of JSON, where tuples are lists and keys of dicts are texts;
            empty if it gave back something else, or raised.
        problem: The exception that it raised, or why its result is no plain data; or empty.
        type_name: The type of its result.
    """

    result: str
    problem: str = ""
    type_name: str = ""

    @property
    def value(self) -> Any:  # noqa: ANN401 - any plain data
        """The result; None if there is none."""
        return json.loads(self.result) if self.result else None


def report(answer: Any, *arguments: Any) -> Report:  # noqa: ANN401 - whatever a learner hands over
    """Call a function and write down what it gives back.

    Args:
        answer: The function.
        arguments: What it is called with.
    """
    seen = Report("", f"Deadline: it was still running after {SECONDS:g} s")
    with Deadline(SECONDS) as deadline:
        try:
            seen = _written(answer(*arguments))
        except (Exception, SystemExit) as error:  # whatever a learner's function does is evidence
            seen = Report("", f"{type(error).__name__}: {error}")
    late = f"Deadline: it was still running after {SECONDS:g} s"
    return Report("", late) if deadline.passed else seen


def _written(value: Any) -> Report:  # noqa: ANN401
    kind = type(value).__name__
    if value is None:
        return Report("", "", kind)
    try:
        text = json.dumps(value)
    except (TypeError, ValueError, RecursionError) as error:
        return Report("", f"NotPlain: {error}", kind)
    if len(text) > MOST:
        return Report("", f"NotPlain: it is {len(text)} characters long", kind)
    return Report(text, "", kind)
