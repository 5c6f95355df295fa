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
from dataclasses import dataclass, replace
from functools import lru_cache
from hashlib import sha256

from rosbeat.exercises.cells import answer_in
from rosbeat.exercises.registry import EXERCISES
from rosbeat.page_runs.jobs import PageCell, PageJob
from rosbeat.page_runs.notebook import Cell, CoursePage

#: What is said of an answer if no cell of the page names it.
NOT_THERE = "No cell of the page defines it."
_BITS = 63
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
        is_tried: Whether a cell of it is not as the course has released it.
    """

    exercise: str
    source: str = ""
    stored: str = ""
    is_tried: bool = False


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
    digest = _digest(code)
    subjects = {exercise: subject_of(page, exercise) for exercise in exercises}
    seeds = {exercise: _seed(secret, digest, exercise) for exercise in exercises}
    job = _job(page.number, _to_run(page, code), subjects)
    return SubmittedPage(replace(job, seeds=seeds), answers)


def own_page(number: str, code: Sequence[Cell], subjects: Mapping[str, str]) -> PageJob:
    """Return how a learner's own page is run: all of its code, with the inputs of a page.

    Args:
        number: The page's two digits.
        code: Its code cells.
        subjects: The expression that is checked for each exercise, such as `HumiditySensor`.
    """
    return _job(number, [_page_cell(cell, {}) for cell in code], subjects)


def _job(number: str, cells: Sequence[PageCell], subjects: Mapping[str, str]) -> PageJob:
    given = {name: json.dumps(EXERCISES[name].given(), sort_keys=True) for name in subjects}
    needs_files = any(_IN_WORKSPACE.search(cell.source) for cell in cells)
    return PageJob(number, tuple(cells), subjects, dict.fromkeys(subjects, 0), given, needs_files)


def _page_cell(cell: Cell, wanted: Mapping[str, str]) -> PageCell:
    exercise = cell.exercise or wanted.get(cell.id, "")
    return PageCell(cell.source, cell.place, exercise, cell.checked)


# What is drawn for a page.


def _digest(cells: Iterable[Cell]) -> str:
    text = json.dumps([cell.source for cell in cells])
    return sha256(text.encode()).hexdigest()


def _seed(secret: int, digest: str, exercise: str) -> int:
    """Return a number that is nobody's business to foresee, and that fits this page only."""
    if not secret:
        return 0
    drawn = sha256(f"{secret}\n{digest}\n{exercise}".encode()).digest()
    return int.from_bytes(drawn[:8], "big") >> (64 - _BITS) or 1


# The cells to run.


@lru_cache(maxsize=256)
def subject_of(page: CoursePage, exercise: str) -> str:
    """Return the expression that the check of an exercise hands over, such as `HumiditySensor`."""
    cell = next((cell for cell in page.cells if cell.check == exercise), None)
    return (subject_in(cell.source, exercise) if cell else "") or "None"


def subject_in(source: str, exercise: str) -> str:
    """Return the expression that a cell's check of an exercise hands over; empty if none does."""
    answer = answer_in(source, exercise)
    return ast.unparse(answer) if answer else ""


def _to_run(page: CoursePage, code: Sequence[Cell]) -> tuple[PageCell, ...]:
    """Return the cells to run, in order."""
    released = {_shape(cell.source): cell for cell in page.cells if cell.sort == "code"}
    wanted = {cell.id: cell.exercise for cell in page.wanted}
    left = [cell for cell in code if _is_left_out(cell, released)]
    kept = [cell for cell in code if cell not in left]
    own = [cell for cell in kept if _shape(cell.source) not in released]
    words = frozenset(word for cell in own for word in _WORD.findall(cell.source))
    needed = [cell for cell in left if _names(cell.source).touched & words]
    left = [cell for cell in left if cell not in needed]
    kept += needed
    while True:
        names = words.union(*(_names(cell.source).free for cell in kept if cell not in own))
        needed = [cell for cell in left if _names(cell.source).bound & names]
        if not needed:
            break
        kept += needed
        left = [cell for cell in left if cell not in needed]
    return tuple(_page_cell(cell, wanted) for cell in sorted(kept, key=lambda cell: cell.place))


