"""Make of a page that was handed in a job for a sandbox: the cells to run, and what is checked.

There are no rules about which cell holds an answer: the page is run as it is, and what counts is
what its last check of an exercise was given. Left out are only cells that are as the course has
released them, that its source marks as showing something (`shows=true`), and of which no other cell
needs a name.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256

from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.jobs import PageCell, PageJob
from rosbeat.grading.notebook import Cell, CoursePage

#: What is said of an answer if no cell of the page names it.
NOT_THERE = "No cell of the page defines it."
_BITS = 63
_CHECK = re.compile(r"""(?m)^[^#\n]*?\bcheck\(\s*(?:exercise\s*=\s*)?["']\s*(\w+)\s*["']""")
#: What a learner writes into a prediction or a quiz, which changes nothing else of its cell.
_GUESS = re.compile(r"""\bpredict\(\s*(?:"[^"\n]*"|'[^'\n]*')""")
_CHOICES = re.compile(r"""\bquiz\((?:\s*(?:"[^"\n]*"|'[^'\n]*')\s*,?)*\)""")
_TERMINAL = re.compile(r"%%?terminal\s+(\w+)")
#: What is the same whatever was done with it.
_OF_THE_COURSE = frozenset(("bags", "clinic", "viz", "workspace"))
_WORD = re.compile(r"[^\W\d]\w*")
_IN_WORKSPACE = re.compile(r"(?m)^\s*%%?(?:save|terminal)\b|\bworkspace\b")


@dataclass(frozen=True)
class Answer:
    """Describe the answer to one exercise as it stands on a page.

    Attributes:
        source: The cells that seem to belong to it, for a person to read.
        stored: The status that the page's own stored output says, such as `passed`; or empty.
    """

    exercise: str
    source: str = ""
    stored: str = ""


@dataclass(frozen=True)
class SubmittedPage:
    """Describe a page that was handed in.

    Attributes:
        job: What is to be run; None if all of its code is as the course has released it.
        answers: One for each exercise of the page, in order.
    """

    job: PageJob | None
    answers: tuple[Answer, ...]


def submitted_page(page: CoursePage, cells: Sequence[Cell], secret: int = 0) -> SubmittedPage:
    """Describe a page that was handed in.

    Args:
        page: The course's page.
        cells: The cells that were handed in.
        secret: The secret of the class; 0 gives the inputs of a page.
    """
    code = [cell for cell in cells if cell.sort == "code"]
    released = [cell.source for cell in page.cells if cell.sort == "code"]
    exercises = tuple(dict.fromkeys(wanted.exercise for wanted in page.wanted))
    answers = tuple(_answer(page, exercise, cells) for exercise in exercises)
    if not exercises or [cell.source for cell in code] == released:
        return SubmittedPage(None, answers)
    run = _to_run(page, code)
    digest = _digest(run)
    job = PageJob(
        page.number,
        run,
        {exercise: subject_of(page, exercise) for exercise in exercises},
        {exercise: _seed(secret, digest, exercise) for exercise in exercises},
        {
            exercise: json.dumps(EXERCISES[exercise].given(), sort_keys=True)
            for exercise in exercises
        },
        any(_IN_WORKSPACE.search(cell.source) for cell in run),
    )
    return SubmittedPage(job, answers)


# What is drawn for a page.


def _digest(cells: Iterable[PageCell]) -> str:
    text = json.dumps([cell.source for cell in cells])
    return sha256(text.encode()).hexdigest()


def _seed(secret: int, digest: str, exercise: str) -> int:
    """Return a number that is nobody's business to foresee, and that fits this page only."""
    if not secret:
        return 0
    drawn = sha256(f"{secret}\n{digest}\n{exercise}".encode()).digest()
    return int.from_bytes(drawn[:8], "big") >> (64 - _BITS) or 1


# The cells to run.


def checks_in(source: str) -> tuple[str, ...]:
    """Return the exercises that a cell checks, in order."""
    return tuple(dict.fromkeys(name.lower() for name in _CHECK.findall(source)))


@lru_cache(maxsize=256)
def subject_of(page: CoursePage, exercise: str) -> str:
    """Return the expression that the check of an exercise hands over, such as `HumiditySensor`."""
    cell = next((cell for cell in page.cells if cell.check == exercise), None)
    tree = ast.parse(cell.source) if cell else ast.Module([], [])
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    checks = [call for call in calls if getattr(call.func, "id", "") == "check" and call.args[1:]]
    return ast.unparse(checks[0].args[1]) if checks else "None"


def _to_run(page: CoursePage, code: Sequence[Cell]) -> tuple[PageCell, ...]:
    """Return the cells to run, in order."""
    released = {_shape(cell.source): cell for cell in page.cells if cell.sort == "code"}
    wanted = {cell.id: cell.exercise for cell in page.wanted}
    left = [cell for cell in code if _is_left_out(cell, released)]
    kept = [cell for cell in code if cell not in left]
    own = [cell for cell in kept if _shape(cell.source) not in released]
    touched = _words(own)
    needed = [cell for cell in left if _names(cell.source).touched & touched]
    while needed:
        kept += needed
        left = [cell for cell in left if cell not in needed]
        words = _words(kept)
        needed = [cell for cell in left if _names(cell.source).bound & words]
    return tuple(
        PageCell(
            cell.source,
            cell.place,
            cell.exercise or wanted.get(cell.id, ""),
            checks_in(cell.source),
        )
        for cell in sorted(kept, key=lambda cell: cell.place)
    )


def _is_left_out(cell: Cell, released: Mapping[str, Cell]) -> bool:
    """Return whether a cell is as released, and only shows something."""
    ours = released.get(_shape(cell.source))
    return ours is not None and ours.shows


def _words(cells: Iterable[Cell]) -> frozenset[str]:
    return frozenset(word for cell in cells for word in _WORD.findall(cell.source))


def _shape(source: str) -> str:
    """Return a cell's text without what a learner guesses in it."""
    return _CHOICES.sub("quiz()", _GUESS.sub("predict(____", source)).strip()


@dataclass(frozen=True)
class _Names:
    """Hold names of a cell: those that it defines, and those of objects that it may change."""

    bound: frozenset[str]
    touched: frozenset[str]


@lru_cache(maxsize=1024)
def _names(source: str) -> _Names:
    """Return the names in a cell of the course's own; those of a cell of a terminal are its."""
    terminal = _TERMINAL.match(source)
    if terminal:
        return _Names(frozenset((terminal[1],)), frozenset((terminal[1],)))
    bound: set[str] = set()
    used: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            bound.add(node.id)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            bound.add(node.name)
        elif isinstance(node, ast.alias):
            bound.add((node.asname or node.name).split(".")[0])
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            used.add(node.value.id)
    return _Names(frozenset(bound), frozenset(bound | used - _OF_THE_COURSE))


# What a person reads of an answer.


def _answer(page: CoursePage, exercise: str, cells: Sequence[Cell]) -> Answer:
    released = {cell.source.strip() for cell in page.cells}
    ids = {wanted.id for wanted in page.wanted if wanted.exercise == exercise}
    defining = _defining(subject_of(page, exercise))
    checks = [cell.place for cell in cells if exercise in checks_in(cell.source)]
    stored = [status for cell in cells for name, status in cell.stored if name == exercise]
    own = [cell for cell in cells if cell.exercise == exercise or (cell.id and cell.id in ids)]
    begin = min((cell.place for cell in own), default=len(cells))
    end = max(checks, default=-1)
    changed = [
        cell
        for cell in cells
        if cell.sort == "code"
        and cell.source.strip() not in released
        and not (checks_in(cell.source) and not defining.search(cell.source))
    ]
    chosen = [
        cell
        for cell in changed
        if cell in own or defining.search(cell.source) or begin < cell.place < end
    ]
    text = "\n\n".join(cell.source for cell in chosen or own[:1])
    return Answer(exercise, text, stored[-1] if stored else "")


@lru_cache(maxsize=256)
def _defining(subject: str) -> re.Pattern[str]:
    """Return a pattern for the lines that define what a check hands over."""
    tree = ast.parse(subject, mode="eval").body
    name = re.escape(tree.id) if isinstance(tree, ast.Name) else r"(?!)"
    return re.compile(rf"(?m)^\s*(?:(?:class|(?:async\s+)?def)\s+{name}\b|{name}\s*(?::[^=\n]+)?=)")
