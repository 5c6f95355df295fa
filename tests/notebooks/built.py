"""Whether the run that nbval has compared would be stored as the page that is there, byte for byte.

nbval compares what a reader sees of each cell. `rosbeat build --check` compares more: the order of
outputs, numbers of cells, metadata, what must not show in a page. It runs a page for that, and so
does nbval; here one run serves both.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from nbformat import NotebookNode
from nbformat.v4 import output_from_msg

from rosbeat.authoring import pages
from rosbeat.authoring.build import Change, compare
from rosbeat.authoring.source import Course, Lesson, read_lesson

_OUTPUTS = ("stream", "display_data", "execute_result", "error")


@dataclass
class Ran:
    """What running a cell gave, as it came from the kernel.

    Attributes:
        count: The number of the cell.
        outputs: Its outputs, in order.
    """

    count: int | None = None
    outputs: list[NotebookNode] = field(default_factory=list)

    def see(self, message: Mapping[str, Any]) -> None:
        """Take note of a message that answers this cell."""
        self.count = message["content"].get("execution_count", self.count)
        if message["msg_type"] in _OUTPUTS:
            self.outputs.append(output_from_msg(message))


def source_of(path: Path) -> Path | None:
    """The lesson from which a page of `solutions/` is built; None for any other notebook."""
    source = path.parents[1] / "src" / "lessons" / f"{path.stem}.py"
    return source if path.parent.name == "solutions" and source.exists() else None


def difference(
    path: Path, lesson: Path, runs: list[Ran], points: Mapping[str, int]
) -> Change | None:
    """In what the page that these runs make differs from the one that is there.

    Args:
        path: The page.
        lesson: Its source.
        runs: What its code cells gave, in their order.
        points: What each exercise is worth.

    Raises:
        LessonError: If the outputs could not be stored: they are not repeatable.
        ValueError: If there are more or fewer runs than code cells.
    """
    lessons = Course(lesson.parents[2]).lessons()
    page = solution(read_lesson(lesson), path.parent, runs, points, lessons)
    change = compare(path, pages.to_bytes(page))
    return change if change and change.matters else None


def solution(
    lesson: Lesson,
    folder: Path,
    runs: list[Ran],
    points: Mapping[str, int],
    lessons: Sequence[Lesson] = (),
) -> NotebookNode:
    """The solution page of a lesson that has been run already."""

    def fill(page: NotebookNode, _: Path) -> None:
        code = [cell for cell in page.cells if cell.cell_type == "code"]
        for cell, ran in zip(code, runs, strict=True):
            cell.execution_count, cell.outputs = ran.count, ran.outputs

    return pages.solution_page(lesson, folder, points=points, lessons=lessons, run=fill)
