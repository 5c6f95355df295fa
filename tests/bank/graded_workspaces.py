"""Answers about files and terminals, handed in on their pages and graded."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from hashlib import sha256

from bank.graded import course
from bank.workspaces.answer import Answer
from bank.workspaces.table import ANSWERS
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.answers import answers_on
from rosbeat.grading.jobs import Job
from rosbeat.grading.judging import judge, untouched
from rosbeat.grading.run import Pool
from rosbeat.records import Outcome

#: What stands above an answer in its cell; the others are not texts of a cell, but what a terminal
#: shows, or lines of a shell that do by hand what a command of the page would do.
HEADS = {
    "01a": '%%terminal one\ncd "$ROS2_WORKSPACE"\n',
    "01b": "%%terminal two\n",
    "02a": "%%save src/sensor_simulator/package.xml\n",
    "05a": "%%save src/sensor_simulator/setup.py\n",
    "05b": "",
}


def job_of(answer: Answer) -> Job | None:
    """What grading has to observe, if a learner hands in the page with this answer on it.

    None if the cell is as it was given out.
    """
    page = course()[answer.exercise[:2]]
    (place,) = (wanted.id for wanted in page.wanted if wanted.exercise == answer.exercise)
    text = HEADS[answer.exercise] + answer.given
    cells = [replace(one, source=text) if one.id == place else one for one in page.cells]
    (found,) = (one for one in answers_on(page, cells) if one.exercise == answer.exercise)
    return found.job


def graded(answers: Iterable[Answer]) -> Iterator[tuple[str, Outcome]]:
    """Ids of answers and what grading says of them, as they are ready."""
    by_id = {answer.id: answer for answer in answers}
    jobs = {name: job_of(one) for name, one in by_id.items()}
    for name in (name for name, job in jobs.items() if job is None):
        yield name, untouched(EXERCISES[by_id[name].exercise])
    with Pool() as pool:
        for name, seen in pool.observe([(name, job)] for name, job in jobs.items() if job):
            yield name, judge(EXERCISES[by_id[name].exercise], seen)


def usable(exercise: str) -> list[Answer]:
    """The answers to an exercise that are texts of its cell, in an order that stays the same.

    A command or a file with a blank in it is neither typed nor saved on a page.
    """
    mine = [one for one in ANSWERS if one.exercise == exercise]
    found = [one for one in mine if not one.also and "____" not in one.given]
    return sorted(found, key=lambda one: sha256(one.id.encode()).hexdigest())
