"""Lesson source to page: the first step, which every tree shares."""

from __future__ import annotations

from typing import Any

from nbformat import NotebookNode, v4

from rosbeat.authoring.kernel import DISPLAY_NAME, KERNEL_NAME
from rosbeat.authoring.source import Lesson, SourceCell


def assemble(lesson: Lesson) -> NotebookNode:
    """Make a page that still holds answers, markers and working notes in the cells' metadata.

    Args:
        lesson: The lesson source.
    """
    page = v4.new_notebook(cells=[_cell(cell) for cell in lesson.cells])
    # Fixed, so that a newer nbformat does not rewrite every page.
    page.nbformat, page.nbformat_minor = 4, 5
    page.metadata.kernelspec = {
        "display_name": DISPLAY_NAME,
        "language": "python",
        "name": KERNEL_NAME,
    }
    page.metadata.language_info = {"name": "python"}
    page.metadata.title = lesson.header.title
    page.metadata.rosbeat = {"lesson": lesson.name}
    return page


def _cell(cell: SourceCell) -> Any:  # noqa: ANN401 - untyped library
    make = v4.new_code_cell if cell.kind == "code" else v4.new_markdown_cell
    made = make(cell.page_text)
    made.id = cell.id
    made.metadata.update({"line": cell.line, "only": cell.only})
    if cell.tags:
        made.metadata.tags = list(cell.tags)
    roles = {"exercise": cell.exercise, "check": cell.check}
    marks = {role: name for role, name in roles.items() if name}
    if marks:
        made.metadata.rosbeat = marks
    return made
