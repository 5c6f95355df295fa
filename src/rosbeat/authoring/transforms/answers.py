"""Answers in, or blanks in their place."""

from __future__ import annotations

from collections.abc import Callable

from nbformat import NotebookNode

from rosbeat.authoring.source import with_answers, with_blanks


def fill_answers(page: NotebookNode) -> NotebookNode:
    """Keep the answers and remove markers and blanks."""
    return _rewrite(page, with_answers)


def blank_answers(page: NotebookNode) -> NotebookNode:
    """Keep the blanks, uncommented, and remove markers and answers."""
    return _rewrite(page, with_blanks)


def _rewrite(page: NotebookNode, rewrite: Callable[[str], str]) -> NotebookNode:
    for cell in page.cells:
        if cell.cell_type == "code":
            cell.source = rewrite(cell.source)
    return page
