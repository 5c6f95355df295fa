"""Run `rosbeat check`: all checks of a page in a terminal, for a learner and for CI.

The page runs in a kernel, cell by cell and as it is saved, in an empty workspace of its own; so
the outcomes are those that Jupyter shows. Nothing is written to the page or to the progress.
"""

from __future__ import annotations

import asyncio
import logging
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import nbformat
from jupyter_client.manager import AsyncKernelManager
from nbclient import NotebookClient
from nbclient.exceptions import DeadKernelError

from rosbeat.authoring.execution import KernelPlace, kernel_place
from rosbeat.errors import ExerciseError
from rosbeat.exercises.cells import checks_in
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.outcome_display import MIME, OPEN, RIGHT, WRONG
from rosbeat.exercises.registry import PAGES
from rosbeat.records_json import to_json

#: Seconds for one cell; an endless loop is interrupted then, and the next cell runs.
SECONDS = 120.0
#: What is said of an exercise whose check shows no outcome.
NOT_CHECKED = "not checked"
_FAILED = 1


@dataclass(frozen=True)
class Checked:
    """Hold what the check of one exercise says.

    Attributes:
        page: The page's file.
        exercise: The exercise's id.
        status: The status of its outcome, or `not checked`.
        text: What the page shows: the outcome in words, or why there is none.
        outcome: The outcome as data, as it is saved in the page; empty if there is none.
    """

    page: str
    exercise: str
    status: str
    text: str
    outcome: dict[str, Any] = field(default_factory=dict)


def run(pages: Sequence[Path], as_json: bool = False) -> int:
    """Check pages, and print what their checks say.

    Args:
        pages: The files.
        as_json: Whether to print JSON instead of text.

    Returns:
        0 if every exercise of every page has passed, else 1.

    Raises:
        ExerciseError: If a file is not a page of the course.
    """
    notebooks = [(path, _read(path)) for path in pages]  # before the first one runs
    found: list[Checked] = []
    for path, notebook in notebooks:
        checked = check_page(path, notebook)
        found += checked
        if not as_json:
            print("\n".join(_lines(path, checked)), flush=True)
    if as_json:
        print(to_json(found, indent=1))
    return 0 if all(one.status == PASSED for one in found) else _FAILED


def check_page(path: Path, notebook: nbformat.NotebookNode) -> list[Checked]:
    """Run a page, and return what the check of each of its exercises says.

    Args:
        path: The page's file; the page runs in its folder.
        notebook: The page; its cells get outputs.
    """
    said = _execute(path, notebook)
    shown = {one["exercise"]: (one, text) for one, text in _outcomes(notebook)}
    found = []
    for exercise, cell in _checks(notebook).items():
        outcome, text = shown.get(exercise, ({}, ""))
        text = text or said or _error_of(cell) or "Its check shows no outcome."
        status = str(outcome.get("status", NOT_CHECKED))
        found.append(Checked(str(path), exercise, status, text, outcome))
    return found


def _read(path: Path) -> nbformat.NotebookNode:
    try:
        with warnings.catch_warnings():  # about cells without an id, which do no harm here
            warnings.simplefilter("ignore")
            notebook = nbformat.read(path, as_version=4)
    except OSError as error:
        raise _no_page(path, error.strerror or str(error)) from error
    except Exception as error:  # what nbformat raises for a damaged file is not documented
        raise _no_page(path, "it is not a notebook") from error
    if not _checks(notebook):
        raise _no_page(path, "it has no check of an exercise")
    return notebook


def _no_page(path: Path, why: str) -> ExerciseError:
    return ExerciseError(
        f"{path} cannot be checked: {why}.",
        "Only a page of the course has checks; no page was run.",
        "Give the file of a page:  rosbeat check 03_write_a_publisher.ipynb",
    )


def _checks(notebook: nbformat.NotebookNode) -> dict[str, nbformat.NotebookNode]:
    """Return the cells that check an exercise of a page, by the exercise; the last one counts."""
    known = {exercise.id for page in PAGES if page.number for exercise in page.exercises}
    code = (cell for cell in notebook.cells if cell.cell_type == "code")
    return {
        exercise: cell for cell in code for exercise in checks_in(cell.source) if exercise in known
    }


def _execute(path: Path, notebook: nbformat.NotebookNode) -> str:
    """Run every cell; return why the rest did not run, or an empty text."""
    lesson = notebook.metadata.get("rosbeat", {}).get("lesson", "")
    with kernel_place(f"{lesson}.ipynb" if lesson else path.name) as place:
        try:
            asyncio.run(_run_cells(notebook, path.resolve().parent, place))
        except DeadKernelError:
            return "A cell above has ended the kernel, so nothing below it has run."
    return ""


async def _run_cells(notebook: nbformat.NotebookNode, folder: Path, place: KernelPlace) -> None:
    manager = AsyncKernelManager(**place.options())
    client = NotebookClient(notebook, manager, ipython_hist_file="")
    client.allow_errors = client.interrupt_on_timeout = True
    client.timeout = SECONDS
    client.log = logging.Logger("rosbeat.check", logging.CRITICAL)
    with place.log.open("wb") as log:
        await client.async_start_new_kernel(cwd=str(folder), env=place.environment, stderr=log)
    try:
        await client.async_start_new_kernel_client()
        for index, cell in enumerate(notebook.cells):
            await client.async_execute_cell(cell, index, client.code_cells_executed + 1)
    finally:
        if client.kc is not None:
            client.kc.stop_channels()
        await manager.shutdown_kernel(now=True)


def _outcomes(notebook: nbformat.NotebookNode) -> Iterator[tuple[dict[str, Any], str]]:
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if MIME in data:
                yield dict(data[MIME]), str(data.get("text/plain", ""))


def _error_of(cell: nbformat.NotebookNode) -> str:
    for output in cell.get("outputs", ()):
        if output.output_type == "error":
            return f"{output.ename}: {output.evalue}"
    return ""


def _lines(path: Path, checked: Sequence[Checked]) -> Iterator[str]:
    passed = sum(one.status == PASSED for one in checked)
    sign = RIGHT if passed == len(checked) else WRONG
    yield f"{sign} {path.name}: {passed} of {len(checked)} exercises passed."
    for one in checked:
        text = (
            one.text
            if one.outcome
            else f"{OPEN} Exercise {one.exercise}: {NOT_CHECKED}. {one.text}"
        )
        yield from (f"  {line}" for line in text.splitlines())
