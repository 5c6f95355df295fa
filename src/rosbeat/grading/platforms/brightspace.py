"""Read downloads and rosters of Brightspace (D2L), and write its table of grades and feedback.

No Brightspace was at hand: the formats come from D2L's help and from programs that read them.

- The download of an assignment is a folder for each submission and an `index.html` that lists them.
  A folder's name has the user's number, that of the assignment, the name and the date, as in
  `104840-170649 - Ana Muster - Nov 26, 2025 933 PM`, with or without the colon in the time (public
  scripts: "File renaming logic for standardizing Brightspace assessment folder names", and
  `bsunzip.sh` of squell/bb-scripts). Older downloads put the same before each file's name.
- The table of grades, "Importing grades" on community.d2l.com (3538): a learner is found by
  `OrgDefinedId` or `Username`; the column of a numeric grade item is called as the item, followed
  by ` Points Grade`. An exported table ends each row with `End-of-Line Indicator` and `#`, and
  begins ids with `#`, so that spreadsheets leave them alone.
- The names in a download have neither of the two ids, so the table needs an export of the grades as
  a roster.
- "Grade Offline and Bulk Upload Feedback Files" (help of Carleton University): a zip with folders
  that are called as in the download.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from datetime import datetime

from rosbeat.grading.files import csv_text
from rosbeat.grading.marks import Graded
from rosbeat.grading.platforms.base import Feedback, Owner, Platform, rest_of

#: A folder's name, or the beginning of a file's. The first number is the user's, so what follows,
#: a name that a learner may have chosen included, cannot make it another's.
_NAME = re.compile(
    r"(?s)(?P<id>\d+)-\d+ ?- (?P<name>.+?) - (?P<date>[^-]{0,24}\b\d{4}\b[^-]{0,24})"
    r"(?: - (?P<file>.+))?"
)
_DATE = re.compile(
    r"(?:(?P<month>[A-Za-z]{3})[a-z]*\.? (?P<day>\d{1,2}),?"
    r"|(?P<day_first>\d{1,2}) (?P<month_second>[A-Za-z]{3})[a-z]*\.?,?)"
    r" (?P<year>\d{4}),? (?P<hour>\d{1,2})[:_.]?(?P<minute>\d{2}) ?(?P<half>[AaPp][Mm])?"
)
_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_INDEX = "index.html"
_ID, _USERNAME, _END = "orgdefinedid", "username", "end-of-line indicator"


class Brightspace(Platform):
    """Describe Brightspace's assignment and gradebook."""

    name = "brightspace"
    title = "Brightspace"
    id_columns = (_ID, _USERNAME)
    roster_has_ids = False

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return the user whose number the name begins with."""
        match = _NAME.fullmatch(parts[0])
        if match is None:
            return ()
        path = rest_of(match["file"] or "", *parts[1:])
        handed_in = _seconds(match["date"])
        return (Owner(match["id"], match["name"].strip(), path, self.name, handed_in=handed_in),)

    def is_own_file(self, name: str) -> bool:
        """Return whether it is the list of submissions."""
        return name == _INDEX

    def has_roster(self, header: Collection[str]) -> bool:
        """Return whether it is an export of the grades, with either of the two ids."""
        return _ID in header or {_USERNAME, _END} <= set(header)

    def person_id(self, cells: Mapping[str, str]) -> str:
        """Return the id without the sign that keeps it a text."""
        return super().person_id(cells).removeprefix("#").strip()

    def aliases(self, learner: str, details: Mapping[str, str]) -> tuple[str, ...]:
        """Return both ids of the roster."""
        return tuple(details[name].removeprefix("#") for name in _ids_in(details))

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the grades: "Import" of the gradebook takes them.

        Only learners whose line of the roster is known have a row. A learner with an exercise that
        is held has no grade yet.
        """
        known = [graded for graded in learners if _ids_in(graded.details)]
        columns = [
            (name, title)
            for name, title in ((_ID, "OrgDefinedId"), (_USERNAME, "Username"))
            if any(graded.details.get(name) for graded in known)
        ]
        head = (*(title for _, title in columns), f"{assignment} Points Grade")
        rows: list[tuple[str | float, ...]] = [(*head, "End-of-Line Indicator")]
        for graded in known:
            ids = (graded.details.get(name, "") for name, _ in columns)
            rows.append((*ids, "" if graded.grade is None else graded.grade, "#"))
        return csv_text(rows) if known else ""

    def feedback_files(self, feedback: Feedback) -> Iterator[tuple[str, str]]:
        """Yield the learner's page, once, in the folder of the last submission."""
        graded = feedback.graded
        parts = (part for _, path in graded.files for part in path.split("/")[:-1])
        # What a team shares stays in the folder of whoever handed it in.
        folders = [part for part in parts if _is_of(part, graded.learner)]
        if folders:
            yield f"{max(folders, key=_date_of)}/feedback.html", feedback.page


def _ids_in(details: Mapping[str, str]) -> list[str]:
    """Return which of the two ids of a learner are known."""
    return [name for name in Brightspace.id_columns if details.get(name)]


def _is_of(folder: str, learner: str) -> bool:
    match = _NAME.fullmatch(folder)
    return match is not None and match["id"] == learner


def _date_of(folder: str) -> float:
    match = _NAME.fullmatch(folder)
    return (_seconds(match["date"]) if match else None) or 0.0


def _seconds(text: str) -> float | None:
    """Return a date in seconds since 1970, in the time zone of this computer, if it is known."""
    match = _DATE.fullmatch(text.strip())
    if match is None:
        return None
    month = (match["month"] or match["month_second"]).casefold()
    day, hour = int(match["day"] or match["day_first"]), int(match["hour"])
    if match["half"]:
        hour = hour % 12 + 12 * (match["half"].casefold() == "pm")
    try:
        return datetime(
            int(match["year"]), _MONTHS.index(month) + 1, day, hour, int(match["minute"])
        ).timestamp()
    except (ValueError, OverflowError, OSError):  # a month in another language, a 31st of June
        return None
