"""Define the rules of a lesson, one function each.

A rule takes a `Desk` (the lesson, its neighbours, the course's folders) and yields a `Finding` for
every place that breaks it; the function's name is the rule's. To add a rule, append it to `LINTS`.
Rules protect learners and builds from answers that can be read, pages that stop, and links that
lead nowhere. `docs/authoring.md` describes how a good page reads; no rule counts words.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from urllib.parse import unquote

import rosbeat
from rosbeat.authoring.source import (
    BLANK,
    Course,
    Lesson,
    SourceCell,
    find_blocks,
    with_answers,
    with_blanks_in_place,
)
from rosbeat.errors import LessonError

_FENCE = re.compile(r"^ {0,3}(```|~~~)")
_MAGIC = re.compile(r"^(\s*)[%!?].*|^(\s*)\S+\?$")
_LINK = re.compile(r"(?P<image>!?)\[(?P<text>[^\]]*)\]\((?P<target>[^)\s]*)(?:\s+\"[^\"]*\")?\)")
_ELSEWHERE = ("http://", "https://", "mailto:")
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
_COMMENT = re.compile(r"(^|\s)#.*")
# Shorter lines of an answer (`pass`, `return`, `count = 0`) are everybody's.
_SHORTEST = 12
# So is this one: an answer that is a whole class begins with it, like any class.
_EVERYBODYS = {"def__init__(self):"}


@dataclass(frozen=True)
class Finding:
    """Describe a violation: the position in a file, and the rule that is broken.

    Attributes:
        line: Line in the lesson source, counted from 1.
        what: Description of the violation.
        to_try: How to fix it.
        file: The lesson source.
        lint: Name of the rule.
    """

    line: int
    what: str
    to_try: str = ""
    file: str = ""
    lint: str = ""

    def __str__(self) -> str:
        cure = f" {self.to_try}" if self.to_try else ""
        return f"{self.file}:{self.line}: {self.lint}: {self.what}{cure}"


@dataclass(frozen=True)
class Desk:
    """Hold the lesson to check, all lessons, and the folders that links may point into."""

    course: Course
    lessons: tuple[Lesson, ...]
    lesson: Lesson

    @cached_property
    def learner_cells(self) -> list[SourceCell]:
        """Return the cells of the learner's page, answers still inside."""
        return [cell for cell in self.lesson.cells if cell.only != "solution"]

    @cached_property
    def code(self) -> list[SourceCell]:
        """Return the code cells of the learner's page."""
        return [cell for cell in self.learner_cells if cell.kind == "code"]

    @cached_property
    def python(self) -> list[SourceCell]:
        """Return the code cells of the learner's page that hold Python."""
        return [cell for cell in self.code if cell.is_python]


Lint = Callable[[Desk], Iterator[Finding]]


def check_lessons(course: Course, lessons: list[Lesson], chosen: list[Lesson]) -> list[Finding]:
    """Apply every rule to the chosen lessons; return what breaks one, by file and line."""
    found = []
    for lesson in chosen:
        desk = Desk(course, tuple(lessons), lesson)
        # The other rules rely on the markers.
        for lint in [answer_markers] if any(answer_markers(desk)) else LINTS:
            name = lint.__name__.replace("_", "-")
            file = f"src/lessons/{lesson.path.name}"
            found += [replace(one, file=file, lint=name) for one in lint(desk)]
    return sorted(found, key=lambda one: (one.file, one.line, one.lint))


# Answers and blanks.


def answer_markers(desk: Desk) -> Iterator[Finding]:
    """Require that markers are closed, in order, not nested, and that a blank holds a blank."""
    for cell in desk.lesson.cells:
        try:
            find_blocks(cell.source, "", cell.line)
        except LessonError as error:
            _, line, what = error.what.split(":", 2)
            yield Finding(int(line), what.strip(), error.to_try)


def leaked_answer(desk: Desk) -> Iterator[Finding]:
    """Require that no line of an answer stands anywhere else on the learner's page."""
    answers = {key: line for cell in desk.code for key, line in _distinctive(cell)}
    for line, text in _page_texts(desk):
        for key, answer in answers.items():
            if key in _squeeze(text):
                rows = [_squeeze(row) for row in text.split("\n")]
                yield Finding(
                    line + next((n for n, row in enumerate(rows) if key in row), 0),
                    f"the answer {answer.strip()!r} can be read here.",
                    "Reword this place, or move the line out of the answer.",
                )


