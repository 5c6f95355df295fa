"""Read downloads and rosters of Canvas, and write its gradebook and its feedback files.

Sources of the formats, in Canvas's repository:

- The download, "Download Submissions": `app/models/content_zipper.rb`. It dates every file at the
  moment of the download (`get_output_stream`), and writes LATE into the names of those that are.
- The gradebook: `lib/gradebook_importer.rb` requires `Student`, `ID`, ... `Section` first. It finds
  a learner by the ID, which is in the names of downloaded files, and the assignment by its title,
  or by the number in parentheses after it. A row that begins with `Points Possible` gives the
  assignment's maximum points.
- "Upload Submissions": `infer_comment_context_from_filename` of
  `app/models/abstract_assignment.rb`. A file's name is that of a downloaded file. Learners see the
  name of the file that they submitted, whatever the content is. The feedback is therefore a
  notebook, as their submission was.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from rosbeat.grading.files import csv_text
from rosbeat.grading.marks import Graded
from rosbeat.grading.platforms.base import Feedback, Owner, Platform, rest_of

#: `musterana_LATE_4711_998877_page-1.ipynb`; the number before the suffix counts attempts.
_NAME = re.compile(
    r"(?s)(?P<name>[^_]+)_(?P<late>LATE_)?(?P<id>\d+)_(?P<submission>\d+)_(?P<file>.+)"
)
_ATTEMPT = re.compile(r"(?s)(?P<stem>.+)-(?P<number>\d{1,3})(?P<suffix>\.\w+)")
_COLUMNS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
_POINTS_POSSIBLE = "Points Possible"
#: Rows of the gradebook that are no learner.
_NOBODY = re.compile(r"(?i)points possible|student, test|test student")


class Canvas(Platform):
    """Describe Canvas's assignment and gradebook."""

    name = "canvas"
    title = "Canvas"
    dates_files = False
    roster_columns = frozenset({"student", "id", "section"})
    id_columns = ("id",)

    def owners(self, parts: tuple[str, ...]) -> tuple[Owner, ...]:
        """Return the learner whose number is in the name."""
        match = _NAME.fullmatch(parts[0])
        if match is None:
            return ()
        numbered = _ATTEMPT.fullmatch(match["file"])
        file = numbered["stem"] + numbered["suffix"] if numbered else match["file"]
        attempt = int(numbered["number"]) if numbered else 0
        path = rest_of(file, *parts[1:])
        late = bool(match["late"])
        return (Owner(match["id"], match["name"].strip(), path, self.name, late, attempt),)

    def person_id(self, cells: Mapping[str, str]) -> str:
        """Return Canvas's number; the gradebook has rows of nobody, too."""
        return "" if _NOBODY.search(cells.get("student", "")) else super().person_id(cells)

    def table(self, learners: Sequence[Graded], assignment: str) -> str:
        """Return the gradebook: "Import" of the gradebook takes it.

        A learner with an exercise that is held has no grade yet.

        Args:
            learners: Those who handed in on Canvas.
            assignment: The assignment's title, best with its number in parentheses, as in
                `Publishers (4711)`. If there is none of that title, Canvas offers to make one.
        """
        whole = max((graded.out_of for graded in learners), default=0.0)
        rows: list[tuple[str | float, ...]] = [(*_COLUMNS, assignment)]
        rows.append((f"    {_POINTS_POSSIBLE}", "", "", "", "", whole))
        return csv_text([*rows, *map(_row, learners)])

    def feedback_files(self, feedback: Feedback) -> Iterator[tuple[str, str]]:
        """Yield a notebook for each page under the name that Canvas gave to the submitted one."""
        for lesson, path in feedback.graded.files:
            match = next(filter(None, map(_NAME.fullmatch, path.split("/"))), None)
            # What a team shares goes back to whoever handed it in.
            is_own = match is not None and match["id"] == feedback.graded.learner
            if match and is_own and match[0].endswith(".ipynb"):
                yield match[0], feedback.notebook(lesson)


def _row(graded: Graded) -> tuple[str | float, ...]:
    grade = "" if graded.grade is None else graded.grade
    name = re.sub(rf"(?i){_POINTS_POSSIBLE}", "?", graded.name)  # no learner's row is that row
    return name, graded.learner, "", "", "", grade
