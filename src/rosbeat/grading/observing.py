"""Run an answer inside a sandbox, and write its observation.

Nothing in this module decides about a mark: it runs submitted code and its exercise's scenario.
"""

from __future__ import annotations

import ast
import asyncio
import inspect
import json
import linecache
import os
import signal
import threading
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import scenario
from rosbeat.grading import system_calls
from rosbeat.grading.jobs import Job
from rosbeat.workspace.location import PAGE, STEADY
from rosbeat.workspace.location import workspace as workspace_folder

#: The file name of the answer's cell, by which its lines are found.
CELL = "<answer>"
_MOST_TEXT = 1_000


def observe(job: Job, seal: str, patience: float, result: int) -> None:
    """Run an answer, and write down what it did.

    Args:
        job: The answer.
        seal: What the text begins with, so that what an answer writes by accident is told apart.
        patience: Seconds after which cells of Python that still run are interrupted.
        result: The descriptor to write to: the seal, and an object of JSON with `seen`; or with
            `raised`, `text`, `line` and `code` if the cell could not be run.
    """
    # What is looked up here is what it was before the answer runs.
    run, write, to_text = scenario(job.exercise), _writer(seal, result), to_json
    given = json.loads(job.given)
    warnings.simplefilter("ignore")  # a warning ends no cell
    try:
        subject = _replayed(job) if job.replay else _subject_of(job, patience)
    except BaseException as error:  # SystemExit, too: it is what the cell does
        write(fault_of(error, job.answer))
        return
    write({"seen": to_text(run(subject, job.seed, **given))})


def _writer(seal: str, result: int) -> Callable[[dict[str, Any]], None]:
    """Return what writes the result, with the functions that are there before an answer runs."""
    encode, open_file = json.JSONEncoder().encode, os.fdopen

    def write(said: dict[str, Any]) -> None:
        with open_file(result, "w", encoding="utf-8", errors="replace") as file:
            file.write(seal + encode(said))

    return write


# A cell of Python.


def _subject_of(job: Job, patience: float) -> Any:  # noqa: ANN401 - whatever a learner hands over
    """Run the answer's cell as on its page, and evaluate what its check hands over.

    Raises:
        BaseException: Whatever the cell raises, if what it should hand over is not there.
    """
    space: dict[str, Any] = {"__name__": "__main__", "display": print, "get_ipython": StandIn()}
    run_imports(job.imports, space)
    for statement in job.earlier:
        with suppress(Exception):  # as on a page where its cell has failed
            exec(compile(statement, "<earlier>", "exec", dont_inherit=True), space)
    failed: list[BaseException] = []
    with _stopped_after(patience):
        for number, text in enumerate((*job.parts, job.answer)):
            _run(text, CELL if text is job.answer else f"<part {number + 1}>", space, failed)
    # As on a page: what cells have defined before they failed is there for the check.
    try:
        return eval(compile(job.subject, "<check>", "eval", dont_inherit=True), space)
    except NameError:
        if failed:
            raise failed[0] from None
        raise


def _run(text: str, name: str, space: dict[str, Any], failed: list[BaseException]) -> None:
    linecache.cache[name] = (len(text), None, text.splitlines(keepends=True), name)
    # It is of no module, which rclpy's first log line would ask each of them otherwise.
    inspect.modulesbyfile[name] = name
    try:
        code = compile(text, name, "exec", ast.PyCF_ALLOW_TOP_LEVEL_AWAIT, dont_inherit=True)
        if code.co_flags & inspect.CO_COROUTINE:  # a cell may await, as in a notebook
            asyncio.run(eval(code, space))
        else:
            exec(code, space)
    except (Exception, SystemExit, KeyboardInterrupt) as error:
        failed.append(error)  # `exit()` ends a cell, and the page goes on


@contextmanager
def _stopped_after(patience: float) -> Iterator[None]:
    """Interrupt what goes on for long, as a learner does with a cell whose `main` spins."""
    timer = threading.Timer(patience, os.kill, (os.getpid(), signal.SIGINT))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def fault_of(error: BaseException, answer: str, cell: str = CELL) -> dict[str, Any]:
    """Return what went wrong in a cell, as plain data."""
    line = _line(error, cell)
    lines = answer.splitlines()
    code = lines[line - 1].strip() if 0 < line <= len(lines) else ""
    return {"raised": type(error).__name__, "text": _text(error), "line": line, "code": code}


