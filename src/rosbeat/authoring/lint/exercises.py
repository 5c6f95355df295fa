"""Exercises, their checks and their names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding
from rosbeat.authoring.source import SourceCell, find_blocks


def answer_outside_exercise(desk: Desk) -> Iterator[Finding]:
    """Answers stand in exercises and predictions, and an exercise has at least one."""
    for cell in desk.lesson.cells:
        blocks = find_blocks(cell.source)
        if blocks and (cell.kind != "code" or not (cell.exercise or cell.predict)):
            line = cell.line + blocks[0].line
            cure = f"Begin the cell with '# %% exercise=\"{desk.lesson.number}a\"'."
            yield desk.finding("answer-outside-exercise", line, "this is no exercise cell.", cure)
        if cell.exercise and not blocks:
            what = f"exercise {cell.exercise} has no answer."
            yield desk.finding("answer-outside-exercise", cell.line, what)
        if cell.only and (cell.exercise or cell.check):
            what = "an exercise or its check stands on both pages."
            yield desk.finding("answer-outside-exercise", cell.line, what, "Remove only=.")


def exercise_names(desk: Desk) -> Iterator[Finding]:
    """Exercises are named NNa, NNb, NNc, in order; several cells before one check may share one."""
    for cell, letter in zip(first_cells(desk), "abcdefghijklmnopqrstuvwxyz", strict=False):
        expected = desk.lesson.number + letter
        if cell.exercise != expected:
            what = f"exercise {cell.exercise} would be {expected} by its place on the page."
            yield desk.finding("exercise-names", cell.line, what, "Rename it, and its check.")


def first_cells(desk: Desk) -> list[SourceCell]:
    """The first cell of each exercise: an exercise may have several, one after the other.

    Args:
        desk: The lesson among its neighbours.
    """
    found, before = [], None
    for cell in desk.lesson.cells:
        if cell.exercise and cell.exercise != before:
            found.append(cell)
        if cell.exercise or cell.check:
            before = cell.exercise
    return found


def exercise_pairs(desk: Desk) -> Iterator[Finding]:
    """Every exercise has one check below it, and every check has its exercise."""
    known: set[str] = set()
    checks = Counter(cell.check for cell in desk.lesson.cells if cell.check)
    for cell in desk.lesson.cells:
        known |= {cell.exercise} if cell.exercise else set()
        if cell.exercise and checks[cell.exercise] != 1:
            what = f"exercise {cell.exercise} has {checks[cell.exercise]} check cells."
            cure = f"Give it one, with '# %% check=\"{cell.exercise}\"'."
            yield desk.finding("exercise-pairs", cell.line, what, cure)
        if cell.check and cell.check not in known:
            what = f"check {cell.check} has no exercise above it."
            yield desk.finding("exercise-pairs", cell.line, what)


def mentioned(text: str) -> list[str]:
    """Return the exercise names, such as ``03a``, that a text mentions."""
    return re.findall(r"\b\d\d[a-z]\b", text)
