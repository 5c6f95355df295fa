"""What a lint is given, and what it hands back."""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

from rosbeat.authoring.source import Course, Lesson, SourceCell, with_blanks_in_place

_FENCE = re.compile(r"^ {0,3}(```|~~~)")
_MAGIC = re.compile(r"^(\s*)[%!?].*|^(\s*)\S+\?$")


@dataclass(frozen=True)
class Finding:
    """A place that breaks a rule.

    Attributes:
        lint: The rule's name.
        file: The lesson source.
        line: The line in it, counted from 1.
        what: What is wrong.
        to_try: What to do about it.
    """

    lint: str
    file: str
    line: int
    what: str
    to_try: str = ""

    def __str__(self) -> str:
        cure = f" {self.to_try}" if self.to_try else ""
        return f"{self.file}:{self.line}: {self.lint}: {self.what}{cure}"


@dataclass(frozen=True)
class Desk:
    """One lesson on the desk, with everything a rule may look at.

    Attributes:
        course: The folders that links lead into.
        lessons: All lessons of the course.
        lesson: The lesson to check.
    """

    course: Course
    lessons: tuple[Lesson, ...]
    lesson: Lesson

    @cached_property
    def learner_cells(self) -> list[SourceCell]:
        """The cells of the learner's page, answers still inside."""
        return [cell for cell in self.lesson.cells if cell.only != "solution"]

    @cached_property
    def code(self) -> list[SourceCell]:
        """The code cells of the learner's page."""
        return [cell for cell in self.learner_cells if cell.kind == "code"]

    @cached_property
    def python(self) -> list[SourceCell]:
        """The code cells that hold Python; the others are for a terminal, or a file of text."""
        return [cell for cell in self.code if cell.is_python]

    @cached_property
    def markdown(self) -> list[SourceCell]:
        """The markdown cells of the learner's page."""
        return [cell for cell in self.learner_cells if cell.kind == "markdown"]

    def finding(self, lint: str, line: int, what: str, to_try: str = "") -> Finding:
        """Make a finding in this lesson.

        Args:
            lint: The rule's name.
            line: The line of the source file.
            what: What is wrong.
            to_try: What to do about it.
        """
        return Finding(lint, f"src/lessons/{self.lesson.path.name}", line, what, to_try)


Lint = Callable[[Desk], Iterator[Finding]]


def learner_text(cell: SourceCell) -> str:
    """What a learner sees of a cell, on the lines it has in the source."""
    return with_blanks_in_place(cell.source) if cell.kind == "code" else cell.source


def tree_of(text: str) -> ast.Module | None:
    """Parse code, with IPython's magics out of the way, or return nothing if it is no Python."""
    if text.lstrip().startswith("%%"):
        return ast.Module([], [])
    plain = [_MAGIC.sub(_indented_pass, line) for line in text.split("\n")]
    try:
        return ast.parse("\n".join(plain))
    except SyntaxError:
        return None


def _indented_pass(match: re.Match[str]) -> str:
    return (match[1] or match[2] or "") + "pass"


def prose_lines(cell: SourceCell) -> Iterator[tuple[int, str]]:
    """Yield the lines of a markdown cell that are not fenced code, with their source lines."""
    fence = ""
    for number, line in enumerate(cell.source.split("\n"), cell.line):
        match = _FENCE.match(line)
        if match and fence in ("", match[1]):
            fence = "" if fence else match[1]
        elif not fence:
            yield number, line


def headings(cell: SourceCell) -> Iterator[tuple[int, int, str]]:
    """Yield the headings of a markdown cell: source line, level, text."""
    for number, line in prose_lines(cell):
        match = re.match(r"(#{1,6}) +(.*?) *#*$", line)
        if match:
            yield number, len(match[1]), match[2]