def _text(error: BaseException) -> str:
    try:
        text = error.msg if isinstance(error, SyntaxError) else str(error)
    except BaseException:  # a broken __str__
        text = ""
    return text[:_MOST_TEXT]


def _line(error: BaseException, cell: str) -> int:
    if isinstance(error, SyntaxError) and error.filename == cell:
        return error.lineno or 0
    found = traceback.extract_tb(error.__traceback__)
    lines = [one.lineno for one in found if one.filename == cell]
    return (lines[-1] if lines else 0) or 0


# A page of terminals and files.


def _replayed(job: Job) -> Any:  # noqa: ANN401 - whatever a page hands over
    """Run a page cell by cell as a kernel runs it, and return what it hands over to the check.

    Some exercises are not about a class but about what was typed: a folder that is there now, a
    program that runs in a terminal. So the course's own cells are run in order, with the learner's
    answer among them, in a workspace as the pages before leave it.
    """
    # What is typed in a terminal is another process, and may not look into this one.
    system_calls.prctl(system_calls.PR_SET_DUMPABLE, 0)
    # A steady home, as when pages are built: what it prints names no machine and no person.
    os.environ[STEADY] = str(Path.cwd() / "home")
    _put(job.files, workspace_folder())
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    config = Config()
    config.HistoryManager.enabled = False
    shell: Any = InteractiveShell.instance(config=config)
    workspace = import_module("rosbeat.workspace")
    # The workspace is as the pages before leave it; what makes it is not in here, so no page is.
    os.environ.pop(PAGE, None)
    workspace.catch_up = StandIn()  # type: ignore[attr-defined]  # a module
    workspace.register(shell)
    run_imports(job.imports, shell.user_ns)
    for cell in job.replay:
        shell.run_cell(cell, store_history=True)
    return eval(compile(job.subject, "<check>", "eval", dont_inherit=True), shell.user_ns)


def _put(files: Mapping[str, str], root: Path) -> None:
    root.mkdir(parents=True, exist_ok=True)
    for name, content in files.items():
        path = root / name
        if name.endswith("/"):
            path.mkdir(parents=True, exist_ok=True)
        else:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content.encode("latin-1"))


# What the names of a page stand for while its answers are observed.

#: Names of the course that are the same as on a page.
_REAL = {
    "rosbeat": {"Session", "bags", "clinic", "workspace"},
    "rosbeat.ros.test_nodes": {"add_greenhouse"},
    # As on page 07 of release 0.1.0.
    "rosbeat.scenarios.stranger": {"greenhouse"},
}


class StandIn:
    """Do nothing, when called, read or entered.

    A page's cell of imports brings `check`, `hint`, pictures and more. They judge, draw or keep
    progress, none of which belongs where a stranger's code runs.
    """

    def __call__(self, *_: object, **__: object) -> StandIn:
        """Do nothing."""
        return self

    def __getattr__(self, name: str) -> StandIn:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __repr__(self) -> str:
        return "<left out while answers are observed>"


def run_imports(cell: str, space: dict[str, Any]) -> None:
    """Run a cell of imports; names of the course that do not belong here become stand-ins."""
    tree = ast.parse(cell)
    ours = [one for one in tree.body if _is_ours(one)]
    tree.body = [one for one in tree.body if one not in ours]
    exec(compile(tree, "<imports>", "exec", dont_inherit=True), space)
    for statement in ours:
        assert isinstance(statement, ast.ImportFrom)
        for alias in statement.names:
            space[alias.asname or alias.name] = _ours(str(statement.module), alias.name)


def _is_ours(statement: ast.stmt) -> bool:
    named = isinstance(statement, ast.ImportFrom) and statement.level == 0
    return named and str(getattr(statement, "module", "")).split(".")[0] == "rosbeat"


def _ours(module: str, name: str) -> Any:  # noqa: ANN401 - whatever it is
    real = name in _REAL.get(module, ())
    return getattr(import_module(module), name) if real else StandIn()
