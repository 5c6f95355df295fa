"""Answers of the bank, handed in on their pages and graded."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from hashlib import sha256

from bank.answer import Answer
from bank.beyond import page_07, page_08, page_09, page_10, page_11, page_12, page_13
from bank.nodes import table
from bank.pages import ROOT
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.course_pages import CoursePage, course_pages
from rosbeat.grading.judging import judge
from rosbeat.grading.pool import Pool
from rosbeat.grading.tasks import Task, tasks_of
from rosbeat.records import Outcome

_BEYOND = (page_07, page_08, page_09, page_10, page_11, page_12, page_13)
#: Every answer to an exercise that is answered with a cell of Python.
ANSWERS: tuple[Answer, ...] = (
    *table.ANSWERS,
    *(answer for page in _BEYOND for answer in page.ANSWERS),
)


@cache
def course() -> dict[str, CoursePage]:
    """The course's pages by number."""
    return {page.number: page for page in course_pages(ROOT / "notebooks")}


def task_of(answer: Answer) -> Task:
    """What has to be done, if a learner hands in the page with this answer on it.

    What the check cell hands over is the answer's: a learner who gives a class another name writes
    it there, and the bank has such answers.
    """
    page = course()[answer.exercise[:2]]
    place = [wanted.id for wanted in page.wanted if wanted.exercise == answer.exercise][-1]
    cells = [replace(one, source=answer.text) if one.id == place else one for one in page.cells]
    (task,) = (one for one in tasks_of(page, cells) if one.exercise == answer.exercise)
    return replace(task, job=replace(task.job, subject=answer.subject) if task.job else None)


def graded(answers: Iterable[Answer], workers: int | None = None) -> Iterator[tuple[str, Outcome]]:
    """Ids of answers and what grading says of them, as they are ready; none of those it holds."""
    by_id = {answer.id: answer for answer in answers}
    with Pool(workers) as pool:
        tasks = ((name, task_of(answer)) for name, answer in by_id.items())
        jobs = ((name, task.job) for name, task in tasks if task.job is not None)
        for name, observed in pool.observe(jobs):
            yield name, judge(EXERCISES[by_id[name].exercise], observed)


def sample(most: int) -> tuple[Answer, ...]:
    """Some answers of each exercise, right and wrong, chosen by their digest: always the same.

    Args:
        most: How many there are of each status of an exercise, at most.
    """
    found: dict[tuple[str, str], list[Answer]] = {}
    for answer in sorted(ANSWERS, key=_digest):
        found.setdefault((answer.exercise, answer.status), []).append(answer)
    return tuple(one for some in found.values() for one in some[:most])


def _digest(answer: Answer) -> str:
    return sha256(answer.id.encode()).hexdigest()
