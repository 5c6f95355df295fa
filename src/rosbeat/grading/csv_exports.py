"""Write tables as CSV: one to read, and one to upload for each learning platform.

Sources of the formats:

- Moodle: the offline grading worksheet. `mod/assign/feedback/offline/importgradeslib.php` requires
  the columns `Identifier` (`Participant` and the number in the names of downloaded files), `Grade`
  and `Last modified (grade)`, in the language of Moodle's interface, and accepts `Feedback
  comments`, which `mod/assign/feedback/comments/locallib.php` stores as HTML. `locallib.php` in
  the same folder as the first silently skips a row if its grade is empty or above the maximum.
- Canvas: the gradebook. `lib/gradebook_importer.rb` requires `Student`, `ID`, ... `Section` first.
  It finds a learner by the ID, which is in the names of downloaded files, and the assignment by its
  title, or by the number in parentheses after it. A row that begins with `Points Possible` gives
  the assignment's maximum points.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape

from rosbeat.grading.files import FORMULA_SIGNS, MOST_OF_A_CELL, csv_text, number, printable
from rosbeat.grading.marks import HELD, Gradebook, Graded, Mark

#: Excel takes a file for UTF-8 only if it begins with this; others skip it.
_BYTE_ORDER_MARK = "\ufeff"
_GRADES = (
    *("learner", "name", "system", "page", "exercise", "title", "status", "points", "out_of"),
    *("cause", "mistake", "late", "judged", "manual", "comment", "differs"),
)
_MOODLE = (
    *("Identifier", "Full name", "Email address", "Status", "Grade", "Maximum Grade"),
    *("Grade can be changed", "Last modified (submission)", "Last modified (grade)"),
    "Feedback comments",
)
_CANVAS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_POINTS_POSSIBLE = "Points Possible"
#: Signs of formulas as HTML, so that the file is harmless in a spreadsheet too.
_AS_HTML = {ord(sign): f"&#{ord(sign)};" for sign in FORMULA_SIGNS}
#: Characters of one sentence or comment in Moodle's feedback.
_MOST_OF_A_LINE = 2_000


def grades_csv(gradebook: Gradebook) -> str:
    """Return a row for each learner and exercise, with the cause, to open in a spreadsheet.

    It begins with a byte order mark: without one, Excel shows every name that is not ASCII wrong.
    """
    rows = [_GRADES, *(_row(one, mark) for one in gradebook.learners for mark in one.marks)]
    return _BYTE_ORDER_MARK + csv_text(rows)


def _row(graded: Graded, mark: Mark) -> tuple[str | float, ...]:
    return (
        *(graded.learner, graded.name, graded.system, mark.page, mark.exercise, mark.title),
        *(
            mark.status,
            "" if graded.excused else mark.points,
            mark.out_of,
            mark.cause,
            mark.mistake,
            _yes(mark.late),
        ),
        *(mark.judged, _yes(mark.manual), mark.comment, mark.differs),
    )


def _yes(is_so: bool) -> str:
    return "yes" if is_so else ""


def moodle_csv(gradebook: Gradebook) -> str:
    """Return Moodle's grading worksheet: "Upload grading worksheet" of an assignment takes it.

    Moodle has to be shown in English, the assignment's maximum grade has to be the learner's
    `out_of`, and for a second upload the instructor allows Moodle to update records that are newer.
    A learner with an exercise that is held has no grade yet; Moodle leaves such a row alone.

    Returns:
        The file; empty if nobody's submission came from Moodle.
    """
    learners = [one for one in gradebook.learners if one.system == "moodle"]
    return csv_text([_MOODLE, *map(_of_moodle, learners)]) if learners else ""


def _of_moodle(graded: Graded) -> tuple[str | float, ...]:
    grade = "" if graded.grade is None else graded.grade
    who = f"Participant {graded.learner}", graded.name, ""
    return *who, "", grade, graded.out_of, "Yes", "-", "-", _feedback(graded)


def _feedback(graded: Graded) -> str:
    """Return what Moodle shows to the learner, as HTML; no sentence breaks off at the end."""
    lines: list[str] = []
    room = MOST_OF_A_CELL
    for line in _feedback_lines(graded):
        room -= len(line)
        if room < 0:
            break
        lines.append(line)
    return "".join(lines)


def _feedback_lines(graded: Graded) -> Iterator[str]:
    if graded.excused:
        yield "<p>Nothing was handed in, so there is no grade.</p>"
    elif graded.is_settled:
        yield f"<p>{_html(number(graded.points))} of {_html(number(graded.out_of))} points.</p>"
    else:
        yield "<p>One of your exercises has no points yet; below is why.</p>"
    if graded.comment:
        yield f"<p>{_html(graded.comment)}</p>"
    for mark in graded.marks:
        reached = f"{number(mark.points)} of {number(mark.out_of)}"
        reached = "not settled yet" if mark.status == HELD else reached
        told = f"{mark.exercise}, {mark.title}: {reached}. {mark.cause}"
        comment = f"<br>{_html(mark.comment)}" if mark.comment else ""
        yield f"<p>{_html(told)}{comment}</p>"


def _html(text: str) -> str:
    lines = [printable(line, _MOST_OF_A_LINE) for line in text.splitlines()]
    return "<br>".join(escape(line).translate(_AS_HTML) for line in lines)


def canvas_csv(gradebook: Gradebook, assignment: str = "rosbeat") -> str:
    """Return Canvas's gradebook: "Import" of the gradebook takes it.

    A learner with an exercise that is held has no grade yet.

    Args:
        gradebook: A class.
        assignment: The assignment's title in Canvas, best with its number in brackets, as in
            `Publishers (4711)`. If there is none of that title, Canvas offers to make one.

    Returns:
        The file; empty if nobody's submission came from Canvas.
    """
    learners = [one for one in gradebook.learners if one.system == "canvas"]
    whole = max((one.out_of for one in learners), default=0.0)
    rows: list[tuple[str | float, ...]] = [(*_CANVAS, assignment)]
    rows.append((f"    {_POINTS_POSSIBLE}", "", "", "", "", whole))
    return csv_text([*rows, *map(_of_canvas, learners)]) if learners else ""


def _of_canvas(graded: Graded) -> tuple[str | float, ...]:
    grade = "" if graded.grade is None else graded.grade
    name = re.sub(rf"(?i){_POINTS_POSSIBLE}", "?", graded.name)  # no learner's row is that row
    return name, graded.learner, "", "", "", grade
