"""A learner meets few names that are the course's own: the rest of a page is ROS and Python.

Counted are the names that a page imports from `rosbeat`, the attributes of what they give, such as
sessions, terminals and records, the options of both, and `%%terminal` and `%%save` with theirs.
`python tests/test_names.py` lists them, with the pages that use them.
"""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

import rosbeat
from rosbeat.authoring.lint import tree_of
from rosbeat.authoring.source import SourceCell, read_lesson, with_answers

LESSONS = Path(__file__).resolve().parents[1] / "src" / "lessons"
#: What a page is given: modules, and classes in them.
GIVEN = {
    "rosbeat.page_session": ("Session",),
    "rosbeat.viz": (),
    "rosbeat.viz.picture": ("Picture",),
    "rosbeat.workspace": (),
    "rosbeat.workspace.terminals.terminal": ("Terminal",),
    "rosbeat.bags": (),
    "rosbeat.bags.bag": ("Bag",),
    "rosbeat.clinic": (),
    "rosbeat.clinic.patients": ("Patient", "Ward"),
    "rosbeat.ros.simulated_program": ("SimulatedProgram",),
    "rosbeat.diagnosis.silence": ("Explanation", "Diagnosis"),
    "rosbeat.comparisons": ("Comparison", "Difference"),
    "rosbeat.records": (
        *("Sample", "LogRecord", "CallbackRecord", "Endpoint", "GraphSnapshot"),
        *("Observation", "QoS", "Fault"),
    ),
}
#: The receivers of attributes that are ROS, not the course: messages, and what a client is given.
FOREIGN = {"self", "msg", "message", "request", "response", "result", "goal", "goal_handle"}
#: At most so many names, and options of them, on the pages of the tutorial, and on all pages.
MOST = {"06": (35, 12), "13": (59, 26)}


def given() -> frozenset[str]:
    """Return the public attributes of what a page is given."""
    found: set[str] = set()
    for module_name, classes in GIVEN.items():
        module = import_module(module_name)
        if not classes:
            found |= set(module.__all__)
        for name in classes:
            one = getattr(module, name)
            own = re.findall(r"\bself\.(\w+)(?:: [^=\n]+)? = ", inspect.getsource(one))
            found |= {*dir(one), *getattr(one, "__annotations__", ()), *own}
    return frozenset(name for name in found if not name.startswith("_"))


def names_in(cell: SourceCell, ours: frozenset[str], known: set[str]) -> Iterator[str]:
    """Return the names of the course in a cell.

    Args:
        cell: The cell, answers included.
        ours: The public attributes of what a page is given.
        known: The names of the course that the page has so far; imports are added.
    """
    if cell.magic:
        yield from re.findall(r"%%?[a-z]+|--[a-z-]+", cell.magic)
    tree = tree_of(with_answers(cell.source)) if cell.is_python else None
    foreign = set(FOREIGN)
    for node in ast.walk(tree or ast.Module([], [])):
        if isinstance(node, ast.ImportFrom) and str(node.module).startswith("rosbeat"):
            known |= {one.name for one in node.names}
            yield from (one.name for one in node.names)
    for node in _outside_of_nodes(tree):
        if isinstance(node, ast.Name) and node.id in rosbeat.__all__:  # every page knows them
            yield node.id
        if isinstance(node, ast.Attribute) and node.attr in ours and _is_ours(node.value, foreign):
            yield node.attr
        if isinstance(node, ast.Call) and _is_called_on_ours(node.func, ours, known, foreign):
            yield from (f"{one.arg}=" for one in node.keywords if one.arg)


def _outside_of_nodes(tree: ast.Module | None) -> Iterator[ast.AST]:
    """Return what stands outside of classes: in a node, everything is ROS."""
    todo: list[ast.AST] = [tree] if tree else []
    while todo:
        node = todo.pop()
        if not isinstance(node, ast.ClassDef):
            yield node
            todo += ast.iter_child_nodes(node)


def _is_ours(receiver: ast.expr, foreign: set[str]) -> bool:
    words = set(re.findall(r"\w+", ast.unparse(receiver)))
    root = re.match(r"\w*", ast.unparse(receiver))
    asked = words & {"get_parameter", "get_clock", "result", "request", "offers", "asks"}
    modules = {"rclpy", "time", "random", "math", "sys", "struct", "sqlite3", "subprocess", "os"}
    return not asked and (root is None or root.group() not in foreign | modules)


def _is_called_on_ours(
    func: ast.expr, ours: frozenset[str], known: set[str], foreign: set[str]
) -> bool:
    if isinstance(func, ast.Attribute):
        return func.attr in ours and _is_ours(func.value, foreign)
    return isinstance(func, ast.Name) and func.id in known


def names_of(path: Path) -> set[str]:
    """Return the names of the course on a page.

    Args:
        path: The source of the page.
    """
    known = set(rosbeat.__all__)
    ours = given()
    return {name for cell in read_lesson(path).cells for name in names_in(cell, ours, known)}


def met() -> dict[str, list[str]]:
    """Return the names of the course, each with the pages that use it."""
    found: dict[str, list[str]] = {}
    for path in sorted(LESSONS.glob("[0-9]*.py")):
        for name in names_of(path):
            found.setdefault(name, []).append(path.name[:2])
    return found


def until(last: str) -> dict[str, list[str]]:
    """Return the names on the pages up to one.

    Args:
        last: The number of that page.
    """
    return {name: pages for name, pages in met().items() if pages[0] <= last}


def is_option(name: str) -> bool:
    """Return whether a name is an argument's, or an option of a command."""
    return name.startswith("--") or name.endswith("=")


@pytest.mark.parametrize("last", MOST)
def test_a_learner_meets_few_names_that_are_not_of_ros(last: str) -> None:
    found = until(last)
    options = [name for name in found if is_option(name)]
    assert len(found) - len(options) <= MOST[last][0], found
    assert len(options) <= MOST[last][1], options


def test_names_are_found_and_those_of_ros_are_not() -> None:
    names = until("06")
    assert {"Session", "add", "run", "queue", "seconds=", "returncode", "%%terminal"} <= set(names)
    assert not {"create_publisher", "spin", "data", "lambda", "observation", "queue_steps"} & set(
        names
    )


if __name__ == "__main__":
    for last in MOST:
        rows = until(last)
        options = sum(map(is_option, rows))
        print(f"{len(rows) - options} names and {options} options on the pages up to {last}")
        for name, pages in sorted(rows.items(), key=lambda row: (-len(row[1]), row[0])):
            print(f"  {name:20} {' '.join(pages)}")
