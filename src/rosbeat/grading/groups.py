"""Group similar answers: those that differ only in layout, or only in layout and chosen names.

An instructor can mark all answers of a group at once. That answers are similar, or equal to the
published solution, is no evidence of copying: a short exercise has few right answers.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from hashlib import sha256

from rosbeat.exercises.exercise import FAILED, NOT_ATTEMPTED, PASSED
from rosbeat.grading.marks import HELD, LOOKED_AT, MISSING, Gradebook, Graded, Mark

#: The order in which a person looks at groups.
_ORDER = (HELD, FAILED, LOOKED_AT, NOT_ATTEMPTED, PASSED)
#: What is said of a group whose answers are the published solution.
EQUAL = "equal to the published solution but for names and layout"


@dataclass(frozen=True)
class Group:
    """Hold answers to one exercise that are alike, with equal outcomes.

    Attributes:
        members: Whose they are, and their marks.
        solution: `EQUAL` if they are the published solution; or empty.
    """

    exercise: str
    members: tuple[tuple[Graded, Mark], ...]
    solution: str = ""

    @property
    def first(self) -> Mark:
        """Return the answer that is shown for all of them."""
        return self.members[0][1]


@lru_cache(maxsize=20_000)
def shape_of(source: str) -> str:
    """Return a digest of a program, whatever its layout, comments, docstrings and own names.

    What is no Python is compared by its words.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of escapes in a learner's text
            tree = _without_docstrings(ast.parse(source))
        return _digest(ast.dump(_Renaming(tree).visit(tree)))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return _digest(" ".join(source.split()))


def _digest(text: str) -> str:
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def _without_docstrings(tree: ast.Module) -> ast.Module:
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if isinstance(body, list):
            kept = [one for one in body if not _is_text(one)]
            node.body = kept or [ast.Pass()]  # type: ignore[attr-defined]  # it has one
    return tree


def _is_text(node: ast.AST) -> bool:
    return (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    )


class _Renaming(ast.NodeTransformer):
    """Replace the names that a program gives by numbers, in the order in which they come.

    Names that come from elsewhere stay: those of ROS and of Python, and of arguments given by name.
    """

    def __init__(self, tree: ast.Module) -> None:
        self._own: set[str] = set()
        self._attributes: set[str] = set()
        self._numbers: dict[str, str] = {}
        for node in ast.walk(tree):
            self._collect(node)

    def _collect(self, node: ast.AST) -> None:
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            self._own.add(node.id)
        elif isinstance(node, ast.arg):
            self._own.add(node.arg)
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            self._own.add(node.name)
            methods = (one for one in node.body if isinstance(one, ast.FunctionDef))
            if isinstance(node, ast.ClassDef):
                self._attributes.update(one.name for one in methods)
        elif isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store) and _is_self(node):
            self._attributes.add(node.attr)

    def _number(self, name: str) -> str:
        return self._numbers.setdefault(name, f"#{len(self._numbers)}")

    def visit_Name(self, node: ast.Name) -> ast.AST:
        """Rename a variable."""
        if node.id in self._own:
            node.id = self._number(node.id)
        return node

    def visit_arg(self, node: ast.arg) -> ast.AST:
        """Rename a parameter."""
        node.arg = self._number(node.arg)
        return self.generic_visit(node)

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        """Rename a function or a method."""
        node.name = self._number("." * (node.name in self._attributes) + node.name)
        return self.generic_visit(node)

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        """Rename a class."""
        node.name = self._number(node.name)
        return self.generic_visit(node)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        """Rename an attribute or a method of the answer's own object."""
        if node.attr in self._attributes and _is_self(node):
            node.attr = self._number(f".{node.attr}")
        return self.generic_visit(node)


def _is_self(node: ast.Attribute) -> bool:
    return isinstance(node.value, ast.Name) and node.value.id == "self"


def groups_of(book: Gradebook) -> tuple[Group, ...]:
    """Group the answers of a class, by exercise in the order of the course.

    Within an exercise come first those that wait for a person, then those that failed; large groups
    come before small ones. Pages that were not handed in are left out.
    """
    solutions = {one.exercise: shape_of(one.source) for one in book.solutions}
    found: dict[tuple[str, ...], list[tuple[Graded, Mark]]] = {}
    exercises: dict[str, int] = {}
    for graded, mark in _answers(book):
        exercises.setdefault(mark.exercise, len(exercises))
        key = (mark.exercise, shape_of(mark.source), mark.status, mark.mistake)
        found.setdefault(key, []).append((graded, mark))
    groups = (_group(members, solutions) for members in found.values())
    return tuple(sorted(groups, key=lambda one: (exercises[one.exercise], *_rank(one))))


def _answers(book: Gradebook) -> Iterator[tuple[Graded, Mark]]:
    for graded in book.learners:
        yield from ((graded, mark) for mark in graded.marks if mark.status != MISSING)


def _group(members: Iterable[tuple[Graded, Mark]], solutions: dict[str, str]) -> Group:
    members = tuple(members)
    mark = members[0][1]
    is_solution = mark.source.strip() and shape_of(mark.source) == solutions.get(mark.exercise)
    return Group(mark.exercise, members, EQUAL if is_solution else "")


def _rank(group: Group) -> tuple[int, int, str]:
    status = group.first.status
    place = _ORDER.index(status) if status in _ORDER else len(_ORDER)
    return place, -len(group.members), group.members[0][0].learner
