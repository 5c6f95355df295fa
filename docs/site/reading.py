"""Makes a page that is read: what a learner would see of it, and what answers it in folded boxes.

The lesson's source says which cell is an exercise, a prediction or a quiz, and holds the blanks;
the executed page of `solutions/` holds the answers and the outputs.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from html import escape
from itertools import takewhile
from string import ascii_lowercase
from typing import Any

from rosbeat.authoring.source import Lesson, SourceCell, with_blanks
from rosbeat.exercises.outcome_display import words
from rosbeat.exercises.quiz import QUESTIONS, Question

#: The lexer of `conf.py`: it gives a cell of %%terminal or %%save the colors of its language.
LEXER = "rosbeat-page"
#: What a link to the home page leads to.
HOME_LINK = re.compile(r"\]\((?:\.\./)?(?:notebooks/)?home\.ipynb\)")

_AFTER = "After your prediction: what happened"
_RECORD = "application/vnd.rosbeat.outcome+json"
# Whoever reads has not told the page what they expect.
_PREDICTED = re.compile(
    r"\N{CHECK MARK} You predicted .*?, and it was (.*?\.)( That is close enough\.)?"
)

Cell = dict[str, Any]


def for_readers(notebook: Cell, lesson: Lesson) -> Cell:
    """Return a page with its blanks, questions and predictions open, and its answers folded.

    Args:
        notebook: The executed page, as nbformat 4 describes it.
        lesson: The source of the page.
    """
    return {
        **notebook,
        "cells": _Page(lesson, {cell["id"]: cell for cell in notebook["cells"]}).cells(),
        "metadata": {
            **notebook["metadata"],
            "language_info": {"name": "python", "pygments_lexer": LEXER},
        },
    }


@dataclass
class _Page:
    """Hold a page while its cells are gone through.

    Attributes:
        lesson: The source of the page.
        solved: The cells of the executed page, by their ids.
        answers: The answer to the exercise at hand, until its check has come.
        boxes: How many boxes there are so far.
    """

    lesson: Lesson
    solved: dict[str, Cell]
    answers: list[Cell] = field(default_factory=list)
    boxes: int = 0

    def cells(self) -> list[Cell]:
        """Return the cells of the page; links to its neighbors are the theme's."""
        shown: list[Cell] = []
        rest = list(self.lesson.cells)
        while rest:
            cell = rest.pop(0)
            if cell.source.endswith("progress()"):  # that of whoever built the page
                continue
            if cell.predict:
                shown += [self._asked(cell), *self._prediction(cell, _answering(rest))]
            elif cell.exercise:
                shown.append(self._asked(cell))
                self.answers.append({**self._made(cell), "id": f"{cell.id}-answer"})
            elif cell.check:
                shown += [self._asked(cell), *self._answer(cell, _group(rest, "solution"))]
            elif cell.only:
                shown += self._variants([cell, *_group(rest, "notebook", "solution")])
            else:
                shown.append(self._made(cell))
        shown[0]["source"] = re.sub(r"^# ", f"# {self.lesson.number} ", shown[0]["source"])
        return shown

    def _asked(self, cell: SourceCell) -> Cell:
        """Return a cell as a learner finds it: with blanks, and without what it will show."""
        if cell.kind == "markdown":
            return _text(cell.id, cell.page_text)
        return {
            "cell_type": "code",
            "execution_count": None,
            "id": cell.id,
            "metadata": {},
            "outputs": [],
            "source": with_blanks(cell.page_text),
        }

    def _made(self, cell: SourceCell) -> Cell:
        """Return a cell as it ran."""
        solved = self.solved[cell.id]
        source = "".join(solved["source"])
        if cell.kind == "markdown":
            return _text(cell.id, source)
        return {**solved, "source": source, "outputs": _outputs(solved)}

    def _shown(self, cell: SourceCell) -> Cell:
        """Return what a cell showed when it ran, without its code."""
        made = self._made(cell)
        metadata = {**made["metadata"], "tags": ["remove-input"]}
        return {**made, "id": f"{cell.id}-shown", "metadata": metadata}

    def _prediction(self, cell: SourceCell, answering: Iterable[SourceCell]) -> list[Cell]:
        outcome = self._shown(cell)
        return self._folded(_AFTER, [outcome, *map(self._made, answering)])

    def _answer(self, check: SourceCell, reasons: Iterable[SourceCell]) -> list[Cell]:
        parts = [*self.answers, self._shown(check), *map(self._made, reasons)]
        self.answers = []
        return self._folded(f"The answer to exercise {check.check}", parts)

    def _variants(self, cells: list[SourceCell]) -> list[Cell]:
        """Return what differs between the page and its solution: the page's, and a box for it."""
        others = [cell for cell in cells if not cell.source.startswith("quiz(")]
        asked = [self._asked(cell) for cell in others if cell.only == "notebook"]
        made = [self._made(cell) for cell in others if cell.only == "solution"]
        return [
            *asked,
            *(self._folded("How the solution does it", made) if made else []),
            *(self._questions() if len(others) < len(cells) else []),
        ]

    def _questions(self) -> Iterator[Cell]:
        for question in QUESTIONS[self.lesson.number]:
            yield _text(f"question-{question.id[-1]}", _question(question))
            answer = _text(f"reasons-{question.id[-1]}", _reasons(question))
            yield from self._folded(f"The answer to question {question.id}", [answer])

    def _folded(self, title: str, cells: list[Cell]) -> list[Cell]:
        """Put cells into a box that opens with a click."""
        self.boxes += 1
        return [
            _text(
                f"box-{self.boxes}",
                f'<details class="answer">\n<summary>{escape(title)}</summary>',
            ),
            *cells,
            _text(f"box-{self.boxes}-end", "</details>"),
        ]


