"""The answers of all exercises, for `hint`: one file for each, made from the exercise cells."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from rosbeat.authoring.source import Course, Lesson, with_answers


def answer_files(course: Course, lessons: Iterable[Lesson]) -> dict[Path, bytes]:
    """Return the file of every answer, with its content: the cells as the solution page has them.

    Args:
        course: Where they belong.
        lessons: All lessons of the course.
    """
    if not folder_of(course).parent.is_dir():  # such a course has no package to give hints
        return {}
    texts: dict[str, list[str]] = {}
    for cell in (cell for lesson in lessons for cell in lesson.cells):
        if cell.exercise:
            texts.setdefault(cell.exercise, []).append(with_answers(cell.page_text))
    # The parts of an exercise in several cells stand as far apart as classes in a file.
    files = {name: "\n\n\n".join(parts) + "\n" for name, parts in texts.items()}
    return {folder_of(course) / f"{name}.txt": text.encode() for name, text in files.items()}


def folder_of(course: Course) -> Path:
    """Return the folder that holds the answers, and nothing else.

    Args:
        course: The course.
    """
    return course.root / "src/rosbeat/exercises/solved"
