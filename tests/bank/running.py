"""Run an answer of the bank as a page would."""

import linecache
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

from bank import workspaces
from bank.pages import imports
from bank.reading import Answer
from rosbeat.exercises.check import check
from rosbeat.exercises.random_inputs import PAGE
from rosbeat.exercises.registry import EXERCISES
from rosbeat.records import Outcome
from rosbeat.ros.scenario import observe

#: Mistakes that a deadline finds out, and the seconds until then; a page has more patience.
ENDLESS, _PATIENCE = {"callback-blocks", "constructor-blocks"}, 1.0


def namespace_of(exercise: str, text: str, name: str) -> dict[str, Any]:
    """Execute a cell after the imports of its page.

    Args:
        exercise: The exercise's id.
        text: The cell.
        name: The name of its file; tracebacks and faults find its lines under it, as in IPython.
    """
    space: dict[str, Any] = {"__name__": "__main__"}
    exec("from rosbeat import *", space)  # as the kernel of a page has the names
    exec(imports(exercise), space)
    linecache.cache[name] = (len(text), None, text.splitlines(keepends=True), name)
    exec(compile(text, name, "exec", dont_inherit=True), space)
    return space


def outcome_of(exercise: str, text: str, subject: str, seed: int = PAGE) -> Outcome:
    """Return what `check` says of a cell.

    Args:
        exercise: The exercise's id.
        text: The cell.
        subject: The expression that the check cell hands over.
        seed: Of the inputs; the page's by default, and else those with which a class is graded.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a warning ends no cell; in a test it would be an error
        space = namespace_of(exercise, text, f"<cell of {exercise}>")
        answer = eval(subject, space)
        if seed == PAGE:
            return check(exercise, answer).outcome
        found = EXERCISES[exercise]
        return found.judged(found.observed(answer, seed), seed)


def told(answer: Answer, workspace: Path, seed: int = PAGE, *, patient: bool = False) -> Outcome:
    """Return what `check` says of an answer of the bank.

    Args:
        answer: The answer.
        workspace: A folder that is not there yet, where the environment says that it is; only
            answers about files and terminals make it.
        seed: Of the inputs.
        patient: Whether an answer that does not end gets as much time as on a page.
    """
    if answer.exercise in workspaces.EXERCISES:
        return workspaces.outcome_of(answer, workspace)
    with hurried(answer, patient):
        return outcome_of(answer.exercise, answer.text, answer.subject, seed)


def observed(answer: Answer) -> Any:
    """Return what is seen of an answer that is a cell, fed with the page's inputs."""
    with hurried(answer), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        space = namespace_of(answer.exercise, answer.text, f"<cell of {answer.exercise}>")
        return EXERCISES[answer.exercise].observed(eval(answer.subject, space))


@contextmanager
def hurried(answer: Answer, patient: bool = False) -> Iterator[None]:
    """Wait for an answer that does not end only as long as is needed to tell."""
    usual = observe.__kwdefaults__
    assert usual is not None
    hurried = not patient and ENDLESS & set(answer.mistakes)
    with patch.dict(usual, deadline=_PATIENCE if hurried else usual["deadline"]):
        yield
