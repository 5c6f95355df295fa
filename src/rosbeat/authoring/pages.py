"""The two trees of pages, each a list of transformations."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import nbformat
from nbformat import NotebookNode

from rosbeat.authoring.execution import Deadlines
from rosbeat.authoring.source import Lesson
from rosbeat.authoring.transforms import Transform
from rosbeat.authoring.transforms.answers import blank_answers, fill_answers
from rosbeat.authoring.transforms.assemble import assemble
from rosbeat.authoring.transforms.failures import quiet_failures
from rosbeat.authoring.transforms.nbgrader import NO_POINTS, mark_for_nbgrader
from rosbeat.authoring.transforms.repeatable import refuse_unrepeatable
from rosbeat.authoring.transforms.run import run_in
from rosbeat.authoring.transforms.selection import keep_cells_of
from rosbeat.authoring.transforms.streams import merge_streams
from rosbeat.authoring.transforms.uncompared import keep_uncompared
from rosbeat.authoring.transforms.whitelist import keep_known_metadata

_NOTEBOOK: list[Transform] = [keep_cells_of("notebook"), blank_answers]
_SOLUTION: list[Transform] = [keep_cells_of("solution"), fill_answers]
_AFTER_RUN: list[Transform] = [merge_streams, quiet_failures, refuse_unrepeatable]


def notebook_page(lesson: Lesson, points: Mapping[str, int] = NO_POINTS) -> NotebookNode:
    """Make the page a learner opens: blanks, no outputs.

    Args:
        lesson: The lesson source.
        points: What each exercise is worth, by its id.

    Raises:
        LessonError: An answer marker is wrong.
    """
    return _apply(lesson, [*_NOTEBOOK, mark_for_nbgrader(points), keep_known_metadata])


def solution_draft(lesson: Lesson, points: Mapping[str, int] = NO_POINTS) -> NotebookNode:
    """Make the solution page without running it.

    Args:
        lesson: The lesson source.
        points: What each exercise is worth, by its id.

    Raises:
        LessonError: An answer marker is wrong.
    """
    return _apply(lesson, [*_SOLUTION, mark_for_nbgrader(points), keep_known_metadata])


def solution_page(
    lesson: Lesson,
    folder: Path,
    deadlines: Deadlines | None = None,
    *,
    fresh: bool = False,
    points: Mapping[str, int] = NO_POINTS,
    run: Transform | None = None,
) -> NotebookNode:
    """Make the solution page: answers, run from top to bottom, outputs stored.

    Args:
        lesson: The lesson source.
        folder: The kernel's current directory, and where the page is kept.
        deadlines: How long the page may take.
        fresh: Store new outputs in cells of which the outputs are not compared, too.
        points: What each exercise is worth, by its id.
        run: The step that runs the page; by default in a fresh kernel of its own.

    Raises:
        LessonError: An answer marker is wrong, a cell fails, or an output is not repeatable.
    """
    kept = [] if fresh else [keep_uncompared(folder / f"{lesson.name}.ipynb")]
    ran = [run or run_in(folder, deadlines), *_AFTER_RUN, *kept]
    return _apply(lesson, [*_SOLUTION, *ran, mark_for_nbgrader(points), keep_known_metadata])


def to_bytes(page: NotebookNode) -> bytes:
    """Write a page as it stands in a file.

    Args:
        page: The page.
    """
    nbformat.validate(page)
    text: str = nbformat.writes(page)
    return (text.rstrip("\n") + "\n").encode()


def _apply(lesson: Lesson, steps: list[Transform]) -> NotebookNode:
    page = assemble(lesson)
    for step in steps:
        page = step(page)
    return page
