"""What nbgrader has to know of a page: which cells are answers, and which cells give points.

An institution that runs nbgrader or JupyterHub can use the pages as they are. The fields and their
meaning are those of the schema's version 3 (`nbgrader/nbgraderformat/v3.py`); nothing of this is
looked at by the course itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from nbformat import NotebookNode

from rosbeat.authoring.transforms import Transform

SCHEMA = 3
#: What an exercise is worth that nobody says anything about.
USUAL = 1
NO_POINTS: Mapping[str, int] = MappingProxyType({})


def mark_for_nbgrader(points: Mapping[str, int]) -> Transform:
    """Make the step that tells nbgrader what the cells of exercises and checks are.

    The cells of an answer become solution cells, which learners change; the check below them
    becomes a locked cell, which nbgrader puts back before it grades, and which gives the points.

    Args:
        points: What each exercise is worth, by its id; one point where nothing is said.
    """

    def mark(page: NotebookNode) -> NotebookNode:
        parts: Counter[str] = Counter()
        for cell in page.cells:
            role = cell.metadata.get("rosbeat", {})
            if "exercise" in role:
                parts[role.exercise] += 1
                cell.metadata.nbgrader = _answer(role.exercise, parts[role.exercise])
            elif "check" in role:
                cell.metadata.nbgrader = _check(role.check, points.get(role.check, USUAL))
        return page

    return mark


def _answer(exercise: str, part: int) -> NotebookNode:
    """The cell of an answer; a second one of the same exercise has a name of its own."""
    name = exercise if part == 1 else f"{exercise}-{part}"
    return _role(name, solution=True)


def _check(exercise: str, points: int) -> NotebookNode:
    return _role(f"{exercise}-check", grade=True, locked=True, points=points)


def _role(name: str, **known: Any) -> NotebookNode:  # noqa: ANN401 - a field of any plain type
    none = {"grade": False, "locked": False, "solution": False, "task": False}
    return NotebookNode({**none, "grade_id": name, "schema_version": SCHEMA, **known})
