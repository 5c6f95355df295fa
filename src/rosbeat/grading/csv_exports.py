"""Write the table of all marks that people open in a spreadsheet.

The tables that learning platforms take are in `platforms`.
"""

from __future__ import annotations

from rosbeat.grading.files import csv_text
from rosbeat.grading.marks import Gradebook, Graded, Mark

#: Excel takes a file for UTF-8 only if it begins with this; others skip it.
_BYTE_ORDER_MARK = "\ufeff"
_COLUMNS = (
    "learner",
    "name",
    "system",
    "page",
    "exercise",
    "title",
    "status",
    "points",
    "out_of",
    "cause",
    "mistake",
    "late",
    "judged",
    "deducted",
    "manual",
    "comment",
    "differs",
)


def grades_csv(gradebook: Gradebook) -> str:
    """Return a row for each learner and exercise, with the cause, to open in a spreadsheet.

    It begins with a byte order mark: without one, Excel shows every name that is not ASCII wrong.
    """
    rows = [_COLUMNS, *(_row(one, mark) for one in gradebook.learners for mark in one.marks)]
    return _BYTE_ORDER_MARK + csv_text(rows)


def _row(graded: Graded, mark: Mark) -> tuple[str | float, ...]:
    return (
        graded.learner,
        graded.name,
        graded.system,
        mark.page,
        mark.exercise,
        mark.title,
        mark.status,
        "" if graded.excused else mark.points,
        mark.out_of,
        mark.cause,
        mark.mistake,
        _yes(mark.late),
        mark.judged,
        mark.deduction or "",
        _yes(mark.manual),
        mark.comment,
        mark.differs,
    )


def _yes(is_so: bool) -> str:
    return "yes" if is_so else ""
