"""Apply points and comments that a person gives by hand; they survive every further run.

`manual.csv` has the columns `learner,exercise,points,comment`, in any order and with others between
them. Without points, the judge's points stay; without an exercise, the comment is about the whole
submission. A file that a person has edited is never written to. A line that cannot be used is
reported, nothing of it is published, and it does not affect other lines.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from rosbeat.grading.files import Row, csv_text, number, printable, read_table, write_whole
from rosbeat.grading.marks import DIGITS, HELD, LOOKED_AT, Gradebook, Graded, Mark
from rosbeat.grading.remarks import Remark
from rosbeat.grading.roster import Lookup, UnusableError

FILE = "manual.csv"
COLUMNS = ("learner", "exercise", "points", "comment")
#: The template has the name as well, for the person who fills it in.
_TEMPLATE = ("learner", "name", "exercise", "points", "comment")
#: What is said of an answer that was held, when it has points.
_LOOKED_AT = "Looked at by the instructor."


@dataclass(frozen=True)
class Line:
    """Hold one line of the file, as it is there."""

    number: int
    learner: str
    exercise: str
    points: str
    comment: str


@dataclass(frozen=True)
class Manual:
    """Hold all that is in the file."""

    lines: tuple[Line, ...] = ()
    remarks: tuple[Remark, ...] = ()


def read_manual(path: Path) -> Manual:
    """Read what was given by hand; nothing, if there is no file.

    Raises:
        GradingError: If there is such a file and it cannot be read.
    """
    if not path.exists():
        return Manual()
    table = read_table(path, COLUMNS)
    lines = [_line(row) for row in table.rows]
    told = tuple(one for one in lines if one.points or one.comment)
    if {"points", "comment"} & set(table.header):
        return Manual(told)
    return Manual(told, (_remark(1, "There is no column points and none comment."),))


def _line(row: Row) -> Line:
    return Line(row.line, *(row.cells.get(name, "") for name in COLUMNS))


def _remark(line: int, text: str) -> Remark:
    return Remark("manual", f"{FILE}, line {line}", text)


# Applying.


@dataclass(frozen=True)
class _Given:
    """Hold what was given for one exercise, or for the whole."""

    points: float | None = None
    comment: str = ""


def apply_manual(gradebook: Gradebook, manual: Manual) -> Gradebook:
    """Put points and comments that were given by hand into a gradebook.

    An exercise that was held for a person to look at has been looked at then, and says nothing else
    any more. `judged` stays what the judge gave. Points are points: they stay what was written when
    an exercise gets another worth.

    Returns:
        The gradebook with both; lines that could not be used are among its remarks.
    """
    lookup = Lookup(gradebook.learners)
    given: dict[tuple[str, str], _Given] = {}
    remarks = list(manual.remarks)
    for line in manual.lines:
        try:
            graded, mark = meant(line, lookup)
            points = points_by_hand(line.points, mark) if line.points else None
        except UnusableError as error:
            said = f"{error} Nothing is taken from this line. {error.to_try}"
            remarks.append(_remark(line.number, said))
            continue
        place = graded.learner, mark.exercise if mark else ""
        now = _Given(points, line.comment)
        given[place] = _merged(given.get(place, _Given()), now, line, remarks)
    learners = [_with(one, given) for one in gradebook.learners]
    return replace(gradebook, learners=tuple(learners), remarks=(*gradebook.remarks, *remarks))


def meant(line: Line, lookup: Lookup[Graded]) -> tuple[Graded, Mark | None]:
    """Return whom and which exercise a line is about; no exercise if it is about the whole.

    Raises:
        UnusableError: If there is no such learner or exercise.
    """
    graded, wanted = lookup.find(line.learner), line.exercise.strip("' ").casefold()
    if not line.exercise:
        return graded, None
    for mark in graded.marks:
        if mark.exercise in (wanted, f"0{wanted}"):  # 3a and 03a
            return graded, mark
    graded_are = ", ".join(mark.exercise for mark in graded.marks) or "none"
    raise UnusableError(
        f"There is no exercise {printable(line.exercise, 40)!r} among those that are graded.",
        f"Write one of these, or leave it empty for a comment about the whole: {graded_are}.",
    )


def points_by_hand(text: str, mark: Mark | None) -> float:
    """Return points that a person has written for an exercise.

    Raises:
        UnusableError: If it is no number of points that the exercise can have.
    """
    shown = printable(text, 40)
    if mark is None:
        raise UnusableError(
            f"Points ({shown}) belong to an exercise, and none is named.",
            "Write the exercise, such as 03a, or leave the points empty.",
        )
    to_try = f"Write a number from 0 to {number(mark.out_of)}, or nothing."
    try:
        points = float(text.replace(",", "."))
    except ValueError:
        raise UnusableError(f"{shown!r} is not a number of points.", to_try) from None
    if not 0 <= points <= mark.out_of:  # which no NaN is
        top = number(mark.out_of)
        raise UnusableError(f"{mark.exercise} has points from 0 to {top}, not {shown}.", to_try)
    return round(points, DIGITS)


def _merged(before: _Given, now: _Given, line: Line, remarks: list[Remark]) -> _Given:
    if before != _Given():
        about = "This learner and exercise have an earlier line too; the later one counts."
        remarks.append(_remark(line.number, about))
    points = before.points if now.points is None else now.points
    return _Given(points, now.comment or before.comment)


def _with(graded: Graded, given: dict[tuple[str, str], _Given]) -> Graded:
    marks = [
        _marked(mark, given.get((graded.learner, mark.exercise), _Given())) for mark in graded.marks
    ]
    whole = given.get((graded.learner, ""), _Given())
    comment = whole.comment or graded.comment
    excused = graded.excused and not any(mark.manual for mark in marks)
    return replace(graded, marks=tuple(marks), comment=comment, excused=excused)


def _marked(mark: Mark, given: _Given) -> Mark:
    commented = replace(mark, comment=given.comment or mark.comment)
    if given.points is None:
        return commented
    settled = replace(commented, points=given.points, manual=True)
    if mark.status == HELD:
        said = replace(settled, status=LOOKED_AT, cause=_LOOKED_AT)
        return replace(said, evidence="", hint="", mistake="")
    cause = f"Set by hand to {number(given.points)} of {number(mark.out_of)}. {mark.cause}".strip()
    return replace(settled, cause=cause)


# The template.


def template(gradebook: Gradebook) -> str:
    """Return a file to fill in, with a line for each exercise that is held."""
    rows: list[tuple[str, ...]] = [_TEMPLATE]
    for graded in gradebook.learners:
        held = [mark for mark in graded.marks if mark.status == HELD]
        rows += [(graded.learner, graded.name, mark.exercise, "", "") for mark in held]
    return "\ufeff" + csv_text(rows)


def write_template(path: Path, gradebook: Gradebook) -> bool:
    """Write the template, unless a person has written something into the file.

    Returns:
        Whether the file is now the template.

    Raises:
        GradingError: If it cannot be read or written.
    """
    if path.exists() and not _is_untouched(path):
        return False
    write_whole(path, template(gradebook))
    return True


def _is_untouched(path: Path) -> bool:
    table = read_table(path, COLUMNS)
    written = [row for row in table.rows if row.cells.get("points") or row.cells.get("comment")]
    return table.header == _TEMPLATE and not written
