"""An untouched page runs to the bottom: blanks wait inside functions."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding, learner_text, tree_of
from rosbeat.authoring.source import BLANK, with_answers

_Function = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)


def syntax(desk: Desk) -> Iterator[Finding]:
    """Code is Python on both pages, with blanks and with answers."""
    for cell in desk.python:
        for text, page in (
            (learner_text(cell), "learner's"),
            (with_answers(cell.source), "solution"),
        ):
            if tree_of(text) is None:
                what = f"this cell is not Python on the {page} page."
                cure = "A forgotten [markdown]? A blank that is only half a line?"
                yield desk.finding("syntax", cell.line, what, cure)
                break


def blank_outside_function(desk: Desk) -> Iterator[Finding]:
    """A blank that runs while the cell runs would end the untouched page."""
    for cell in (cell for cell in desk.python if cell.runs):
        tree = tree_of(learner_text(cell))
        for node in eager(tree) if tree else ():
            if _is_blank(node):
                yield desk.finding(
                    "blank-outside-function",
                    cell.line + getattr(node, "lineno", 1) - 1,
                    f"{BLANK} would be run at once, and the untouched page would stop here.",
                    "Move it into the body of a function or method.",
                )


def stray_blank(desk: Desk) -> Iterator[Finding]:
    """Blanks stand in exercises and predictions only."""
    for cell in desk.code:
        if cell.exercise or cell.predict:
            continue
        for number, line in enumerate(learner_text(cell).split("\n"), cell.line):
            if BLANK in line:
                what = f"{BLANK} stands outside of an exercise."
                yield desk.finding("stray-blank", number, what, 'Mark the cell exercise="..".')


def eager(node: ast.AST) -> Iterator[ast.AST]:
    """Yield what is evaluated when the cell runs: everything but the bodies of functions."""
    yield node
    for name, value in ast.iter_fields(node):
        if name == "body" and isinstance(node, _Function):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                yield from eager(child)


def _is_blank(node: ast.AST) -> bool:
    names = (getattr(node, field, None) for field in ("id", "attr", "arg", "name"))
    return BLANK in names
