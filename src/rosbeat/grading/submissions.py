"""Whether what somebody points at can be submissions at all; an empty class is a slip, no success.

Whoever names the wrong folder finds out here, before anything is written.
"""

from __future__ import annotations

from pathlib import Path

from rosbeat.errors import GradingError
from rosbeat.grading.collecting import Collection
from rosbeat.grading.ledger import FILE as LEDGER
from rosbeat.grading.release import MARKER
from rosbeat.grading.remarks import Remark, printable

#: Remarks about files that somebody meant to be a page.
_ATTEMPTS = {"empty", "half-uploaded", "unreadable", "too-large", "refused"}
_MEANS = """\
Nothing was written. Submissions are the zip file that Moodle or Canvas lets you download,
                 or a folder (or a zip file) for each learner with pages of the course in it, as
                 ana/03_write_a_publisher.ipynb  and  ben/03_write_a_publisher.ipynb  are."""
_TRY = "Give that zip file or folder; docs/instructors.md shows what it may look like."


def require_submissions(source: Path, found: Collection, pages_named: bool) -> None:
    """Refuse what holds no submission.

    Args:
        source: What somebody has pointed at.
        found: What was found in it.
        pages_named: Whether it is known without any page which ones count. Then a class in which
            nobody has handed in a page that can be read is a class all the same.

    Raises:
        GradingError: If it is a release, or there is neither a page nor a try of one.
    """
    if (source / MARKER).is_file():
        raise GradingError(f"{_name(source)} is what learners get, a release.", _MEANS, _TRY)
    if any(one.pages for one in found.submissions):
        return
    if pages_named and _somebody_tried(found):
        return
    raise GradingError(f"{_name(source)} has no submission in it: {_why(source, found)}", _MEANS,
                       _TRY)  # fmt: skip


def require_apart(source: Path, out: Path) -> None:
    """Refuse a folder of results among the submissions: the next run would take it for a learner.

    Args:
        source: The submissions.
        out: The folder for results.

    Raises:
        GradingError: If one is in the other's place, or in it.
    """
    if out.resolve().is_relative_to(source.resolve()):
        raise GradingError(
            f"The results would lie in the folder of the submissions, {_name(source)}.",
            "The next run would take them for something that was handed in; nothing was written.",
            "Name a folder beside it:  --out ~/class/grades",
        )


def _name(source: Path) -> str:
    return printable(str(source), 1000)


def _somebody_tried(found: Collection) -> bool:
    return any(
        one.system != "folder" or any(remark.about in _ATTEMPTS for remark in one.remarks)
        for one in found.submissions
    )


def _why(source: Path, found: Collection) -> str:
    remarks = [*found.remarks, *(one for each in found.submissions for one in each.remarks)]
    if not remarks:
        return "it is empty."
    if (source / LEDGER).is_file():
        return "it is a folder of results."
    one = len(remarks) == 1
    none = "its one file is no" if one else f"of its {len(remarks)} files none is a"
    return f"{none} learner's page of this course. {_example(remarks[0])}"


def _example(remark: Remark) -> str:
    return f"For example {remark.path}: {remark.text}"
