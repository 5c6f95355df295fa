"""Grade answers of the bank, handed in on their pages."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from hashlib import sha256

from bank import workspaces
from bank.pages import ROOT
from bank.reading import Answer, answers
from rosbeat.exercises.registry import EXERCISES
from rosbeat.page_runs.jobs import PageJob
from rosbeat.page_runs.judging import judge, untouched
from rosbeat.page_runs.notebook import Cell, CoursePage, course_pages
from rosbeat.page_runs.pool import Pool
from rosbeat.page_runs.submitted_page import submitted_page
from rosbeat.records import Outcome

#: Lines above an answer in its cell. Answers to the exercises about workspaces that are not here
#: are no texts of a cell: what a terminal shows, or lines that do by hand what a command would do.
_ABOVE = {
    "01a": '%%terminal one\ncd "$ROS2_WORKSPACE"\n',
    "01b": '%%terminal two\ncd "$ROS2_WORKSPACE/resources/images"\n',
    "02a": "%%save src/sensor_simulator/package.xml\n",
    "05a": "%%save src/sensor_simulator/setup.py\n",
    "05b": "%%save src/lamp_control/setup.py\n",
}
#: Exercises whose answers are commands and files, with real builds.
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


def page_of(chosen: Sequence[Answer]) -> PageJob | None:
    """Return the page of a learner who hands in these answers, each to another exercise.

    What a check cell hands over is the answer's: a learner who gives a class another name writes it
    there, and the bank has such answers.
    """
    page = course()[chosen[0].exercise[:2]]
    by_exercise = {one.exercise: one for one in chosen}
    last = {wanted.exercise: wanted.id for wanted in page.wanted}
    texts = {last[name]: one for name, one in by_exercise.items()}

    def filled(cell: Cell) -> Cell:
        if cell.id in texts:
            one = texts[cell.id]
            return replace(cell, source=_ABOVE.get(one.exercise, "") + one.text)
        if cell.check in by_exercise and cell.check not in workspaces.EXERCISES:
            return replace(cell, source=f'check("{cell.check}", {by_exercise[cell.check].subject})')
        return cell

    return submitted_page(page, [filled(cell) for cell in page.cells]).job


def learners(chosen: Iterable[Answer]) -> list[list[Answer]]:
    """Return answers as learners hand them in: on a page one to each exercise, at most."""
    pages: dict[tuple[str, int], list[Answer]] = {}
    counts: dict[str, int] = {}
    for one in chosen:
        turn = counts[one.exercise] = counts.get(one.exercise, 0) + 1
        # What one answer does to a workspace may be what another one is asked for.
        alone = one.exercise in REPLAYED
        pages.setdefault((one.exercise if alone else one.exercise[:2], turn), []).append(one)
    return list(pages.values())


def graded(chosen: Iterable[Answer], workers: int | None = None) -> Iterator[tuple[str, Outcome]]:
    """Yield ids of answers and what grading says of them, as they are ready."""
    submissions = []
    for page in learners(chosen):
        job = page_of(page)
        if job is None:
            yield from ((one.id, untouched(EXERCISES[one.exercise])) for one in page)
        else:
            submissions.append([({one.exercise: one.id for one in page}, job)])
    with Pool(workers) as pool:
        for names, evidence in pool.observe(submissions):
            for exercise, name in names.items():
                yield name, judge(EXERCISES[exercise], evidence.exercises[exercise])


@cache
def sample(most: int) -> tuple[Answer, ...]:
    """Return some answers of each exercise, right and wrong; always the same ones.

    Args:
        most: How many there are of each status of an exercise, at most. An exercise about files
            and terminals has so many in all.
    """
    found: dict[tuple[str, str], list[Answer]] = {}
    for one in sorted(usable(), key=lambda one: sha256(one.id.encode()).hexdigest()):
        kind = "" if one.exercise in REPLAYED else one.status
        found.setdefault((one.exercise, kind), []).append(one)
    return tuple(one for some in found.values() for one in some[:most])