def _distinctive(cell: SourceCell) -> Iterator[tuple[str, str]]:
    for block in find_blocks(cell.source):
        for line in block.answer:
            key = _squeeze(_COMMENT.sub("", line))
            if len(key) >= _SHORTEST and key not in _EVERYBODYS:
                yield key, line


def _page_texts(desk: Desk) -> Iterator[tuple[int, str]]:
    for cell in desk.learner_cells:
        yield cell.line, learner_text(cell)
        for line, target in _targets(cell):
            image = _resolve(desk, target.partition("#")[0])
            # A drawing is text too, and its labels are on the page.
            if image.suffix == ".svg" and image.is_file():
                yield line, image.read_text(encoding="utf-8").replace("\n", " ")


def _squeeze(text: str) -> str:
    return re.sub(r"[\s'\"`]+", "", text)


def syntax(desk: Desk) -> Iterator[Finding]:
    """Require that code is Python on both pages, with blanks and with answers."""
    for cell in desk.python:
        texts = {"learner's": learner_text(cell), "solution": with_answers(cell.source)}
        wrong = [page for page, text in texts.items() if tree_of(text) is None]
        if wrong:
            what = f"this cell is not Python on the {wrong[0]} page."
            cure = "A forgotten [markdown]? A blank that is only half a line?"
            yield Finding(cell.line, what, cure)


def blank_outside_function(desk: Desk) -> Iterator[Finding]:
    """Require that a blank does not run with its cell, which would end the untouched page."""
    for cell in (cell for cell in desk.python if cell.runs):
        for node in _run_at_once(learner_text(cell)):
            if BLANK in _names(node):
                yield Finding(
                    cell.line + getattr(node, "lineno", 1) - 1,
                    f"{BLANK} would be run at once, and the untouched page would stop here.",
                    "Move it into the body of a function or method.",
                )


def stray_blank(desk: Desk) -> Iterator[Finding]:
    """Require that blanks stand in exercises and predictions only."""
    for cell in (cell for cell in desk.code if not (cell.exercise or cell.predict)):
        for number, line in enumerate(learner_text(cell).split("\n"), cell.line):
            if BLANK in line:
                what = f"{BLANK} stands outside of an exercise."
                yield Finding(number, what, 'Mark the cell exercise="..".')


# Exercises, checks and predictions.


def answer_outside_exercise(desk: Desk) -> Iterator[Finding]:
    """Require that answers stand in exercises and predictions, and that an exercise has one."""
    for cell in desk.lesson.cells:
        blocks = find_blocks(cell.source)
        if blocks and (cell.kind != "code" or not (cell.exercise or cell.predict)):
            line = cell.line + blocks[0].line
            cure = f"Begin the cell with '# %% exercise=\"{desk.lesson.number}a\"'."
            yield Finding(line, "this is no exercise cell.", cure)
        if cell.exercise and not blocks:
            what = f"exercise {cell.exercise} has no answer."
            yield Finding(cell.line, what)
        if cell.only and (cell.exercise or cell.check):
            what = "an exercise or its check stands on both pages."
            yield Finding(cell.line, what, "Remove only=.")


def exercise_pairs(desk: Desk) -> Iterator[Finding]:
    """Require that every exercise has one check below it, and every check its exercise."""
    known: set[str] = set()
    checks = Counter(cell.check for cell in desk.lesson.cells if cell.check)
    for cell in desk.lesson.cells:
        known |= {cell.exercise} if cell.exercise else set()
        if cell.exercise and checks[cell.exercise] != 1:
            what = f"exercise {cell.exercise} has {checks[cell.exercise]} check cells."
            cure = f"Give it one, with '# %% check=\"{cell.exercise}\"'."
            yield Finding(cell.line, what, cure)
        if cell.check and cell.check not in known:
            what = f"check {cell.check} has no exercise above it."
            yield Finding(cell.line, what)


def predictions(desk: Desk) -> Iterator[Finding]:
    """Require that the learner's page asks, the solution page answers, and both run."""
    for cell in desk.lesson.cells:
        what, cure = _prediction_flaw(cell)
        if what:
            yield Finding(cell.line, what, cure)


