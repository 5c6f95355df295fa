"""An answer's cell, run where it may do no harm, and the scenario of its exercise."""

from __future__ import annotations

import inspect
import json
import linecache
import os
import traceback
import warnings
from collections.abc import Callable
from functools import partial
from typing import Any

from rosbeat.exercises.evidence import to_json
from rosbeat.exercises.registry import scenario
from rosbeat.grading.inside.careful import careful_functions
from rosbeat.grading.inside.definitions import define_missing
from rosbeat.grading.inside.intact import Census, differences
from rosbeat.grading.inside.standins import run_imports
from rosbeat.grading.jobs import Job

#: The file name of the answer's cell, by which its lines are found.
CELL = "<answer>"
_MOST_TEXT = 1_000


def observe_job(job: Job, before: Census, seal: str, result: int) -> None:
    """Run an answer, and write down what it did.

    Args:
        job: The answer.
        before: What there was before it.
        seal: What the text begins with, so that nobody else's passes for it.
        result: The descriptor to write to: the seal, and an object of JSON with `evidence` and
            `changed`; or with `raised`, `text`, `line` and `code` if the cell could not be run.
    """
    run, write, given = scenario(job.exercise), writer(seal, result), json.loads(job.given)
    look = partial(differences, before)
    warnings.simplefilter("ignore")  # a warning ends no cell
    try:
        subject = subject_of(job)
    except BaseException as error:  # SystemExit, too: it is what the cell does
        write(fault_of(error, job.answer))
        return
    seen = run(subject, **given)
    # Before the evidence is written: what writes it could put itself back.
    changed = look()
    write({"evidence": to_json(seen), "changed": changed})


def writer(seal: str, result: int) -> Callable[[dict[str, Any]], None]:
    """What writes the result, with the functions that are there before an answer runs."""
    encode, open_file = json.JSONEncoder().encode, os.fdopen

    def write(said: dict[str, Any]) -> None:
        with open_file(result, "w", encoding="utf-8", errors="replace") as file:
            file.write(seal + encode(said))

    return write


def subject_of(job: Job) -> Any:  # noqa: ANN401 - whatever a learner hands over
    """Run the answer's cell as on its page, and evaluate what its check hands over.

    Raises:
        BaseException: Whatever the cell raises, if what it should hand over is not there.
    """
    space: dict[str, Any] = {"__name__": "__main__", **careful_functions()}
    run_imports(job.imports, space)
    define_missing((*job.parts, job.answer), job.earlier, space)
    failed: list[BaseException] = []
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
        exec(compile(text, name, "exec", dont_inherit=True), space)
    except (Exception, SystemExit) as error:  # `exit()` ends a cell, and the page goes on
        failed.append(error)


def fault_of(error: BaseException, answer: str, cell: str = CELL) -> dict[str, Any]:
    """What went wrong in a cell, as plain data.

    Args:
        error: What it raised.
        answer: Its text.
        cell: Its file name.
    """
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
