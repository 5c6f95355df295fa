"""The answers of all exercises, for `hint`: one file for each, made from the exercise cells."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rosbeat.authoring.layout import Course
from rosbeat.authoring.markers import solution
from rosbeat.authoring.source import Lesson


def answer_files(course: Course, lessons: Iterable[Lesson]) -> dict[Path, bytes]:
    """Return the file of every answer, with its content: the cell as the solution page has it.

    Args:
        course: Where they belong.
        lessons: All lessons of the course.
    """
    if not folder_of(course).parent.is_dir():  # such a course has no package to give hints
        return {}
    return {
        folder_of(course) / f"{cell.exercise}.txt": (solution(cell.page_text) + "\n").encode()
        for lesson in lessons
        for cell in lesson.cells
        if cell.exercise
    }


def folder_of(course: Course) -> Path:
    """Return the folder that holds the answers, and nothing else.

    Args:
        course: The course.
    """
    return course.root / "src/rosbeat/exercises/solved"
