"""Answers by somebody who had the pages only, and neither a judge nor this bank.

They were written before any of them was run, so they measure the judges as a held-out set measures
a model. Where the page leaves open what is right, an answer was set aside (the same order number
twice in 09b, for one). Each exercise has a text file::

    === right | what is unusual about it | what is handed to check, if not what the page hands over
    === wrong mistake-id | what is wrong
    --- the mistake in plain words, as its author put it
    the cell, the file or the lines of the terminal
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

STATUS = {"right": "passed", "wrong": "failed", "untried": "not attempted"}


@dataclass(frozen=True)
class HeldOut:
    """Hold one answer, and what must be said of it.

    Attributes:
        exercise: The exercise's id.
        name: What it is about; unique within the exercise.
        text: The cell, the file or the lines of the terminal.
        status: The status that it must get.
        mistake: Id of the mistake that must be named; empty if the answer is right.
        handed: The expression that is handed to `check`, if it is not the page's own.
    """

    exercise: str
    name: str
    text: str
    status: str
    mistake: str = ""
    handed: str = ""

    @property
    def id(self) -> str:
        """Return its name in a test report."""
        return f"{self.exercise} {self.name}"


def answers() -> tuple[HeldOut, ...]:
    """Return all answers, in the order of the exercises."""
    files = sorted(Path(__file__).parent.glob("*.txt"))
    return tuple(one for file in files for one in _read(file))


def _read(file: Path) -> Iterator[HeldOut]:
    for entry in file.read_text(encoding="utf-8").split("=== ")[1:]:
        head, _, text = entry.partition("\n")
        verdict, name, *handed = head.split(" | ")
        word, _, mistake = verdict.partition(" ")
        if text.startswith("--- "):
            text = text.partition("\n")[2]
        yield HeldOut(file.stem, name, text, STATUS[word], mistake, "".join(handed))
