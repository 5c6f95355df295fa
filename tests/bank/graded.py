"""Grade answers of the bank, handed in on their pages."""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache
from hashlib import sha256

from bank import workspaces
from bank.pages import ROOT
from bank.reading import Answer, answers
from rosbeat.exercises.registry import EXERCISES
from rosbeat.grading.answers import Answer as HandedIn
from rosbeat.grading.answers import answers_on
from rosbeat.grading.judging import judge, untouched
from rosbeat.grading.notebook import CoursePage, course_pages
from rosbeat.grading.pool import Pool
from rosbeat.records import Outcome

#: Answers that one learner hands in: as many as a page or two have.
_AT_ONCE = 6
#: Lines above an answer in its cell. Answers to the exercises about workspaces that are not here
#: are no texts of a cell: what a terminal shows, or lines that do by hand what a command would do.
_ABOVE = {
    "01a": '%%terminal one\ncd "$ROS2_WORKSPACE"\n',
    "01b": '%%terminal two\ncd "$ROS2_WORKSPACE/resources/images"\n',
    "02a": "%%save src/sensor_simulator/package.xml\n",
    "05a": "%%save src/sensor_simulator/setup.py\n",
    "05b": "%%save src/lamp_control/setup.py\n",
}
#: Exercises whose page is replayed in a terminal, with real builds.
REPLAYED = frozenset(_ABOVE)


@cache
def course() -> dict[str, CoursePage]:
    """Return the course's pages by number."""
    return {page.number: page for page in course_pages(ROOT / "notebooks")}


@cache
def usable(exercise: str = "") -> tuple[Answer, ...]:
    """Return the answers that are texts of a cell, to one exercise or to all.

    A command or a file with a blank in it is neither typed nor saved on a page.
    """
    return tuple(
        one
        for one in answers()
        if exercise in ("", one.exercise)
        and (one.exercise not in workspaces.EXERCISES or one.exercise in _ABOVE)
        and not (one.before or (one.exercise in _ABOVE and "____" in one.text))
    )


def handed_in(answer: Answer) -> HandedIn:
    """Return what grading finds if a learner hands in the page with this answer on it.

    What the check cell hands over is the answer's: a learner who gives a class another name writes
    it there, and the bank has such answers.
    """
    page = course()[answer.exercise[:2]]
    place = [wanted.id for wanted in page.wanted if wanted.exercise == answer.exercise][-1]
    text = _ABOVE.get(answer.exercise, "") + answer.text
    cells = [replace(one, source=text) if one.id == place else one for one in page.cells]
    (found,) = (one for one in answers_on(page, cells) if one.exercise == answer.exercise)
    if found.job is None or answer.exercise in workspaces.EXERCISES:
        return found
    return replace(found, job=replace(found.job, subject=answer.subject))


def graded(chosen: Iterable[Answer], workers: int | None = None) -> Iterator[tuple[str, Outcome]]:
    """Yield ids of answers and what grading says of them, as they are ready."""
    by_id = {one.id: one for one in chosen}
    jobs = {name: handed_in(one).job for name, one in by_id.items()}
    for name in (name for name, job in jobs.items() if job is None):
        yield name, untouched(EXERCISES[by_id[name].exercise])
    pages = [(name, job) for name, job in jobs.items() if job and job.exercise in _ABOVE]
    others = [(name, job) for name, job in jobs.items() if job and job.exercise not in _ABOVE]
    submissions = [others[at : at + _AT_ONCE] for at in range(0, len(others), _AT_ONCE)]
    with Pool(workers) as pool:
        # A workspace is its learner's: whoever leaves one hands in nothing else.
        for name, evidence in pool.observe([*submissions, *([one] for one in pages)]):
            yield name, judge(EXERCISES[by_id[name].exercise], evidence)


@cache
def sample(most: int) -> tuple[Answer, ...]:
    """Return some answers of each exercise, right and wrong; always the same ones.

    Args:
        most: How many there are of each status of an exercise, at most. A replayed
            exercise has so many in all.
    """
    found: dict[tuple[str, str], list[Answer]] = {}
    for one in sorted(usable(), key=lambda one: sha256(one.id.encode()).hexdigest()):
        kind = "" if one.exercise in REPLAYED else one.status
        found.setdefault((one.exercise, kind), []).append(one)
    return tuple(one for some in found.values() for one in some[:most])
