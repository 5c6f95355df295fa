"""How an answer of the bank is written down."""

import ast
from dataclasses import dataclass
from textwrap import dedent


@dataclass(frozen=True)
class Answer:
    """One answer to an exercise about a node: the text of a cell, and what must be said of it.

    Attributes:
        exercise: The exercise's id.
        name: What it is about; unique within the exercise.
        text: The cell.
        status: The status that it must get.
        mistakes: Ids of mistakes, each of which is a true name for what is wrong; one id if there
            is only one mistake. Empty if the answer is right.
        handed: The expression that the check cell hands over; by default the class or function
            that the cell defines last.
    """

    exercise: str
    name: str
    text: str
    status: str = "passed"
    mistakes: tuple[str, ...] = ()
    handed: str = ""

    @property
    def id(self) -> str:
        """Its name in a test report."""
        return f"{self.exercise} {self.name}"

    @property
    def subject(self) -> str:
        """The expression that is handed to `check`."""
        if self.handed:
            return self.handed
        defined = (ast.ClassDef, ast.FunctionDef)
        return [node.name for node in ast.parse(self.text).body if isinstance(node, defined)][-1]


def right(exercise: str, name: str, text: str, handed: str = "") -> Answer:
    """An answer that does what is asked."""
    return Answer(exercise, name, dedent(text).lstrip("\n"), handed=handed)


def wrong(exercise: str, name: str, mistake: str, text: str, handed: str = "") -> Answer:
    """An answer with one mistake."""
    return Answer(exercise, name, dedent(text).lstrip("\n"), "failed", (mistake,), handed)


def either(
    exercise: str, name: str, mistakes: tuple[str, ...], text: str, handed: str = ""
) -> Answer:
    """An answer with two mistakes, or with one that has two names: any of them is true."""
    return Answer(exercise, name, dedent(text).lstrip("\n"), "failed", mistakes, handed)


def edited(text: str, *edits: tuple[str, str]) -> str:
    """A text with something else in the place of something that is in it.

    Raises:
        ValueError: If a text to replace is not there: the answer would not be what its name says.
    """
    text = dedent(text).lstrip("\n")
    for old, new in edits:
        if old not in text:
            raise ValueError(f"{old!r} is not in:\n{text}")
        text = text.replace(old, new)
    return text
