"""What a class did, counted: points, exercises, mistakes. Pure functions of a gradebook."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby
from statistics import mean, median

from rosbeat.diagnosis.mistakes import UNKNOWN
from rosbeat.exercises.exercise import FAILED
from rosbeat.grading.marks import HELD, MISSING, Gradebook, Graded, Mark

#: How many per cent of the points each step of the distribution covers; 100 is a step of its own.
STEP = 10


@dataclass(frozen=True)
class ExerciseTally:
    """One exercise in a class.

    Attributes:
        exercise: Its id.
        title: What it is about.
        page: The lesson's name.
        counts: How many learners there are of each status.
    """

    exercise: str
    title: str
    page: str
    counts: dict[str, int]

    @property
    def learners(self) -> int:
        """Of how many learners it was graded."""
        return sum(self.counts.values())


@dataclass(frozen=True)
class MistakeTally:
    """One mistake in a class.

    Attributes:
        mistake: Its id.
        count: In how many answers it was found.
        learners: How many learners made it.
        places: The exercises in which it was found, with how often, most frequent first.
        hint: The hint that was given for it most often.
        evidence: What was observed most often.
    """

    mistake: str
    count: int
    learners: int
    places: tuple[tuple[str, int], ...]
    hint: str
    evidence: str


@dataclass(frozen=True)
class PointsTally:
    """The points of a class, in per cent of what each learner could reach.

    Attributes:
        steps: For each step its name, such as `50 to 59 %`, and how many learners are in it.
        median: The median in per cent.
        mean: The mean in per cent.
    """

    steps: tuple[tuple[str, int], ...]
    median: float
    mean: float

    @property
    def highest(self) -> int:
        """How many learners are in the step that has most."""
        return max(many for _, many in self.steps)

    @property
    def range(self) -> tuple[tuple[str, int], ...]:
        """The steps from the lowest in which somebody is to the highest."""
        taken = [at for at, (_, many) in enumerate(self.steps) if many]
        return self.steps[taken[0] : taken[-1] + 1] if taken else ()


def all_marks(book: Gradebook) -> Iterable[tuple[Graded, Mark]]:
    """Every mark with its learner, learner by learner.

    Args:
        book: The class.
    """
    return ((learner, mark) for learner in book.learners for mark in learner.marks)


def tally_exercises(book: Gradebook) -> tuple[ExerciseTally, ...]:
    """Count the outcomes of each exercise, in the order of the course.

    Args:
        book: The class.
    """
    counts: dict[tuple[str, str, str], Counter[str]] = {}
    for _, mark in all_marks(book):
        place = counts.setdefault((mark.page, mark.exercise, mark.title), Counter())
        place[mark.status] += 1
    return tuple(
        ExerciseTally(exercise, title, page, dict(found))
        for (page, exercise, title), found in counts.items()
    )


def tally_mistakes(book: Gradebook) -> tuple[MistakeTally, ...]:
    """Count the mistakes, most frequent first.

    Args:
        book: The class.
    """
    found: dict[str, list[tuple[str, Mark]]] = defaultdict(list)
    for learner, mark in all_marks(book):
        if mark.status == FAILED:
            found[mark.mistake or UNKNOWN].append((learner.learner, mark))
    tallies = (_mistake(mistake, marks) for mistake, marks in found.items())
    return tuple(sorted(tallies, key=lambda one: (-one.count, one.mistake)))


def _mistake(mistake: str, found: Sequence[tuple[str, Mark]]) -> MistakeTally:
    marks = [mark for _, mark in found]
    return MistakeTally(
        mistake,
        len(marks),
        len({learner for learner, _ in found}),
        tuple(_ranked(mark.exercise for mark in marks)),
        _first(_ranked(mark.hint for mark in marks if mark.hint)),
        _first(_ranked(mark.evidence for mark in marks if mark.evidence)),
    )


def _ranked(words: Iterable[str]) -> list[tuple[str, int]]:
    """Words with their numbers, most frequent first, then by name."""
    return sorted(Counter(words).items(), key=lambda one: (-one[1], one[0]))


def _first(ranked: Sequence[tuple[str, int]]) -> str:
    return ranked[0][0] if ranked else ""


def tally_points(book: Gradebook) -> PointsTally:
    """Sort the learners into steps by their share of the points.

    Args:
        book: The class; learners for whom there are no points are left out.
    """
    shares = [100 * one.points / one.out_of for one in book.learners if one.out_of > 0]
    steps = Counter(int(min(max(share, 0.0), 100.0) // STEP) for share in shares)
    rows = [(f"{at} to {at + STEP - 1} %", steps[at // STEP]) for at in range(0, 100, STEP)]
    rows.append(("100 %", steps[100 // STEP]))
    return PointsTally(
        tuple(rows), median(shares) if shares else 0.0, mean(shares) if shares else 0.0
    )


def held(book: Gradebook) -> list[tuple[Graded, Mark]]:
    """What is held for a person to look at.

    Args:
        book: The class.
    """
    return [
        (learner, mark)
        for learner, mark in all_marks(book)
        if mark.status == HELD and not mark.waits_for_its_file
    ]


def cut_off(book: Gradebook) -> list[tuple[Graded, str, list[str]]]:
    """Files that break off, with the exercises that are not in them.

    Args:
        book: The class.

    Returns:
        Of each file its learner, its path, and the exercises' ids.
    """
    return [
        (learner, file, [mark.exercise for mark in marks])
        for learner in book.learners
        for file, marks in groupby(
            (mark for mark in learner.marks if mark.waits_for_its_file), lambda mark: mark.file
        )
    ]


def nameless(book: Gradebook) -> list[tuple[Graded, Mark]]:
    """Answers that failed with a mistake that has no name.

    Args:
        book: The class.
    """
    return [
        (learner, mark)
        for learner, mark in all_marks(book)
        if mark.status == FAILED and mark.mistake in ("", UNKNOWN)
    ]


def empty_handed(book: Gradebook) -> list[Graded]:
    """Learners of whom no page was found.

    Args:
        book: The class.
    """
    return [one for one in book.learners if all(mark.status == MISSING for mark in one.marks)]
