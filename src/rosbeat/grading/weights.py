"""Read an instructor's own points for exercises, which replace those of the course.

The file is CSV, because it is a table of two columns, and every spreadsheet and every editor can
save one:

    exercise,points
    03a,4
    03c,0
    04,10

An exercise is worth the points on its line; with 0 points it is not graded. A page counts for the
points on its line, and its exercises share them in proportion to their own points. Exercises that
the file does not name keep the course's points. All points are multiples of 0.01.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.exercises.exercise import PASSED
from rosbeat.exercises.registry import PAGES, Page
from rosbeat.grading.csv_table import Row, read_table
from rosbeat.grading.remarks import printable
from rosbeat.records import Outcome

COLUMNS = ("exercise", "points")
#: Digits behind the point that any points have, so that what is shown adds up to what is shown.
DIGITS = 2
#: Points of one exercise or page; more is a slip of the finger.
MOST_POINTS = 10_000
#: Complaints about one file that are shown at once.
_MOST_SHOWN = 5


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


def without_effect(points: Points, graded: Collection[str], pages: Sequence[Page] = PAGES) -> str:
    """Say which points change nothing, because their pages are not graded.

    Returns:
        One line; empty if all points count.
    """
    named = [
        page.number
        for page in pages
        if page.number not in graded and any(one.id in points.by_exercise for one in page.exercises)
    ]
    if not named:
        return ""
    many = "page" if len(named) == 1 else "pages"
    return (
        f"The points for {many} {', '.join(named)} change nothing: graded are the pages "
        f"{', '.join(graded) or '(none)'}. --lessons says which ones count."
    )


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


def read_points(path: Path, pages: Sequence[Page] = PAGES) -> Points:
    """Read what exercises are worth.

    Raises:
        GradingError: If it cannot be read, or if any line cannot be used; all such lines are named.
    """
    table = read_table(path, COLUMNS)
    complaints: list[str] = []
    if "points" not in table.header:
        complaints.append("line 1: there is no column points")
    given = _given(table.rows, pages, complaints)
    if not complaints:
        by_exercise = _shared_out(given, pages, complaints)
    if complaints:
        raise _unusable(path, complaints)
    return Points(by_exercise)


def _given(
    rows: Iterable[Row], pages: Sequence[Page], complaints: list[str]
) -> dict[str, tuple[float, int]]:
    """Return points by exercises and pages, as they stand in the file, each with its line."""
    known = _known(pages)
    given: dict[str, tuple[float, int]] = {}
    for row in rows:
        try:
            name = _name(row.cells.get("exercise", ""), known)
            points = _points(row.cells.get("points", ""))
            if name in given:
                raise ValueError(f"{name} is in line {given[name][1]} already")
        except ValueError as error:
            complaints.append(f"line {row.line}: {error}")
        else:
            given[name] = points, row.line
    return given


def _known(pages: Sequence[Page]) -> list[str]:
    exercises = [exercise.id for page in pages for exercise in page.exercises]
    return exercises + [page.number for page in pages if page.number]


def _name(text: str, known: Sequence[str]) -> str:
    """Return an exercise's id or a page's number, also if a spreadsheet took its zero away."""
    wanted = text.strip("' ").casefold()
    for name in (wanted, f"0{wanted}", wanted.split("_")[0]):
        if name in known:
            return name
    if not wanted:
        raise ValueError("it names no exercise")
    near = get_close_matches(wanted[:20], known, 1)
    meant = f"; did you mean {near[0]}?" if near else ""
    raise ValueError(f"there is no exercise or page {printable(text, 40)!r}{meant}")


def _points(text: str) -> float:
    try:
        points = float(text.replace(",", "."))
    except ValueError:
        raise ValueError(f"{printable(text, 40)!r} is not a number of points") from None
    if not 0 <= points <= MOST_POINTS:  # which no NaN is
        raise ValueError(f"points are from 0 to {MOST_POINTS}, and not {printable(text, 40)}")
    if points and not round(points, DIGITS):
        raise ValueError(f"points are 0 or at least 0.01, and not {printable(text, 40)}")
    return round(points, DIGITS)


def _shared_out(
    given: dict[str, tuple[float, int]], pages: Sequence[Page], complaints: list[str]
) -> dict[str, float]:
    """Return points by exercises; those of a page are shared among its exercises."""
    shared = {name: points for name, (points, _) in given.items()}
    for page in pages:
        if page.number not in given:
            continue
        whole = shared.pop(page.number)
        own = {one.id: shared.get(one.id, float(one.points)) for one in page.exercises}
        total = sum(own.values())
        if whole and not total:
            line = given[page.number][1]
            complaints.append(f"line {line}: none of the exercises of {page.number} has points")
        shared |= _hundredths(own, whole) if whole and total else dict.fromkeys(own, 0.0)
        if whole and any(own[name] and not shared[name] for name in own):
            line = given[page.number][1]
            complaints.append(f"line {line}: too few points for all exercises of {page.number}")
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


def _unusable(path: Path, complaints: Sequence[str]) -> GradingError:
    shown = "\n".join(f"    {one}" for one in complaints[:_MOST_SHOWN])
    more = len(complaints) - _MOST_SHOWN
    shown += f"\n    and {more} more" if more > 0 else ""
    return GradingError(
        f"The points in {printable(str(path))} cannot be used:\n{shown}",
        "Marks that follow from a slip would be wrong for everybody, so nothing is graded.",
        "Correct these lines: an exercise such as 03a or a page such as 03, a comma, and points.",
    )