def _answering(rest: list[SourceCell]) -> list[SourceCell]:
    """Take what answers a prediction from the cells below it.

    These are all cells up to the text that is marked so, and the pictures that this text is about.
    """
    last = next((number for number, cell in enumerate(rest) if cell.answers), -1)
    end = last + 1
    while last >= 0 and end < len(rest) and rest[end].source.startswith("viz."):
        end += 1
    taken, rest[:] = rest[:end], rest[end:]
    return taken


def _group(rest: list[SourceCell], *trees: str) -> list[SourceCell]:
    """Take the next cells as long as they are only in one of these trees."""
    taken = list(takewhile(lambda cell: cell.only in trees, rest))
    rest[:] = rest[len(taken) :]
    return taken


def _text(name: str, source: str) -> Cell:
    """Return a cell of text, in which a link to the home page leads to that of the site."""
    linked = HOME_LINK.sub("](../index.md#the-pages)", source)
    return {"cell_type": "markdown", "id": name, "metadata": {}, "source": linked}


def _outputs(cell: Cell) -> list[Cell]:
    """Return outputs without the record of a check: that is for graders, and the card shows it."""
    return [
        {
            **output,
            "data": {
                kind: _PREDICTED.sub(r"It was \1", "".join(text))
                for kind, text in output["data"].items()
                if kind != _RECORD
            },
        }
        if "data" in output
        else output
        for output in cell["outputs"]
    ]


def _question(question: Question) -> str:
    """Return a question and all that may be chosen, as one block of HTML."""
    choices = "".join(f"<li>{words(choice.text)}</li>" for choice in question.choices)
    text = f'<p class="question"><strong>{question.id}</strong> {words(question.text)}</p>'
    return f'<div class="quiz">{text}<ol type="a">{choices}</ol></div>'


def _reasons(question: Question) -> str:
    """Return the right choice and what speaks for or against each, as one block of HTML."""
    lettered = list(zip(ascii_lowercase, question.choices, strict=False))
    right = [
        f"<p><strong>{letter}. {words(choice.text)}</strong><br>{words(choice.reason)}</p>"
        for letter, choice in lettered
        if choice.right
    ]
    wrong = [
        f"<li>Not {letter}: {words(choice.reason)}</li>"
        for letter, choice in lettered
        if not choice.right
    ]
    return f"{''.join(right)}<ul>{''.join(wrong)}</ul>"
