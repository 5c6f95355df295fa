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
from rosbeat.grading.answers import Answer as HandedIn
from rosbeat.grading.answers import answers_on
from rosbeat.grading.course_pages import CoursePage, course_pages
from rosbeat.grading.judging import judge
from rosbeat.grading.run import Pool
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


#: Answers that one learner hands in: as many as a page or two have.
_AT_ONCE = 6


def handed_in(answer: Answer) -> HandedIn:
    """What grading finds, if a learner hands in the page with this answer on it.

    What the check cell hands over is the answer's: a learner who gives a class another name writes
    it there, and the bank has such answers.
    """
    page = course()[answer.exercise[:2]]
    place = [wanted.id for wanted in page.wanted if wanted.exercise == answer.exercise][-1]
    cells = [replace(one, source=answer.text) if one.id == place else one for one in page.cells]
    (found,) = (one for one in answers_on(page, cells) if one.exercise == answer.exercise)
    return replace(found, job=replace(found.job, subject=answer.subject) if found.job else None)


def graded(answers: Iterable[Answer], workers: int | None = None) -> Iterator[tuple[str, Outcome]]:
    """Ids of answers and what grading says of them, as they are ready."""
    by_id = {answer.id: answer for answer in answers}
    with Pool(workers) as pool:
        found = ((name, handed_in(answer)) for name, answer in by_id.items())
        jobs = [(name, one.job) for name, one in found if one.job is not None]
        submissions = (jobs[at : at + _AT_ONCE] for at in range(0, len(jobs), _AT_ONCE))
        for name, evidence in pool.observe(submissions):
            yield name, judge(EXERCISES[by_id[name].exercise], evidence)


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