def _is_left_out(cell: Cell, released: Mapping[str, Cell]) -> bool:
    """Return whether a cell is as released, and only shows something."""
    ours = released.get(_shape(cell.source))
    return ours is not None and ours.shows


def _shape(source: str) -> str:
    """Return a cell's text without what a learner guesses in it."""
    return _CHOICES.sub("quiz()", _GUESS.sub("predict(____", source)).strip()


@dataclass(frozen=True)
class _Names:
    """Hold names of a cell of the course's own.

    Attributes:
        bound: Those that it defines.
        free: Those that it may ask for, since it has not defined them before.
        touched: Those of objects that it may change, and those that it defines.
    """

    bound: frozenset[str] = frozenset()
    free: frozenset[str] = frozenset()
    touched: frozenset[str] = frozenset()


@lru_cache(maxsize=1024)
def _names(source: str) -> _Names:
    """Return the names of a cell; a cell of a terminal has that of the terminal."""
    terminal = _TERMINAL.match(source)
    if terminal:
        name = frozenset((terminal[1],))
        return _Names(name, name, name)
    try:
        statements = ast.parse(source).body
    except SyntaxError:  # another command of a page
        return _Names(free=frozenset(_WORD.findall(source)))
    bound: set[str] = set()
    free: set[str] = set()
    used: set[str] = set()
    for statement in statements:
        nodes = list(ast.walk(statement))
        names = [node for node in nodes if isinstance(node, ast.Name)]
        loaded = {node.id for node in names if not isinstance(node.ctx, ast.Store)}
        free |= loaded - bound
        bound |= {node.id for node in names if isinstance(node.ctx, ast.Store)}
        bound |= {name for node in nodes for name in _defined_by(node)}
        attributes = [node.value for node in nodes if isinstance(node, ast.Attribute)]
        used |= {value.id for value in attributes if isinstance(value, ast.Name)}
    return _Names(frozenset(bound), frozenset(free), frozenset(bound | used - _OF_THE_COURSE))


def _defined_by(node: ast.AST) -> tuple[str, ...]:
    if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
        return (node.name,)
    if isinstance(node, ast.alias):
        return ((node.asname or node.name).split(".")[0],)
    return ()


# What a person reads of an answer.


def _answer(page: CoursePage, exercise: str, cells: Sequence[Cell]) -> Answer:
    released = {cell.source.strip() for cell in page.cells}
    ids = {wanted.id for wanted in page.wanted if wanted.exercise == exercise}
    defining = _defining(subject_of(page, exercise))
    checks = [cell.place for cell in cells if exercise in cell.checked]
    stored = [status for cell in cells for name, status in cell.stored if name == exercise]
    own = [cell for cell in cells if cell.exercise == exercise or (cell.id and cell.id in ids)]
    begin = min((cell.place for cell in own), default=len(cells))
    end = max(checks, default=-1)
    changed = [
        cell
        for cell in cells
        if cell.sort == "code"
        and cell.source.strip() not in released
        and not (cell.checked and not defining.search(cell.source))
    ]
    chosen = [
        cell
        for cell in changed
        if cell in own or defining.search(cell.source) or begin < cell.place < end
    ]
    text = "\n\n".join(cell.source for cell in chosen or own[:1])
    return Answer(exercise, text, stored[-1] if stored else "", bool(chosen))


@lru_cache(maxsize=256)
def _defining(subject: str) -> re.Pattern[str]:
    """Return a pattern for the lines that define what a check hands over."""
    tree = ast.parse(subject, mode="eval").body
    name = re.escape(tree.id) if isinstance(tree, ast.Name) else r"(?!)"
    return re.compile(rf"(?m)^\s*(?:(?:class|(?:async\s+)?def)\s+{name}\b|{name}\s*(?::[^=\n]+)?=)")
