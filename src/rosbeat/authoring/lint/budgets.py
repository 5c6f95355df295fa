"""Limits that keep a page readable."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from rosbeat.authoring.lint.desk import Desk, Finding, learner_text, prose_lines
from rosbeat.authoring.lint.exercises import first_cells
from rosbeat.authoring.source import SourceCell, with_answers

_NOT_WORDS = re.compile(r"\]\([^)]*\)|<[^>]+>|https?://\S+")
_WORD = re.compile(r"\w+(?:['’./_-]\w+)*")


@dataclass(frozen=True)
class Budgets:
    """How much a page and its cells may hold.

    Attributes:
        code_lines: Lines of a code cell, empty ones not counted.
        exercise_lines: Lines of an exercise or of a saved file, which may hold a whole program.
        cell_words: Words of a markdown cell, code and tables not counted.
        page_cells: The fewest and the most cells of a page.
        page_words: The fewest and the most words of a page.
        exercises: The most exercises of a page.
    """

    code_lines: int = 25
    exercise_lines: int = 40
    cell_words: int = 120
    page_cells: tuple[int, int] = (25, 42)
    page_words: tuple[int, int] = (900, 1500)
    exercises: int = 3


PAGE = Budgets()
FIRST_PAGE = Budgets(page_cells=(12, 42), page_words=(400, 1500))
"""The first page brings the first message within a minute, so it may be short."""


def budgets_for(desk: Desk) -> Budgets:
    """Return the limits of a lesson.

    Args:
        desk: The lesson among its neighbours.
    """
    return FIRST_PAGE if int(desk.lesson.number) == 0 else PAGE


def cell_budget(desk: Desk) -> Iterator[Finding]:
    """A cell is short enough to be taken in at once."""
    budgets = budgets_for(desk)
    for cell in desk.lesson.cells:
        if cell.kind == "markdown":
            count, limit, unit = _words(cell), budgets.cell_words, "words"
        else:
            long = cell.exercise or cell.saved_as
            limit = budgets.exercise_lines if long else budgets.code_lines
            count, unit = _code_lines(cell), "lines"
        if count > limit:
            what = f"the cell has {count} {unit}, and {limit} is the limit."
            yield desk.finding("cell-budget", cell.line, what, "Cut it, or split it in two.")


def page_budget(desk: Desk) -> Iterator[Finding]:
    """A page is long enough to teach something and short enough to finish."""
    budgets = budgets_for(desk)
    words = sum(_words(cell) for cell in desk.markdown)
    exercises = len(first_cells(desk))
    for count, unit, (least, most) in (
        (len(desk.learner_cells), "cells", budgets.page_cells),
        (words, "words", budgets.page_words),
        (exercises, "exercises", (0, budgets.exercises)),
    ):
        if not least <= count <= most:
            what = f"the page has {count} {unit}; it should have {least} to {most}."
            yield desk.finding("page-budget", 1, what)


def _words(cell: SourceCell) -> int:
    lines = (text for _, text in prose_lines(cell) if not text.lstrip().startswith("|"))
    return len(_WORD.findall(_NOT_WORDS.sub(" ", "\n".join(lines))))


def _code_lines(cell: SourceCell) -> int:
    texts = (learner_text(cell), with_answers(cell.source))
    return max(sum(1 for line in text.split("\n") if line.strip()) for text in texts)
