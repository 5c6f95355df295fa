"""The rule about answer markers."""

from __future__ import annotations

from collections.abc import Iterator

from rosbeat.authoring.lint.desk import Desk, Finding
from rosbeat.authoring.source import find_blocks
from rosbeat.errors import LessonError


def answer_markers(desk: Desk) -> Iterator[Finding]:
    """Markers are closed, in order, not nested, and a blank holds a blank."""
    for cell in desk.lesson.cells:
        try:
            find_blocks(cell.source, "", cell.line)
        except LessonError as error:
            _, line, what = error.what.split(":", 2)
            yield desk.finding("answer-markers", int(line), what.strip(), error.to_try)
