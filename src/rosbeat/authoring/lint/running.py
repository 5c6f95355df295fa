"""Code that would never end, could not be tested, or runs on one machine only."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from rosbeat.authoring.lint.blanks import eager
from rosbeat.authoring.lint.desk import Desk, Finding, tree_of
from rosbeat.authoring.source import with_answers

_UNSEEN = {"clear_output", "update_display", "display_id"}
_MACHINE = re.compile(r"(?<![\w.:~/>-])/(?:home|Users|root|tmp|work|mnt|media|var)/\w|\b[A-Z]:\\\w")


def endless(desk: Desk) -> Iterator[Finding]:
    """No cell waits for ever: no spin and no open loop at the top level."""
    for cell in (cell for cell in desk.python if not cell.saved_as):
        for node in eager(tree_of(with_answers(cell.source)) or ast.Module([], [])):
            if _never_returns(node):
                yield desk.finding(
                    "endless",
                    cell.line,
                    "this cell would never end.",
                    "Run for a bounded time instead: ros.run(seconds=10).",
                )


def unseen_by_nbval(desk: Desk) -> Iterator[Finding]:
    """No output is replaced after it was shown: nbval compares what came, not what is left."""
    for cell in desk.python:
        for node in ast.walk(tree_of(with_answers(cell.source)) or ast.Module([], [])):
            names = {getattr(node, field, None) for field in ("id", "attr", "arg", "name")}
            for name in sorted(_UNSEEN & names):
                what = f"{name} replaces an output, which the tests cannot compare."
                yield desk.finding("unseen-by-nbval", cell.line, what, "Show it once, at the end.")


def machine_path(desk: Desk) -> Iterator[Finding]:
    """No path of one machine stands in a page."""
    for cell in desk.lesson.cells:
        for number, line in enumerate(cell.source.split("\n"), cell.line):
            if _MACHINE.search(line):
                what = f"a path of one machine: {line.strip()!r}."
                yield desk.finding("machine-path", number, what, "Use a relative path.")


def _never_returns(node: ast.AST) -> bool:
    if isinstance(node, ast.Call):
        called = node.func
        return (isinstance(called, ast.Attribute) and called.attr == "spin") or (
            isinstance(called, ast.Name) and called.id == "spin"
        )
    return (
        isinstance(node, ast.While)
        and isinstance(node.test, ast.Constant)
        and bool(node.test.value)
        and not any(isinstance(inner, (ast.Break, ast.Return)) for inner in ast.walk(node))
    )
