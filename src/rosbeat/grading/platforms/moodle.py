"""Read downloads and rosters of Moodle, and write its grading worksheet and its feedback files.

Sources of the formats, in Moodle's repository:

- The download, "Download all submissions", with and without folders: `mod/assign/locallib.php`,
  `download_submissions`.
- The offline grading worksheet: `mod/assign/feedback/offline/importgradeslib.php` requires the
  columns `Identifier` (`Participant` and the number in the names of downloaded files), `Grade` and
  `Last modified (grade)`, in the language of Moodle's interface, and accepts `Feedback comments`,
  which `mod/assign/feedback/comments/locallib.php` stores as HTML. `locallib.php` in the same
  folder as the first silently skips a row if its grade is empty or above the maximum.
- "Upload multiple feedback files in a zip": `mod/assign/feedback/file/importziplib.php`. A file's
  name consists of the learner's full name, the number in the names of downloaded files,
  `assignfeedback` and `file`, joined by underscores; the learner sees the rest.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from html import escape

from rosbeat.grading.files import FORMULA_SIGNS, MOST_OF_A_CELL, csv_text, number, printable
from rosbeat.grading.marks import HELD, Graded, late_note
from rosbeat.grading.platforms.base import Feedback, Owner, Platform, rest_of

#: `Ana Muster_4711_assignsubmission_file_`, and behind it the file's name if there are no folders.
#: A learner may choose that so that it looks like another one's: the first number counts.
_NAME = re.compile(r"(?s)(?P<name>.+?)_(?P<id>\d+)_assignsubmission_[a-z]+(?:_(?P<file>.*))?")
_COLUMNS = (
    "Identifier",
    "Full name",
    "Email address",
    "Status",
    "Grade",
    "Maximum Grade",
    "Grade can be changed",
    "Last modified (submission)",
    "Last modified (grade)",
    "Feedback comments",
)
#: Signs of formulas as HTML, so that the file is harmless in a spreadsheet too.
_AS_HTML = {ord(sign): f"&#{ord(sign)};" for sign in FORMULA_SIGNS}
#: Characters of one sentence or comment in the feedback.
_MOST_OF_A_LINE = 2_000
#: What a name in the names of feedback files must not have.
_NOT_IN_A_NAME = re.compile(r"[_/\\\x00-\x1f\x7f]+")


class Moodle(Platform):
    """Describe Moodle's assignment."""

    name = "moodle"
    title = "Moodle"
    roster_columns = frozenset({"identifier"})
    id_columns = ("identifier",)

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return the participant whose number is in the name."""
        match = _NAME.fullmatch(parts[0])
        if match is None:
            return ()
        file = rest_of(match["file"] or "", *parts[1:])
        return (Owner(match["id"], match["name"].strip(), file, self.name),)

    def person_id(self, cells: Mapping[str, str]) -> str:
        """Return the participant's number."""
        return super().person_id(cells).removeprefix("Participant ").strip()

    def aliases(self, learner: str, details: Mapping[str, str]) -> tuple[str, ...]:
        """Return what the column Identifier says."""
        return (f"Participant {learner}",)

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the grading worksheet: "Upload grading worksheet" of an assignment takes it.

        Moodle has to be shown in English, the assignment's maximum grade has to be the learner's
        `out_of`, and for a second upload the instructor allows Moodle to update records that are
        newer. A learner with an exercise that is held has no grade yet; Moodle leaves such a row
        alone.
        """
        return csv_text([_COLUMNS, *map(_row, learners)])

    def feedback_files(self, feedback: Feedback) -> Iterator[tuple[str, str]]:
        """Yield the learner's page, if Moodle's number is known."""
        graded = feedback.graded
        if graded.learner.isdecimal():
            name = _NOT_IN_A_NAME.sub(" ", graded.name).strip(" .~") or "learner"
            yield f"{name}_{graded.learner}_assignfeedback_file_feedback.html", feedback.page


def _row(graded: Graded) -> tuple[str | float, ...]:
    grade = "" if graded.grade is None else graded.grade
    who = f"Participant {graded.learner}", graded.name, ""
    return *who, "", grade, graded.out_of, "Yes", "-", "-", _comments(graded)


def _comments(graded: Graded) -> str:
    """Return what Moodle shows to the learner, as HTML; no sentence breaks off at the end."""
    lines: list[str] = []
    room = MOST_OF_A_CELL
    for line in _comment_lines(graded):
        room -= len(line)
        if room < 0:
            break
        lines.append(line)
    return "".join(lines)


def _comment_lines(graded: Graded) -> Iterator[str]:
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
        note = f" {late_note(mark)}" if mark.deduction else ""
        told = f"{mark.exercise}, {mark.title}: {reached}.{note} {mark.cause}"
        comment = f"<br>{_html(mark.comment)}" if mark.comment else ""
        yield f"<p>{_html(told)}{comment}</p>"


def _html(text: str) -> str:
    lines = [printable(line, _MOST_OF_A_LINE) for line in text.splitlines()]
    return "<br>".join(escape(line).translate(_AS_HTML) for line in lines)
