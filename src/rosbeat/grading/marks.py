"""Hold the results of grading: the marks of each exercise, of a learner and of a class.

These records are plain data, made from outcomes. `rosbeat grade` derives every file from them.
What exercises are worth is the course's, or an instructor's (`read_points`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.registry import EXERCISES, PAGES
from rosbeat.grading.files import number, printable, read_table
from rosbeat.grading.remarks import Remark
from rosbeat.records import Outcome, Part

#: The status of an exercise besides those of an outcome: its page was not handed in; it has no
#: points yet, because a person has to look at it or its file cannot be read; a person has looked at
#: it and given points.
MISSING, HELD, LOOKED_AT = "missing", "held", "looked at"


@dataclass(frozen=True)
class Mark:
    """Hold one exercise of one learner.

    Attributes:
        exercise: The exercise's id, such as `03a`.
        page: The lesson's name, such as `03_write_a_publisher`.
        status: `passed`, `failed`, `not attempted`, `missing`, `held` or `looked at`.
        points: Points that count, a manual mark included.
        out_of: Points that there are.
        cause: Why these points, one sentence for a table.
        mistake: Id of the mistake, empty if there is none.
        hint: What to think about next.
        remarks: What is worth knowing although the answer is right.
        parts: The requirements, if there are points for each.
        differs: What the run says of an exercise that has passed by the page's own stored output;
            empty if they agree.
        judged: Points before anything was taken off for being late, and before a manual mark.
        manual: Whether a person has set the points.
        comment: What a person has written to the learner.
        late: Whether the page was handed in late. A remark about the file says how late, and what
            was taken off.
        answer: The text of an answer that a person has to look at, or has looked at.
        file: The file that an exercise which is or was held was handed in with.
        source: The text of the learner's cells of this exercise, for people; not in results.json.
        trace: What the answer did over time, as `traces.trace_of` wrote it; not in results.json.
    """

    exercise: str
    title: str
    page: str
    status: str
    points: float
    out_of: float
    cause: str
    mistake: str = ""
    evidence: str = ""
    hint: str = ""
    remarks: tuple[str, ...] = ()
    parts: tuple[Part, ...] = ()
    differs: str = ""
    judged: float = 0.0
    manual: bool = False
    comment: str = ""
    late: bool = False
    answer: str = ""
    file: str = ""
    source: str = ""
    trace: str = ""

    @property
    def deduction(self) -> float:
        """Return the points that were deducted because the page was late."""
        is_deducted = self.late and not self.manual and self.judged > self.points
        return round(self.judged - self.points, DIGITS) if is_deducted else 0.0


def late_note(mark: Mark) -> str:
    """Say in a sentence what a mark lost because its page was late; empty if it lost nothing."""
    if not mark.deduction:
        return ""
    return f"Late: {number(mark.deduction)} of {number(mark.judged)} points were deducted."


@dataclass(frozen=True)
class Graded:
    """Hold one learner.

    Attributes:
        learner: What tells this learner from others.
        system: The name of the platform that the submission came from, or `folder`.
        marks: One for each exercise that was graded for, in the order of the course.
        remarks: What is worth telling about the files.
        comment: What a person has written to the learner about the whole.
        excused: Whether there is no grade because nothing was handed in.
        files: Of each page that was handed in its name and its path; not in results.json.
        details: What the platform and the roster say of the learner besides, by column; not in
            results.json.
    """

    learner: str
    name: str
    system: str
    marks: tuple[Mark, ...]
    remarks: tuple[Remark, ...] = ()
    comment: str = ""
    excused: bool = False
    files: tuple[tuple[str, str], ...] = ()
    details: Mapping[str, str] = field(default_factory=dict)

    @property
    def called(self) -> str:
        """Return the name, with the id that tells the learner from others of that name."""
        return self.name if self.name == self.learner else f"{self.name} ({self.learner})"

    @property
    def points(self) -> float:
        """Return the sum of the points that count."""
        return round(sum(mark.points for mark in self.marks), 6)

    @property
    def out_of(self) -> float:
        """Return the sum of the points that there are."""
        return round(sum(mark.out_of for mark in self.marks), 6)

    @property
    def deduction(self) -> float:
        """Return the sum of the points that were deducted because pages were late."""
        return round(sum(mark.deduction for mark in self.marks), DIGITS)

    @property
    def is_settled(self) -> bool:
        """Return whether all points are known: no exercise is held."""
        return all(mark.status != HELD for mark in self.marks)

    @property
    def grade(self) -> float | None:
        """Return the points to upload; None if an exercise is held, or if there is no grade."""
        return self.points if self.is_settled and not self.excused else None


@dataclass(frozen=True)
class Solution:
    """Hold the published solution of one exercise, observed as an answer is."""

    exercise: str
    source: str
    trace: str = ""


@dataclass(frozen=True)
class Gradebook:
    """Hold a class.

    Attributes:
        course: The version of the course that has judged.
        learners: One for each learner, sorted by `learner`.
        remarks: About files that belong to no learner.
        solutions: What the published solutions are and do; not in results.json.
    """

    course: str
    learners: tuple[Graded, ...]
    remarks: tuple[Remark, ...] = ()
    solutions: tuple[Solution, ...] = ()

    @property
    def with_a_grade(self) -> tuple[Graded, ...]:
        """Return the learners whose points are all known, who are those that averages are about."""
        return tuple(one for one in self.learners if one.grade is not None)


# What exercises are worth.

COLUMNS = ("exercise", "points")
#: Digits behind the point that any points have, so that what is shown adds up to what is shown.
DIGITS = 2
#: Points of one exercise or page; more is a slip of the finger.
MOST_POINTS = 10_000


@dataclass(frozen=True)
class Points:
    """Hold what exercises are worth.

    Attributes:
        by_exercise: Points by the exercise's id; without an entry, those of the course.
    """

    by_exercise: dict[str, float] = field(default_factory=dict)

    def of(self, exercise: str, default: float) -> float:
        """Return what an exercise is worth; with 0 points it is not graded."""
        return self.by_exercise.get(exercise, float(default))


def scaled(outcome: Outcome, out_of: float) -> float:
    """Return the points for an outcome if the exercise is worth more or less than in the course.

    Args:
        outcome: What the judge says. Part of its points gives the same part here.
        out_of: What the exercise is worth.

    Returns:
        Points from 0 to `out_of`, in hundredths.
    """
    whole = outcome.out_of or 1
    reached = outcome.points if outcome.out_of else float(outcome.status == PASSED)
    return round(min(max(reached / whole, 0.0), 1.0) * out_of, DIGITS)


def read_points(path: Path) -> Points:
    """Read what exercises are worth.

    Raises:
        GradingError: If it cannot be read, or if a line of it cannot be used.
    """
    table = read_table(path, COLUMNS)
    given: dict[str, float] = {}
    line = 1
    try:
        if "points" not in table.header:
            raise ValueError("there is no column points")
        for row in table.rows:
            line = row.line
            name = _name(row.cells.get("exercise", ""))
            if name in given:
                raise ValueError(f"{name} is there a second time")
            given[name] = _points(row.cells.get("points", ""))
        return Points(_shared_out(given))
    except ValueError as error:
        raise GradingError(
            f"The points in {printable(str(path))} cannot be used: line {line}: {error}.",
            "Marks that follow from a slip would be wrong for everybody, so nothing is graded.",
            "Correct the line: an exercise such as 03a or a page such as 03, a comma, and points.",
        ) from None


def _name(text: str) -> str:
    """Return an exercise's id or a page's number, also if a spreadsheet took its zero away."""
    known = {*EXERCISES, *(page.number for page in PAGES if page.number)}
    wanted = text.strip("' ").casefold()
    for name in (wanted, f"0{wanted}", wanted.split("_")[0]):
        if name in known:
            return name
    raise ValueError(f"there is no exercise or page {printable(text, 40)!r}")


def _points(text: str) -> float:
    try:
        points = float(text.replace(",", "."))
    except ValueError:
        raise ValueError(f"{printable(text, 40)!r} is not a number of points") from None
    if not 0 <= points <= MOST_POINTS or (points and not round(points, DIGITS)):  # nor is NaN
        said = f"points are 0, or from 0.01 to {MOST_POINTS}, and not {printable(text, 40)}"
        raise ValueError(said)
    return round(points, DIGITS)


def _shared_out(given: Mapping[str, float]) -> dict[str, float]:
    """Return points by exercises; those of a page are shared among its exercises."""
    shared = dict(given)
    for page in PAGES:
        if page.number not in given:
            continue
        whole = shared.pop(page.number)
        own = {one.id: shared.get(one.id, float(one.points)) for one in page.exercises}
        shares = _hundredths(own, whole) if any(own.values()) else own
        if whole and not all(shares[name] for name in own if own[name]):
            raise ValueError(f"there are too few points for all exercises of page {page.number}")
        if whole and not any(own.values()):
            raise ValueError(f"none of the exercises of page {page.number} has points")
        shared |= shares
    return shared


def _hundredths(own: Mapping[str, float], whole: float) -> dict[str, float]:
    """Return shares in whole hundredths that add up to all points (largest remainders)."""
    total = sum(own.values())
    exact = {name: points / total * round(whole * 100) for name, points in own.items()}
    shares = {name: int(share) for name, share in exact.items()}
    by_remainder = sorted(exact, key=lambda name: (shares[name] - exact[name], name))
    for name in by_remainder[: round(whole * 100) - sum(shares.values())]:
        shares[name] += 1
    return {name: share / 100 for name, share in shares.items()}
