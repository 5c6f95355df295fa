"""Where a course keeps its sources and its pages."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rosbeat.authoring.source import Lesson, read_lesson
from rosbeat.errors import LessonError


@dataclass(frozen=True)
class Course:
    """A checkout of the course.

    Attributes:
        root: The folder that holds ``src``, ``notebooks`` and ``solutions``.
    """

    root: Path

    @property
    def sources(self) -> Path:
        """The folder of the lesson sources."""
        return self.root / "src" / "lessons"

    @property
    def notebooks(self) -> Path:
        """The folder of the learner's pages."""
        return self.root / "notebooks"

    @property
    def solutions(self) -> Path:
        """The folder of the solution pages."""
        return self.root / "solutions"

    def lessons(self) -> list[Lesson]:
        """Read every lesson, in order.

        Raises:
            LessonError: A source breaks the format.
        """
        return [read_lesson(path) for path in sorted(self.sources.glob("*.py"))]


def find_course(start: Path) -> Course:
    """Find the course that a folder belongs to.

    Args:
        start: The folder, or any folder inside the course.

    Raises:
        LessonError: Neither the folder nor one above it has ``src/lessons``.
    """
    for folder in (start, *start.parents):
        if (folder / "src" / "lessons").is_dir():
            return Course(folder)
    raise LessonError(
        f"no lessons are found from {start}.",
        "Pages are built from src/lessons in a checkout of the course.",
        "Change into the checkout, or name it with --root.",
    )


def choose(lessons: list[Lesson], names: list[str]) -> list[Lesson]:
    """Choose lessons by number, name or file.

    Args:
        lessons: The lessons to choose from.
        names: ``03``, ``03_write_a_publisher`` or a path of its source or page; none means all.

    Raises:
        LessonError: A name fits no lesson.
    """
    wanted = {_named(lessons, name) for name in names}
    return [lesson for lesson in lessons if not names or lesson.name in wanted]


def _named(lessons: list[Lesson], name: str) -> str:
    stem = Path(name).stem
    for lesson in lessons:
        if stem in (lesson.name, lesson.number):
            return lesson.name
    known = ", ".join(lesson.name for lesson in lessons) or "none"
    raise LessonError(f"no lesson is called {name!r}.", "", f"The lessons are: {known}.")
