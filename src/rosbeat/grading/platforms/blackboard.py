"""Read downloads and rosters of Blackboard Learn, and write the table that its gradebook takes.

No Blackboard was at hand: the formats come from its help and from programs that read them.

- The download, "Assignment File Download", is `gradebook_COURSE_ASSIGNMENT_DATE.zip`. A file in it
  is `ASSIGNMENT_USERNAME_attempt_2026-11-25-15-14-00_FILE`, and each attempt has a text file of the
  same name without `_FILE`, which begins with `Name: Ana Muster (ana)` (kwurst/bb-file-cleanup;
  vangef/BBGradebookOrganiser; jeroendoggen/blackboard-analysis-tools).
- The table, "Work Offline" in Blackboard's help: a learner is found by `Username`, and a column by
  the number at the end of its heading, as in `Publishers [Total Pts: 8 Score] |123456`. A column
  without such a number becomes a new one.
- There is no upload of feedback files for several learners.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from contextlib import suppress
from datetime import datetime
from typing import TYPE_CHECKING

from rosbeat.grading.files import csv_text
from rosbeat.grading.marks import Graded
from rosbeat.grading.platforms.base import Owner, Platform, rest_of

if TYPE_CHECKING:
    from rosbeat.grading.archives import File

#: The name of a file. Its end is the learner's choice, so the first attempt in it counts.
_NAME = re.compile(
    r"(?s)(?P<attempt>(?P<head>.+?_(?P<id>[^_]+))_attempt_(?P<date>\d{4}(?:-\d\d){5}))"
    r"(?:_(?P<file>.+)|(?P<note>\.txt))"
)
#: The first line of the text file of an attempt.
_WHO = re.compile(r"\s*Name:\s*(?P<name>.+?)\s*\((?P<id>[^()]+)\)\s*")
#: Bytes of such a file that are looked at.
_MOST_OF_A_NOTE = 4_000


class Blackboard(Platform):
    """Describe Blackboard's assignment and gradebook.

    Args:
        people: Id and name of the learner of an attempt, by the beginning of its files' names.
    """

    name = "blackboard"
    title = "Blackboard"
    roster_columns = frozenset({"username", "last name", "first name", "student id"})
    id_columns = ("username",)

    def __init__(self, people: Mapping[str, tuple[str, str]] | None = None) -> None:
        self._people = people or {}

    def opened(self, files: Sequence[File]) -> Platform:
        """Return Blackboard with what the text files of this download say about people."""
        people: dict[str, tuple[str, str]] = {}
        heads: dict[tuple[tuple[str, ...], str], set[str]] = defaultdict(set)
        for file in files:
            match = _NAME.fullmatch(file.parts[-1])
            if match is None:
                continue
            who = _who(file) if match["note"] else None
            if who and match["head"].endswith(f"_{who['id']}"):
                people[match["attempt"]] = who["id"].strip(), who["name"]
            heads[file.parts[:-1], match["id"]].add(match["head"])
        for (_, name), several in heads.items():
            # Usernames with an underscore, and nothing says where they begin: nobody is mixed up.
            for head in several if len(several) > 1 else ():
                people.setdefault(head, (head, name))
        return Blackboard(people)

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return the learner whose username is in the name."""
        match = _NAME.fullmatch(parts[0])
        if match is None:
            return ()
        named = self._people.get(match["attempt"]) or self._people.get(match["head"])
        learner, name = named or (match["id"], match["id"])
        path = rest_of(match["file"] or "", *parts[1:])
        return (Owner(learner, name, path, self.name, handed_in=_seconds(match["date"])),)

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the marks: "Work Offline", "Upload" of the gradebook takes them.

        A learner with an exercise that is held has no grade yet.

        Args:
            learners: Those who handed in on Blackboard.
            assignment: The heading of the column, best as Blackboard's own table has it, with the
                number at its end.
        """
        rows: list[tuple[str | float, ...]] = [("Username", assignment)]
        for graded in learners:
            rows.append((graded.learner, "" if graded.grade is None else graded.grade))
        return csv_text(rows)


def _who(file: File) -> re.Match[str] | None:
    """Return id and name in the text file of an attempt; further lines are the learner's."""
    if file.problem or file.size > 1_000_000:
        return None
    with suppress(OSError):
        text = file.read()[:_MOST_OF_A_NOTE].decode("utf-8-sig", "replace")
        return _WHO.fullmatch(text.splitlines()[0]) if text.strip() else None
    return None


def _seconds(text: str) -> float | None:
    """Return a date in seconds since 1970, in the time zone of this computer."""
    try:
        return datetime.strptime(text, "%Y-%m-%d-%H-%M-%S").timestamp()
    except (ValueError, OverflowError, OSError):
        return None