def _prediction_flaw(cell: SourceCell) -> tuple[str, str]:
    """Return what is wrong with a cell's predictions and what to do; empty texts for nothing."""
    answered = _guesses(with_answers(cell.source)) if cell.is_python else []
    if not cell.predict:
        cure = "Begin the cell with '# %% predict=true'."
        return ("predict is called in a cell that is not marked.", cure) if answered else ("", "")
    if cell.kind != "code" or cell.magic or cell.exercise or cell.check or cell.only:
        return "a prediction stands in a cell that is something else, too.", "Make two cells of it."
    if not find_blocks(cell.source):
        return "the prediction has no answer.", "Put predict(...) between the answer markers."
    asked = _guesses(learner_text(cell))
    if not asked or len(asked) != len(answered) or set(asked) != {BLANK}:
        cure = (
            f'On the learner\'s page its first argument is "{BLANK}", in quotes, so that it runs.'
        )
        return "the learner's page asks for no prediction.", cure
    if BLANK in answered:
        return "the solution page makes no prediction.", "Put the right guess into the answer."
    return "", ""


def _guesses(text: str) -> list[object]:
    """Return the first argument of every call of `predict`, None for what is no constant."""
    return [
        getattr(node.args[0], "value", None)
        for node in ast.walk(tree_of(text) or ast.Module([], []))
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "predict" and node.args
    ]


def unfolded_answer(desk: Desk) -> Iterator[Finding]:
    """Require that what answers a prediction is folded on the learner's page, and nothing else.

    That is the first text below it, and the heading above it says no more than the prediction asks.
    """
    is_asked, heading = False, ""
    for cell in desk.learner_cells:
        if cell.predict:
            if heading.startswith("What went wrong:"):
                what = f"the heading {heading!r} answers this prediction."
                yield Finding(cell.line, what, "Say in the heading what is done, and no more.")
            is_asked = True
        if cell.answers and (cell.kind != "markdown" or not is_asked or any(headings(cell))):
            what = "answers=true is for a text without headings, below a prediction."
            yield Finding(cell.line, what, "Remove it, or give the heading a cell of its own.")
        elif cell.kind == "markdown" and is_asked and not cell.answers:
            what = "this text can be read before the prediction above it is made."
            cure = (
                "Begin what answers it with '# %% [markdown] answers=true', in a cell of its own."
            )
            yield Finding(cell.line, what, cure)
        if cell.kind == "markdown":
            is_asked = False
            heading = [heading, *(text for _, text in headings(cell))][-1]


def needless_import(desk: Desk) -> Iterator[Finding]:
    """Require that a page imports nothing that its kernel brings; a file imports what it uses."""
    brought = set(rosbeat.__all__)
    for cell in (cell for cell in desk.python if not cell.saved_as):
        for node in ast.walk(tree_of(learner_text(cell)) or ast.Module([], [])):
            if isinstance(node, ast.ImportFrom) and node.module == "rosbeat":
                names = [one.name for one in node.names if one.name in brought]
                if names:
                    what = f"every page knows {', '.join(names)} without an import."
                    yield Finding(cell.line + node.lineno - 1, what, "Remove it.")


# Links, images, headings and paths.


def broken_link(desk: Desk) -> Iterator[Finding]:
    """Require that a link leads to a file of the course, a page, or a heading that exists."""
    for cell in desk.lesson.cells:
        for line, target in _targets(cell):
            problem = _link_problem(desk, target)
            if problem:
                yield Finding(line, f"{target!r} leads nowhere: {problem}.")


def alt_text(desk: Desk) -> Iterator[Finding]:
    """Require that an image has words for those who do not see it."""
    for cell in desk.lesson.cells:
        for line, text in prose_lines(cell):
            named = all(m["text"].strip() for m in _LINK.finditer(text) if m["image"])
            if not named or "<img" in text.lower():
                what = "an image has no alternative text."
                cure = "Say in words what it shows: ![what it shows](image.svg)."
                yield Finding(line, what, cure)


def _targets(cell: SourceCell) -> Iterator[tuple[int, str]]:
    for line, text in prose_lines(cell):
        plain = re.sub(r"`[^`]*`", "", text)
        yield from ((line, match["target"]) for match in _LINK.finditer(plain))


