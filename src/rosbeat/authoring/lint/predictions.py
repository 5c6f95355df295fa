"""Predictions: the learner's page asks, the solution page answers, and both run."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding, learner_text, tree_of
from rosbeat.authoring.source import BLANK, SourceCell, find_blocks, with_answers

_MARKED = "Begin the cell with '# %% predict=true'."
_QUOTED = f'On the learner\'s page its first argument is "{BLANK}", in quotes, so that it runs.'


def predictions(desk: Desk) -> Iterator[Finding]:
    """A prediction is asked for in a cell of its own kind, as a text that runs unfilled."""
    for cell in desk.lesson.cells:
        what, cure = _flaw(cell)
        if what:
            yield desk.finding("predictions", cell.line, what, cure)


def _flaw(cell: SourceCell) -> tuple[str, str]:
    """What is wrong with a cell's predictions, and what to do; empty texts if nothing is."""
    if not cell.predict:
        asks = cell.is_python and _guesses(with_answers(cell.source))
        return ("predict is called in a cell that is not marked.", _MARKED) if asks else ("", "")
    if cell.kind != "code" or cell.magic or cell.exercise or cell.check or cell.only:
        return "a prediction stands in a cell that is something else, too.", "Make two cells of it."
    if not find_blocks(cell.source):
        return "the prediction has no answer.", "Put predict(...) between the answer markers."
    asked, answered = _guesses(learner_text(cell)), _guesses(with_answers(cell.source))
    if not asked or len(asked) != len(answered) or not all(map(_is_blank, asked)):
        return "the learner's page asks for no prediction.", _QUOTED
    if any(map(_is_blank, answered)):
        return "the solution page makes no prediction.", "Put the right guess into the answer."
    return "", ""


def _guesses(text: str) -> list[ast.expr]:
    """The first argument of every call of `predict`."""
    calls = (node for node in ast.walk(tree_of(text) or ast.Module([], [])))
    return [
        node.args[0]
        for node in calls
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "predict"
        and node.args
    ]


def _is_blank(guess: ast.expr) -> bool:
    return isinstance(guess, ast.Constant) and guess.value == BLANK
