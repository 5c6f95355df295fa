"""What can be said of a function whose result is the answer, whatever was asked."""

from __future__ import annotations

from rosbeat.checks.verdicts import BLANK, failed, not_attempted
from rosbeat.records import Outcome
from rosbeat.scenarios.reports import Report


def before_reading(exercise: str, seen: Report, example: str) -> Outcome | None:
    """What can be said of a report whatever was asked: a blank, an exception, no result; or None.

    Args:
        exercise: The exercise's id.
        seen: The report.
        example: What the check cell should say, such as `check("07a", findings)`.
    """
    if f"'{BLANK}'" in seen.problem and seen.problem.startswith("NameError"):
        return not_attempted(exercise)
    if seen.problem.startswith("Deadline"):
        said = seen.problem.partition(": ")[2]
        hint = "It only has to return what you found."
        return failed(exercise, f"The function does not end: {said}.", hint, "does-not-return")
    if "object is not callable" in seen.problem:
        hint = f"Hand over the function itself, by its name: {example}."
        return failed(exercise, "What was handed over is no function.", hint, "no-function")
    if seen.problem.startswith("NotPlain"):
        said = seen.problem.partition(": ")[2]
        hint = "Give back numbers, texts, lists and dicts only."
        return failed(exercise, f"The result cannot be read: {said}.", hint, "not-plain")
    if seen.problem:
        hint = "What is to be a text stands in quotes; numbers stand without."
        name = "name-error" if seen.problem.startswith("NameError") else "raised"
        return failed(exercise, f"The function raised {seen.problem}.", hint, name)
    if seen.type_name == "NoneType":
        hint = "The function needs a return: print gives back nothing."
        return failed(exercise, "The function gave nothing back.", hint, "returns-nothing")
    return None