def _link_problem(desk: Desk, target: str) -> str:
    if target.startswith(_ELSEWHERE):
        return ""
    file, _, anchor = target.partition("#")
    lesson = desk.lesson if not file else _lesson_at(desk, _resolve(desk, file))
    if lesson is None:
        return "" if _resolve(desk, file).exists() else "there is no such file"
    # What JupyterLab makes of a heading: markup gone, spaces to hyphens, letters as they are.
    titles = [text for cell in lesson.cells for _, text in headings(cell)]
    known = {re.sub(r"[`*]", "", text).replace(" ", "-") for text in titles}
    return f"{lesson.name} has no such heading" if anchor and unquote(anchor) not in known else ""


def _resolve(desk: Desk, file: str) -> Path:
    # Both trees lie side by side, so a relative link leads to the same place from either.
    return Path(desk.course.notebooks, unquote(file))


def _lesson_at(desk: Desk, path: Path) -> Lesson | None:
    trees = (desk.course.notebooks.resolve(), desk.course.solutions.resolve())
    names = {lesson.name: lesson for lesson in desk.lessons}
    is_page = path.suffix == ".ipynb" and path.resolve().parent in trees
    return names.get(path.stem) if is_page else None


def title(desk: Desk) -> Iterator[Finding]:
    """Require that the page opens with the header's title, the only heading of level 1."""
    wanted = desk.lesson.header.title
    found = [row for cell in desk.learner_cells for row in headings(cell)]
    tops = [text for level, text in found if level == 1]
    opening = [text for cell in desk.lesson.cells[:1] for _, text in headings(cell)][:1]
    if tops != [wanted] or opening != [wanted]:
        what = f"the page has the headings {tops} of level 1; it opens with exactly one."
        yield Finding(1, what, f"Begin the first cell with '# # {wanted}', as the header says.")


# What rules look at.


def learner_text(cell: SourceCell) -> str:
    """Return what a learner sees of a cell, on the lines it has in the source."""
    return with_blanks_in_place(cell.source) if cell.kind == "code" else cell.source


def tree_of(text: str) -> ast.Module | None:
    """Parse code, with IPython's magics out of the way; None if it is no Python."""
    if text.lstrip().startswith("%%"):
        return ast.Module([], [])
    plain = [_MAGIC.sub(lambda m: f"{m[1] or m[2] or ''}pass", line) for line in text.split("\n")]
    try:
        return ast.parse("\n".join(plain))
    except SyntaxError:
        return None


def prose_lines(cell: SourceCell) -> Iterator[tuple[int, str]]:
    """Yield the lines of a markdown cell that are not fenced code, with their source lines."""
    fence = ""
    for number, line in enumerate(cell.source.split("\n"), cell.line):
        match = _FENCE.match(line)
        if match and fence in ("", match[1]):
            fence = "" if fence else match[1]
        elif not fence and cell.kind == "markdown":
            yield number, line


def headings(cell: SourceCell) -> Iterator[tuple[int, str]]:
    """Yield the headings of a cell: level, text."""
    for _, line in prose_lines(cell):
        match = re.match(r"(#{1,6}) +(.*?) *#*$", line)
        if match:
            yield len(match[1]), match[2]


def _run_at_once(text: str) -> Iterator[ast.AST]:
    """Yield what is evaluated when a cell runs: everything but the bodies of functions."""
    todo: list[ast.AST] = [tree_of(text) or ast.Module([], [])]
    for node in todo:
        yield node
        for name, value in ast.iter_fields(node):
            if name != "body" or not isinstance(node, _FUNCTIONS):
                children = value if isinstance(value, list) else [value]
                todo += [child for child in children if isinstance(child, ast.AST)]


def _names(node: ast.AST) -> set[object]:
    return {getattr(node, field, None) for field in ("id", "attr", "arg", "name")}


LINTS: tuple[Lint, ...] = (
    leaked_answer,
    syntax,
    blank_outside_function,
    stray_blank,
    answer_outside_exercise,
    exercise_pairs,
    predictions,
    unfolded_answer,
    needless_import,
    broken_link,
    alt_text,
    title,
)
"""Every rule but `answer_markers`, which comes first: the others rely on it."""
