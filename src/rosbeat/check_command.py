"""Run `rosbeat check`: all checks of a page in a terminal, for a learner and for CI.

A page is run from top to bottom as `rosbeat grade` runs it, in a process and an empty workspace of
its own, and judged as in Jupyter: with the inputs of the page. It is the learner's own code, so
there is no sandbox, only limits. Nothing is written to the page or to the progress.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rosbeat.errors import ExerciseError
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.outcome_display import OPEN, RIGHT, WRONG, Shown
from rosbeat.exercises.registry import EXERCISES, PAGES, Page
from rosbeat.page_runs.jobs import PageEvidence, PageJob
from rosbeat.page_runs.judging import judge
from rosbeat.page_runs.notebook import Cell, course_pages, read_notebook
from rosbeat.page_runs.pool import Pool
from rosbeat.page_runs.submitted_page import own_page, subject_in, subject_of
from rosbeat.records_json import to_json
from rosbeat.workspace.location import course_root

#: What is said of an exercise that no cell checks.
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
        GradingError: If no page can be run on this machine.
    """
    jobs = [(path, _job(path)) for path in pages]  # before the first one runs
    results: list[Checked] = []
    with Pool(1, unsafe=True) as pool:
        for path, job in jobs:
            ((_, evidence),) = pool.observe([[(path, job)]])
            checked = _checked(path, job, evidence)
            results += checked
            if not as_json:
                print("\n".join(_lines(path, checked)), flush=True)
    if as_json:
        print(to_json(results, indent=1))
    return 0 if all(result.status == PASSED for result in results) else _FAILED


def _job(path: Path) -> PageJob:
    """Read a page, and return what is to be run.

    Raises:
        ExerciseError: If it is not a page of the course.
    """
    try:
        notebook = read_notebook(path.read_bytes())
    except OSError as error:
        raise _no_page(path, f"{error.strerror or error}.") from error
    if notebook.problem:
        raise _no_page(path, notebook.problem)
    code = [cell for cell in notebook.cells if cell.sort == "code"]
    page = max(PAGES, key=lambda page: _exercises_on(page, code))
    if not _exercises_on(page, code):
        raise _no_page(path, "No cell of it has to do with an exercise.")
    return own_page(page.number, code, _subjects(page, code, path))


def _exercises_on(page: Page, cells: Sequence[Cell]) -> int:
    """Return how many exercises of a page have something to do with cells."""
    named = {name for cell in cells for name in (cell.exercise, cell.check, *cell.checked)}
    return sum(exercise.id in named for exercise in page.exercises) if page.number else 0


def _subjects(page: Page, cells: Sequence[Cell], path: Path) -> Mapping[str, str]:
    """Return what is checked for each exercise: what the page's last check of it hands over.

    An exercise whose check is gone is checked as the course's own page does, where that is there.
    """
    root = course_root()
    folder = root / "notebooks" if root else None
    course = course_pages(folder) if folder and folder.is_dir() else ()
    there = next((own for own in course if own.number == page.number), None)
    subjects = {}
    for exercise in page.exercises:
        sources = [cell.source for cell in cells if exercise.id in cell.checked]
        subject = subject_in(sources[-1], exercise.id) if sources else ""
        subjects[exercise.id] = subject or (subject_of(there, exercise.id) if there else "")
    return {exercise: subject for exercise, subject in subjects.items() if subject}


def _no_page(path: Path, why: str) -> ExerciseError:
    return ExerciseError(
        f"{path} cannot be checked. {why}",
        "Only a page of the course has checks; no page was run.",
        "Give the file of a page:  rosbeat check 03_write_a_publisher.ipynb",
    )


def _checked(path: Path, job: PageJob, evidence: PageEvidence) -> list[Checked]:
    """Return what the check of each exercise of a page says."""
    page = next(page for page in PAGES if page.number == job.page)
    checked = []
    for exercise in page.exercises:
        if exercise.id not in evidence.exercises:
            why = f'No cell of the page checks it, as `check("{exercise.id}", ...)` does.'
            text = f"{OPEN} Exercise {exercise.id}: {NOT_CHECKED}. {why}"
            checked.append(Checked(str(path), exercise.id, NOT_CHECKED, text))
            continue
        shown = Shown(judge(EXERCISES[exercise.id], evidence.exercises[exercise.id]))
        status = shown.outcome.status
        checked.append(Checked(str(path), exercise.id, status, str(shown), shown.record()))
    return checked


def _lines(path: Path, checked: Sequence[Checked]) -> Iterator[str]:
    passed = sum(result.status == PASSED for result in checked)
    sign = RIGHT if passed == len(checked) else WRONG
    yield f"{sign} {path.name}: {passed} of {len(checked)} exercises passed."
    for result in checked:
        yield from (f"  {line}" for line in result.text.splitlines())
